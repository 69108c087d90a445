use std::fmt::Write as _;
use std::io::{Cursor, Write as _};

use adsdv_oracle::candump::Direction::{Rx, Tx};
use adsdv_oracle::candump::{Entries as _, Entry, FrameKind};
use flate2::Compression;
use flate2::write::ZlibEncoder;

use super::BlfReader;

/// The header of a file whose measurement began a second after 1970.
fn file() -> Vec<u8> {
    let mut file = b"LOGG".to_vec();
    file.extend(144_u32.to_le_bytes());
    file.resize(40, 0);
    file.extend([1970_u16, 1, 4, 1, 0, 0, 1, 0].map(u16::to_le_bytes).concat());
    file.resize(144, 0);
    file
}

/// An object with a header of version 1 and padding; the time is in nanoseconds.
fn object(kind: u32, time: u64, body: &[u8]) -> Vec<u8> {
    let size = u32::try_from(32 + body.len()).expect("small");
    let mut object = b"LOBJ".to_vec();
    object.extend([32_u16, 1].map(u16::to_le_bytes).concat());
    object.extend([size, kind, 2, 0].map(u32::to_le_bytes).concat());
    object.extend(time.to_le_bytes());
    object.extend(body);
    object.resize(object.len() + (size % 4) as usize, 0);
    object
}

/// An object with a header of version 2; the time is in tens of microseconds.
fn object_2(kind: u32, time: u64, body: &[u8]) -> Vec<u8> {
    let size = u32::try_from(40 + body.len()).expect("small");
    let mut object = b"LOBJ".to_vec();
    object.extend([40_u16, 2].map(u16::to_le_bytes).concat());
    object.extend([size, kind, 1, 0].map(u32::to_le_bytes).concat());
    object.extend([time, 0].map(u64::to_le_bytes).concat());
    object.extend(body);
    object
}

fn container(method: u16, content: &[u8], claimed: u32) -> Vec<u8> {
    let size = u32::try_from(32 + content.len()).expect("small");
    let mut object = b"LOBJ".to_vec();
    object.extend([16_u16, 1].map(u16::to_le_bytes).concat());
    object.extend([size, 10].map(u32::to_le_bytes).concat());
    object.extend([method, 0, 0, 0].map(u16::to_le_bytes).concat());
    object.extend([claimed, 0].map(u32::to_le_bytes).concat());
    object.extend(content);
    object.resize(object.len() + (size % 4) as usize, 0);
    object
}

fn stored(content: &[u8]) -> Vec<u8> {
    container(0, content, u32::try_from(content.len()).expect("small"))
}

fn deflated(content: &[u8]) -> Vec<u8> {
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::default());
    packed.write_all(content).expect("memory");
    let packed = packed.finish().expect("memory");
    container(2, &packed, u32::try_from(content.len()).expect("small"))
}

/// Channel 1, received, of as many bytes as its identifier says.
fn message(id: u32) -> Vec<u8> {
    let mut body = vec![1, 0, 0, 8];
    body.extend(id.to_le_bytes());
    body.extend([1, 2, 3, 4, 5, 6, 7, 8]);
    body
}

/// Frames as text, what is broken in words.
fn read(parts: &[Vec<u8>]) -> Vec<String> {
    let mut reader = BlfReader::new(Box::new(Cursor::new(parts.concat())));
    let mut all = Vec::new();
    while let Some(entry) = reader.next_entry().expect("memory does not fail") {
        all.push(match entry {
            Entry::Frame(record) => {
                let direction = match record.direction {
                    Some(Rx) => "R",
                    Some(Tx) => "T",
                    None => "-",
                };
                let kind = match record.kind {
                    FrameKind::Standard => "s".to_owned(),
                    FrameKind::Extended => "x".to_owned(),
                    kind => format!("{kind:?}"),
                };
                let mut data = String::new();
                for byte in record.data {
                    write!(data, "{byte:02X}").expect("it is text");
                }
                format!(
                    "{} {} {} {kind} {:X}#{data} {direction}",
                    record.line, record.time_ns, record.interface, record.id
                )
            }
            Entry::Dropped(dropped) => format!("{dropped:?}"),
            Entry::Broken(error) => error.to_string(),
        });
    }
    all
}

const DATA: &str = "0102030405060708";

