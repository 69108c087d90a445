//! The frames of the bus, and how well the cycle is held.

use adsdv_can::status::Status;
use ratatui::style::Style;
use ratatui::text::Span;

use super::{ms, named};
use crate::screen::theme::{QUIET, Theme};

/// What came and went, and what went wrong; where there is little room, only what did go wrong.
pub(in crate::screen) fn frames(status: &Status, theme: Theme, all: bool) -> Vec<Vec<Span<'static>>> {
    let wrong = [
        ("unsent", status.unsent),
        ("refused", status.refused),
        ("dropped", status.dropped),
        ("of another VCU", status.foreign),
        ("error frames", status.errors),
    ];
    let mut pieces =
        vec![named("in", &status.received, Style::new()), named("out", &status.sent, Style::new())];
    if !all && wrong.iter().all(|&(_, count)| count == 0) {
        pieces.push(vec![Span::styled("none lost or wrong", QUIET)]);
    } else {
        let listed = wrong.into_iter().filter(|&(_, count)| all || count > 0);
        pieces.extend(listed.map(|(name, count)| named(name, &count, theme.well(count == 0))));
    }
    pieces
}

/// How well the cycle is held.
pub(in crate::screen) fn cycles(status: &Status, theme: Theme) -> Vec<Vec<Span<'static>>> {
    let cycles = &status.cycles;
    vec![
        named("cycles", &cycles.count, Style::new()),
        named("late", &cycles.late, theme.well(cycles.late == 0)),
        named("p99", &ms(cycles.p99_ms), Style::new()),
        named("worst", &ms(cycles.worst_ms), Style::new()),
    ]
}
