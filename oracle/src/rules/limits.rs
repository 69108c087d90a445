//! What no file may exceed, so that none takes memory or time without bound.

/// So many lines has a file.
pub(super) const LINES: usize = 1000;
/// So many characters has a line.
pub(super) const CHARACTERS: usize = 2000;
/// So deep are parentheses and `not` in one another.
pub(super) const DEPTH: usize = 50;
/// So many digits has a number, in front of the point and behind it together.
pub(super) const DIGITS: usize = 12;
/// The longest bound, in nanoseconds: an hour.
pub(super) const LONGEST_NS: i64 = 3_600_000_000_000;
/// So many mistakes of a file are listed; further ones are counted.
pub(super) const MISTAKES: usize = 20;
/// So many breaches of a rule are listed; further ones are counted.
pub(super) const BREACHES: usize = 20;
/// So many times of one rule are followed at once; those beyond are not decided.
pub(super) const OPEN: usize = 1000;
