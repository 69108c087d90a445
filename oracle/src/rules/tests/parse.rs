use super::super::limits::{CHARACTERS, DEPTH, LINES};
use super::super::syntax::Form;
use super::*;

#[test]
fn each_form_is_read_as_what_it_is() {
    let text = "\u{feff}# ours\r
a: always Go on\r
b: NEVER Go on and not (ASMS off or TSMS is off) \"of  two\twords\" # and a comment with a \"\n\
c: never Go on for 3 s
d: Go on for at most 1500ms
e: after Go on, ASMS on within 0.25 s
f: after Go on, ASMS on for 3600 s
g: after Go on, ASMS on until TSMS off within 1 ms
h: after Go on, ASMS on until TSMS off

   i : Go on until ASMS off";
    let file: RuleFile = text.parse().expect("every form");
    let found = file.rules.iter().map(|line| {
        let form = match &line.form {
            Form::Always(_) => "always".to_owned(),
            Form::Never(_) => "never".to_owned(),
            Form::AtMost(_, ns) => format!("at most {ns}"),
            Form::Within(.., ns) => format!("within {ns}"),
            Form::Throughout(.., ns) => format!("throughout {ns}"),
            Form::Until(premise, .., ns) => format!("until {} {ns:?}", premise.is_some()),
        };
        format!("{} {} {form}", line.number, line.name)
    });
    let expected = [
        "2 a always",
        "3 b never",
        "4 c at most 3000000000",
        "5 d at most 1500000000",
        "6 e within 250000000",
        "7 f throughout 3600000000000",
        "8 g until true Some(1000000)",
        "9 h until true None",
        "11 i until false None",
    ];
    assert!(found.eq(expected), "{file:#?}");
    assert_eq!(file.rules[1].note.as_deref(), Some("of two words"));
    assert_eq!(file.rules[1].rule, "NEVER Go on and not (ASMS off or TSMS is off)");
    assert_eq!((file.len(), file.is_empty()), (9, false));
    assert!(file.check(&Edition::V3_0).is_ok());
}

#[test]
fn what_is_wrong_is_reported_with_its_place() {
    let deep = format!("a: always {}Go", "not ".repeat(DEPTH + 1));
    let cases = [
        ("", 1, 1, 1, "found no rule; expected a line such as "),
        ("# nothing\n\n# here", 3, 1, 1, "found no rule"),
        ("3: always Go on", 1, 1, 1, "found 3; expected the name of a rule"),
        ("calm never Go on", 1, 6, 5, "found \"never\"; expected a colon behind the name of the rule"),
        ("a: Go on", 1, 9, 1, "found the end of the line; expected until, or for at most"),
        ("a: > 3", 1, 4, 1, "found \">\"; expected always, never, after, or a condition"),
        ("a: always Go on\nb: always Go on\na: never Go on", 3, 1, 1, "line 1 has a rule of this name"),
        ("a: always", 1, 10, 1, "found the end of the line; expected the name of a signal or a condition"),
        ("a: always until on", 1, 11, 5, "found \"until\"; expected the name of a signal or a condition"),
        ("a: after Go on ASMS off for 3 s", 1, 16, 4, "found \"ASMS\"; expected a comma, and what is to be"),
        (
            "a: after Go on, ASMS off # soon",
            1,
            25,
            1,
            "found the end of the line; expected within, for or until",
        ),
        ("a: after Go on, ASMS off within soon", 1, 33, 4, "found \"soon\"; expected a time, such as 3 s"),
        ("a: after Go on, ASMS off within 3", 1, 34, 1, "expected s or ms behind the number"),
        ("a: never Go on for 3 min", 1, 22, 3, "found \"min\"; expected s or ms"),
        ("a: never Go on for 0.9 ms", 1, 20, 6, "found a time out of range; expected 1 ms to 3600 s"),
        ("a: never Go on for 3600.001 s", 1, 20, 10, "found a time out of range"),
        ("a: never Go on for -3 s", 1, 20, 4, "found a time out of range"),
        ("a: never Go on for 1234567890123 s", 1, 20, 13, "found 13 digits; expected at most 12"),
        ("a: Go on for 3 s", 1, 14, 1, "found 3; expected until, or for at most"),
        (
            "a: always (Go on",
            1,
            17,
            1,
            "found the end of the line; expected and, or, or a closing parenthesis",
        ),
        (
            "a: always Go on)",
            1,
            16,
            1,
            "found \")\"; expected and, or, a text in quotes, or the end of the line",
        ),
        ("a: always speed = 5", 1, 17, 1, "found \"=\"; expected ==, or another comparison"),
        ("a: always speed > on", 1, 19, 2, "found \"on\"; expected a number"),
        ("a: always speed ==", 1, 19, 1, "expected a number, or a word that the signal has"),
        ("a: always abs(speed)", 1, 21, 1, "expected a comparison with a number, such as > 5"),
        (
            "a: always abs(speed > 5",
            1,
            21,
            1,
            "found \">\"; expected a closing parenthesis behind the signal",
        ),
        ("a: always 510h.", 1, 16, 1, "expected the name of a signal behind that of its message"),
        (
            "a: always Go on \"not\u{7}ended",
            1,
            17,
            10,
            "a text in quotes does not end; expected \" at its end",
        ),
        (
            "a: always Go & ASMS",
            1,
            14,
            1,
            "found '&'; expected a word, a number, a comparison or a parenthesis",
        ),
        (
            &deep,
            1,
            11 + 4 * DEPTH,
            3,
            "found \"not\"; expected at most 50 parentheses and nots in one another",
        ),
    ];
    for (text, line, column, width, why) in cases {
        let error = refused(text);
        assert_eq!((error.line, error.column, error.width), (line, column, width), "{text}: {error}");
        assert!(error.why.starts_with(why) || error.why.ends_with(why), "{text}: {error}");
        assert!(!error.text.contains(char::is_control), "{text:?}");
    }
}