#[test]
fn frames_are_read_from_containers_of_both_methods_and_without_any() {
    let one = object(1, 5, &message(0x520));
    let two = object_2(86, 7, &message(0x8000_0521));
    let three = object(1, 9, &message(0x522));
    let expected = [
        format!("1 1000000005 can0 s 520#{DATA} R"),
        format!("2 1000070000 can0 x 521#{DATA} R"),
        format!("3 1000000009 can0 s 522#{DATA} R"),
    ];
    assert_eq!(read(&[file(), stored(&one), deflated(&[two.clone(), three.clone()].concat())]), expected);
    assert_eq!(read(&[file(), one, two, three]), expected);
    assert_eq!(read(&[file()]), [""; 0]);
}

#[test]
fn an_object_goes_on_in_the_next_container_wherever_it_is_cut() {
    let all: Vec<u8> =
        [object(1, 5, &message(0x520)), object(65, 6, b"a note"), object(86, 7, &message(0x521))].concat();
    let expected = [format!("1 1000000005 can0 s 520#{DATA} R"), format!("3 1000000007 can0 s 521#{DATA} R")];
    for cut in 0..=all.len() {
        let (begin, end) = all.split_at(cut);
        assert_eq!(read(&[file(), deflated(begin), stored(end)]), expected, "cut at {cut}");
    }
}

#[test]
fn each_type_of_frame_is_what_it_says() {
    let with = |kind: u32, edit: &dyn Fn(&mut Vec<u8>)| {
        let mut body = message(0x123);
        edit(&mut body);
        object(kind, 0, &body)
    };
    let mut fd = vec![2, 0, 1, 9];
    fd.extend(0x8000_0001_u32.to_le_bytes());
    fd.extend([0, 0, 0, 0, 0, 7, 12, 0, 0, 0, 0, 0]);
    fd.extend([0xAB; 64]);
    let mut no_fd = fd.clone();
    (no_fd[13], no_fd[14], no_fd[2]) = (0, 2, 0);
    let mut fd_64 = vec![3, 15, 64, 0];
    fd_64.extend([0x123_u32, 0, 0x3000].map(u32::to_le_bytes).concat());
    fd_64.resize(40, 0);
    fd_64.extend([0xCD; 3]);
    let mut fd_64_remote = vec![3, 8, 0, 0];
    fd_64_remote.extend([0x123_u32, 0, 0x10].map(u32::to_le_bytes).concat());
    fd_64_remote.resize(40, 0);
    let mut error = vec![1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0];
    error.extend([0x2000_0004_u32, 0].map(u32::to_le_bytes).concat());
    error.extend([9; 8]);
    let mut known = error.clone();
    known[4] = 1;
    let objects = [
        with(1, &|body| body[2] = 1),
        with(1, &|body| (body[2], body[3]) = (0x80, 3)),
        with(1, &|body| body[3] = 15),
        with(1, &|body| body[0] = 0),
        with(1, &|body| body[2] = 2),
        object(100, 0, &fd),
        object(100, 0, &no_fd),
        object(101, 0, &fd_64),
        object(101, 0, &fd_64_remote),
        object(2, 0, &[1, 0, 0, 0]),
        object(3, 0, &[1, 0, 0, 0]),
        object(73, 0, &error),
        object(73, 0, &known),
        object(104, 0, &[2, 0]),
    ];
    assert_eq!(
        read(&[file(), deflated(&objects.concat())]),
        [
            format!("1 1000000000 can0 s 123#{DATA} T"),
            "2 1000000000 can0 Remote { extended: false, len: 3 } 123# R".to_owned(),
            format!("3 1000000000 can0 s 123#{DATA} R"),
            format!("4 1000000000 canX s 123#{DATA} R"),
            format!("6 1000000000 can1 Fd {{ extended: true, flags: 3 }} 1#{} T", "AB".repeat(12)),
            "7 1000000000 can1 x 1#ABAB R".to_owned(),
            format!(
                "8 1000000000 can2 Fd {{ extended: false, flags: 1 }} 123#{}{} R",
                "CD".repeat(3),
                "00".repeat(61)
            ),
            "9 1000000000 can2 Remote { extended: false, len: 8 } 123# R".to_owned(),
            "10 1000000000 can0 Error 80# -".to_owned(),
            "11 1000000000 can0 Error 8#0000200000000000 -".to_owned(),
            "12 1000000000 can0 Error 4#0909 -".to_owned(),
            "13 1000000000 can0 Error 80# -".to_owned(),
            "14 1000000000 can1 Error 80# -".to_owned(),
        ]
    );
}

