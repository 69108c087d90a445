//! `after P, Q within T` and `after P, Q for T`: what Q is at one moment decides, and if it never is that, the end of the bound.

use std::collections::VecDeque;

use adsdv_spec::Truth;

use super::{Edge, RuleOutcome, Start, has_room};

/// What is to follow a premise.
#[derive(Clone, Debug)]
pub(in crate::rules) struct Response {
    bound: i64,
    /// What decides at once: that Q is true keeps `within`, that it is false breaks `for`.
    decides: Truth,
    edge: Edge,
    /// Whether Q may have been what decides since the premise was known to be false.
    maybe: bool,
    open: VecDeque<OpenResponse>,
}

/// A premise that became true.
#[derive(Clone, Copy, Debug)]
struct OpenResponse {
    start: Start,
    /// Whether Q may have been what decides.
    maybe: bool,
}

impl Response {
    const fn new(bound: i64, decides: Truth) -> Self {
        Self { bound, decides, edge: Edge::new(), maybe: false, open: VecDeque::new() }
    }

    pub(super) const fn within(bound: i64) -> Self {
        Self::new(bound, Truth::True)
    }

    pub(super) const fn throughout(bound: i64) -> Self {
        Self::new(bound, Truth::False)
    }

    pub(super) fn pass(&mut self, t: i64, out: &mut impl FnMut(RuleOutcome)) {
        while let Some(first) = self.open.front() {
            let over = first.start.by.saturating_add(self.bound);
            if over >= t {
                return;
            }
            out(match (first.maybe, self.decides) {
                (true, _) => RuleOutcome::Unknown,
                (false, Truth::True) => RuleOutcome::Broken(over),
                (false, _) => RuleOutcome::Held,
            });
            self.open.pop_front();
        }
    }

    pub(super) fn step(&mut self, t: i64, premise: Truth, wanted: Truth, out: &mut impl FnMut(RuleOutcome)) {
        let was_open = self.edge.is_open();
        if let Some(start) = self.edge.step(t, premise) {
            if has_room(self.open.len()) {
                self.open.push_back(OpenResponse { start, maybe: was_open && self.maybe });
            } else {
                out(RuleOutcome::Unknown);
            }
        }
        if self.edge.is_open() {
            let may_be = wanted == Truth::Unknown || wanted == self.decides;
            self.maybe = may_be || was_open && self.maybe;
        }
        if wanted == Truth::Unknown {
            self.open.iter_mut().for_each(|open| open.maybe = true);
        } else if wanted == self.decides {
            for open in self.open.drain(..) {
                // Wherever the premise became true, it is within the bound.
                let certain = t <= open.start.after.saturating_add(self.bound);
                out(match (certain, self.decides) {
                    (false, _) => RuleOutcome::Unknown,
                    (true, Truth::True) => RuleOutcome::Held,
                    (true, _) => RuleOutcome::Broken(t),
                });
            }
        }
    }

    /// What is still to be decided.
    pub(super) fn open(&mut self) -> impl Iterator<Item = ()> {
        self.open.drain(..).map(|_| ())
    }
}
