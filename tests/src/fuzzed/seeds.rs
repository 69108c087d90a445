//! What fuzzers begin with: the inputs of `fuzz/corpus` and the words of `fuzz/dictionaries`, made from what the project has.
//!
//! `cargo run -p adsdv-tests --bin seeds` writes them, and a test fails when they have to be written again.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use adsdv_can::car::{Action, Switch};
use adsdv_can::scenario::{self, Scenario};
use adsdv_conform::protocol::{INPUTS, InputsAsJson, Protocol, Request, SHOWN, Shown};
use adsdv_conform::suite::{self, Kind, Test};
use adsdv_oracle::candump::{Dropped, MAX_LINE, write_dropped};
use adsdv_proofs::theorems;
use adsdv_spec::messages::{AnyMessage, AsState, Frame};
use adsdv_spec::{
    AiMessages, Atom, Choice, Choices, Control, Edition, Fault, Inputs, Knowledge, Machine, Observation,
    Outputs, Reading, Readings, Taken, Timing, Truth, VcuMessages,
};
use serde::Serialize;
use serde_json::Value;

use super::{belief, car, codec, judge_any, protocol, step};
use crate::bus::{BUS, encoded};
use crate::world::Random;

/// The logs that the project has, each with its name.
const LOGS: [(&str, &str); 2] = [
    ("mission", include_str!("../../logs/mission.log")),
    ("finished-while-moving", include_str!("../../logs/finished-while-moving.log")),
];

/// So many lines of a log are enough to begin with, and of so many of its frames bytes are taken.
const LINES: usize = 60;
/// A word of a dictionary has at most so many bytes: libFuzzer takes no longer ones.
const WORD: usize = 64;
/// A body has at most so many inputs to begin with: one for each theorem, which two bytes pick.
pub const MOST: usize = 512;

/// By the name of a body, the inputs that it begins with, each with its name.
pub type Corpus = BTreeMap<&'static str, BTreeMap<String, Vec<u8>>>;

/// A recording of each format, as its tool or another writes it.
fn recordings() -> [(&'static str, &'static [u8]); 10] {
    macro_rules! samples {
        ($($name:literal),*) => { [$(($name, include_bytes!(concat!("../../../formats/tests/samples/", $name)))),*] };
    }
    samples!(
        "vector.asc",
        "python-can.csv",
        "savvycan.csv",
        "savvycan-older.csv",
        "peak-1.1.trc",
        "peak-2.1.trc",
        "python-can.blf",
        "python-can-stored.blf",
        "zstd.mcap",
        "lz4.mcap"
    )
}

