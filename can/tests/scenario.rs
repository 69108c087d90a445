//! Scenario files: what is read, what is refused and with which message, and when lines take place.

use std::fmt::Write as _;
use std::io::{self, BufRead, BufReader, Read};

use adsdv_can::car::{Action, Switch};
use adsdv_can::scenario::{MAX_BYTES, MAX_LINE, Player, Scenario, Unreadable, When};
use adsdv_spec::messages::AsState;
use fastrand::Rng;

fn errors(text: &[u8]) -> Vec<String> {
    match Scenario::read(text) {
        Ok(scenario) => panic!("{scenario}"),
        Err(error) => error.to_string().lines().map(str::to_owned).collect(),
    }
}

fn scenario(text: &str) -> Scenario {
    text.parse().unwrap_or_else(|error| panic!("{error}"))
}

/// Everything that a scenario did: the time and the action.
fn played(text: &str, states: &[(u64, Option<AsState>)]) -> Vec<(u64, String)> {
    let mut player = Player::new(&scenario(text));
    let mut done = Vec::new();
    let mut state = None;
    for time in (0..20_000).step_by(10) {
        state = states.iter().rev().find(|(since, _)| *since <= time).map_or(state, |(_, state)| *state);
        done.extend(player.due(time, state).into_iter().map(|action| (time, action.to_string())));
        if player.is_over() {
            done.push((time, "end".to_owned()));
            break;
        }
    }
    done
}

fn owned(done: &[(u64, &str)]) -> Vec<(u64, String)> {
    done.iter().map(|&(time, what)| (time, what.to_owned())).collect()
}

#[test]
fn what_may_stand_in_a_file() {
    let text = "\u{feff}# comment\n\n  \t\n0 asms on,tsms on # both\r\n+0.25\tami  TRACK_DRIVE\nAS_READY+5.5 go on\n\
                AS_DRIVING   +3  power   cycle\nAS_OFF asms off\n99.125 end";
    let expected = "0 asms on, tsms on\n+0.25 ami TRACK_DRIVE\nAS_READY +5.5 go on\nAS_DRIVING +3 power cycle\n\
                    AS_OFF asms off\n99.125 end\n";
    let read = scenario(text);
    assert_eq!(read.to_string(), expected);
    assert_eq!(read.lines()[0].number, 4);
    assert_eq!(read.lines()[2].when, When::State(AsState::Ready, 5500));
    // A comment may be in any encoding.
    assert!(Scenario::read(&b"0 asms on # Gr\xFC\xDFe\n"[..]).is_ok());
}