#[test]
fn a_file_is_no_longer_than_is_judged() {
    let longest = format!("a: always Go on #{}", " ".repeat(CHARACTERS - 17));
    assert!(longest.parse::<RuleFile>().is_ok());
    let error = refused(&format!("{longest} "));
    assert_eq!((error.line, error.column, error.text.chars().count()), (1, CHARACTERS, CHARACTERS));
    let most = format!("{}a: always Go on", "\n".repeat(LINES - 1));
    assert!(most.parse::<RuleFile>().is_ok());
    assert_eq!(refused(&format!("{most}\n\n")).line, LINES + 1);
}

/// Of pieces that mean something, joined at random, and of any characters.
#[test]
fn no_text_is_more_than_refused() {
    let pieces = [
        "a",
        ":",
        "always",
        "never",
        "after",
        "until",
        "within",
        "for",
        "at",
        "most",
        "and",
        "or",
        "not",
        "is",
        "(",
        ")",
        ",",
        "abs",
        "Go",
        "on",
        "off",
        "AS_STATE",
        "AS_READY",
        "VEH_SPEED_ACTUAL",
        "510h.",
        ".",
        "==",
        "!=",
        ">",
        "<=",
        "=",
        "3",
        "-0.5",
        "99999999999999",
        "s",
        "ms",
        "km/h",
        "\"",
        "#",
        "\n",
        "\r",
        "\u{0}",
        "°",
        "é",
        "𝄞",
        "\u{feff}",
    ];
    let mut random = numbers(7);
    let (mut read, mut possible) = (0, 0);
    for _ in 0..30_000 {
        let count = random(14);
        let mut text = if random(2) == 0 { "a: always ".to_owned() } else { String::new() };
        for _ in 0..count {
            text.push_str(pieces[random(pieces.len())]);
            text.push_str(if random(4) == 0 { "" } else { " " });
        }
        match text.parse::<RuleFile>() {
            Ok(file) => {
                read += 1;
                possible += usize::from(file.check(&Edition::V2026).is_ok());
            }
            Err(errors) => {
                let mut last = (1, 0);
                for error in errors.iter() {
                    let line = text.split('\n').nth(error.line - 1).unwrap_or_default();
                    assert!(error.column <= line.chars().count() + 1 && error.width > 0, "{text:?}: {error}");
                    assert!(
                        last <= (error.line, error.column) && !error.why.is_empty(),
                        "{text:?}: {errors}"
                    );
                    last = (error.line, error.column);
                }
            }
        }
    }
    assert!(read > 20 && possible > 10, "{read} were read, and {possible} are possible");
}

/// Numbers below a bound that look random, the same in each run.
pub(super) fn numbers(seed: u64) -> impl FnMut(usize) -> usize {
    let mut random = fastrand::Rng::with_seed(seed);
    move |bound| random.usize(..bound)
}
