//! The identifiers that the AI Computer must not use: those that are reserved newly, and those that no longer are.

use std::fmt;

use adsdv_spec::Bus;
use serde::Serialize;

use super::change::Sides;

/// Identifiers in a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub(super) struct Range {
    pub(super) first: u16,
    pub(super) last: u16,
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { first, last } = *self;
        if first == last { write!(f, "{first:03X}h") } else { write!(f, "{first:03X}h to {last:03X}h") }
    }
}

/// How the ranges are cut does not matter, only what is in them.
pub(super) fn compare(from: &Bus, to: &Bus) -> Sides<Range> {
    Sides {
        new: ranges(|id| to.is_reserved(id) && !from.is_reserved(id)),
        gone: ranges(|id| from.is_reserved(id) && !to.is_reserved(id)),
    }
}

fn ranges(is_in: impl Fn(u16) -> bool) -> Vec<Range> {
    let mut ranges: Vec<Range> = Vec::new();
    for id in (0..=u16::MAX).filter(|&id| is_in(id)) {
        match ranges.last_mut().filter(|range| range.last.checked_add(1) == Some(id)) {
            Some(range) => range.last = id,
            None => ranges.push(Range { first: id, last: id }),
        }
    }
    ranges
}
