use std::io::Cursor;

use adsdv_oracle::candump::{Direction, Entries as _, Entry};

use super::McapReader;

fn text(text: &str) -> Vec<u8> {
    let mut bytes = u32::try_from(text.len()).expect("short").to_le_bytes().to_vec();
    bytes.extend(text.as_bytes());
    bytes
}

fn record(kind: u8, body: &[u8]) -> Vec<u8> {
    let mut record = vec![kind];
    record.extend((body.len() as u64).to_le_bytes());
    record.extend(body);
    record
}

fn schema(id: u16, name: &str, encoding: &str) -> Vec<u8> {
    let parts: [&[u8]; 4] = [&id.to_le_bytes(), &text(name), &text(encoding), &text("")];
    record(3, &parts.concat())
}

fn channel(id: u16, schema: u16, topic: &str, encoding: &str) -> Vec<u8> {
    let parts: [&[u8]; 5] =
        [&id.to_le_bytes(), &schema.to_le_bytes(), &text(topic), &text(encoding), &text("")];
    record(4, &parts.concat())
}

fn message(channel: u16, logged: u64, body: &[u8]) -> Vec<u8> {
    let parts: [&[u8]; 5] =
        [&channel.to_le_bytes(), &[0; 4], &logged.to_le_bytes(), &logged.to_le_bytes(), body];
    record(5, &parts.concat())
}

/// A `can_msgs/msg/Frame` of three bytes of data, without a time if that is 0.
fn frame(seconds: u32, id: u32, big: bool) -> Vec<u8> {
    let number = |number: u32| if big { number.to_be_bytes() } else { number.to_le_bytes() };
    let mut frame = vec![0, u8::from(!big), 0, 0];
    frame.extend([number(seconds), number(7 * seconds.min(1)), number(4)].concat());
    frame.extend(b"can\0");
    frame.extend(number(id));
    frame.extend([0, 0, 0, 3, 1, 2, 3, 0, 0, 0, 0, 0]);
    frame
}

fn chunk(compression: &str, packed: &[u8], unpacked: usize, checksum: u32) -> Vec<u8> {
    let parts: [&[u8]; 6] = [
        &[0; 16],
        &(unpacked as u64).to_le_bytes(),
        &checksum.to_le_bytes(),
        &text(compression),
        &(packed.len() as u64).to_le_bytes(),
        packed,
    ];
    record(6, &parts.concat())
}

fn file(parts: &[Vec<u8>]) -> Vec<u8> {
    let begin: &[u8] = b"\x89MCAP0\r\n";
    [begin, &record(1, &[0; 8]), &parts.concat(), &record(15, &[0; 4])].concat()
}

fn read(bytes: Vec<u8>) -> Vec<String> {
    let mut reader = McapReader::new(Box::new(Cursor::new(bytes)));
    let mut all = Vec::new();
    while let Some(entry) = reader.next_entry().expect("memory does not fail") {
        all.push(match entry {
            Entry::Frame(record) => format!(
                "{} {} {} {:X} {:?} {}",
                record.line,
                record.time_ns,
                record.interface,
                record.id,
                record.data,
                match record.direction {
                    Some(Direction::Tx) => "T",
                    Some(Direction::Rx) => "R",
                    None => "-",
                }
            ),
            Entry::Dropped(dropped) => format!("{dropped:?}"),
            Entry::Broken(error) => error.to_string(),
        });
    }
    all
}

fn begin() -> Vec<u8> {
    [
        schema(1, "can_msgs/msg/Frame", "ros2msg"),
        channel(1, 1, "/can0/from_can_bus", "cdr"),
        channel(2, 1, "/can0/to_can_bus", "cdr"),
        channel(3, 1, "/can 1", "cdr"),
    ]
    .concat()
}

