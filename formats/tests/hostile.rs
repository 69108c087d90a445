//! Recordings of the text formats that are damaged in every way: cut off, with a bit turned round, or endless. Whatever a file holds, nothing panics, memory
//! is bounded, and every entry makes sense.
//!
//! Each file in `tests/samples` is a small recording; every format has one at least. Those of the binary formats are in `hostile_binary.rs`, which counts the memory of all threads.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::fs;
use std::io::{self, Cursor, Read};
use std::path::{Path, PathBuf};

use adsdv_formats::{Entries, Entry, Format, OpenError, open};

/// Counts what a thread holds, and the most that it has held.
struct Counting;

thread_local! {
    static HELD: Cell<isize> = const { Cell::new(0) };
    static MOST: Cell<isize> = const { Cell::new(0) };
}

fn count(bytes: usize, sign: isize) {
    // Memory of another thread may be given back in this one.
    let held = HELD.get() + sign * bytes.cast_signed();
    HELD.set(held);
    MOST.set(MOST.get().max(held));
}

// SAFETY: the system's allocator does the work.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size(), 1);
        // SAFETY: the caller promises the same.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(layout.size(), -1);
        // SAFETY: the caller promises the same.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// What a reader may hold, whatever the recording: its buffers, and a line or a container.
const LIMIT: isize = 4 << 20;

/// What was read of a recording.
struct Seen {
    format: Format,
    frames: u64,
    /// Frames that are not of a last line without its end, which may lack data.
    whole: u64,
    broken: u64,
}

/// Reads a recording to its end or until it fails, and looks at every entry; `None` if it is of a kind that is not read.
fn read(source: impl Read + Send + 'static) -> Option<Seen> {
    let before = HELD.get();
    MOST.set(before);
    let mut log = match open(source) {
        Ok(log) => log,
        Err(OpenError::Foreign(_) | OpenError::NotBuilt { .. } | OpenError::Read(_)) => return None,
    };
    let mut seen = Seen { format: log.format(), frames: 0, whole: 0, broken: 0 };
    let mut last = 0;
    // A source that fails, as one that is compressed may, has no more.
    while let Ok(Some(entry)) = log.next_entry() {
        let line = match entry {
            Entry::Frame(record) => {
                assert!(record.time_ns >= 0, "{record:?}");
                assert!(record.id <= record.kind.max_id(), "{record:?}");
                assert!(!record.interface.is_empty(), "{record:?}");
                assert!(
                    !record.interface.contains(|c: char| c.is_whitespace() || c.is_control()),
                    "{record:?}"
                );
                assert!(record.data.len() <= 2048, "{record:?}");
                seen.frames += 1;
                seen.whole += u64::from(record.terminated);
                record.line
            }
            Entry::Dropped(dropped) => dropped.line,
            Entry::Broken(error) => {
                assert!(error.column > 0 && !error.expected.is_empty(), "{error}");
                seen.broken += 1;
                error.line
            }
        };
        assert!(line > 0 && line >= last, "{line} comes after {last}");
        last = line;
    }
    assert!(last <= log.count());
    let held = MOST.get() - before;
    assert!(held < LIMIT, "{held} bytes are held");
    Some(seen)
}

/// The samples, and their paths.
fn samples() -> Vec<(PathBuf, Vec<u8>)> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/samples");
    let files = fs::read_dir(directory).expect("there are samples");
    let mut paths: Vec<PathBuf> = files.map(|file| file.expect("it can be listed").path()).collect();
    paths.retain(|path| !path.extension().is_some_and(|format| format == "blf" || format == "mcap"));
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), fs::read(path).expect("it can be read"))).collect()
}

