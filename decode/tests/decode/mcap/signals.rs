//! Signals and frames: those of the recording.

use std::fmt::Write as _;
use std::io::Cursor;

use adsdv_decode::{Catalog, Database, Frame, Options, mcap};
use adsdv_formats::{Entries as _, Entry, open};
use adsdv_oracle::candump::{Direction, FrameKind, Record};
use adsdv_spec::Edition;
use serde_json::Value as Json;

use super::read::{Contents, contents, written};
use crate::frames::{Format, catalog, decode, random};

/// A number of each edition's messages, random, as JSON Lines has them.
#[test]
fn the_signals_of_every_edition_are_those_of_json_lines() {
    for edition in Edition::ALL {
        let catalog = catalog(edition);
        let log = random(&catalog, 20);
        let (lines, _, _) = decode(&log, &catalog, Format::JsonLines);
        let contents = contents(&log, &catalog);
        let by_judge = ["/adsdv/as_state", "/adsdv/blocked", "/adsdv/findings"];
        let said: Vec<_> = contents.said.iter().filter(|said| !by_judge.contains(&&*said.topic)).collect();
        assert_eq!((said.len(), contents.others), (lines.lines().count(), lines.lines().count()));
        for (line, said) in lines.lines().zip(said) {
            let line: Json = serde_json::from_str(line).expect("JSON");
            assert_eq!(said.topic, format!("/adsdv/{}", line["message"].as_str().expect("a name")));
            let seconds = line["time_s"].as_f64().expect("a time");
            #[expect(clippy::cast_precision_loss, reason = "it is small")]
            let late = said.time as f64 - seconds * 1e9;
            assert!(late.abs() < 1.0, "{late}");
            let signals = line["signals"].as_object().expect("signals");
            for (name, signal) in signals {
                if signal["value"].is_null() {
                    assert_eq!(said.says.get(name), None, "no number");
                    continue;
                }
                assert_eq!(said.says[name], signal["value"], "{name}");
                let value_name = said.says.get(format!("{name}_name"));
                let is_named =
                    catalog.named(line["message"].as_str().expect("a name")).is_some_and(|message| {
                        message.signals.iter().any(|one| *one.name == **name && !one.names.is_empty())
                    });
                let expected = signal.get("name").map_or_else(
                    || signal["value"].to_string(),
                    |name| name.as_str().expect("text").to_owned(),
                );
                assert_eq!(value_name.and_then(Json::as_str), is_named.then_some(&*expected), "{name}");
            }
        }
    }
}

const KINDS: &str = "\
(1795209995.234703) can0 520#0000010000000000
(1795209995.234712) can0 513#0A00 T
(1795209995.234713) can0 524#0102 R
(1795209995.240000123) can1 18FF50E5#0102FF
(1795209995.250000) can0 7FF#R4
(1795209995.260000) can0 20000004#000C000000000000
(1795209995.270000) can0 523##000001B000000
(1795209995.270000) can0 18FF50E5##0000102030405060708090A0B0C T
(1795209995.280000) can0 524#
";

#[test]
fn frames_are_read_back_as_they_were() {
    let options = Options { edition: Some(&Edition::V2026), ..Options::default() };
    let (file, _, notes) = written(KINDS, &catalog(&Edition::V2026), &options);
    assert_eq!(notes, Vec::<String>::new());
    let frames = |log: Box<dyn std::io::Read + Send>| {
        let (mut log, mut frames) = (open(log).expect("a recording"), Vec::new());
        while let Some(entry) = log.next_entry().expect("it can be read") {
            let Entry::Frame(record) = entry else { panic!("{entry:?}") };
            let interface = record.interface.trim_start_matches("/can/").to_owned();
            // Which bits of an error frame count, the message has no place for.
            let id = if record.kind == FrameKind::Error { record.id & 0x1FFF_FFFF } else { record.id };
            let is_sent = record.direction == Some(Direction::Tx);
            frames.push((record.time_ns, interface, record.kind, id, record.data.to_vec(), is_sent));
        }
        frames
    };
    let (before, after) = (frames(Box::new(Cursor::new(KINDS))), frames(Box::new(Cursor::new(file.clone()))));
    assert_eq!(before, after);
    // Written once more from there, they are the same again, and so are the topics.
    let again = open(Cursor::new(file.clone())).expect("a recording");
    let recording = adsdv_decode::Recording::begin(again, &options).expect("a frame");
    let (catalog, mut second) = (catalog(&Edition::V2026), Vec::new());
    let mut sink = adsdv_decode::mcap(&catalog, &options, &mut second).expect("it was built in");
    recording.decode(&catalog, &mut *sink, |_| {}).expect("a vector takes everything");
    drop(sink);
    assert_eq!(frames(Box::new(Cursor::new(second.clone()))), after);
    assert_eq!(Contents::of(&file).topics, Contents::of(&second).topics);
}

