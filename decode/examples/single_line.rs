//! Decodes a log to text in one line for each frame: `cargo run --release -p adsdv-decode --example single_line run.log > run.txt`.

use std::error::Error;
use std::fs::File;
use std::io;

use adsdv_decode::{Catalog, Options, Recording, Text, TextLayout};

fn main() -> Result<(), Box<dyn Error>> {
    let log = std::env::args_os().nth(1).ok_or("expected a log")?;
    let recording = Recording::begin(adsdv_formats::open(File::open(log)?)?, &Options::default())?;
    let catalog = Catalog::of(recording.recognised().edition);
    let mut text = Text::new(&catalog, io::stdout(), TextLayout::SingleLine, false);
    let summary = recording.decode(&catalog, &mut text, |_| {})?;
    eprintln!("edition {}, {} frames", catalog.edition().version, summary.frames);
    Ok(())
}
