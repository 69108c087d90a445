//! Recognition by an edition's tables alone: of an edition that nobody has published.

use adsdv_spec::messages::{MessageDef, SignalDef};
use adsdv_spec::{Bus, Edition};

use super::{Recognised, Recogniser};

const MS: i64 = 1_000_000;

fn changed(id: u16, change: impl Fn(&mut MessageDef)) -> &'static MessageDef {
    let mut message = *Edition::V4_0.bus.message(id).expect("a message of 4.0");
    change(&mut message);
    Box::leak(Box::new(message))
}

/// Version 4.0 without 120h, with 500h every 100 ms, and with an `AS_STATE` that may be 0.
fn later() -> &'static Edition {
    let state = |signal: &SignalDef| {
        let mut signal = *signal;
        if signal.field == "as_state" {
            (signal.min, signal.values) = (0, &[]);
        }
        signal
    };
    let messages: Vec<&'static MessageDef> = Edition::V4_0
        .bus
        .messages
        .iter()
        .filter(|message| message.id != 0x120)
        .map(|message| match message.id {
            0x500 => changed(0x500, |message| message.cycle_ms = 100),
            0x520 => changed(0x520, |message| {
                message.signals = message.signals.iter().map(state).collect::<Vec<_>>().leak();
            }),
            _ => *message,
        })
        .collect();
    let bus = Bus { messages: messages.leak(), ..Edition::V4_0.bus };
    Box::leak(Box::new(Edition { version: "later", bus, ..Edition::V4_0 }))
}

fn among(editions: &[&'static Edition], frames: impl IntoIterator<Item = (i64, u32, Vec<u8>)>) -> Recognised {
    let mut recogniser = Recogniser::among(editions.to_vec().leak(), &Edition::V3_0);
    for (t_ms, id, data) in frames {
        assert!(recogniser.frame(t_ms * MS, id, &data), "{id:03X}h is a message of some edition");
    }
    recogniser.recognise()
}

fn three() -> [&'static Edition; 3] {
    [&Edition::V3_0, &Edition::V4_0, later()]
}

fn every(ms: i64, id: u32, data: &[u8]) -> Vec<(i64, u32, Vec<u8>)> {
    (0..1000 / ms).map(|place| (place * ms, id, data.to_vec())).collect()
}

#[test]
fn a_slower_message_tells_an_edition() {
    let steer = every(10, 0x523, &[0; 6]);
    let slow = among(&three(), [every(100, 0x500, &[0; 8]), steer.clone()].concat());
    assert_eq!((slow.edition.version, slow.certain), ("later", true), "{slow}");
    assert_eq!(
        slow.to_string(),
        "version later: 500h comes every 100 ms (3.0: every 10 ms, 4.0: every 10 ms), 523h has 6 bytes (3.0: 8)"
    );
    let fast = among(&three(), [every(10, 0x500, &[0; 8]), steer].concat());
    assert_eq!((fast.edition.version, fast.certain), ("4.0", true), "{fast}");
    assert_eq!(fast.against, ["120h is absent (4.0: every 10 ms)"]);
}

#[test]
fn a_value_that_one_edition_allows_tells_it() {
    let off = among(&three(), every(10, 0x520, &[0; 8]));
    assert_eq!((off.edition.version, off.certain), ("later", true), "{off}");
    assert_eq!(off.evidence, ["AS_STATE of 520h is 0 (3.0: 1 to 5, 4.0: 1 to 5)"]);
}

#[test]
fn a_message_that_one_edition_has_tells_it() {
    let status = among(&three(), every(10, 0x120, &[0; 8]));
    assert_eq!((status.edition.version, status.certain), ("4.0", true), "{status}");
    let text = "120h is there (3.0: no such message, later: no such message)";
    assert_eq!(status.evidence, [text]);
}

#[test]
fn bits_that_have_a_signal_in_one_edition_only_tell_it() {
    let plausibility = [0, 0, 1, 0, 0, 0, 4, 0];
    let two = [&Edition::V3_0, &Edition::V4_0];
    let status = among(&two, every(10, 0x520, &plausibility));
    assert_eq!((status.edition.version, status.certain), ("4.0", true), "{status}");
    assert_eq!(status.evidence, ["520h uses BRAKE_PLAUSIBILITY_FAULT (3.0: no signal there)"]);
    let unassigned = among(&two, every(10, 0x520, &[0, 0, 1, 0, 0, 0, 8, 0]));
    assert_eq!(unassigned.evidence, [""; 0], "no edition has a signal there");
}

#[test]
fn what_fits_two_editions_alike_is_not_certain() {
    let both = among(&three(), every(10, 0x523, &[0; 6]));
    assert!(!both.certain, "{both}");
    assert_eq!(both.edition.version, "later", "it lacks no message");
    let all = among(&three(), every(10, 0x526, &[0; 8]));
    assert_eq!((all.edition.version, all.certain), ("3.0", false), "the default");
}

#[test]
fn a_length_that_no_edition_has_is_told_and_decides_nothing() {
    let odd = among(&[&Edition::V3_0, &Edition::V4_0], every(10, 0x511, &[0; 5]));
    assert_eq!((odd.edition.version, odd.certain), ("3.0", false));
    assert_eq!(
        odd.to_string(),
        "version 3.0, as the frames do not tell which, but 511h has 5 bytes (3.0: 8, 4.0: 4)"
    );
}

/// `STATUS_EBS` is not there in 3.0, and 0 in no edition: a start value.
#[test]
fn a_value_that_no_edition_allows_tells_nothing() {
    let start = among(&[&Edition::V3_0, &Edition::V4_0], every(10, 0x524, &[0, 0, 0, 0, 1]));
    assert_eq!((start.edition.version, start.certain), ("4.0", true), "{start}");
    assert_eq!(start.against, ["120h is absent (4.0: every 10 ms)"], "and nothing else");
}

/// Data of any length, times of any order, and identifiers of any width.
#[test]
fn no_frame_is_too_odd() {
    let mut recogniser = Recogniser::new(Edition::DEFAULT);
    for len in 0..80 {
        for (t, id) in [(i64::MIN, 0x520), (i64::MAX, 0x511), (0, u32::MAX), (-1, 0)] {
            recogniser.frame(t, id, &vec![0xFF; len]);
        }
    }
    assert!(!recogniser.recognise().to_string().is_empty());
    assert_eq!(Recogniser::among(&[], Edition::DEFAULT).recognise().edition, Edition::DEFAULT);
}
