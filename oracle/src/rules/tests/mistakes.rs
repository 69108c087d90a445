use super::super::limits::{LINES, MISTAKES};
use super::*;

/// Where the mistakes are.
fn places(errors: &RuleErrors) -> Vec<(usize, usize)> {
    errors.iter().map(|error| (error.line, error.column)).collect()
}

#[test]
fn every_mistake_is_reported_in_the_order_of_the_file() {
    let text = "\
# ours
a: never sped > 5 or ASMSS on and AS_STATE is READY
b: > 3
c: always asms
a: never ANGLE > 5 rpm
b: after wheel on, Go on until TSMM off within 3 s
d: always EBS_STATE is EBS_FAULT
";
    let everywhere = [(2, 10), (2, 22), (2, 47), (3, 4), (5, 1), (5, 20), (6, 1), (6, 10), (6, 32)];
    assert_eq!(places(&mistakes(text)), everywhere);
    let of_3_0 = RuleFile::read(text, Some(&Edition::V3_0)).expect_err("it has no EBS_STATE");
    assert_eq!(places(&of_3_0), [&everywhere[..], &[(7, 11)]].concat());
    assert_eq!(
        of_3_0.first().why.split(';').next(),
        Some("found \"sped\", which is no signal and no condition of edition 3.0")
    );
    let lines: Vec<String> = of_3_0.to_string().lines().map(str::to_owned).collect();
    assert_eq!(lines.len(), 10);
    assert!(lines[3].starts_with("line 3, column 4: found \">\"; expected always"), "{lines:#?}");
}

#[test]
fn further_mistakes_are_counted() {
    let wrong = |count: usize| -> String {
        let lines: Vec<String> = (0..count).map(|line| format!("a{line}: never sped\n")).collect();
        lines.concat()
    };
    for (count, more) in
        [(MISTAKES, None), (MISTAKES + 1, Some("and 1 more mistake")), (LINES, Some("and 980 more mistakes"))]
    {
        let errors = mistakes(&wrong(count));
        assert_eq!((errors.iter().count(), errors.more()), (MISTAKES, count - MISTAKES));
        assert_eq!(errors.and_more().as_deref(), more);
        assert_eq!(errors.to_string().lines().nth(MISTAKES), more);
    }
}

/// A file of any length is refused soon: what is only counted is not looked into, and what is too long is not read.
#[test]
fn a_file_full_of_mistakes_takes_no_longer_than_one_of_rules() {
    let line = |name: usize| format!("a{name}: never {}\n", vec!["sped"; 240].join(" or "));
    let errors = mistakes(&(0..2 * LINES).map(line).collect::<String>());
    assert_eq!(errors.iter().count() + errors.more(), 240 * LINES + 1);
}

#[test]
fn a_name_that_some_edition_has_may_be_what_the_log_speaks() {
    for (text, having) in [
        ("a: never AS_STATE == AS_INIT", "2026"),
        ("a: never SM_AS == 3", "4.0"),
        ("a: never EBS_STATE is EBS_FAULT\nb: always 520h.AS_STATE is not AS_INIT", "2026"),
    ] {
        let file: RuleFile = text.parse().expect(text);
        for edition in Edition::ALL {
            match file.check(edition) {
                Ok(()) => assert_eq!(edition.version, having, "{text}"),
                Err(errors) => {
                    let lacks = format!("edition {} has no such ", edition.version);
                    assert!(
                        edition.version != having && errors.iter().all(|error| error.why.contains(&lacks)),
                        "{errors}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_name_that_no_edition_has_is_refused_at_once_with_the_nearest_of_all() {
    for (text, column, why) in [
        (
            "a: never EBS_STAT is EBS_FAULT",
            10,
            "is no signal and no condition of any edition; expected EBS_STATE",
        ),
        ("a: never SM_A == 3", 10, "is no signal and no condition of any edition; expected SM_AS"),
        ("a: never VCU2AI_Stats.AS_STATE == 3", 10, "is no message of any edition; expected VCU2AI_Status"),
        (
            "a: never AS_STATE is READY",
            22,
            "is no word of AS_STATE; expected AS_INIT, AS_OFF, AS_READY, AS_DRIVING, EMERGENCY_BRAKE or AS_FINISHED",
        ),
        ("a: never AS_STATE is AS_INI", 22, "AS_INIT"),
        ("a: never ANGLE > 5 rpm", 20, "found \"rpm\"; expected deg, as ANGLE is"),
        ("a: never EBS_STATE > 5", 22, "EBS_STATE has words"),
        ("a: never HANDSHAKE on", 10, "expected one of AI2VCU_Status.HANDSHAKE, VCU2AI_Status.HANDSHAKE"),
    ] {
        let error = refused(text);
        assert_eq!((error.line, error.column), (1, column), "{text}: {error}");
        assert!(error.why.contains(why), "{text}: {error}");
    }
}

/// Each of the names is in some edition, and the file in none: no log can make it right.
#[test]
fn rules_that_no_edition_has_together_are_refused_at_once() {
    let errors = mistakes("a: never AS_STATE == AS_INIT\nb: never moving or SM_AS == 3");
    assert_eq!(places(&errors), [(1, 22), (2, 20)]);
    let why = |version| {
        format!(
            "found what only edition {version} has, and no edition has all that these rules name; expected rules of one edition"
        )
    };
    assert!(errors.iter().map(|error| error.why.clone()).eq([why("2026"), why("4.0")]), "{errors}");
}