#[test]
fn each_bad_line_is_reported_with_what_was_found_and_expected() {
    let cases = [
        (
            "asms on",
            "column 1: found \"asms\", expected a time such as 12.5 or +0.5, or one of AS_OFF, AS_READY, ",
        ),
        ("as_ready asms on", "column 1: found \"as_ready\", expected a time"),
        ("NaN asms on", "column 1: found \"NaN\", expected a time"),
        ("inf asms on", "column 1: found \"inf\", expected a time"),
        ("-1 asms on", "column 1: found \"-1\", expected seconds such as"),
        (".5 asms on", "column 1: found \".5\", expected seconds such as"),
        ("1e3 asms on", "column 1: found \"1e3\", expected seconds such as"),
        ("1,5 asms on", "column 1: found \"1,5\", expected seconds such as"),
        ("0.0001 asms on", "column 1: found \"0.0001\", expected seconds with at most three decimals"),
        ("86401 asms on", "column 1: found \"86401\", expected at most 86400 seconds, which is a day"),
        (
            "999999999999999999999 asms on",
            "column 1: found \"999999999999999999999\", expected at most 86400",
        ),
        ("+ asms on", "column 1: found \"+\", expected + and seconds such as"),
        ("+-1 asms on", "column 1: found \"+-1\", expected + and seconds such as"),
        ("+NaN asms on", "column 1: found \"+NaN\", expected + and seconds"),
        ("AS_READY + asms on", "column 10: found \"+\", expected + and seconds"),
        ("AS_READY +x asms on", "column 10: found \"+x\", expected + and seconds"),
        ("AS_READY+x asms on", "column 9: found \"+x\", expected + and seconds"),
        (
            "AS_READY 5.5 go on",
            "column 10: found \"5.5\", expected +5.5: a time behind a state begins with +",
        ),
        ("AS_READY 5,5 go on", "column 10: found \"5,5\", expected + and seconds such as"),
        ("AS_READY + 5 asms on", "column 10: found \"+ 5\", expected +5 without a space"),
        ("+ 0.5 asms on", "column 1: found \"+ 0.5\", expected +0.5 without a space"),
        ("AS_REDY + 5 asms on", "column 1: found \"AS_REDY\", expected a time"),
        ("AS_REDY 5 asms on", "column 1: found \"AS_REDY\", expected a time"),
        ("nonsense", "column 1: found \"nonsense\", expected a time"),
        ("0", "column 2: found nothing, expected an action such as asms on"),
        ("0 asms", "column 7: found nothing, expected asms to be off or on"),
        ("0 asms up", "column 8: found \"up\", expected asms to be off or on"),
        ("0 asms 1", "column 8: found \"1\", expected asms to be off or on"),
        ("0 asms on tsms on", "column 8: found \"on tsms on\", expected asms to be off or on"),
        ("0 asms on,", "column 11: found nothing, expected an action"),
        ("0 asms on,,go on", "column 11: found nothing, expected an action"),
        ("0 horn", "column 3: found \"horn\", expected end, power cycle, or one of asms"),
        (
            "0 ami TRACKDRIVE",
            "column 7: found \"TRACKDRIVE\", expected ami to be NOT_SELECTED, ACCELERATION, ",
        ),
        ("4 power cycle now", "column 15: found \"now\", expected nothing behind power cycle"),
        ("3 power", "column 3: found \"power\", expected power cycle"),
        ("3 power  off", "column 3: found \"power  off\", expected power cycle"),
        (
            "3 pwoer cycle",
            "column 3: found \"pwoer\", expected the name of a switch; did you mean power cycle?",
        ),
        ("3 ASMS on", "column 3: found \"ASMS\", expected the name of a switch; did you mean asms?"),
        (
            "3 remote-estop on",
            "column 3: found \"remote-estop\", expected the name of a switch; did you mean remote_estop?",
        ),
        ("3 END", "column 3: found \"END\", expected an action; did you mean end?"),
        ("0 handshake on", "column 3: found \"handshake\", expected power cycle, or one of asms"),
        ("0 asms on, asms off", "column 12: found \"asms off\", expected each switch once in a line"),
        ("0 end, asms on", "column 8: found \"asms on\", expected nothing behind end"),
        ("0 end, end", "column 8: found \"end\", expected nothing behind end"),
    ];
    for (text, expected) in cases {
        let errors = errors(text.as_bytes());
        let expected = format!("line 1, {expected}");
        assert!(errors.len() == 1 && errors[0].starts_with(&expected), "{text:?}: {errors:?}");
    }
}

#[test]
fn every_error_is_reported_and_none_hides_another() {
    let text = b"0 asms up, horn, go on\nx tsms maybe\n# fine\n1 \xff\xfe\n2 go off\nAS_REDY +3 go in\n";
    let expected = [
        "line 1, column 8: found \"up\"",
        "line 1, column 12: found \"horn\"",
        "line 2, column 1: found \"x\"",
        "line 2, column 8: found \"maybe\"",
        "line 4, column 3: found \"\\xff\\xfe\", expected text in UTF-8",
        "line 6, column 1: found \"AS_REDY\"",
        "line 6, column 15: found \"in\"",
    ];
    let errors = errors(text);
    assert_eq!(errors.len(), expected.len(), "{errors:#?}");
    for (error, expected) in errors.iter().zip(expected) {
        assert!(error.starts_with(expected), "{error}");
    }
}

#[test]
fn lines_that_cannot_take_place_in_their_order() {
    let messages = errors(b"1 asms on\n0.5 asms off\n");
    assert_eq!(
        messages,
        ["line 2, column 1: found \"0.5\", expected 1 or later: line 1 does not take place before that"]
    );
    let messages = errors(b"1 asms on\n+0.5 tsms on\nAS_READY +2 go on\n1.999 asms off\n3 end");
    assert_eq!(
        messages,
        ["line 4, column 1: found \"1.999\", expected 2 or later: line 3 does not take place before that"]
    );
    let messages = errors(b"0 end\n\n1 end\n2 asms on\n");
    assert_eq!(messages[0], "line 3, column 1: found \"1 end\", expected nothing more: end stands in line 1");
    assert_eq!(messages.len(), 1, "it is reported once: {messages:?}");
    // What else is wrong there is reported as well.
    let messages = errors(b"0 end\n1 end\n2 asms up\n");
    assert!(messages.len() == 2 && messages[1].starts_with("line 3, column 8: found \"up\""), "{messages:?}");
    // At the same time is well.
    assert_eq!(scenario("1 asms on\n1 tsms on\n+0 go on").lines().len(), 3);
}