#[test]
fn an_object_that_cannot_be_a_frame_is_broken_where_it_goes_wrong() {
    let mut long = vec![1, 0, 0, 8];
    long.extend(0x123_u32.to_le_bytes());
    long.extend([0, 0, 0, 0, 0, 1, 65, 0, 0, 0, 0, 0]);
    long.extend([0; 64]);
    let mut longer = long.clone();
    (longer[13], longer[14]) = (0, 9);
    let mut coded = message(0x123);
    coded[3] = 16;
    let objects = [
        object(1, 0, &message(0x800)),
        object(1, u64::MAX, &message(0x123)),
        object(1, 0, &[1, 0, 0]),
        object(100, 0, &long),
        object(100, 0, &longer),
        object(1, 0, &coded),
        object(1, 0, &vec![0; 4096]),
        object(1, 0, &message(0x7FF)),
    ];
    let found = read(&[file(), stored(&objects.concat())]);
    let begins = [
        "object 1, byte 37: found \"\\x00\\x08",
        "object 2, byte 25: found \"\\xff",
        "object 3, byte 33: found \"\\x01\\x00\\x00\", expected an object that is long enough",
        "object 4, byte 47: found \"A",
        "object 5, byte 47: found \"\\t",
        "object 6, byte 36: found \"\\x10",
        "object 7, byte 9: found",
        "8 1000000000 can0 s 7FF",
    ];
    assert_eq!(found.len(), begins.len(), "{found:#?}");
    for (found, begin) in found.iter().zip(begins) {
        assert!(found.starts_with(begin), "{found}, {begin}");
    }
}

/// How many frames were read, and how often something was broken.
fn counts(entries: &[String]) -> (usize, usize) {
    let broken = entries.iter().filter(|entry| entry.starts_with("object ")).count();
    (entries.len() - broken, broken)
}

#[test]
fn damage_costs_one_object_or_one_container() {
    let objects = |ids: std::ops::Range<u32>| ids.map(|id| object(1, 0, &message(id))).collect::<Vec<_>>();
    // The size of the third object, one too many and far too many; its signature.
    for (at, byte) in [(2 * 48 + 8, 49), (2 * 48 + 8, 127), (2 * 48 + 9, 16), (2 * 48, b'X')] {
        let mut content = objects(0..9).concat();
        content[at] = byte;
        let (frames, broken) = counts(&read(&[file(), deflated(&content)]));
        assert!(frames >= 8 && broken == 1, "{frames} {broken} for {byte} at {at}");
    }
    // A container that is no zlib any more, between two others.
    let container = |ids| deflated(&objects(ids).concat());
    let mut damaged = container(9..18);
    damaged[40] ^= 0x55;
    let all = read(&[file(), container(0..9), damaged, container(18..27)]);
    let (frames, broken) = counts(&all);
    assert!(frames >= 18 && broken == 1, "{all:#?}");
    // The size of a container.
    for size in [0_u32, 33, 40, 1 << 20] {
        for method in [stored, deflated] {
            let mut damaged = method(&objects(9..18).concat());
            damaged[8..12].copy_from_slice(&size.to_le_bytes());
            let all = read(&[file(), container(0..9), damaged, stored(&objects(18..27).concat())]);
            let (frames, broken) = counts(&all);
            assert!(frames >= 18 && (1..=2).contains(&broken) || frames == 27, "{size} {all:#?}");
        }
    }
    // A method that nobody has heard of; the header of the file.
    let odd = self::container(1, &[0; 100], 100);
    assert_eq!(counts(&read(&[file(), odd, container(0..9)])), (9, 1));
    let mut header = file();
    header[5] = 0xFF;
    assert_eq!(counts(&read(&[header, container(0..9)])), (9, 1));
}

#[test]
fn a_file_that_was_cut_off_gives_all_that_is_in_it_and_says_so() {
    let frames: Vec<u8> = (0..4).flat_map(|id| object(1, 0, &message(id))).collect();
    let whole = [file(), stored(&frames), deflated(&frames)].concat();
    let mut last = 0;
    for len in 0..whole.len() {
        let (frames, broken) = counts(&read(&[whole.get(..len).unwrap_or_default().to_vec()]));
        assert!(frames >= last && frames <= 8, "{frames} after {last} at {len}");
        last = frames;
        // Between two objects of the file nobody can tell.
        let padding = u32::from_le_bytes([whole[376], whole[377], whole[378], whole[379]]) as usize % 4;
        let ends = [144, 144 + 32 + 4 * 48, whole.len() - padding];
        let between = ends.iter().any(|&end| (end..=end + 4).contains(&len));
        assert!(broken == 1 || between, "{broken} broken at {len}");
    }
    assert_eq!(last, 8);
}