/// Every input of `fuzz/corpus`.
pub fn corpus() -> Corpus {
    let mut all = Corpus::new();
    let mut add = |target: &'static str, name: &str, bytes: Vec<u8>| {
        all.entry(target).or_default().insert(name.to_owned(), bytes);
    };
    for (name, log) in LOGS {
        for (place, piece) in pieces(log).enumerate() {
            let name = format!("{name}-{}", place + 1);
            add("candump", &name, with(&[7], piece.as_bytes()));
            add("judge_any", &name, with(&judge_any::AS_TEXT, piece.as_bytes()));
        }
    }
    for (name, line) in other_lines() {
        add("candump", name, with(&[0], line.as_bytes()));
        add("judge_any", name, with(&judge_any::AS_TEXT, line.as_bytes()));
    }
    for (name, bytes) in recordings() {
        add("recording", name, bytes.to_vec());
    }
    for edition in Edition::ALL {
        let text = adsdv_spec::export::Dbc(edition).to_string();
        add("database", &format!("edition-{}", edition.version), with(&[0; 9], text.as_bytes()));
    }
    add("database", "a-team-s-own", with(&[0; 9], include_bytes!("../../../decode/tests/decode/team.dbc")));
    let wide = "\u{feff}(1.000000) can0 520#0000010000000000\r\n(1.01) can0 \u{1f697}\r\n".encode_utf16();
    add("recording", "utf-16", wide.flat_map(u16::to_le_bytes).collect());
    for (name, text) in Scenario::SAMPLES {
        add("scenario", name, with(text.as_bytes(), &with(&[0], &any_bytes(name.len() as u64, 60))));
    }
    let long = format!("0 asms on\n1 go on #{}\n2 asms off\n", "x".repeat(scenario::MAX_LINE));
    add("scenario", "longer-than-a-line-may-be", with(long.as_bytes(), &with(&[0], &any_bytes(7, 60))));
    for (of, edition) in (0..).zip(Edition::ALL) {
        let machine = Machine::new(**edition, edition.readings);
        let tests = suite::generate(edition);
        for kind in Kind::ALL {
            // The shortest of each kind says as much as a longer one.
            let of_kind = tests.iter().filter(|test| test.kind == kind);
            if let Some(test) = of_kind.min_by_key(|test| test.to_line(&machine).len()) {
                let name = named(edition, kind.name());
                add("suite", &name, test.to_line(&machine).into_bytes());
                for (place, text) in exchange(test, &machine).into_iter().enumerate().take(3) {
                    let as_text = protocol::as_text(of);
                    add("protocol", &format!("{name}-{}", place + 1), with(&as_text, text.as_bytes()));
                }
            }
        }
    }
    for (name, text) in jsons() {
        add("names", name, text.into_bytes());
    }
    add("names", "names", words("names").into_iter().collect::<Vec<String>>().join("\n").into_bytes());
    for edition in Edition::ALL {
        for def in edition.bus.messages {
            let first = (LOGS.iter()).find_map(|(_, log)| log.lines().find_map(|line| data_of(line, def.id)));
            let data = first.unwrap_or_else(|| vec![0; def.len.into()]);
            let name = named(edition, &format!("{:03X}", def.id));
            add("codec", &name, codec::as_data(edition, def.id, &data));
        }
    }
    let all_terms = |taken: &[step::Decided]| terms().all(|term| taken.contains(&term));
    for (place, walk) in walks(20_000, 256, step::taken, all_terms).into_iter().enumerate() {
        add("step", &format!("walk-{}", place + 1), walk);
    }
    let all_rows = |taken: &[belief::Arrow]| {
        terms()
            .all(|(version, Taken { row, .. })| taken.iter().any(|&(of, by)| (of, by.row) == (version, row)))
    };
    for (place, walk) in walks(5000, 512, belief::taken, all_rows).into_iter().enumerate() {
        add("belief", &format!("walk-{}", place + 1), walk);
    }
    let all_states = |reached: &[car::Reached]| {
        let states = |edition: &&'static Edition| AsState::ALL.map(|state| (edition.version, state));
        Edition::ALL.iter().flat_map(states).all(|state| reached.contains(&state))
    };
    for (place, walk) in walks(200, 600, car::reached, all_states).into_iter().enumerate() {
        add("car", &format!("walk-{}", place + 1), walk);
    }
    for (place, theorem) in theorems::all().enumerate() {
        let values = any_bytes(place as u64 + 1, 64);
        add("theorems", theorem.name, with(&u16::try_from(place).unwrap_or_default().to_le_bytes(), &values));
    }
    for target in ["c_border", "codec", "conform", "judge_any", "judge_reference", "protocol"] {
        for (place, len) in [16_u16, 48, 64, 96, 128, 192, 256, 400].into_iter().enumerate() {
            add(target, &format!("any-{}", place + 1), any_bytes(place as u64 + 1, len));
        }
    }
    all
}

/// The dictionary of each format that is text, as libFuzzer reads it.
pub fn dictionaries() -> BTreeMap<&'static str, String> {
    let text = |target: &str| {
        let mut text = format!("# The words of {target}; written by: cargo run -p adsdv-tests --bin seeds\n");
        for word in words(target) {
            text.push('"');
            for byte in word.bytes() {
                match byte {
                    b'"' | b'\\' => text.extend(['\\', char::from(byte)]),
                    b' '..=b'~' => text.push(char::from(byte)),
                    _ => {
                        // Writing to a string does not fail.
                        let _ = write!(text, "\\x{byte:02X}");
                    }
                }
            }
            text.push_str("\"\n");
        }
        text
    };
    ["candump", "judge_any", "names", "protocol", "scenario", "suite"]
        .into_iter()
        .map(|target| (target, text(target)))
        .collect()
}