#[test]
fn frames_are_read_with_their_own_time_or_that_of_the_log() {
    let frames = [frame(9, 0x520, false), frame(0, 0x511, true), frame(1, 0x123, false)];
    let messages: Vec<u8> =
        (1..).zip(&frames).flat_map(|(id, frame)| message(id, 4 + u64::from(id), frame)).collect();
    assert_eq!(
        read(file(&[begin(), messages])),
        [
            "6 9000000007 /can0 520 [1, 2, 3] R".to_owned(),
            "7 6 /can0 511 [1, 2, 3] T".to_owned(),
            "8 1000000007 /can_1 123 [1, 2, 3] -".to_owned(),
        ]
    );
}

#[test]
fn a_frame_that_is_sent_and_looped_back_is_read_once() {
    let sent_and_heard =
        [message(2, 5, &frame(9, 0x511, false)), message(1, 6, &frame(9, 0x511, false))].concat();
    let other = message(1, 7, &frame(9, 0x520, false));
    assert_eq!(
        read(file(&[begin(), sent_and_heard, other])),
        ["6 9000000007 /can0 511 [1, 2, 3] T".to_owned(), "8 9000000007 /can0 520 [1, 2, 3] R".to_owned()]
    );
}

#[test]
fn a_channel_of_can_that_is_not_read_is_told_of_once() {
    let parts = [
        schema(1, "foo.CanFrame", "protobuf"),
        channel(1, 1, "/can", "protobuf"),
        channel(2, 0, "/raw_can", "json"),
        schema(3, "sensor_msgs/msg/LaserScan", "ros2msg"),
        channel(3, 3, "/scan", "cdr"),
        message(1, 5, b"x"),
        message(2, 5, b"x"),
        message(3, 5, b"x"),
        message(4, 5, b"x"),
        message(4, 5, b"x"),
    ];
    let found = read(file(&parts));
    let begins = [
        "record 3, byte 3: found \"foo.CanFrame\", expected frames of CAN",
        "record 4, byte 9: found \"/raw_can",
        "record 10, byte 1: found \"\\x04\\x00",
    ];
    assert_eq!(found.len(), begins.len(), "{found:#?}");
    for (found, begin) in found.iter().zip(begins) {
        assert!(found.starts_with(begin), "{found}, {begin}");
    }
}

#[test]
fn a_chunk_that_is_damaged_costs_itself() {
    let sound = message(1, 5, &frame(9, 0x520, false));
    let mut longer = sound.clone();
    longer[1] += 1;
    let sound_chunk = chunk("", &sound, sound.len(), 0);
    for (damaged, frames) in [
        (chunk("", &longer, longer.len(), 0), 2),
        (chunk("", &sound, sound.len(), 1), 3),
        (chunk("zstd", &sound, sound.len(), 0), 2),
        (chunk("lz4", &sound, sound.len(), 0), 2),
        (chunk("brotli", &sound, sound.len(), 0), 2),
        (chunk("", &sound_chunk, sound_chunk.len(), 0), 2),
        (chunk("", &[0; 20], 20, 0), 2),
    ] {
        let found = read(file(&[begin(), sound_chunk.clone(), damaged, sound_chunk.clone()]));
        let broken = found.iter().filter(|entry| entry.starts_with("record")).count();
        assert_eq!((found.len() - broken, broken), (frames, 1), "{found:#?}");
    }
}

#[test]
fn a_file_that_was_cut_off_gives_all_that_is_in_it_and_says_so() {
    let messages = message(1, 5, &frame(9, 0x520, false)).repeat(3);
    let whole = file(&[begin(), chunk("", &messages, messages.len(), 0), messages.clone()]);
    let mut last = 0;
    // The mark of the end has 13 bytes, of which 9 are enough.
    for len in 0..whole.len() - 4 {
        let found = read(whole.get(..len).unwrap_or_default().to_vec());
        let broken = found.iter().filter(|entry| entry.starts_with("record")).count();
        assert!((1..=2).contains(&broken), "{found:#?} of {len}");
        assert!(found.len() - broken >= last, "{found:#?} of {len}");
        last = found.len() - broken;
    }
    assert_eq!(last, 6);
    assert_eq!(read(whole).len(), 6);
}
