//! What a rule comes to over time: each form follows what its predicates are, and tells what was kept and what was broken.
//!
//! Between two steps the predicates stay as they are. A step at `t` first lets time pass up to it, under what was so before; a bound
//! that ends at `t` itself is not over yet, so that what comes at that very moment still counts.
//!
//! A premise that was unknown just before it became true did so at a time that lies between two: [`Start`]. Broken or kept is only
//! what is so wherever it lies.

mod invariant;
mod lasting;
mod response;
mod until;

use adsdv_spec::Truth;

use super::limits::OPEN;
use super::syntax::Form;

pub(super) use invariant::Invariant;
pub(super) use lasting::Lasting;
pub(super) use response::Response;
pub(super) use until::Until;

/// What became of a rule once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RuleOutcome {
    Held,
    /// At this time.
    Broken(i64),
    /// Something that decides was unknown.
    Unknown,
    /// The recording ended before.
    Ended,
}

/// What follows a rule.
#[derive(Clone, Debug)]
pub(super) enum Track {
    Invariant(Invariant),
    Lasting(Lasting),
    Response(Response),
    Until(Until),
}

impl Track {
    pub(super) fn of<P>(form: &Form<P>) -> Self {
        match *form {
            Form::Always(_) => Self::Invariant(Invariant::new(Truth::True)),
            Form::Never(_) => Self::Invariant(Invariant::new(Truth::False)),
            Form::AtMost(_, time) => Self::Lasting(Lasting::new(time)),
            Form::Within(_, _, time) => Self::Response(Response::within(time)),
            Form::Throughout(_, _, time) => Self::Response(Response::throughout(time)),
            Form::Until(ref premise, _, _, time) => Self::Until(Until::new(premise.is_some(), time)),
        }
    }

    /// Time passes up to `t`, with everything as it was.
    pub(super) fn pass(&mut self, t: i64, out: &mut impl FnMut(RuleOutcome)) {
        match self {
            Self::Invariant(_) => {}
            Self::Lasting(lasting) => lasting.pass(t, out),
            Self::Response(response) => response.pass(t, out),
            Self::Until(until) => until.pass(t, out),
        }
    }

    /// From `t` on, up to which time has passed, the predicates are these, in the order in which they stand in the form.
    pub(super) fn step(&mut self, t: i64, truths: [Truth; 3], out: &mut impl FnMut(RuleOutcome)) {
        let [first, second, third] = truths;
        match self {
            Self::Invariant(invariant) => invariant.step(t, first, out),
            Self::Lasting(lasting) => lasting.step(t, first, out),
            Self::Response(response) => response.step(t, first, second, out),
            Self::Until(until) if until.has_premise() => until.step(t, first, second, third, out),
            Self::Until(until) => until.step(t, Truth::False, first, second, out),
        }
    }

    /// The recording ends at `t`, up to which time has passed. What ends with it is over.
    pub(super) fn end(&mut self, t: i64, out: &mut impl FnMut(RuleOutcome)) {
        match self {
            Self::Invariant(_) => {}
            Self::Lasting(lasting) => lasting.end(out),
            Self::Response(response) => {
                response.pass(t.saturating_add(1), out);
                response.open().for_each(|()| out(RuleOutcome::Ended));
            }
            Self::Until(until) => {
                until.pass(t.saturating_add(1), out);
                until.open().for_each(|()| out(RuleOutcome::Ended));
            }
        }
    }
}

/// When something became true: behind `after`, and not later than `by`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Start {
    pub(super) after: i64,
    pub(super) by: i64,
}

/// Follows a premise, and tells when it becomes true.
#[derive(Clone, Debug)]
pub(super) struct Edge {
    before: Truth,
    /// Up to when it was known to be false, since it was last known to be true.
    false_until: Option<i64>,
}

impl Edge {
    pub(super) const fn new() -> Self {
        Self { before: Truth::Unknown, false_until: None }
    }

    /// From `t` on it is this. `Some` if it became true; what is true when it is first known did not become so.
    pub(super) fn step(&mut self, t: i64, now: Truth) -> Option<Start> {
        if self.before == Truth::False {
            self.false_until = Some(t);
        }
        self.before = now;
        match now {
            Truth::True => self.false_until.take().map(|after| Start { after, by: t }),
            Truth::False => {
                self.false_until = Some(t);
                None
            }
            Truth::Unknown => None,
        }
    }

    /// Whether it may have become true since it was known to be false.
    pub(super) const fn is_open(&self) -> bool {
        matches!(self.before, Truth::Unknown) && self.false_until.is_some()
    }
}

/// Whether there is room to follow one more.
const fn has_room(open: usize) -> bool {
    open < OPEN
}
