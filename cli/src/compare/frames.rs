//! Frames that came otherwise, in words.

use std::fmt::{self, Write as _};

use adsdv_oracle::compare::{AnswersDiffer, FrameDiffers};
use adsdv_oracle::judge::ResponseTimes;

use super::section::{heading, more};
use crate::layout::{counted, wrapped};

/// So many identifiers tell enough.
const SHOWN: usize = 8;

pub(super) fn write(
    out: &mut String,
    frames: &[FrameDiffers],
    answers: Option<&AnswersDiffer>,
    width: usize,
) -> fmt::Result {
    heading(out, "FRAMES", frames.is_empty() && answers.is_none())?;
    for frame in frames.iter().take(SHOWN) {
        wrapped(out, line(frame).split(' '), 2, width);
    }
    more(out, frames.len(), SHOWN)?;
    let Some(AnswersDiffer { times: [good, bad] }) = answers else { return Ok(()) };
    writeln!(out, "  AI handshake: GOOD {}; BAD {}", times(good), times(bad))
}

fn line(frame: &FrameDiffers) -> String {
    let name = frame.name.map_or_else(String::new, |name| format!(" {name}"));
    let mut parts = Vec::new();
    if let Some((which, count)) = frame.only {
        parts.push(format!("only in {}, {}", which.name(), counted(count, "frame")));
    }
    if let Some([good, bad]) = frame.cycle_ms {
        parts.push(format!("every {good:.1} ms in GOOD, {bad:.1} ms in BAD"));
    }
    if let Some([good, bad]) = frame.lengths {
        parts.push(format!("{} bytes in GOOD, {} in BAD", lengths(good), lengths(bad)));
    }
    format!("{:03X}h{name}: {}", frame.id, parts.join("; "))
}

/// Such as `0, 5 and 8`.
pub(super) fn lengths(set: u16) -> String {
    let mut all: Vec<String> =
        (0..u16::BITS).filter(|len| set >> len & 1 == 1).map(|len| len.to_string()).collect();
    match all.pop() {
        Some(last) if !all.is_empty() => format!("{} and {last}", all.join(", ")),
        last => last.unwrap_or_default(),
    }
}

fn times(times: &ResponseTimes) -> String {
    match (times.quantile_ms(0.5), times.quantile_ms(0.99), times.max_ms()) {
        (Some(median), Some(p99), Some(max)) => format!("median {median:.2}, p99 {p99:.2}, max {max:.2} ms"),
        _ => "no answers".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_listed() {
        for (set, text) in [(0, ""), (1 << 8, "8"), (1 << 5 | 1 << 8, "5 and 8"), (0b111, "0, 1 and 2")] {
            assert_eq!(lengths(set), text);
        }
    }
}
