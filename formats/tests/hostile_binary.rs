//! Whatever a file holds: no panic, an end, entries that make sense, and no more memory than is fixed.

mod counting;

use std::io::{Cursor, Read, Write as _};

use adsdv_formats::{Entries as _, Entry, open};
use adsdv_oracle::candump::FrameKind;
use counting::{ALONE, MIB, most_memory};
use flate2::Compression;
use flate2::write::ZlibEncoder;

/// Reads all of it, with at most so many bytes of memory more than before: frames and what is broken.
fn read(source: impl Read + Send + 'static, memory: usize) -> (usize, usize) {
    let mut counts = (0, 0);
    let most = most_memory(|| counts = read_all(source));
    assert!(most <= memory, "{most} bytes of memory");
    counts
}

fn read_all(source: impl Read + Send + 'static) -> (usize, usize) {
    let (mut frames, mut broken, mut last) = (0, 0, 0);
    let Ok(mut log) = open(source) else { return (0, 0) };
    while let Some(entry) = log.next_entry().expect("memory does not fail") {
        match entry {
            Entry::Frame(record) => {
                let most = if matches!(record.kind, FrameKind::Fd { .. }) { 64 } else { 8 };
                assert!(record.data.len() <= most && record.id <= record.kind.max_id(), "{record:?}");
                assert!(record.time_ns >= 0 && record.line >= last, "{record:?}");
                let sane = |letter: char| !letter.is_whitespace() && !letter.is_control();
                assert!(!record.interface.is_empty() && record.interface.chars().all(sane), "{record:?}");
                last = record.line;
                frames += 1;
            }
            Entry::Dropped(dropped) => panic!("{dropped:?}"),
            Entry::Broken(error) => {
                assert!(error.line >= last && error.column > 0, "{error}");
                last = error.line;
                broken += 1;
            }
        }
        assert!(log.count() >= last);
    }
    (frames, broken)
}

const SAMPLES: &[&[u8]] = &[
    include_bytes!("samples/python-can.blf"),
    include_bytes!("samples/python-can-stored.blf"),
    #[cfg(feature = "mcap")]
    include_bytes!("samples/zstd.mcap"),
    #[cfg(feature = "mcap")]
    include_bytes!("samples/lz4.mcap"),
    #[cfg(feature = "mcap")]
    include_bytes!("samples/unchunked.mcap"),
];

#[test]
fn a_sample_has_14_frames_and_those_before_the_place_where_it_is_cut() {
    let _alone = ALONE.lock();
    for sample in SAMPLES {
        assert_eq!(read(Cursor::new(*sample), 2 * MIB), (14, 0));
        let mut before = 0;
        // What is shorter than what tells the format is a text.
        for len in 8..sample.len() {
            let (frames, broken) = read(Cursor::new(&sample[..len]), 2 * MIB);
            assert!(frames >= before && frames <= 14 && broken <= 2, "{frames} {broken} of {len}");
            before = frames;
        }
        assert!(before >= 13);
    }
}

#[test]
fn no_bit_that_is_another_makes_it_panic() {
    let _alone = ALONE.lock();
    for sample in SAMPLES {
        for bit in 0..sample.len() * 8 {
            let mut damaged = sample.to_vec();
            damaged[bit / 8] ^= 1 << (bit % 8);
            // A damaged window of Zstandard may be as large as it is allowed to be.
            read(Cursor::new(damaged), 160 * MIB);
        }
    }
}

/// A gigabyte of zeros. Behind the first two parts a part is as the one before, so that no more are made.
fn bomb() -> Vec<u8> {
    const PARTS: usize = 1024;
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::best());
    let zeros = vec![0; MIB];
    let mut ends = [0; 2];
    for end in &mut ends {
        packed.write_all(&zeros).expect("memory");
        packed.flush().expect("memory");
        *end = packed.get_ref().len();
    }
    let [first, second] = ends;
    let whole = packed.finish().expect("memory");
    let (parts, rest) = whole.split_at(second);
    // The checksum, Adler-32 of as many zeros, is behind what ends the data.
    let (end, _) = rest.split_at(rest.len() - 4);
    let checksum = u32::try_from(PARTS * MIB % 65521).expect("small") << 16 | 1;
    [parts, &parts[first..].repeat(PARTS - 2), end, &checksum.to_be_bytes()].concat()
}

#[test]
fn the_bomb_is_one() {
    let _alone = ALONE.lock();
    let mut unpacked = flate2::read::ZlibDecoder::new(Cursor::new(bomb()));
    assert_eq!(std::io::copy(&mut unpacked, &mut std::io::sink()).expect("it is whole"), 1 << 30);
}

#[test]
fn a_container_that_unpacks_to_a_gigabyte_takes_time_and_no_memory() {
    let _alone = ALONE.lock();
    let bomb = bomb();
    for claimed in [100_u32, u32::MAX] {
        let mut file = SAMPLES[0].to_vec();
        file.extend(b"LOBJ\x10\0\x01\0");
        file.extend(
            [u32::try_from(32 + bomb.len()).expect("small"), 10, 2, 0, claimed, 0]
                .map(u32::to_le_bytes)
                .concat(),
        );
        file.extend(&bomb);
        assert_eq!(read(Cursor::new(file), 4 * MIB), (14, 1));
    }
}

#[test]
fn a_file_that_ends_behind_its_magic_is_cut_off() {
    let _alone = ALONE.lock();
    assert_eq!(read(Cursor::new(b"LOGG"), MIB), (0, 1));
    if cfg!(feature = "mcap") {
        assert_eq!(read(Cursor::new(b"\x89MCAP0\r\n"), MIB), (0, 1));
    }
}

#[cfg(not(feature = "mcap"))]
#[test]
fn mcap_is_refused_with_the_name_of_its_feature() {
    use adsdv_formats::{Format, OpenError};

    let error = open(Cursor::new(b"\x89MCAP0\r\n")).err().expect("it was not built in");
    assert!(error.to_string().contains("cargo install --path cli --features mcap"), "{error}");
    assert!(matches!(error, OpenError::NotBuilt { format: Format::Mcap, feature: "mcap" }));
}
