//! The reader as its users see it: whole logs, rubbish, failing sources, and the way there and back.

use std::fmt::Write as _;
use std::io::{self, Read};

use super::*;

/// What stays of an entry when the reader moves on.
#[derive(Clone, Debug, PartialEq, Eq)]
enum OwnedEntry {
    Frame { line: u64, time_ns: i64, interface: String, kind: FrameKind, id: u32, data: Vec<u8> },
    Dropped { line: u64, interface: String, count: u64, total: u64 },
    Broken(LineError),
}

fn time_of(entry: &OwnedEntry) -> i64 {
    let OwnedEntry::Frame { time_ns, .. } = entry else { panic!("{entry:?}") };
    *time_ns
}

fn set_time(entry: &mut OwnedEntry, time: impl Fn(i64) -> i64) {
    let OwnedEntry::Frame { time_ns, .. } = entry else { panic!("{entry:?}") };
    *time_ns = time(*time_ns);
}

impl OwnedEntry {
    fn line(&self) -> u64 {
        match self {
            Self::Frame { line, .. } | Self::Dropped { line, .. } => *line,
            Self::Broken(error) => error.line,
        }
    }
}

fn read_all(source: impl Read) -> (Vec<OwnedEntry>, Option<ReadError>) {
    let mut reader = Reader::new(source);
    let mut seen = Vec::new();
    loop {
        match reader.next_record() {
            Ok(Some(Entry::Frame(record))) => seen.push(OwnedEntry::Frame {
                line: record.line,
                time_ns: record.time_ns,
                interface: record.interface.to_owned(),
                kind: record.kind,
                id: record.id,
                data: record.data.to_vec(),
            }),
            Ok(Some(Entry::Dropped(Dropped { line, interface, count, total }))) => {
                seen.push(OwnedEntry::Dropped { line, interface: interface.to_owned(), count, total });
            }
            Ok(Some(Entry::Broken(error))) => seen.push(OwnedEntry::Broken(error)),
            Ok(None) => return (seen, None),
            Err(error) => return (seen, Some(error)),
        }
    }
}

fn read(text: &[u8]) -> Vec<OwnedEntry> {
    let (seen, error) = read_all(text);
    assert!(error.is_none());
    seen
}

/// `Ok` with its line number for each line that was read, `Err` for each broken one.
fn outline(seen: &[OwnedEntry]) -> Vec<Result<u64, u64>> {
    seen.iter()
        .map(
            |entry| if matches!(entry, OwnedEntry::Broken(_)) { Err(entry.line()) } else { Ok(entry.line()) },
        )
        .collect()
}

/// What is drawn from a seed, so that a failure can be repeated.
struct Random(fastrand::Rng);

impl Random {
    fn with_seed(seed: u64) -> Self {
        Self(fastrand::Rng::with_seed(seed))
    }

    fn below(&mut self, bound: usize) -> usize {
        self.0.usize(..bound)
    }

    /// Of up to 29 bits, short ones as likely as long ones.
    fn identifier(&mut self) -> u32 {
        self.0.u32(..) >> self.0.u32(3..32)
    }

    fn bytes(&mut self, len: usize) -> Vec<u8> {
        (0..len).map(|_| self.0.u8(..)).collect()
    }

    /// Bytes that a log is made of, so that rubbish comes close to being a frame.
    fn near_miss(&mut self, len: usize) -> Vec<u8> {
        const ALPHABET: &[u8] = b"()... 0123456789abcdefABCDEF##RT_:vcan\r\t\n\0";
        (0..len).map(|_| ALPHABET[self.below(ALPHABET.len())]).collect()
    }
}

/// A source that gives a few bytes at a time, and is interrupted in between.
struct Trickle<'a>(&'a [u8], Random);

impl Read for Trickle<'_> {
    fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
        let count = 1 + self.1.below(30);
        if count == 7 {
            return Err(io::ErrorKind::Interrupted.into());
        }
        let count = count.min(room.len());
        self.0.read(&mut room[..count])
    }
}

const GOOD: &[u8] = b"(1.000000) vcan0 520#0001";

