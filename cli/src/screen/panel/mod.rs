//! The parts of the screen, each a function from a status to lines of text.
//!
//! | to read about | look in |
//! |---|---|
//! | the operator's switches | [`switches`] |
//! | the AS state and its light | [`state`] |
//! | what is missing before AS_DRIVING | [`missing`] |
//! | what the AI Computer asks for, and what comes of it | [`requests`] |
//! | the handshake | [`handshake`] |
//! | faults and warnings | [`faults`] |
//! | frames and cycles | [`bus`] |
//! | what happened | [`happened`] |

pub(super) mod bus;
pub(super) mod faults;
pub(super) mod handshake;
pub(crate) mod happened;
pub(super) mod missing;
pub(super) mod requests;
pub(super) mod state;
pub(super) mod switches;

pub(super) use happened::Room;

use std::fmt;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Paragraph, Widget as _};

use super::theme::{QUIET, STRONG};

/// Between two pieces of a line.
const GAP: &str = "  ";

/// Draws lines below a rule with a title. Where there is not room for all, the last line tells how many more there are.
pub(super) fn draw(
    title: impl Into<Line<'static>>,
    mut lines: Vec<Line<'static>>,
    area: Rect,
    buffer: &mut Buffer,
) {
    let rule = Block::new().borders(Borders::TOP).border_style(QUIET);
    // The title is not as faint as its rule.
    let block = rule.title_style(STRONG.remove_modifier(Modifier::DIM)).title(title);
    let room = usize::from(block.inner(area).height);
    if lines.len() > room {
        let seen = room.saturating_sub(1);
        let more = lines.len().saturating_sub(seen);
        lines.truncate(seen);
        lines.push(Line::styled(format!("... {more} more lines"), QUIET));
    }
    Paragraph::new(lines).block(block).render(area, buffer);
}

/// The height of lines below a rule.
pub(super) fn height(lines: &[Line<'_>]) -> u16 {
    rows(lines.len())
}

/// The height of so many lines below a rule.
pub(super) fn rows(lines: usize) -> u16 {
    u16::try_from(lines).unwrap_or(u16::MAX).saturating_add(1)
}

/// A title with some room around it.
pub(super) fn title(text: &str) -> String {
    format!(" {text} ")
}

/// Lines of at most this width, of pieces that stay whole.
pub(super) fn flow(pieces: Vec<Vec<Span<'static>>>, width: usize) -> Vec<Line<'static>> {
    spaced(pieces, GAP, width)
}

/// Lines of at most this width, of pieces that stay whole, with this gap between them.
pub(super) fn spaced(pieces: Vec<Vec<Span<'static>>>, gap: &'static str, width: usize) -> Vec<Line<'static>> {
    let mut lines: Vec<Line<'static>> = Vec::new();
    for piece in pieces {
        let wide: usize = piece.iter().map(Span::width).sum();
        match lines.last_mut() {
            Some(line) if line.width() + gap.len() + wide <= width => {
                line.push_span(gap);
                line.extend(piece);
            }
            _ => lines.push(Line::from(piece)),
        }
    }
    lines
}

/// A name and its value.
fn named(name: &str, value: &dyn fmt::Display, style: Style) -> Vec<Span<'static>> {
    vec![Span::raw(format!("{name} ")), Span::styled(value.to_string(), style)]
}

/// A time in milliseconds.
fn ms(ms: f64) -> String {
    format!("{ms:.1} ms")
}

/// A long time, given in milliseconds, in seconds.
#[expect(clippy::cast_precision_loss, reason = "a millisecond more or less in 285 000 years")]
pub(super) fn seconds(ms: u64) -> String {
    format!("{:.1} s", ms as f64 / 1000.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_stay_whole() {
        let lines = |width| {
            let pieces = ["one", "two", "three", "a longer one"].map(|piece| vec![Span::raw(piece)]);
            let lines = flow(pieces.into(), width);
            lines.iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        assert_eq!(lines(8), ["one  two", "three", "a longer one"]);
        assert_eq!(lines(7), ["one", "two", "three", "a longer one"]);
        assert_eq!(lines(0).len(), 4);
    }
}