#[test]
fn every_sample_is_read_and_every_text_format_has_one() {
    let mut formats = Vec::new();
    for (path, bytes) in samples() {
        let seen = read(Cursor::new(bytes)).expect("it is of a known format");
        assert!(
            seen.frames > 3 && seen.broken == 0,
            "{}: {} and {}",
            path.display(),
            seen.frames,
            seen.broken
        );
        formats.push(seen.format);
    }
    let binary = [Format::Blf, Format::Mcap];
    for format in Format::ALL.into_iter().filter(|format| !binary.contains(format)) {
        assert!(formats.contains(&format), "tests/samples has none of {format}");
    }
}

#[test]
fn the_fuzzer_begins_with_every_format() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus/recording");
    let files = fs::read_dir(folder).expect("the fuzzer has seeds");
    let formats: Vec<Format> = files
        .map(|file| fs::File::open(file.expect("it can be listed").path()).expect("it can be read"))
        .filter_map(|file| match open(file) {
            Ok(log) => Some(log.format()),
            Err(OpenError::NotBuilt { format, .. }) => Some(format),
            Err(_) => None,
        })
        .collect();
    for format in Format::ALL {
        assert!(
            formats.contains(&format),
            "fuzz/corpus/recording has none of {format}: name one in tests/src/fuzzed/seeds.rs, then cargo run -p adsdv-tests --bin seeds"
        );
    }
}

#[test]
fn a_recording_may_end_anywhere() {
    for (path, bytes) in samples() {
        let whole = read(Cursor::new(bytes.clone())).expect("it is of a known format");
        let mut last = 0;
        for len in 0..=bytes.len() {
            // Its beginning is at times that of another format.
            let Some(seen) = read(Cursor::new(bytes[..len].to_vec())) else { continue };
            if seen.format == whole.format {
                assert!(seen.whole <= whole.whole && seen.whole >= last, "{}: {len} bytes", path.display());
                assert!(seen.frames <= seen.whole + 1, "{}: {len} bytes", path.display());
                assert!(seen.broken <= 1, "{}: {len} bytes have more broken than their end", path.display());
                last = seen.whole;
            }
        }
        assert_eq!(last, whole.whole, "{}", path.display());
    }
}

#[test]
fn any_bit_may_be_turned_round() {
    for (path, bytes) in samples() {
        let whole = read(Cursor::new(bytes.clone())).expect("it is of a known format");
        let mut as_many = 0;
        for index in 0..bytes.len() {
            for bit in 0..8 {
                let mut bytes = bytes.clone();
                bytes[index] ^= 1 << bit;
                let frames = read(Cursor::new(bytes)).map_or(0, |seen| seen.frames);
                as_many += u64::from(frames >= whole.frames);
            }
        }
        assert!(as_many > 0, "{}: no bit is of data", path.display());
    }
}

#[test]
fn a_recording_may_be_of_one_byte_alone_and_endless() {
    const MANY: u64 = 16 << 20;
    assert!(read(io::empty()).is_some_and(|seen| seen.frames == 0 && seen.broken == 0));
    // One of each format is enough.
    let mut formats = Vec::new();
    let mut heads = samples();
    heads.retain(|(_, bytes)| {
        let format = read(Cursor::new(bytes.clone())).map(|seen| seen.format);
        let new = !formats.contains(&format);
        formats.push(format);
        new
    });
    heads.push((PathBuf::from("nothing"), Vec::new()));
    let endless = |path: &Path, bytes: &[u8]| {
        // All of it, and what ends inside its last frame.
        for len in [bytes.len(), bytes.len() / 2] {
            for byte in [0, b' ', b'\n', b'0', b'x', b';', b',', 0xFF] {
                let head = Cursor::new(bytes[..len].to_vec());
                let seen = read(head.chain(io::repeat(byte).take(MANY)));
                let broken = seen.map_or(0, |seen| seen.broken);
                assert!(broken < 3, "{} and {byte:#04x}: {broken} are broken", path.display());
            }
        }
    };
    // What is held is counted for each thread.
    std::thread::scope(|scope| {
        for (path, bytes) in &heads {
            scope.spawn(|| endless(path, bytes));
        }
    });
}
