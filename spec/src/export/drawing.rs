//! Arrows that somebody else has found out, drawn as Figure 2 is.

use core::fmt;

use super::mark::Mark;
use super::{dot, mermaid};
use crate::messages::AsState;

/// An arrow of a [`Drawing`].
#[derive(Clone, Copy, Debug)]
pub struct DrawnArrow<'a> {
    /// Where it begins.
    pub from: AsState,
    /// Where it leads.
    pub to: AsState,
    /// What stands at it; lines are separated by `\n`.
    pub label: &'a str,
    /// What it is, held against the document.
    pub mark: Mark,
}

/// A state machine over the AS states, such as a program's own: drawn as [`Mermaid`](super::Mermaid) and [`Dot`](super::Dot) draw that
/// of the specification, with what differs from it marked.
///
/// ```
/// use adsdv_spec::AsState;
/// use adsdv_spec::export::{Drawing, DrawnArrow, Mark};
///
/// let (from, to) = (AsState::Ready, AsState::Off);
/// let arrows = [DrawnArrow { from, to, label: "ASMS off", mark: Mark::Differs }];
/// let drawing = Drawing { title: "a simulator's own", arrows: &arrows };
/// assert!(drawing.mermaid().to_string().contains("AS_READY --> AS_OFF : DIFFERS<br/>ASMS off\n"));
/// assert!(drawing.dot().to_string().contains("AS_READY -> AS_OFF [label=\"DIFFERS\\lASMS off\\l\", color="));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Drawing<'a> {
    /// What it is of.
    pub title: &'a str,
    /// The arrows.
    pub arrows: &'a [DrawnArrow<'a>],
}

impl<'a> Drawing<'a> {
    /// As a Mermaid `stateDiagram-v2`.
    pub const fn mermaid(&self) -> AsMermaid<'a> {
        AsMermaid(*self)
    }

    /// As a Graphviz digraph.
    pub const fn dot(&self) -> AsDot<'a> {
        AsDot(*self)
    }

    fn arrows(&self) -> impl Iterator<Item = (AsState, AsState, Marked<'a>, Mark)> + 'a {
        self.arrows.iter().map(|arrow| (arrow.from, arrow.to, Marked(arrow), arrow.mark))
    }
}

/// Displays a [`Drawing`] as Mermaid.
#[derive(Clone, Copy, Debug)]
pub struct AsMermaid<'a>(Drawing<'a>);

impl fmt::Display for AsMermaid<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        mermaid::write(f, &self.0.title, self.0.arrows().map(|(from, to, label, _)| (from, to, label)))
    }
}

/// Displays a [`Drawing`] for Graphviz.
#[derive(Clone, Copy, Debug)]
pub struct AsDot<'a>(Drawing<'a>);

impl fmt::Display for AsDot<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        dot::write(f, &self.0.title, self.0.arrows())
    }
}

/// A label behind what its arrow is.
#[derive(Clone, Copy)]
struct Marked<'a>(&'a DrawnArrow<'a>);

impl fmt::Display for Marked<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.0.mark.prefix(), self.0.label)
    }
}