#[test]
fn a_file_without_a_line() {
    for text in ["", "\n\n", "# only this\n", "   "] {
        let messages = errors(text.as_bytes());
        assert!(
            messages.len() == 1
                && messages[0].ends_with("found nothing, expected a line such as: 0.5 asms on"),
            "{messages:?}"
        );
    }
}

#[test]
fn a_long_line_is_passed_over_and_reported() {
    let fits = format!("0 asms on #{}", "x".repeat(MAX_LINE - 11));
    assert_eq!(fits.len(), MAX_LINE);
    assert!(fits.parse::<Scenario>().is_ok());
    let text = format!("{fits}x\n1 asms up\n");
    let messages = errors(text.as_bytes());
    assert_eq!(messages.len(), 2, "{messages:?}");
    assert!(messages[0].starts_with("line 1, column 1: found \"0 asms on #xxx"), "{messages:?}");
    assert!(messages[0].ends_with("\"..., expected a line of at most 4096 bytes"), "{messages:?}");
    assert!(messages[1].starts_with("line 2, column 8: found \"up\""), "{messages:?}");
}

/// Megabytes without a line feed, and then another line; and the buffer stays small.
#[test]
fn a_line_of_megabytes_is_passed_over() {
    let long = io::repeat(b'x').take(MAX_BYTES - 100).chain(&b"\n1 asms up\n"[..]);
    let source = BufReader::with_capacity(1 << 16, long);
    let Err(Unreadable::Lines { errors, more: 0 }) = Scenario::read(source) else {
        panic!("it is no scenario")
    };
    let messages: Vec<_> = errors.iter().map(|error| (error.line, error.column, error.found.len())).collect();
    assert_eq!(messages, [(1, 1, MAX_LINE), (2, 8, 2)]);
}

#[test]
fn a_flood_of_errors_is_counted() {
    let text = "x\n".repeat(10_000);
    // Each line has one mistake: its first word. That nothing is done then is no other.
    let Err(Unreadable::Lines { errors, more }) = text.parse::<Scenario>() else {
        panic!("it is no scenario")
    };
    assert_eq!((errors.len(), more), (50, 10_000 - 50));
    assert!(text.parse::<Scenario>().unwrap_err().to_string().ends_with("\nand 9950 more"));
    let many = "0 asms on\n".repeat(200_000);
    let messages = errors_of(&many);
    assert!(messages.ends_with("expected at most 100000 lines that say something"), "{messages}");
}

#[test]
fn every_switch_is_named_once() {
    let messages = errors(b"0 horn on\n1 wiper on, hooter on\n2 horn\n");
    let expected = [
        "line 1, column 3: found \"horn\", expected power cycle, or one of asms, tsms, ",
        "line 2, column 3: found \"wiper\", expected the name of a switch: line 1 has them all",
        "line 2, column 13: found \"hooter\", expected the name of a switch: line 1 has them all",
        "line 3, column 3: found \"horn\", expected the name of a switch: line 1 has them all",
    ];
    assert_eq!(messages.len(), expected.len(), "{messages:#?}");
    for (messages, expected) in messages.iter().zip(expected) {
        assert!(messages.starts_with(expected), "{messages}");
    }
}

#[test]
fn a_source_without_end_is_refused() {
    for byte in [b'\0', b'\n', b' ', b'x'] {
        let error = Scenario::read(BufReader::new(io::repeat(byte))).unwrap_err();
        assert_eq!(error.to_string(), "is longer than 4194304 bytes; expected a scenario");
    }
    // So long it may be.
    let room = usize::try_from(MAX_BYTES).expect("a few megabytes");
    let mut text = b"0 asms on\n".to_vec();
    text.resize(room, b'\n');
    assert!(Scenario::read(&text[..]).is_ok() && Scenario::read(BufReader::new(&text[..])).is_ok());
    text.push(b'\n');
    for read in [Scenario::read(&text[..]), Scenario::read(BufReader::new(&text[..]))] {
        assert!(matches!(read, Err(Unreadable::Long { bytes: MAX_BYTES })), "{read:?}");
    }
}

/// What is cut off is text and bytes that are none, at any place.
#[test]
fn what_was_found_is_shown_as_it_is() {
    let shown = |found: &[u8]| {
        let messages = errors(&[b"0 asms on #".to_vec(), found.to_vec(), vec![b'x'; MAX_LINE]].concat());
        let (_, messages) = messages[0].split_once("found \"0 asms on #").expect("the beginning");
        let (found, _) = messages.split_once("\"..., ").expect("it is cut");
        found.to_owned()
    };
    assert_eq!(shown(b""), "x".repeat(29));
    assert_eq!(shown("'\u{fc}\"\u{1b}".as_bytes()), format!("'\u{fc}\\\"\\u{{1b}}{}", "x".repeat(25)));
    assert_eq!(shown(b"a\xffb"), format!("a\\xffb{}", "x".repeat(26)));
    assert_eq!(shown(&[0xff; 40]), "\\xff".repeat(29));
}