#[test]
fn each_interface_and_each_database_has_topics_of_its_own() {
    let dbc = "BO_ 291 Mine: 2 T\n SG_ A : 0|8@1+ (1,0) [0|0] \"\" T\n SG_ A_name : 8|8@1+ (1,0) [0|0] \"V\" T\nVAL_ 291 A 1 \"one\" ;\n";
    let database = Database::read("team.dbc", dbc.as_bytes()).expect("a database");
    let catalog = Catalog::with(&Edition::V3_0, &[database]);
    let log = "(1.0) can0 513#0A00000000000000\n(1.1) can1 513#1400000000000000\n(1.2) can0 123#0102\n(1.3) can1 123#02\n";
    let contents = contents(log, &catalog);
    let on = |topic| contents.on(topic).map(|said| said.says.to_string()).collect::<Vec<_>>();
    assert_eq!(on("/adsdv/AI2VCU_Steer").len(), 1);
    assert_eq!(on("/adsdv/can1/AI2VCU_Steer").len(), 1);
    assert_eq!(on("/dbc/Mine"), ["{\"A\":1,\"A_name\":2,\"A_name_\":\"one\"}"]);
    assert_eq!(on("/dbc/can1/Mine"), ["{\"A\":2,\"A_name_\":\"2\"}"]);
}

#[test]
fn what_does_not_fit_into_the_file_is_counted() {
    let options = Options { edition: Some(&Edition::V2026), ..Options::default() };
    let mut log = "(1.0) a 520#0000010000000000\n".to_owned();
    for interface in 0..64 {
        let _ = writeln!(log, "(1.0) can{interface} 513#0000");
    }
    let (file, summary, notes) = written(&log, &catalog(&Edition::V2026), &options);
    let counted = [
        "1 frames are not in the file as they were: they are of CAN XL, or of too many interfaces",
        "1 frames are in the file without their signals: there are too many interfaces",
    ];
    assert_eq!(notes, counted);
    assert_eq!(summary.frames, 65);
    assert_eq!(Contents::of(&file).others, 64);
}

#[test]
fn what_was_before_1970_stands_at_its_begin() {
    let (catalog, options, mut file) = (catalog(&Edition::V2026), Options::default(), Vec::new());
    let mut sink = mcap(&catalog, &options, &mut file).expect("it was built in");
    let (place, data) = (catalog.place(FrameKind::Standard, 0x513), [10, 0]);
    let message = place.and_then(|place| Some((place, catalog.messages().get(place)?)));
    let record = Record {
        line: 1,
        time_ns: -5,
        interface: "can0",
        kind: FrameKind::Standard,
        id: 0x513,
        data: &data,
        direction: None,
        terminated: true,
    };
    sink.heard(&Entry::Frame(record)).expect("a vector takes everything");
    sink.frame(&Frame { record: &record, message }).expect("a vector takes everything");
    sink.finish(1).expect("a vector takes everything");
    let note = "1 frames have a time before 1970, which MCAP cannot tell; they stand at its begin";
    assert_eq!(sink.notes(), [note]);
    drop(sink);
    let contents = Contents::of(&file);
    let said = contents.on("/adsdv/AI2VCU_Steer").next().expect("it is there");
    assert_eq!((said.time, &said.says["STEER_REQUEST"]), (0, &1.into()));
}
