//! Recognition by the editions' tables alone.

use adsdv_spec::Edition;

use super::{Recognised, Recogniser};

const MS: i64 = 1_000_000;

fn among(editions: &[&'static Edition], frames: impl IntoIterator<Item = (i64, u32, Vec<u8>)>) -> Recognised {
    let mut recogniser = Recogniser::among(editions.to_vec().leak(), &Edition::V3_0);
    for (t_ms, id, data) in frames {
        let of_sides =
            editions.iter().any(|edition| edition.bus.messages.iter().any(|one| u32::from(one.id) == id));
        assert_eq!(recogniser.frame(t_ms * MS, id, &data), of_sides, "{id:03X}h");
        assert_eq!(recogniser.knows(id), of_sides, "{id:03X}h");
    }
    recogniser.recognise()
}

fn three() -> [&'static Edition; 3] {
    [&Edition::V3_0, &Edition::V4_0, &Edition::V2026]
}

fn every(ms: i64, id: u32, data: &[u8]) -> Vec<(i64, u32, Vec<u8>)> {
    (0..1000 / ms).map(|place| (place * ms, id, data.to_vec())).collect()
}

#[test]
fn a_slower_message_tells_an_edition() {
    let steer = every(10, 0x523, &[0; 6]);
    let slow = among(&three(), [every(100, 0x500, &[0; 8]), steer.clone()].concat());
    assert_eq!((slow.edition.version, slow.certain), ("2026", true), "{slow}");
    assert_eq!(
        slow.to_string(),
        "version 2026: 500h comes every 100 ms (3.0: every 10 ms, 4.0: every 10 ms), 523h has 6 bytes (3.0: 8)"
    );
    let fast = among(&three(), [every(10, 0x500, &[0; 8]), steer].concat());
    assert_eq!((fast.edition.version, fast.certain), ("4.0", true), "{fast}");
    assert_eq!(fast.against, ["120h is absent (4.0: every 10 ms)"]);
}

#[test]
fn a_value_that_one_edition_allows_tells_it() {
    let off = among(&three(), every(10, 0x520, &[0; 8]));
    assert_eq!((off.edition.version, off.certain), ("2026", true), "{off}");
    assert_eq!(off.evidence, ["AS_STATE of 520h is 0 (3.0: 1 to 5, 4.0: 1 to 5)"]);
}

#[test]
fn a_message_that_one_edition_has_tells_it() {
    let status = among(&three(), every(10, 0x120, &[0; 8]));
    assert_eq!((status.edition.version, status.certain), ("4.0", true), "{status}");
    let text = "120h is there (3.0: no such message, 2026: no such message)";
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

/// In 4.0 these bits have no meaning.
#[test]
fn the_states_that_520h_shows_since_2026_tell_it() {
    for (byte, raw, name) in [(0, 0x20, "OP_STATE"), (3, 0x30, "TS_STATE"), (4, 0x20, "EBS_STATE")] {
        let mut data = [0, 0, 1, 0, 0, 0, 0, 0];
        data[byte] = raw;
        let status = among(&three(), every(10, 0x520, &data));
        assert_eq!((status.edition.version, status.certain), ("2026", true), "{status}");
        let text = format!("520h uses {name} (3.0: no signal there, 4.0: no signal there)");
        assert_eq!(status.evidence, [text]);
    }
}

#[test]
fn steering_beyond_the_limit_of_all_others_tells_2026() {
    let steer = among(&three(), every(10, 0x513, &250_i16.to_le_bytes()));
    assert_eq!((steer.edition.version, steer.certain), ("2026", true), "{steer}");
    let text = "STEER_REQUEST_deg of 513h is 250 (3.0: -240 to 240, 4.0: -210 to 210)";
    assert!(steer.evidence.iter().any(|evidence| evidence == text), "{steer}");
}

#[test]
fn the_messages_of_devices_tell_the_edition_that_names_them() {
    let steer = every(10, 0x523, &[0; 6]);
    for device in Edition::V2026.bus.devices {
        let frames = every(10, device.id.into(), &vec![0; device.len.into()]);
        let known = among(&three(), [frames, steer.clone()].concat());
        assert_eq!((known.edition.version, known.certain), ("2026", true), "{known}");
        let text = format!("{:03X}h is there (3.0: no such device, 4.0: no such device)", device.id);
        assert_eq!(known.evidence[0], text);
    }
    let all = [every(10, 0x300, &[0; 8]), every(10, 0x181, &[0; 8]), every(100, 0x123, &[0])].concat();
    let all = among(&three(), all);
    assert_eq!(all.evidence, ["123h, 181h and 300h are there (3.0: no such device, 4.0: no such device)"]);
}

/// Devices of another vehicle may use the same identifiers.
#[test]
fn a_device_tells_less_than_all_else() {
    let steer = every(10, 0x523, &[0; 6]);
    let other = among(&three(), [every(10, 0x181, &[0; 7]), steer.clone()].concat());
    assert!(!other.certain, "of another length: {other}");
    let devices = [every(10, 0x181, &[0; 8]), every(10, 0x300, &[0; 8]), every(100, 0x123, &[0])].concat();
    let frames = [devices, every(10, 0x500, &[0; 8]), steer].concat();
    let before = among(&three(), frames);
    assert_eq!((before.edition.version, before.certain), ("4.0", true), "{before}");
    let against = "123h, 181h and 300h are there (3.0: no such device, 4.0: no such device)";
    assert_eq!(before.against, [against, "120h is absent (4.0: every 10 ms)"]);
}

#[test]
fn what_fits_two_editions_alike_is_not_certain() {
    let both = among(&three(), every(10, 0x523, &[0; 6]));
    assert!(!both.certain, "{both}");
    assert_eq!(both.edition.version, "2026", "it lacks no message");
    let text = "version 2026, though 4.0 fits as well: 523h has 6 bytes (3.0: 8)";
    assert_eq!((both.to_string(), both.alike), (text.to_owned(), vec![&Edition::V4_0]));
    let all = among(&three(), every(10, 0x526, &[0; 8]));
    assert_eq!((all.edition.version, all.certain), ("3.0", false), "the default");
}

#[test]
fn a_length_that_no_edition_has_is_named_and_decides_nothing() {
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