/// The words of a format.
fn words(target: &str) -> BTreeSet<String> {
    let mut words = BTreeSet::new();
    match target {
        "candump" | "judge_any" => {
            words.extend(BUS.messages.iter().map(|def| format!("{:03X}#", def.id)));
            for (_, line) in other_lines() {
                let parts = line.split_inclusive(' ').filter(|part| part.len() <= WORD);
                words.extend(parts.map(str::to_owned));
            }
            words.extend(
                ["(", ".", ") ", " can0 ", "##", "#R", "_F", " R\n", " T\n", "\r\n"].map(str::to_owned),
            );
        }
        "scenario" => {
            for switch in Switch::all() {
                words.insert(switch.key().to_owned());
                let positions = switch.positions().into_iter().map(|raw| switch.position(raw));
                // Of numbers there are too many, and a fuzzer knows them.
                words.extend(positions.filter(|position| position.parse::<i32>().is_err()));
            }
            words.extend(AsState::ALL.iter().map(|state| state.name().to_owned()));
            words.extend([Action::POWER_CYCLE, "end", "+", ", ", "#", "0.5", "\n"].map(str::to_owned));
        }
        "protocol" | "suite" => {
            for edition in Edition::ALL {
                let machine = Machine::new(**edition, edition.readings);
                if let Some(test) = suite::generate(edition).first() {
                    if target == "suite" {
                        parts(&test.to_line(&machine), &mut words);
                    } else {
                        for line in exchange(test, &machine) {
                            parts(&line, &mut words);
                        }
                    }
                }
                let signals = edition.bus.messages.iter().flat_map(|def| def.signals);
                let values = signals.flat_map(|signal| signal.values);
                words.extend(values.map(|(_, name)| (*name).to_owned()));
            }
            if target == "suite" {
                words.extend(Kind::ALL.map(|kind| kind.name().to_owned()));
                words.extend(Reading::ALL.iter().map(|reading| reading.id().to_owned()));
            }
            words.extend(INPUTS.iter().map(|field| quoted(field.key)));
            words.extend(SHOWN.iter().map(|field| quoted(field.key)));
            words.extend(["{", "}", "[", "]", ":", ",", "null", "true", "false"].map(str::to_owned));
        }
        _ => {
            words.extend(Atom::ALL.iter().map(ToString::to_string));
            words.extend(Fault::ALL.iter().map(ToString::to_string));
            words.extend(Reading::ALL.iter().map(ToString::to_string));
            words.extend(Choice::ALL.iter().map(ToString::to_string));
            words.extend(Scenario::SAMPLES.map(|(name, _)| name.to_owned()));
            for (_, text) in jsons() {
                parts(&text, &mut words);
            }
        }
    }
    words.remove("");
    words
}

/// Adds the keys and the texts of a line of JSON, with their quotation marks.
fn parts(line: &str, words: &mut BTreeSet<String>) {
    fn walk(value: &Value, words: &mut BTreeSet<String>) {
        match value {
            Value::String(text) if text.len() <= 40 => {
                words.insert(quoted(text));
            }
            Value::Array(list) => list.iter().for_each(|value| walk(value, words)),
            Value::Object(map) => {
                for (key, value) in map {
                    words.insert(quoted(key));
                    walk(value, words);
                }
            }
            _ => {}
        }
    }
    if let Ok(value) = serde_json::from_str(line) {
        walk(&value, words);
    }
}

fn quoted(text: &str) -> String {
    Value::from(text).to_string()
}

fn with(before: &[u8], behind: &[u8]) -> Vec<u8> {
    [before, behind].concat()
}

fn any_bytes(seed: u64, len: u16) -> Vec<u8> {
    let mut random = Random::with_seed(seed);
    (0..len).map(|_| random.bits().to_le_bytes()[0]).collect()
}

/// The terms of Figure 2 of every edition, but for those of an answer that it has settled, which are never there.
fn terms() -> impl Iterator<Item = step::Decided> {
    Edition::ALL.iter().flat_map(|edition| {
        let rows = (0..).zip(edition.rules.table.rows());
        rows.flat_map(|(row, def)| (0..).zip(def.terms()).map(move |(term, def)| (Taken { row, term }, def)))
            .filter(|(_, def)| def.readings.is_subset(edition.choices))
            .map(|(taken, _)| (edition.version, taken))
    })
}

/// Of so many inputs of so many bytes those that lead to something that those before them do not lead to; and of further ones, up to
/// twenty times as many, until they lead to all.
fn walks<T: PartialEq>(
    tries: u64,
    len: u16,
    led_to: fn(&[u8]) -> Vec<T>,
    are_all: impl Fn(&[T]) -> bool,
) -> Vec<Vec<u8>> {
    let mut seen: Vec<T> = Vec::new();
    let mut walks = Vec::new();
    for seed in 1..=20 * tries {
        if seed > tries && are_all(&seen) {
            break;
        }
        let walk = any_bytes(seed, len);
        let more: Vec<T> = led_to(&walk).into_iter().filter(|led| !seen.contains(led)).collect();
        if !more.is_empty() {
            seen.extend(more);
            walks.push(walk);
        }
    }
    walks
}

