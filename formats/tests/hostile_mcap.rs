//! Whatever the chunks of an MCAP unpack to, reading it takes time and no more memory than is fixed.
#![cfg(feature = "mcap")]

mod counting;

use std::io::{Cursor, Read, Write as _};

use adsdv_formats::{Entries as _, Entry, open};
use counting::{ALONE, MIB, most_memory};
use lz4_flex::frame::{BlockSize, FrameEncoder, FrameInfo};

/// Frames and what is broken of a file, and the most memory that reading it took at once.
fn read(source: impl Read + Send + 'static) -> (usize, usize, usize) {
    let (mut frames, mut broken) = (0, 0);
    let memory = most_memory(|| {
        let mut log = open(source).expect("it is an MCAP");
        while let Some(entry) = log.next_entry().expect("memory does not fail") {
            match entry {
                Entry::Frame(_) => frames += 1,
                Entry::Dropped(_) | Entry::Broken(_) => broken += 1,
            }
        }
    });
    (frames, broken, memory)
}

/// The records of a file of 14 frames, without its end.
fn sample() -> Vec<u8> {
    let sample = include_bytes!("samples/unchunked.mcap");
    // The end of the data: its kind, its length of 4, and a checksum.
    let end = sample.windows(9).rposition(|bytes| bytes == [0x0F, 4, 0, 0, 0, 0, 0, 0, 0]);
    sample[..end.expect("it has an end")].to_vec()
}

/// A chunk that claims to unpack to so many bytes.
fn chunk(compression: &str, packed: &[u8], unpacked: u64) -> Vec<u8> {
    let mut body = [0_u64, 0, unpacked].map(u64::to_le_bytes).concat();
    body.extend(0_u32.to_le_bytes());
    body.extend(u32::try_from(compression.len()).expect("short").to_le_bytes());
    body.extend(compression.as_bytes());
    body.extend((packed.len() as u64).to_le_bytes());
    body.extend(packed);
    let mut chunk = vec![0x06];
    chunk.extend((body.len() as u64).to_le_bytes());
    chunk.extend(body);
    chunk
}

const END: [u8; 13] = [0x0F, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];

/// A record of this kind that claims to have so much.
fn claim(kind: u8, len: u64) -> Vec<u8> {
    let mut record = vec![kind];
    record.extend(len.to_le_bytes());
    record
}

/// A frame of Zstandard, with a window of this exponent, of these bytes and of so many blocks of 128 KiB of zeros.
fn zstd_bomb(first: &[u8], blocks: usize, window: u8) -> Vec<u8> {
    let mut packed = vec![0x28, 0xB5, 0x2F, 0xFD, 0x00, (window - 10) << 3];
    let raw = u32::try_from(first.len()).expect("short") << 3;
    packed.extend(&raw.to_le_bytes()[..3]);
    packed.extend(first);
    let repeated = (128 * 1024) << 3 | 1 << 1;
    for block in 1..=blocks {
        packed.extend(&u32::to_le_bytes(repeated | u32::from(block == blocks))[..3]);
        packed.push(0);
    }
    packed
}

/// A frame of LZ4 of these bytes and of so many blocks of 4 MiB of zeros.
fn lz4_bomb(first: &[u8], blocks: usize) -> Vec<u8> {
    let zeros = vec![0; 4 * MIB];
    let mut encoder =
        FrameEncoder::with_frame_info(FrameInfo::new().block_size(BlockSize::Max4MB), Vec::new());
    encoder.write_all(&zeros).expect("memory");
    let packed = encoder.finish().expect("memory");
    let (head, rest) = packed.split_at(7);
    let (block, end) = rest.split_at(rest.len() - 4);
    let raw = (u32::try_from(first.len()).expect("short") | 1 << 31).to_le_bytes();
    [head, &raw[..], first, &block.repeat(blocks)[..], end].concat()
}

