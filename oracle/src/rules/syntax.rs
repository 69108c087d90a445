//! A rule as it is written: names that no edition has been asked for yet.

use super::error::Span;

/// A line with a rule.
#[derive(Clone, Debug)]
pub(super) struct RuleLine {
    /// Its number, from 1.
    pub(super) number: usize,
    /// All of it.
    pub(super) text: String,
    /// The rule's name.
    pub(super) name: String,
    /// What it asks for, as it is written.
    pub(super) rule: String,
    /// What it is for.
    pub(super) note: Option<String>,
    pub(super) form: Form<Expression>,
}

/// The form of a rule; times in nanoseconds.
#[derive(Clone, Debug)]
pub(super) enum Form<P> {
    /// `always P`
    Always(P),
    /// `never P`
    Never(P),
    /// `never P for T`, `P for at most T`
    AtMost(P, i64),
    /// `after P, Q within T`
    Within(P, P, i64),
    /// `after P, Q for T`
    Throughout(P, P, i64),
    /// `after P, Q until R [within T]`; without a premise, from the first moment on
    Until(Option<P>, P, P, Option<i64>),
}

impl<P> Form<P> {
    /// The same form of other predicates, in the order in which they stand.
    pub(super) fn try_map<Q, E>(&self, mut to: impl FnMut(&P) -> Result<Q, E>) -> Result<Form<Q>, E> {
        Ok(match self {
            Self::Always(p) => Form::Always(to(p)?),
            Self::Never(p) => Form::Never(to(p)?),
            Self::AtMost(p, time) => Form::AtMost(to(p)?, *time),
            Self::Within(p, q, time) => Form::Within(to(p)?, to(q)?, *time),
            Self::Throughout(p, q, time) => Form::Throughout(to(p)?, to(q)?, *time),
            Self::Until(p, q, r, time) => {
                let premise = p.as_ref().map(&mut to).transpose()?;
                Form::Until(premise, to(q)?, to(r)?, *time)
            }
        })
    }

    /// The predicates, in the order in which they stand.
    pub(super) fn predicates(&self) -> impl Iterator<Item = &P> {
        let all = match self {
            Self::Always(p) | Self::Never(p) | Self::AtMost(p, _) => [Some(p), None, None],
            Self::Within(p, q, _) | Self::Throughout(p, q, _) => [Some(p), Some(q), None],
            Self::Until(p, q, r, _) => [p.as_ref(), Some(q), Some(r)],
        };
        all.into_iter().flatten()
    }
}

/// What is true or not at a moment.
#[derive(Clone, Debug)]
pub(super) enum Expression {
    Term(Term),
    Not(Box<Self>),
    /// All of these.
    All(Vec<Self>),
    /// At least one of these.
    Any(Vec<Self>),
}

impl Expression {
    /// Every term of it, in the order in which they stand.
    pub(super) fn for_each_term(&self, each: &mut impl FnMut(&Term)) {
        match self {
            Self::Term(term) => each(term),
            Self::Not(inner) => inner.for_each_term(each),
            Self::All(all) | Self::Any(all) => all.iter().for_each(|one| one.for_each_term(each)),
        }
    }
}

/// A signal or a condition, and what is asked of it.
#[derive(Clone, Debug)]
pub(super) struct Term {
    /// The message, where it is named.
    pub(super) message: Option<Spanned<String>>,
    pub(super) name: Spanned<String>,
    /// Whether the size counts, and not the sign.
    pub(super) abs: bool,
    pub(super) test: TermTest,
}

/// What is asked.
#[derive(Clone, Debug)]
pub(super) enum TermTest {
    /// Whether it is on: nothing else was said.
    Bare,
    /// Whether it is this word; `false`: whether it is another. Or on and off.
    Word(bool, Spanned<String>),
    /// How it compares with a number, in a unit if one is said.
    Number(Relation, Spanned<String>, Option<Spanned<String>>),
}

#[derive(Clone, Debug)]
pub(super) struct Spanned<T> {
    pub(super) value: T,
    pub(super) span: Span,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Relation {
    Greater,
    GreaterOrEqual,
    Less,
    LessOrEqual,
    Equal,
    NotEqual,
}

impl Relation {
    /// Whether the left number compares so with the right one.
    pub(super) fn holds(self, left: i128, right: i128) -> bool {
        match self {
            Self::Greater => left > right,
            Self::GreaterOrEqual => left >= right,
            Self::Less => left < right,
            Self::LessOrEqual => left <= right,
            Self::Equal => left == right,
            Self::NotEqual => left != right,
        }
    }
}