/// Some lines from all over a log: its beginning, and where something happens.
fn pieces(log: &str) -> impl Iterator<Item = String> + '_ {
    let lines: Vec<&str> = log.lines().collect();
    let starts: Vec<usize> = (0..4).map(|part| lines.len() * part / 4).collect();
    starts.into_iter().map(move |start| {
        let piece = lines.get(start..).unwrap_or_default().iter().take(LINES);
        piece.flat_map(|line| [*line, "\n"]).collect()
    })
}

/// Lines that the logs do not have.
fn other_lines() -> [(&'static str, String); 7] {
    let mut dropped = Vec::new();
    let dropped_frames = Dropped { line: 0, interface: "can0", count: 3, total: 7 };
    // Memory can be written to.
    let _ = write_dropped(&mut dropped, &dropped_frames);
    [
        ("dropped", String::from_utf8_lossy(&dropped).into_owned()),
        ("extended", "(1.000000) can0 18FF50E5#0011 R\n".to_owned()),
        ("remote", "(1.000000) can0 520#R8_F T\n".to_owned()),
        ("error", "(1.000000) can0 20000004#0004000000000000\n".to_owned()),
        ("fd", "(1.000000) can0 520##10011\r\n".to_owned()),
        (
            "longer-than-a-line-may-be",
            format!("(1.000000) can0 520#{}\n(2.000000) can0 520#\n", "0".repeat(MAX_LINE)),
        ),
        ("xl", "(1.000000) can0 45123#81:00:12345678#00.11".to_owned()),
    ]
}

/// The data of a line that has this identifier.
fn data_of(line: &str, id: u16) -> Option<Vec<u8>> {
    let (_, digits) = line.split_once(&format!(" {id:03X}#"))?;
    let pairs = digits.as_bytes().chunks_exact(2).filter_map(|pair| std::str::from_utf8(pair).ok());
    Some(pairs.map_while(|pair| u8::from_str_radix(pair, 16).ok()).collect())
}

/// The name of a seed of an edition: the default one's has none.
fn named(edition: &Edition, name: &str) -> String {
    if edition == Edition::DEFAULT { name.to_owned() } else { format!("{name}-of-{}", edition.version) }
}

/// The lines to a program that is tested, and its answers.
fn exchange(test: &Test, machine: &Machine) -> Vec<String> {
    let protocol = Protocol::of(machine.edition());
    let shown = test.scenario.shown(machine).map(|shown: Shown| shown.to_string());
    let asked = test.scenario.requests().map(|request: Request| protocol.line(&request).to_string());
    let last = test.scenario.steps.last().map(|step| protocol.object(&InputsAsJson(step.inputs)).to_string());
    shown.take(2).chain(asked.take(3)).chain(last).collect()
}

/// A value of each type that is read from JSON.
fn jsons() -> Vec<(&'static str, String)> {
    fn text(value: &impl Serialize) -> String {
        serde_json::to_string(value).unwrap_or_default()
    }
    let inputs = Inputs::default();
    let (control, outputs): (Control, Outputs) = Machine::REFERENCE.step(&Control::INITIAL, &inputs, 10);
    let seen: Observation = inputs.observe(&Edition::DEFAULT.rules.thresholds);
    let messages: VcuMessages = outputs.messages(&inputs);
    let message = AnyMessage::from(messages.status);
    let frame: Frame = encoded(message);
    let timing: Timing = Edition::DEFAULT.rules.timing;
    vec![
        ("inputs", text(&inputs)),
        ("ai", text(&AiMessages::default())),
        ("control", text(&control)),
        ("outputs", text(&outputs)),
        ("actuation", text(&outputs.actuation(&inputs))),
        ("observation", text(&seen)),
        ("reaction", text(&Machine::REFERENCE.react(&control, seen, 10))),
        ("messages", text(&messages)),
        ("message", text(&message)),
        ("frame", text(&frame)),
        ("timing", text(&timing)),
        ("thresholds", text(&Edition::DEFAULT.rules.thresholds)),
        ("readings", text(&Readings::DEFAULT)),
        ("choices", text(&Choices::ALL)),
        ("knowledge", text(&Knowledge::exact(outputs.atoms))),
        ("truth", text(&Truth::Unknown)),
    ]
}
