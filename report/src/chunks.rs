//! Every frame, in pieces that are unpacked one by one: message by message, byte by byte, as differences.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::answers::Answer;
use crate::packed::Packer;
use crate::recording::{Kept, Recording};
use crate::time::micros;

/// So many frames are unpacked in a blink.
const FRAMES: usize = 1 << 16;

/// A piece of a recording.
#[derive(Serialize)]
pub(crate) struct ChunkJson {
    /// When its first frame came, in microseconds.
    from: i64,
    /// When its last one came.
    until: i64,
    frames: usize,
    packed: String,
}

/// All pieces, in order of time.
pub(crate) fn chunks(recording: &Recording, answers: &[Answer]) -> Vec<ChunkJson> {
    let mut answers = answers.iter().peekable();
    let mut chunks = Vec::new();
    let mut pieces = recording.frames.chunks(FRAMES).peekable();
    while let Some(frames) = pieces.next() {
        let from = frames.first().map_or(0, |frame| micros(frame.t_ns));
        let until_ns = frames.last().map_or(0, |frame| frame.t_ns);
        let last = pieces.peek().is_none();
        let mut of_chunk = Vec::new();
        while let Some(answer) = answers.next_if(|answer| last || answer.t_ns <= until_ns) {
            of_chunk.push(*answer);
        }
        let mut packer = Packer::default();
        messages(&mut packer, frames, from);
        packer.number(of_chunk.len() as u64);
        times(&mut packer, of_chunk.iter().map(|answer| micros(answer.t_ns)), from);
        for answer in &of_chunk {
            packer.signed(micros(answer.took_ns));
        }
        chunks.push(ChunkJson { from, until: micros(until_ns), frames: frames.len(), packed: packer.pack() });
    }
    chunks
}

/// The frames, those of each message together.
fn messages(packer: &mut Packer, frames: &[Kept], from: i64) {
    let mut of_message: BTreeMap<u16, Vec<&Kept>> = BTreeMap::new();
    for frame in frames {
        of_message.entry(frame.id).or_default().push(frame);
    }
    packer.number(of_message.len() as u64);
    for (id, frames) in &of_message {
        packer.number((*id).into());
        packer.number(frames.len() as u64);
        times(packer, frames.iter().map(|frame| micros(frame.t_ns)), from);
        difference(packer, frames.iter().map(|frame| frame.len));
        let longest = frames.iter().map(|frame| frame.len).max().unwrap_or_default();
        packer.number(longest.into());
        for place in 0..usize::from(longest) {
            difference(packer, frames.iter().map(|frame| frame.data.get(place).copied().unwrap_or_default()));
        }
    }
}

/// Times: by how much each step differs from the one before it, which is little where a message has a cycle.
fn times(packer: &mut Packer, times: impl Iterator<Item = i64>, from: i64) {
    let (mut before, mut step) = (from, 0);
    for time in times {
        packer.signed(time - before - step);
        (before, step) = (time, time - before);
    }
}

/// Bytes: how each differs from the one before it, which mostly is not at all.
fn difference(packer: &mut Packer, bytes: impl Iterator<Item = u8>) {
    let mut before = 0_u8;
    for byte in bytes {
        packer.byte(byte.wrapping_sub(before));
        before = byte;
    }
}
