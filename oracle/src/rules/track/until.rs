//! `after P, Q until R`, and `P until Q`.

use std::collections::VecDeque;

use adsdv_spec::Truth;

use super::{Edge, RuleOutcome, Start, has_room};

/// What is to be so until something else is.
#[derive(Clone, Debug)]
pub(in crate::rules) struct Until {
    bound: Option<i64>,
    /// What it begins with; without a premise, whether it has begun.
    edge: Result<Edge, bool>,
    /// What was unknown since the premise was known to be false.
    maybe: Unseen,
    open: VecDeque<OpenUntil>,
}

/// What may have been otherwise than it is to be.
#[derive(Clone, Copy, Debug, Default)]
struct Unseen {
    /// What is to be so may not have been.
    kept: bool,
    /// The end of it may have been.
    end: bool,
}

#[derive(Clone, Copy, Debug)]
struct OpenUntil {
    start: Start,
    maybe: Unseen,
}

impl Until {
    pub(super) const fn new(has_premise: bool, bound: Option<i64>) -> Self {
        let edge = if has_premise { Ok(Edge::new()) } else { Err(false) };
        Self { bound, edge, maybe: Unseen { kept: false, end: false }, open: VecDeque::new() }
    }

    pub(super) const fn has_premise(&self) -> bool {
        self.edge.is_ok()
    }

    pub(super) fn pass(&mut self, t: i64, out: &mut impl FnMut(RuleOutcome)) {
        let Some(bound) = self.bound else { return };
        while let Some(first) = self.open.front() {
            let over = first.start.by.saturating_add(bound);
            if over >= t {
                return;
            }
            out(if first.maybe.end { RuleOutcome::Unknown } else { RuleOutcome::Broken(over) });
            self.open.pop_front();
        }
    }

    pub(super) fn step(
        &mut self,
        t: i64,
        premise: Truth,
        kept: Truth,
        end: Truth,
        out: &mut impl FnMut(RuleOutcome),
    ) {
        self.begin_anew(t, kept, end);
        self.begin(t, premise, kept, end, out);
        let bound = self.bound;
        self.open.retain_mut(|open| {
            let certain = bound.is_none_or(|bound| t <= open.start.after.saturating_add(bound));
            let outcome = match (kept, end) {
                (_, Truth::True) if open.maybe.kept || !certain => RuleOutcome::Unknown,
                (_, Truth::True) => RuleOutcome::Held,
                (Truth::False, Truth::False) if !open.maybe.end => RuleOutcome::Broken(t),
                (Truth::False, _) => RuleOutcome::Unknown,
                _ => {
                    open.maybe.kept |= kept == Truth::Unknown;
                    open.maybe.end |= end == Truth::Unknown;
                    return true;
                }
            };
            out(outcome);
            false
        });
    }

    /// What was known for no time at all, as of a message that came once, is no beginning.
    fn begin_anew(&mut self, t: i64, kept: Truth, end: Truth) {
        let Err(begun) = &mut self.edge else { return };
        let unknown = kept == Truth::Unknown || end == Truth::Unknown;
        if unknown && self.open.front().is_some_and(|open| open.start.by == t) {
            *begun = false;
            self.open.clear();
        }
    }

    /// Follows the premise.
    fn begin(&mut self, t: i64, premise: Truth, kept: Truth, end: Truth, out: &mut impl FnMut(RuleOutcome)) {
        let start = match &mut self.edge {
            Err(begun) => {
                // It begins with the first moment that tells something.
                let known = end == Truth::True || kept != Truth::Unknown && end == Truth::False;
                let begins = known && !*begun;
                *begun |= known;
                begins.then_some((Start { after: t, by: t }, Unseen::default()))
            }
            Ok(edge) => {
                let was_open = edge.is_open();
                let before = if was_open { self.maybe } else { Unseen::default() };
                let start = edge.step(t, premise).map(|start| (start, before));
                if edge.is_open() {
                    let kept = before.kept || kept != Truth::True;
                    self.maybe = Unseen { kept, end: before.end || end != Truth::False };
                }
                start
            }
        };
        match start {
            Some((start, maybe)) if has_room(self.open.len()) => {
                self.open.push_back(OpenUntil { start, maybe });
            }
            Some(_) => out(RuleOutcome::Unknown),
            None => {}
        }
    }

    /// What is still to be decided.
    pub(super) fn open(&mut self) -> impl Iterator<Item = ()> {
        self.open.drain(..).map(|_| ())
    }
}