#[test]
fn recorded_logs_are_read_to_the_last_line() {
    for (name, frames) in [("mission.log", 33_940), ("finished-while-moving.log", 32_535)] {
        let path = format!("{}/../tests/logs/{name}", env!("CARGO_MANIFEST_DIR"));
        let log = std::fs::read(path).expect("the recorded log is part of the project");
        let seen = read(&log);
        assert_eq!(seen.len(), frames, "{name}");
        // Written again they are the same log, byte for byte.
        let mut again = Vec::new();
        for entry in &seen {
            let OwnedEntry::Frame { time_ns, interface, id, data, .. } = entry else {
                panic!("{name}: {entry:?}");
            };
            write_frame(&mut again, *time_ns, interface, *id, data).expect("writing to memory");
        }
        assert!(again == log, "{name}");
    }
}

#[test]
fn blank_lines_and_carriage_returns_are_no_errors_and_count() {
    let log = b"\r\n\n(1.000000) vcan0 520#0001\r\n \t\n(1.000000) vcan0 520#0001";
    assert_eq!(outline(&read(log)), [Ok(3), Ok(5)]);
    assert_eq!(read(b""), []);
    assert_eq!(read(b"\n\r\n  "), []);
}

/// candump writes the name of an interface on each line. Without it nobody knows which bus a frame is from: the line is
/// broken, whether one space stands in its place or two, and whether or not a frame came before.
#[test]
fn a_line_without_an_interface_is_broken_wherever_it_stands() {
    for line in [&b"(1795210168.432225) 514#C8C8"[..], b"(1795210168.432225)  514#C8C8"] {
        assert_eq!(outline(&read(line)), [Err(1)], "{}", line.escape_ascii());
        assert_eq!(outline(&read(&[GOOD, b"\n", line].concat())), [Ok(1), Err(2)], "{}", line.escape_ascii());
    }
}

/// Some editors put a mark before the first line. It costs nothing; anywhere else it is what it is, rubbish.
#[test]
fn the_mark_of_utf_8_costs_no_line() {
    let mark = &b"\xef\xbb\xbf"[..];
    for (log, read) in [
        ([mark, GOOD, b"\n", GOOD].concat(), vec![Ok(1), Ok(2)]),
        ([mark, b"\r\n", GOOD].concat(), vec![Ok(2)]),
        (mark.to_vec(), vec![]),
        ([mark, mark, GOOD].concat(), vec![Err(1)]),
        ([GOOD, b"\n", mark, GOOD].concat(), vec![Ok(1), Err(2)]),
        ([b"\xef\xbb", GOOD].concat(), vec![Err(1)]),
    ] {
        assert_eq!(outline(&self::read(&log)), read, "{}", log.escape_ascii());
        let (seen, error) = read_all(Trickle(&log, Random::with_seed(3)));
        assert!(error.is_none());
        assert_eq!(outline(&seen), read, "{}", log.escape_ascii());
    }
}

#[test]
fn a_last_line_counts_without_its_line_feed_if_it_is_whole() {
    let whole = b"(1.000000) vcan0 520#0001";
    for len in 1..=whole.len() {
        let frame = len == whole.len() || whole[..len].ends_with(b"#") || whole[..len].ends_with(b"#00");
        let expected = if len > 18 && frame { Ok(1) } else { Err(1) };
        assert_eq!(outline(&read(&whole[..len])), [expected], "{}", whole[..len].escape_ascii());
    }
}

#[test]
fn several_interfaces_and_sorts_of_frame_share_a_log() {
    let log = b"(1.0) can0 520#00\n(1.1)  vcan12 20000004#00\n(1.2) can0 123##100\n(1.3) can1 00000123#R\n";
    let seen: Vec<_> = read(log)
        .into_iter()
        .map(|entry| match entry {
            OwnedEntry::Frame { interface, kind, .. } => (interface, kind),
            other => panic!("{other:?}"),
        })
        .collect();
    let expected = [
        ("can0", FrameKind::Standard),
        ("vcan12", FrameKind::Error),
        ("can0", FrameKind::Fd { extended: false, flags: 1 }),
        ("can1", FrameKind::Remote { extended: true, len: 0 }),
    ];
    assert_eq!(seen, expected.map(|(interface, kind)| (interface.to_owned(), kind)));
}