fn errors_of(text: &str) -> String {
    text.parse::<Scenario>().expect_err("no scenario").to_string()
}

#[test]
fn a_source_that_fails_is_reported_with_its_line() {
    struct Fails;
    impl Read for Fails {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            Err(io::ErrorKind::TimedOut.into())
        }
    }
    let source = BufReader::new((&b"0 asms on\n1 go"[..]).chain(Fails));
    let error = Scenario::read(source).unwrap_err();
    assert_eq!(error.to_string(), "cannot read on at line 2: timed out");
}

#[test]
fn an_interrupted_read_goes_on() {
    struct Interrupted<'a>(&'a [u8], bool);
    impl Read for Interrupted<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            self.1 = !self.1;
            if self.1 { Err(io::ErrorKind::Interrupted.into()) } else { self.0.read(buffer) }
        }
    }
    let source = BufReader::with_capacity(3, Interrupted(b"0 asms on\n1 go on", false));
    assert_eq!(Scenario::read(source).map(|scenario| scenario.lines().len()).ok(), Some(2));
}

#[test]
fn what_is_printed_is_read_back() {
    let switches: Vec<Switch> = Switch::all().collect();
    for seed in 1..2000 {
        let mut random = Rng::with_seed(seed);
        let mut text = String::new();
        let mut at = 0;
        let lines = random.usize(1..=6);
        for line in 0..lines {
            let ms = random.usize(..3_000);
            let time = format!("{}.{:03}", ms / 1000, ms % 1000);
            let when = match random.usize(..4) {
                0 => {
                    // Later than everything before it can be.
                    at += 20;
                    format!("{at}.{:03}", ms % 1000)
                }
                1 => format!("+{time}"),
                2 => AsState::ALL[random.usize(..5)].to_string(),
                _ => format!("{} +{time}", AsState::ALL[random.usize(..5)]),
            };
            let first = random.usize(..switches.len() - 3);
            let mut doings: Vec<String> = switches[first..first + random.usize(..3)]
                .iter()
                .map(|switch| {
                    let positions = switch.positions();
                    format!(
                        "{} {}",
                        switch.key(),
                        switch.position(positions[random.usize(..positions.len())])
                    )
                })
                .collect();
            if random.usize(..5) == 0 || doings.is_empty() {
                doings.push("power cycle".to_owned());
            }
            if line + 1 == lines && random.usize(..2) == 0 {
                doings.push("end".to_owned());
            }
            writeln!(text, "{when}\t{}", doings.join(" ,")).expect("a string");
        }
        let read = scenario(&text);
        assert_eq!(scenario(&read.to_string()), read, "{text}");
        assert_eq!(read.lines().len(), lines);
    }
}

/// Anything at all: it is read or refused, and that is all.
#[test]
fn no_bytes_make_it_panic() {
    let words: [&[u8]; 22] = [
        b"0",
        b"+",
        b"-",
        b".",
        b"1.5",
        b"AS_READY",
        b"AS_OFF+",
        b"asms",
        b"on",
        b"ami",
        b"TRACK_DRIVE",
        b"power",
        b"cycle",
        b"end",
        b",",
        b"#",
        b"\n",
        b" ",
        b"\t",
        b"\xff",
        "\u{fc}".as_bytes(),
        b"\r",
    ];
    for seed in 1..20_000 {
        let mut random = Rng::with_seed(seed);
        let count = random.usize(..20);
        let text: Vec<u8> = (0..count).flat_map(|_| words[random.usize(..words.len())]).copied().collect();
        match Scenario::read(&text[..]) {
            Ok(read) => assert_eq!(scenario(&read.to_string()), read),
            Err(error) => assert!(error.to_string().starts_with("line "), "{error}"),
        }
    }
}

#[test]
fn times_count_from_the_start_the_line_before_and_the_state() {
    let states =
        [(0, None), (10, Some(AsState::Off)), (1000, Some(AsState::Ready)), (9000, Some(AsState::Driving))];
    let done = played(
        "0.5 asms on\n+0.25 tsms on\nAS_READY +5.5 go on\nAS_DRIVING go off\n+0 asms off, end",
        &states,
    );
    assert_eq!(
        done,
        owned(&[
            (500, "asms on"),
            (750, "tsms on"),
            (6500, "go on"),
            (9000, "go off"),
            (9000, "asms off"),
            (9000, "end")
        ])
    );
}

