//! Reads a recording and says how long that took: `cargo run --release -p adsdv-formats --all-features --example speed FILE`. It is read five
//! times, or with `--once` before it, once.

use std::fs::File;
use std::time::Instant;

use adsdv_formats::{Entries as _, Entry, open};

fn main() {
    let once = std::env::args().nth(1).is_some_and(|argument| argument == "--once");
    for file in std::env::args().skip(if once { 2 } else { 1 }) {
        let mut best = f64::INFINITY;
        let mut frames = 0_u64;
        for _ in 0..if once { 1 } else { 5 } {
            let begin = Instant::now();
            let mut log = open(File::open(&file).expect("it is there")).expect("it can be read");
            frames = 0;
            while let Some(entry) = log.next_entry().expect("it can be read on") {
                frames += u64::from(matches!(entry, Entry::Frame(_)));
            }
            best = best.min(begin.elapsed().as_secs_f64());
        }
        println!("{file}: {frames} frames, {:.1} ms", best * 1000.0);
    }
}
