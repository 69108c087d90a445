//! What is true, false or unknown at a moment, by what was shown last.

use adsdv_spec::{Atom, Knowledge, Truth};

use super::names::SignalPlace;
use super::syntax::Relation;

/// A signal or a condition that rules are about, and what is known of it now.
#[derive(Clone, Copy, Debug)]
pub(super) struct Subject {
    pub(super) what: SubjectKind,
    pub(super) value: RawValue,
    /// Whether anything was ever known of it.
    pub(super) came: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SubjectKind {
    Signal(SignalPlace),
    Atom(Atom),
}

/// The raw value of a signal; of a condition 1 or 0. `None`: unknown.
pub(super) type RawValue = Option<i32>;

impl Subject {
    pub(super) const fn new(what: SubjectKind) -> Self {
        Self { what, value: None, came: false }
    }

    /// Whether it is the "Go" switch.
    pub(super) const fn is_go(&self) -> bool {
        matches!(self.what, SubjectKind::Atom(Atom::GoOn))
    }

    /// What is left of it when some of the messages have become too old.
    pub(super) fn aged(&self, known: Knowledge, fresh: &impl Fn(u16) -> bool) -> RawValue {
        match self.what {
            SubjectKind::Signal(place) => self.value.filter(|_| fresh(place.message.id)),
            SubjectKind::Atom(atom) => of(known, atom),
        }
    }

    /// What is known of it when messages show this.
    pub(super) fn shown(
        &self,
        known: Knowledge,
        data: &impl Fn(u16) -> Option<([u8; 8], usize)>,
    ) -> RawValue {
        match self.what {
            SubjectKind::Signal(SignalPlace { message, signal }) => {
                let (data, len) = data(message.id)?;
                signal.raw(data.get(..len).unwrap_or(&data))
            }
            SubjectKind::Atom(atom) => of(known, atom),
        }
    }
}

fn of(known: Knowledge, atom: Atom) -> RawValue {
    match known.of(atom) {
        Truth::True => Some(1),
        Truth::False => Some(0),
        Truth::Unknown => None,
    }
}

/// An expression under an edition; subjects by their place in a list.
#[derive(Clone, Debug)]
pub(super) enum Predicate {
    Test(usize, Check),
    Not(Box<Self>),
    All(Vec<Self>),
    Any(Vec<Self>),
}

/// What is asked of a raw value.
#[derive(Clone, Copy, Debug)]
pub(super) enum Check {
    /// Whether it is this one, or means it; `false`: whether it is another.
    Is { raw: i32, equal: bool },
    /// How it compares, times `left`, with `right`.
    Number { comparison: Relation, abs: bool, left: i128, right: i128 },
}

impl Predicate {
    pub(super) fn truth(&self, subjects: &[Subject]) -> Truth {
        match self {
            Self::Test(place, check) => subjects.get(*place).map_or(Truth::Unknown, |subject| {
                subject.value.map_or(Truth::Unknown, |raw| check.holds(subject.what, raw).into())
            }),
            Self::Not(inner) => inner.truth(subjects).not(),
            Self::All(all) => all.iter().fold(Truth::True, |truth, one| truth.and(one.truth(subjects))),
            Self::Any(any) => any.iter().fold(Truth::False, |truth, one| truth.or(one.truth(subjects))),
        }
    }

    /// Whether everything is known that it is about, or all but "Go": if it is unknown, that is why.
    pub(super) fn is_known_but_for_go(&self, subjects: &[Subject]) -> bool {
        match self {
            Self::Test(place, _) => {
                subjects.get(*place).is_some_and(|subject| subject.is_go() || subject.value.is_some())
            }
            Self::Not(inner) => inner.is_known_but_for_go(subjects),
            Self::All(all) | Self::Any(all) => all.iter().all(|one| one.is_known_but_for_go(subjects)),
        }
    }

    /// The subjects that it is about, in the order in which they stand; one may be there twice.
    pub(super) fn subjects(&self, all: &mut Vec<usize>) {
        match self {
            Self::Test(place, _) => all.push(*place),
            Self::Not(inner) => inner.subjects(all),
            Self::All(inner) | Self::Any(inner) => inner.iter().for_each(|one| one.subjects(all)),
        }
    }
}

impl Check {
    fn holds(self, what: SubjectKind, raw: i32) -> bool {
        match self {
            Self::Is { raw: wanted, equal } => {
                let meaning = match what {
                    SubjectKind::Signal(place) => place.signal.meaning(raw),
                    SubjectKind::Atom(_) => raw,
                };
                (raw == wanted || meaning == wanted) == equal
            }
            Self::Number { comparison, abs, left, right } => {
                let raw = i128::from(raw);
                comparison.holds(if abs { raw.abs() } else { raw } * left, right)
            }
        }
    }
}