#[test]
fn a_state_has_to_last_without_a_break() {
    let off = Some(AsState::Off);
    let ready = Some(AsState::Ready);
    let states = [(0, off), (1000, ready), (2000, off), (3000, ready)];
    assert_eq!(played("AS_READY +1.5 go on", &states), owned(&[(4500, "go on")]));
    // A VCU without power is in no state.
    let states = [(0, ready), (1000, None), (3000, ready)];
    assert_eq!(played("AS_READY +1.5 go on", &states), owned(&[(4500, "go on")]));
    // It is there already: the time counts from when it came.
    assert_eq!(
        played("1 asms on\nAS_READY +0.5 go on", &[(0, ready)]),
        owned(&[(1000, "asms on"), (1010, "go on")])
    );
}

#[test]
fn a_line_that_waits_for_a_state_sees_what_the_line_before_did() {
    let states = [(0, Some(AsState::Ready)), (1010, Some(AsState::Off)), (5000, Some(AsState::Ready))];
    let done = played("1 asms off\nAS_READY asms on\n", &states);
    assert_eq!(done, owned(&[(1000, "asms off"), (5000, "asms on")]));
}

#[test]
fn lines_keep_their_order_when_their_time_has_passed() {
    let states = [(0, Some(AsState::Off)), (3000, Some(AsState::Ready))];
    let done = played("AS_READY go on\n1 asms off\n2 tsms off\n", &states);
    assert_eq!(done, owned(&[(3000, "go on"), (3000, "asms off"), (3000, "tsms off")]));
}

#[test]
fn the_player_puts_what_comes_next_into_words() {
    let mut player =
        Player::new(&scenario("0.5 asms on\nAS_READY +5.5 go on\nAS_DRIVING go off, asms off\n+1.5 end"));
    let off = Some(AsState::Off);
    assert_eq!(player.next().as_deref(), Some("at 0.5 s: asms on"));
    assert_eq!(player.waiting_for(), None);
    player.due(500, off);
    assert_eq!(player.next().as_deref(), Some("AS_READY for 5.5 s: go on"));
    let waiting = player.waiting_for().expect("it waits for AS_READY");
    assert_eq!((waiting.line, waiting.state, waiting.since_ms), (2, AsState::Ready, 500));
    player.due(1000, Some(AsState::Ready));
    assert_eq!(player.waiting_for(), None, "it is there, and has to last");
    assert_eq!(player.due(6500, Some(AsState::Ready)).len(), 1);
    assert_eq!(player.next().as_deref(), Some("AS_DRIVING: go off, asms off"));
    player.due(7000, Some(AsState::Driving));
    assert_eq!(player.next().as_deref(), Some("at 8.5 s: end"));
    assert!(!player.is_over() && !player.is_done());
    assert!(player.due(8500, off).is_empty());
    assert!(player.is_over() && player.is_done());
    assert_eq!((player.next(), player.waiting_for()), (None, None));
    assert!(player.due(u64::MAX, off).is_empty());
}

/// The README names every switch and every position, in a table that is what the program knows.
#[test]
fn the_readme_names_every_switch() {
    let readme = include_str!("../README.md");
    let table: Vec<&str> =
        readme.lines().filter(|line| line.starts_with("| `") && line.contains("` | `")).collect();
    let expected: Vec<String> = Switch::all()
        .map(|switch| {
            let positions = switch.positions().into_iter().map(|raw| format!("`{}`", switch.position(raw)));
            let positions = positions.collect::<Vec<_>>().join(", ");
            format!("| `{}` | {positions} | {} |", switch.key(), switch.about())
        })
        .collect();
    assert_eq!(table, expected);
    // It says for how long a scenario may wait, and what comes behind its last line.
    let defaults = adsdv_can::demo::DemoOptions::default();
    assert_eq!((defaults.patience_ms, defaults.tail_ms), (600_000, 1000));
    for words in ["after 600 seconds", "stops a second after the last line", Action::POWER_CYCLE] {
        assert!(readme.contains(words), "{words:?} is missing");
    }
    for (name, _) in Scenario::SAMPLES {
        assert!(readme.contains(&format!("- `{name}`: ")), "{name} is missing");
    }
    // Its example is a scenario.
    let scenarios = readme.split("## Scenarios").nth(1).expect("a section");
    let example =
        scenarios.split("```text\n").nth(1).and_then(|rest| rest.split("```").next()).expect("an example");
    assert!(example.as_bytes().lines().count() > 3);
    scenario(example);
}
