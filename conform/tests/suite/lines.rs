//! A suite is read as it is written, and the error names the line of what is no test of it, what was found and what was expected.

use std::io::{self, BufReader};

use adsdv_conform::protocol::{Request, SHOWN, Shown};
use adsdv_conform::suite::{self, Kind, Test};
use adsdv_spec::{AsState, Edition, Machine};

use crate::tests;

#[test]
fn a_suite_is_read_as_it_is_written() {
    let tests = tests();
    let text: String = tests.iter().map(|test| test.to_line(&Machine::REFERENCE) + "\n").collect();
    let read = suite::read(text.as_bytes(), &Machine::REFERENCE).unwrap();
    assert_eq!(read.bad, []);
    assert_eq!(read.tests, tests);
    assert_eq!(text.lines().count(), tests.len());
    // The lines that a program is asked are those of the scenario.
    let requests: Vec<Request> = tests[0].scenario.requests().collect();
    assert_eq!((&requests[0], requests.len()), (&Request::Reset, tests[0].scenario.steps.len() + 1));
}

/// One line of the suite with something in it changed.
fn changed(from: &str, to: &str) -> String {
    let line = tests()[1].to_line(&Machine::REFERENCE);
    assert!(line.contains(from), "{line}");
    line.replacen(from, to, 1)
}

#[test]
fn bad_lines_are_reported_and_lose_nothing_else() {
    let good = tests();
    let line = |test: &Test| test.to_line(&Machine::REFERENCE);
    for (bad, found, expected) in [
        ("nonsense".to_owned(), "column 2", "a test as one JSON object"),
        ("{}".to_owned(), "missing field", "a test as one JSON object"),
        ("[]".to_owned(), "invalid", "a test as one JSON object"),
        (line(&good[1])[..100].to_owned(), "EOF", "a test as one JSON object"),
        (changed("\"kind\":\"", "\"kind\":\"x"), "xcondition", "row, condition, limit"),
        (changed("\"reading\":null", "\"reading\":\"taste\""), "taste", "fault-trigger"),
        (changed("\"dt_ms\":10", "\"dt_ms\":-1"), "-1", "u32"),
        (
            changed("\"inputs\":{", "\"inputs\":{\"gas\":true,"),
            "step 1: there is no key \"gas\"",
            "steer_angle",
        ),
        (changed("\"as_state\":\"AS_", "\"as_state\":\"AT_"), "as_state is AT_OFF", "AS_OFF"),
        (changed("\"as_state\":\"AS_OFF\"", "\"as_state\":\"AS_READY\""), "as_state is AS_READY", "AS_OFF"),
        (line(&good[0]), "is there already", "one of its own"),
        (
            changed("\"requirements\":[\"", "\"requirements\":[\"<b>\",\""),
            "\"<b>\", which there is not",
            "such as \"HS-9\"",
        ),
        (
            changed("\"requirements\":[\"", "\"requirements\":[\"HS-99\",\""),
            "\"HS-99\", which there is not",
            "of spec/REQUIREMENTS.md",
        ),
        (changed("\"RDY-2\"", "\"RDY-02\""), "\"RDY-02\", which there is not", "of spec/REQUIREMENTS.md"),
        (changed("\"expected\":", "\"foreseen\":"), "unknown field `foreseen`", "`expected`"),
        (changed("\"dt_ms\":10,", ""), "missing field `dt_ms`", "a test as one JSON object"),
        (changed("\"dt_ms\":10,", "\"dt_ms\":10,\"times\":0,"), "step 1: \"times\" is 0", "1 to 20000"),
        (changed("\"dt_ms\":10,", "\"dt_ms\":10,\"times\":20001,"), "\"times\" is 20001", "1 to 20000"),
        (
            r#"{"steps":[{"dt_ms":10,"answers":true,"inputs":{"handshake":true}}]}"#.to_owned(),
            "\"answers\" says what \"handshake\" is",
            "one of them",
        ),
        (changed("\"as_state\":\"AS_OFF\",", ""), "step 1: there is no \"as_state\"", "at least that"),
        (changed("\"edition\":\"3.0\"", "\"edition\":\"4.0\""), "\"edition\" is \"4.0\"", "\"3.0\""),
        (changed("\"schema\":1", "\"schema\":2"), "\"schema\" is 2", "expected 1"),
        (changed("\"name\":\"3.1-but-asms\"", "\"name\":\"\""), "\"name\" is empty", "a name of its own"),
        (
            r#"{"name":"a","kind":"row","about":"","section":"3.1","requirements":[],"reading":null,"steps":[]}"#
                .to_owned(),
            "\"steps\" is empty",
            "at least one step",
        ),
        ("{\"name\":\"\u{fffd}\"".to_owned(), "EOF", "a test as one JSON object"),
    ] {
        let text = format!("{}\n\n{bad}\n{}", line(&good[0]), line(&good[2]));
        let read = suite::read(text.as_bytes(), &Machine::REFERENCE).unwrap();
        assert_eq!(read.tests, [good[0].clone(), good[2].clone()], "{bad}");
        let said = read.bad[0].to_string();
        assert!(read.bad.len() == 1 && said.starts_with("line 3: "), "{said}");
        assert!(said.contains(found) && said.contains(expected), "{bad}: {said}");
    }
    let read = suite::read(&b"\xff\xfe\n"[..], &Machine::REFERENCE).unwrap();
    assert!(read.bad[0].to_string().contains("line 1: is not UTF-8"));
    assert_eq!(suite::read(&b""[..], &Machine::REFERENCE).unwrap(), suite::ReadSuite::default());
}