/// The lines of a log as candump prints them for a person, with what `time` makes of the time since 1970 and since the line before.
fn printed(log: &[u8], mut time: impl FnMut(i64, i64) -> String) -> Vec<u8> {
    let (mut text, mut last) = (String::new(), None);
    for entry in read(log) {
        let OwnedEntry::Frame { time_ns, interface, id, data, .. } = entry else { panic!("{entry:?}") };
        let bytes: Vec<String> = data.iter().map(|byte| format!("{byte:02X}")).collect();
        let time = time(time_ns, time_ns - last.unwrap_or(time_ns));
        last = Some(time_ns);
        writeln!(text, "{time}  {interface}  {id:03X}   [{}]  {}", data.len(), bytes.join(" "))
            .expect("text");
    }
    text.into_bytes()
}

#[test]
fn a_log_that_was_printed_for_a_person_reads_like_one_that_was_recorded() {
    let log = include_bytes!("../../../tests/logs/mission.log");
    let recorded = read(log);
    let first = recorded.first().map(time_of).expect("a frame");
    let seconds = |ns: i64| format!("{:03}.{:06}", ns / 1_000_000_000, ns / 1000 % 1_000_000);
    let day = |ns: i64| (ns / 1_000_000_000 % 86_400, ns / 86_400_000_000_000 * 86_400_000_000_000);
    let (_, midnight) = day(first);
    let absolute = printed(log, |now, _| format!(" ({})", seconds(now)));
    let since_first = printed(log, |now, _| format!(" ({})", seconds(now - first)));
    let since_last = printed(log, |_, delta| format!(" ({})", seconds(delta)));
    let date = printed(log, |now, _| {
        let (of_day, _) = day(now);
        let clock = format!("{:02}:{:02}:{:02}", of_day / 3600, of_day / 60 % 60, of_day % 60);
        format!(" (1970-01-02 {clock}.{:06})", now / 1000 % 1_000_000)
    });
    for (text, begin) in [(absolute, 0), (since_first, first), (date, midnight - 86_400_000_000_000)] {
        let mut expected = recorded.clone();
        for entry in &mut expected {
            set_time(entry, |time_ns| time_ns - begin);
        }
        assert!(read(&text) == expected, "{}", String::from_utf8_lossy(&text[..200]));
    }
    // Only of the first few it is not known yet that their times are since the frame before.
    let read = read(&since_last);
    let wrong = read.iter().zip(&recorded).filter(|(read, is)| time_of(read) != time_of(is) - first).count();
    assert!(wrong < 20 && read.len() == recorded.len(), "{wrong}");
    // Without times none passes.
    assert!(self::read(&printed(log, |_, _| String::new())).iter().all(|entry| time_of(entry) == 0));
}