#[test]
fn a_chunk_that_unpacks_to_a_gigabyte_takes_time_and_no_memory() {
    let _alone = ALONE.lock();
    // A record that says it is long is passed over, whatever it is: a schema, a channel, a message, one of no kind that is known; and one
    // of a kind that there is not ends the chunk. Of each kind there is a gigabyte; where it lies about its length as well, only of messages.
    for kind in [0x00, 0x03, 0x04, 0x05, 0x20] {
        for (len, claimed) in [(1 << 30, (1 << 30) + 9), (u64::MAX, u64::MAX), (u64::MAX, 100)] {
            let unpacked: usize = if len == 1 << 30 || kind == 0x05 { 1 << 30 } else { 1 << 26 };
            let first = claim(kind, len);
            let bombs = [
                ("zstd", zstd_bomb(&first, unpacked / (128 * 1024), 20), 4 * MIB),
                // Two blocks are unpacked, and what they refer to is kept.
                ("lz4", lz4_bomb(&first, unpacked / (4 * MIB)), 16 * MIB),
            ];
            for (compression, packed, memory) in bombs {
                assert!(packed.len() < 5 * MIB, "it is no bomb: {}", packed.len());
                let mut file = sample();
                file.extend(chunk(compression, &packed, claimed));
                file.extend(END);
                let (frames, broken, most) = read(Cursor::new(file));
                assert!(frames == 14 && broken <= 2, "{compression} {kind} {len}: {frames} {broken}");
                assert!(most < memory, "{compression} {kind} {len}: {most} bytes");
            }
        }
    }
}

#[test]
fn a_chunk_can_ask_for_the_largest_window_and_for_no_larger_one() {
    let _alone = ALONE.lock();
    // A window that grows is there twice for a moment, as it was and half as large again.
    for (window, broken, memory) in [(27, 0, 200 * MIB), (28, 1, 4 * MIB), (41, 1, 4 * MIB)] {
        let mut file = sample();
        // One after the other, they do not add up.
        for _ in 0..3 {
            file.extend(chunk("zstd", &zstd_bomb(&claim(0x20, 1 << 28), 2048, window), (1 << 28) + 9));
        }
        file.extend(END);
        let (frames, were_broken, most) = read(Cursor::new(file));
        assert_eq!((frames, were_broken), (14, 3 * broken), "a window of 2^{window}");
        assert!(most < memory, "a window of 2^{window}: {most} bytes");
    }
}

#[test]
fn bombs_within_bombs_are_unpacked_one_after_the_other() {
    let _alone = ALONE.lock();
    let inner = chunk("zstd", &zstd_bomb(&claim(0x20, 1 << 30), 8192, 20), (1 << 30) + 9);
    let mut file = sample();
    file.extend(chunk("lz4", &lz4_bomb(&inner, 256), u64::MAX));
    file.extend(END);
    // No chunk is within another.
    let (frames, broken, most) = read(Cursor::new(file));
    assert!(frames == 14 && broken == 1 && most < 16 * MIB, "{frames} {broken} {most}");
}

#[test]
fn as_many_schemas_and_channels_as_there_can_be_have_their_limit() {
    let _alone = ALONE.lock();
    let text =
        |text: &str| [&u32::try_from(text.len()).expect("short").to_le_bytes()[..], text.as_bytes()].concat();
    let record = |kind: u8, body: Vec<u8>| [claim(kind, body.len() as u64), body].concat();
    let definition = format!("uint32 id\nuint8[8] data\n{}", "uint8 x\n".repeat(62));
    let topic = "/can".repeat(250);
    let mut file = sample();
    for id in 100..=u16::MAX {
        let id = id.to_le_bytes();
        // Each is repeated, since each chunk may do so.
        for _ in 0..2 {
            let schema = [&id[..], &text("a/msg/Can"), &text("ros2msg"), &text(&definition)].concat();
            file.extend(record(0x03, schema));
        }
    }
    for id in 100..=u16::MAX {
        let id = id.to_le_bytes();
        file.extend(record(
            0x04,
            [&id[..], &id[..], &text(&topic), &text("cdr"), &0_u32.to_le_bytes()].concat(),
        ));
    }
    file.extend(END);
    let (frames, broken, most) = read(Cursor::new(file));
    assert_eq!((frames, broken), (14, 0));
    assert!(most < 170 * MIB, "{most} bytes");
}