/// What is expected is all that a step shows.
#[test]
fn every_output_is_expected_in_every_step() {
    let test = &tests()[0];
    let line = test.to_line(&Machine::REFERENCE);
    let shown: Vec<Shown> = test.scenario.shown(&Machine::REFERENCE).collect();
    assert!(shown.iter().all(|shown| line.contains(&format!("\"expected\":{shown}"))));
    assert!(
        SHOWN
            .iter()
            .filter(|field| field.is_in(Edition::DEFAULT))
            .all(|field| line.contains(&format!("\"{}\":", field.key)))
    );
}

/// As suites were before there was another edition.
#[test]
fn a_line_that_names_no_edition_is_of_3_0() {
    let line = changed("\"schema\":1,\"edition\":\"3.0\",", "");
    assert_eq!(suite::read(line.as_bytes(), &Machine::default()).unwrap().tests, [tests()[1].clone()]);
    let other = Machine::new(Edition { version: "test", ..Edition::V3_0 }, Edition::V3_0.readings);
    let said = suite::read(line.as_bytes(), &other).unwrap().bad[0].to_string();
    assert!(said.contains("\"edition\" is \"3.0\"; expected \"test\""), "{said}");
}

/// A test may expect less than all, and be about a requirement for which no test is generated.
#[test]
fn a_test_of_ones_own_is_read() {
    let line = r#"{"name":"mine","kind":"row","about":"","section":"3.1","requirements":["MSG-29","HS-9"],"reading":null,"#;
    let line =
        format!(r#"{line}"steps":[{{"dt_ms":10,"inputs":{{}},"expected":{{"as_state":"AS_OFF"}}}}]}}"#);
    let read = suite::read(line.as_bytes(), &Machine::REFERENCE).unwrap();
    assert_eq!(read.bad, []);
    assert_eq!(read.tests[0].requirements, ["MSG-29", "HS-9"]);
}

/// What a person writes in a minute: steps, how often, and that the AI Computer answers. What is expected the edition says.
#[test]
fn a_test_needs_steps_and_nothing_else() {
    let inputs =
        r#""inputs":{"asms":true,"tsms":true,"ami":"SKIDPAD","ebs":"ARMED","mission_status":"SELECTED"}"#;
    let line = format!(
        r#"{{"steps":[{{"dt_ms":10}},{{"dt_ms":10,"times":30,"answers":true,{inputs}}},{{"dt_ms":10,"times":7,"answers":false,{inputs}}}]}}"#
    );
    let read = suite::read(format!("\n{line}\n").as_bytes(), &Machine::REFERENCE).unwrap();
    assert_eq!(read.bad, []);
    let test = &read.tests[0];
    assert_eq!((test.name.as_str(), test.kind, test.scenario.steps.len()), ("line 2", Kind::Written, 38));
    let outputs: Vec<_> = test.scenario.run(&Machine::REFERENCE).map(|(_, outputs)| outputs).collect();
    assert!(outputs[1..34].iter().all(|outputs| outputs.state == AsState::Ready), "answered");
    assert_eq!(outputs.last().map(|outputs| outputs.state), Some(AsState::EmergencyBrake), "unanswered");
}

/// Every test of the suite, written in the short form and read again, is the same scenario.
#[test]
fn a_scenario_that_is_written_as_a_test_is_read_as_it_was() {
    for edition in Edition::ALL {
        let machine = Machine::new(**edition, edition.readings);
        for test in suite::generate(edition) {
            let line = test.scenario.to_line(&test.name, &machine).to_string();
            let read = suite::read(line.as_bytes(), &machine).unwrap();
            assert_eq!(read.bad, [], "{line}");
            assert_eq!(read.tests[0].scenario, test.scenario, "{line}");
        }
    }
}

#[test]
fn a_suite_of_repeated_steps_without_end_is_cut() {
    let line = r#"{"steps":[{"dt_ms":1,"times":20000}]}"#;
    let read = suite::read([line; 60].join("\n").as_bytes(), &Machine::REFERENCE).unwrap();
    assert_eq!((read.tests.len(), read.bad.len()), (50, 10));
    assert!(read.bad[0].to_string().contains("line 51: 20000 steps are too many; expected at most 1000000"));
}

/// Names are looked up, not compared one by one: a suite of many tests is read in time that grows with its length.
#[test]
fn a_repeated_name_is_reported_however_far_away_the_other_one_is() {
    let line = tests()[1].to_line(&Machine::REFERENCE);
    let named = |number: u32| line.replacen("\"3.1-but-asms\"", &format!("\"{number}\""), 1) + "\n";
    let text: String = (0..2000).chain([0]).map(named).collect();
    let read = suite::read(text.as_bytes(), &Machine::REFERENCE).unwrap();
    assert_eq!((read.tests.len(), read.bad.len()), (2000, 1));
    assert_eq!(
        read.bad[0].to_string(),
        "line 2001: the name \"0\" is there already; expected one of its own"
    );
}

/// A line as long as a line may be is read; a longer one is reported, and is not kept in memory, however long it is.
#[test]
fn a_line_that_is_too_long_costs_itself_alone() {
    let good = tests();
    let line = |index: usize| good[index].to_line(&Machine::REFERENCE);
    let padded = |index: usize, len: usize| line(index) + &" ".repeat(len - 1 - line(index).len()) + "\n";
    let text = [
        padded(0, suite::MAX_LINE),
        padded(1, suite::MAX_LINE + 1),
        line(2) + "\n",
        "x".repeat(3 * suite::MAX_LINE) + "\n",
        line(3) + "\n",
        "x".repeat(suite::MAX_LINE + 1),
    ]
    .concat();
    for capacity in [100, 1 << 16, text.len()] {
        let reader = BufReader::with_capacity(capacity, text.as_bytes());
        let read = suite::read(reader, &Machine::REFERENCE).unwrap();
        assert_eq!(read.tests, [good[0].clone(), good[2].clone(), good[3].clone()]);
        let said: Vec<String> = read.bad.iter().map(ToString::to_string).collect();
        let errors = |line: u64| {
            format!("line {line}: is longer than 4194304 bytes; expected a test as one JSON object")
        };
        assert_eq!(said, [errors(2), errors(4), errors(6)]);
    }
}

#[test]
fn of_many_bad_lines_the_first_are_reported_and_the_others_counted() {
    for (lines, more) in [(suite::MAX_BAD, 0), (suite::MAX_BAD + 2, 2)] {
        let read = suite::read("x\n".repeat(lines).as_bytes(), &Machine::REFERENCE).unwrap();
        assert_eq!((read.bad.len(), read.more_bad), (suite::MAX_BAD, more));
        assert_eq!(read.bad.last().map(|bad| bad.line), u64::try_from(suite::MAX_BAD).ok());
    }
}

/// A reader whose system call is interrupted before each piece, and which may fail in the end.
struct Fitful<'a> {
    pieces: std::slice::Chunks<'a, u8>,
    interrupted: bool,
    fails: bool,
}

impl io::Read for Fitful<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.interrupted = !self.interrupted;
        if self.interrupted {
            return Err(io::ErrorKind::Interrupted.into());
        }
        match self.pieces.next() {
            Some(mut piece) => piece.read(buffer),
            None if self.fails => Err(io::Error::other("the disk is gone")),
            None => Ok(0),
        }
    }
}

#[test]
fn an_interrupted_read_goes_on_and_a_failed_one_is_reported() {
    let tests = &tests()[..2];
    let text: String = tests.iter().map(|test| test.to_line(&Machine::REFERENCE) + "\n").collect();
    let read = |fails| {
        let pieces = text.as_bytes().chunks(100);
        suite::read(BufReader::new(Fitful { pieces, interrupted: false, fails }), &Machine::REFERENCE)
    };
    assert_eq!(read(false).unwrap().tests, tests);
    assert_eq!(read(true).unwrap_err().to_string(), "the disk is gone");
}