#[test]
fn a_broken_line_is_reported_with_where_what_and_why_and_costs_only_itself() {
    let broken: [(&[u8], &str); 6] = [
        (
            b"vcan0  520   [8]  00 00",
            "line 2, column 24: found the end of the line, expected as many data bytes as the length says, such as 00 1A",
        ),
        (
            b"(1.000000) vcan0 52x#00\r",
            r#"line 2, column 20: found "x#00\r", expected a hexadecimal digit of the identifier"#,
        ),
        (
            b"(1.000000) vcan0 520#000",
            "line 2, column 25: found the end of the line, expected the second hexadecimal digit of a data byte",
        ),
        (b"\0\0\0", r#"line 2, column 1: found "\x00\x00\x00", expected a time such as (1436509052.249713)"#),
        (
            b"(1.000000) vcan0 520#00 00",
            r#"line 2, column 25: found "00", expected the end of the line, or R (received) or T (sent)"#,
        ),
        (
            b"(99999999999.0) vcan0 520#00",
            r#"line 2, column 1: found "(99999999999.0) vcan0 52"..., expected a time before the year 2262, which is what 64 bits of nanoseconds can hold"#,
        ),
    ];
    for (line, message) in broken {
        let seen = read(&[GOOD, line, GOOD].join(&b'\n'));
        assert_eq!(outline(&seen), [Ok(1), Err(2), Ok(3)]);
        let OwnedEntry::Broken(error) = &seen[1] else { unreachable!("the outline says so") };
        assert_eq!(error.to_string(), message);
    }
}

#[test]
fn an_endless_line_is_one_broken_line() {
    for len in [MAX_LINE - 1, MAX_LINE, MAX_LINE + 1, 127 * 1024, 128 * 1024, 129 * 1024, 3_000_000] {
        let endless = vec![b'7'; len];
        let log = [GOOD, &endless, GOOD].join(&b'\n');
        let trickled = read_all(Trickle(&log, Random::with_seed(len as u64))).0;
        for seen in [read(&log), trickled] {
            assert_eq!(outline(&seen), [Ok(1), Err(2), Ok(3)], "{len}");
            let OwnedEntry::Broken(error) = &seen[1] else { unreachable!("the outline says so") };
            assert_eq!(error.expected.contains("8192"), len > MAX_LINE, "{len}: {error}");
            assert_eq!(error.found.to_string(), r#""777777777777777777777777"..."#);
        }
        assert_eq!(outline(&read(&endless)), [Err(1)]);
    }
}

/// Also where the line feed has yet to come.
#[test]
fn a_line_of_the_most_bytes_is_read() {
    for (len, end, expected) in
        [(MAX_LINE, &b"\n"[..], Ok(1)), (MAX_LINE, b" \n", Err(1)), (MAX_LINE + 1, b"\n", Err(1))]
    {
        let mut line = GOOD.to_vec();
        line.resize(len, b' ');
        let (seen, error) = read_all(line.chain(end));
        assert!(error.is_none());
        assert_eq!(outline(&seen), [expected], "{len}");
    }
}

#[test]
fn an_endless_source_without_line_feeds_takes_no_memory() {
    let mut reader = Reader::new(io::repeat(0).take(1 << 28).chain(&b"\n(1.0) vcan0 520#00"[..]));
    assert!(matches!(reader.next_record(), Ok(Some(Entry::Broken(LineError { line: 1, .. })))));
    assert!(matches!(reader.next_record(), Ok(Some(Entry::Frame(Record { line: 2, .. })))));
    assert!(matches!(reader.next_record(), Ok(None)));
    assert_eq!(reader.line(), 2);
    assert!(reader.capacity() < 256 * 1024);
}

#[test]
fn lost_frames_are_read_as_they_are_written() -> io::Result<()> {
    let mut log = b"(1.000000) vcan0 520#00\n".to_vec();
    for (count, total) in [(1, 1), (3, 4), (u64::from(u32::MAX), u64::MAX >> 1)] {
        write_dropped(&mut log, &Dropped { line: 0, interface: "vcan0", count, total })?;
    }
    let text = String::from_utf8_lossy(&log).into_owned();
    assert!(text.contains("DROPCOUNT: dropped 1 CAN frame on 'vcan0' socket (total drops 1)\n"), "{text}");
    assert!(text.contains("DROPCOUNT: dropped 3 CAN frames on 'vcan0' socket (total drops 4)\n"), "{text}");
    log.extend(b"DROPCOUNT: dropped 3 CAN fr");
    let seen = read(&log);
    assert_eq!(outline(&seen), [Ok(1), Ok(2), Ok(3), Ok(4), Err(5)]);
    let dropped =
        |line, count, total| OwnedEntry::Dropped { line, interface: "vcan0".to_owned(), count, total };
    assert_eq!(seen[1..4], [dropped(2, 1, 1), dropped(3, 3, 4), dropped(4, 0xFFFF_FFFF, u64::MAX >> 1)]);
    let mut nothing = Vec::new();
    let refused = write_dropped(&mut nothing, &Dropped { line: 0, interface: "can 0", count: 1, total: 1 });
    assert_eq!(refused.map_err(|error| error.kind()), Err(io::ErrorKind::InvalidInput));
    assert!(nothing.is_empty());
    Ok(())
}

#[test]
fn a_failing_source_costs_no_line_before_the_failure() {
    struct Fails;
    impl Read for Fails {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            Err(io::ErrorKind::PermissionDenied.into())
        }
    }
    let log = [GOOD, b"rubbish", GOOD, b"(1.0"].join(&b'\n');
    let (seen, error) = read_all(log.chain(Fails));
    assert_eq!(outline(&seen), [Ok(1), Err(2), Ok(3)]);
    let error = error.expect("the source fails");
    assert_eq!((error.line, error.source.kind()), (3, io::ErrorKind::PermissionDenied));
}

#[test]
fn rubbish_never_panics_and_never_hides_a_line() {
    let mut random = Random::with_seed(0x0AD5_D001);
    for round in 0..3_000 {
        let (mut log, mut expected, mut lines) = (Vec::new(), Vec::new(), 0);
        for _ in 0..random.below(6) {
            let len = random.below(if round % 100 == 0 { 20_000 } else { 60 });
            let rubbish = if round % 2 == 0 { random.bytes(len) } else { random.near_miss(len) };
            lines += memchr::memchr_iter(b'\n', &rubbish).count() as u64;
            log.extend(rubbish);
            log.push(b'\n');
            let time = random.0.i64(0..);
            let id = random.identifier();
            let len = random.below(9);
            let data = random.bytes(len);
            write_frame(&mut log, time, "vcan0", id, &data).expect("a valid frame");
            lines += 2;
            expected.push((lines, time, id, data));
        }
        let seen = read(&log);
        assert!(seen.is_sorted_by(|one, next| one.line() < next.line()));
        let frames = seen.iter().filter_map(|entry| match entry {
            OwnedEntry::Frame { line, time_ns, id, data, .. } => Some((*line, *time_ns, *id, data.clone())),
            OwnedEntry::Dropped { .. } | OwnedEntry::Broken(_) => None,
        });
        // Rubbish may happen to be a frame; every frame that was written has to be there.
        let frames: Vec<_> =
            frames.filter(|frame| expected.iter().any(|(line, ..)| *line == frame.0)).collect();
        assert_eq!(frames, expected, "{}", log.escape_ascii());
        // And it does not matter in what pieces the log arrives.
        assert_eq!(read_all(Trickle(&log, Random::with_seed(round + 1))).0, seen);
    }
}

#[test]
fn a_changed_byte_breaks_at_most_its_own_line() {
    let line: &[u8] = b"(1795209995.234358) vcan0 520#0000010000000000";
    for place in 0..line.len() {
        for byte in (0..=u8::MAX).filter(|byte| *byte != b'\n') {
            let mut changed = line.to_vec();
            changed[place] = byte;
            let outline = outline(&read(&[line, &changed, line].join(&b'\n')));
            assert!(matches!(outline[..], [Ok(1), Ok(2) | Err(2), Ok(3)]), "{}", changed.escape_ascii());
        }
    }
}

#[test]
fn what_is_written_is_read_back() {
    let mut random = Random::with_seed(0x0AD5_D002);
    for _ in 0..20_000 {
        let time_ns = random.0.i64(0..) >> random.0.u32(..63);
        let interface = ["vcan0", "can0", "any", "slcan12", "can-π", "520#00"][random.below(6)];
        let id = random.identifier();
        let len = random.below(9);
        let data = random.bytes(len);
        let mut log = Vec::new();
        write_frame(&mut log, time_ns, interface, id, &data).expect("a valid frame");
        let kind = if id > 0x7FF { FrameKind::Extended } else { FrameKind::Standard };
        let expected =
            OwnedEntry::Frame { line: 1, time_ns, interface: interface.to_owned(), kind, id, data };
        assert_eq!(read(&log), [expected], "{}", log.escape_ascii());
    }
}

#[test]
fn a_last_line_that_was_cut_off_is_not_taken_for_a_whole_one() {
    let mut reader = Reader::new(&b"(1.000000) can0 520#0011\n(1.010000) can0 520#00"[..]);
    let mut terminated = Vec::new();
    while let Ok(Some(Entry::Frame(record))) = reader.next_record() {
        terminated.push(record.terminated);
    }
    assert_eq!(terminated, [true, false]);
}
