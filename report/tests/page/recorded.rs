//! What was recorded is what is on the page.

use std::fmt::Write as _;

use adsdv_spec::messages::Node;

use crate::unpack::{Frame, bytes, chunks};
use crate::{Run, recorded, run};

fn micros(ns: i64) -> i64 {
    (ns + 500).div_euclid(1000)
}

/// The frames that a run kept, as the page has them.
fn kept(run: &Run) -> Vec<Frame> {
    let frame = |frame: &adsdv_report::Kept| (micros(frame.t_ns), frame.id, frame.data().to_vec());
    let mut frames: Vec<Frame> = run.recording.frames.iter().map(frame).collect();
    frames.sort();
    frames
}

#[test]
fn every_frame_is_on_the_page() {
    for name in ["mission", "finished-while-moving"] {
        let run = run(&recorded(name));
        let (frames, _) = chunks(&run.data()["chunks"]);
        assert_eq!(frames.len() as u64, run.report.frames, "{name}");
        assert!(frames == kept(&run), "{name}: other frames");
    }
}

/// More frames than one piece has, of any length, of an unknown identifier, and from a clock that is set back.
#[test]
fn every_frame_of_a_long_and_odd_log_is_on_the_page() {
    let mut log = String::new();
    for number in 0..140_000_u32 {
        let time = f64::from(number % 90_000) * 0.000_731;
        let mut data = String::new();
        for byte in 0..number % 9 {
            write!(data, "{:02X}", (number >> byte) & 0xFF).expect("memory");
        }
        let id = [0x520, 0x510, 0x7FF, 0x001][number as usize % 4];
        writeln!(log, "({time:.6}) can0 {id:03X}#{data}").expect("memory");
    }
    let run = run(log.as_bytes());
    let data = run.data();
    assert_eq!(data["chunks"].as_array().map(Vec::len), Some(3));
    let (frames, _) = chunks(&data["chunks"]);
    assert_eq!(frames.len(), 140_000);
    assert!(frames == kept(&run), "other frames");
}

#[test]
fn what_shows_a_finding_is_among_the_frames() {
    for name in ["mission", "finished-while-moving"] {
        let run = run(&recorded(name));
        let (frames, _) = chunks(&run.data()["chunks"]);
        let evidence = run.report.findings.iter().flat_map(|finding| &finding.evidence);
        let mut looked_for = 0;
        for one in evidence {
            let is = |frame: &&Frame| frame.0 == micros(one.t_ns) && u32::from(frame.1) == u32::from(one.id);
            assert!(frames.iter().any(|frame| is(&frame)), "{name}: {one:?}");
            looked_for += 1;
        }
        assert!(looked_for > 0, "{name}");
    }
}

#[test]
fn the_answers_are_those_that_the_judge_measured() {
    for name in ["mission", "finished-while-moving"] {
        let run = run(&recorded(name));
        let (_, answers) = chunks(&run.data()["chunks"]);
        let times = &run.report.responses;
        assert_eq!(answers.len() as u64, times.count(), "{name}");
        let slowest = answers.iter().map(|(_, took)| *took).max().expect("answers");
        #[expect(clippy::cast_precision_loss, reason = "a few milliseconds")]
        let slowest = slowest as f64 / 1e3;
        assert!((slowest - times.max_ms().expect("answers")).abs() < 0.001, "{name}: {slowest} ms");
    }
}

/// A VCU that is silent for a while may have changed its bit meanwhile.
#[test]
fn nothing_is_measured_across_a_silence() {
    let mut log = String::new();
    for cycle in 0..200_u32 {
        let time = f64::from(cycle) * 0.01 + if cycle < 100 { 0.0 } else { 5.0 };
        let bit = cycle % 2;
        writeln!(log, "({time:.6}) can0 520#0{bit}00010000000000").expect("memory");
        writeln!(log, "({:.6}) can0 510#0{bit}00000000000000", time + 0.002).expect("memory");
    }
    let run = run(log.as_bytes());
    let (_, answers) = chunks(&run.data()["chunks"]);
    assert_eq!(answers.len() as u64, run.report.responses.count());
    assert!(answers.len() > 190 && answers.iter().all(|(_, took)| *took == 2000), "{answers:?}");
}

#[test]
fn the_picture_of_the_whole_has_the_lowest_and_the_highest() {
    let run = run(&recorded("finished-while-moving"));
    let data = run.data();
    let overview = &data["overview"];
    let buckets = usize::try_from(overview["buckets"].as_u64().expect("a number")).expect("few");
    let width = overview["width"].as_i64().expect("a width");
    let floats: Vec<f32> = bytes(&overview["packed"])
        .chunks_exact(4)
        .map(|four| f32::from_le_bytes(four.try_into().expect("four bytes")))
        .collect();
    let lines: Vec<&serde_json::Value> = data["plots"]
        .as_array()
        .into_iter()
        .flatten()
        .flat_map(|plot| plot["lines"].as_array().into_iter().flatten())
        .collect();
    assert_eq!(floats.len(), lines.len() * buckets * 2);
    for (node, field) in [(Node::Vcu, "steer_angle"), (Node::Ai, "rear_axle_trq_request")] {
        let found = adsdv_report::signal(&run.edition.bus, node, field).expect("a signal");
        let place = lines
            .iter()
            .position(|line| line["id"] == found.id && line["signal"] == found.signal.name)
            .expect("it is plotted");
        let begin = place * buckets * 2;
        let mut seen = 0;
        for bucket in 0..buckets {
            let here = i64::try_from(bucket).expect("few");
            let values = run.recording.series(Some(found)).filter(|(t, _)| micros(*t) / width == here);
            #[expect(clippy::cast_possible_truncation, reason = "as precise as the picture")]
            let values: Vec<f32> = values.map(|(_, raw)| found.signal.physical(raw) as f32).collect();
            let lowest = values.iter().copied().fold(f32::NAN, f32::min);
            let highest = values.iter().copied().fold(f32::NAN, f32::max);
            let same = |a: f32, b: f32| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
            assert!(same(floats[begin + bucket], lowest), "{field}, {bucket}");
            assert!(same(floats[begin + buckets + bucket], highest), "{field}, {bucket}");
            seen += usize::from(highest > 0.0);
        }
        assert!(seen > 3, "{field} is not zero all the time");
    }
}

#[test]
fn a_lane_that_flickers_is_thinned_out_and_ends_as_it_ends() {
    let mut log = String::new();
    for cycle in 0..20_000_u32 {
        let go = if cycle < 100 { 0 } else { 8 * (cycle % 2) };
        let time = f64::from(cycle) / 1000.0;
        writeln!(log, "({time:.6}) can0 520#000{go:X}010000000000").expect("memory");
    }
    for cycle in 20_000..20_200_u32 {
        writeln!(log, "({:.6}) can0 520#0000010000000000", f64::from(cycle) / 1000.0).expect("memory");
    }
    let data = run(log.as_bytes()).data();
    let lane =
        data["lanes"].as_array().expect("lanes").iter().find(|lane| lane["id"] == "go").expect("a lane");
    let spans = lane["spans"].as_array().expect("spans");
    assert!(spans.len() < 4000, "{}", spans.len());
    let word = |span: &serde_json::Value| {
        let place = usize::try_from(span[1].as_i64().expect("a place")).expect("known");
        lane["words"][place][0].as_str().expect("a word").to_owned()
    };
    assert_eq!(word(&spans[0]), "NO GO");
    assert!(spans.iter().any(|span| word(span) == "several"));
    let last = spans.last().expect("a span");
    assert!(word(last) == "NO GO" && last[0].as_i64() >= Some(19_990_000), "{last}");
}
