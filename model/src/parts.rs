//! The parts of the table: no row, term or condition of it may be dead.
//!
//! A part decides a step if the table without it takes that step otherwise.

use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};

use adsdv_spec::mutation::{Change, TermChange};
use adsdv_spec::table::{Row, Term};
use adsdv_spec::{Atom, Control, Machine, Mutation, Reads};

use crate::cycle::cycle_ms;
use crate::vectors::{Cache, Vectors};

/// A part of the table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// The row, or the row that the part is in.
    pub row: Row,
    /// The alternative of the row's guard, or the alternative that the part is in; `None`: the part is the whole row.
    pub term: Option<Term>,
    /// The condition of the alternative, with the value that it must have; `None`: the part is the whole alternative.
    pub literal: Option<(Atom, bool)>,
    /// The conditions of the part in words.
    words: String,
}

impl Part {
    /// The part that a mutation drops; `None` if it does something else, or drops what the readings do not have.
    fn dropped(mutation: Mutation, machine: &Machine) -> Option<Self> {
        let rules = &machine.edition().rules;
        let rows = rules.table.rows();
        match mutation.change {
            Change::RowDropped(row) => {
                Some(Self { row: *rows.get(row)?, term: None, literal: None, words: String::new() })
            }
            Change::Term(row, term, change) => {
                let row = *rows.get(row)?;
                let term = *row.terms().get(term)?;
                let literal = match change {
                    TermChange::Dropped => None,
                    TermChange::LiteralDropped(atom) => Some((atom, term.on.has(atom))),
                    _ => return None,
                };
                let there = term.readings.is_subset(machine.readings().choices());
                let text = |(atom, on)| rules.text(atom, on).to_string();
                let words: Vec<String> = match literal {
                    Some(literal) => vec![text(literal)],
                    None => term.literals().map(text).collect(),
                };
                there.then(|| Self { row, term: Some(term), literal, words: words.join(" and ") })
            }
            _ => None,
        }
    }

    /// Whether it is the same part, in whichever words.
    pub(crate) fn is(&self, other: &Self) -> bool {
        (self.row, self.term, self.literal) == (other.row, other.term, other.literal)
    }
}

/// Such as `AS_READY -> AS_OFF (3.6): AS master switch OFF`.
impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { row: Row { from, to, section, .. }, term, literal, words } = self;
        write!(f, "{from} -> {to} ({section})")?;
        match (term, literal) {
            (Some(_), None) => write!(f, ": {words}"),
            (Some(term), Some(_)) => write!(f, ": {words} in the alternative of {}", term.section),
            (None, _) => Ok(()),
        }
    }
}

/// The parts of a machine's table, and which of them have decided a step.
#[derive(Debug)]
pub(crate) struct Parts {
    all: Vec<Candidate>,
}

#[derive(Debug)]
struct Candidate {
    part: Part,
    /// The machine without it.
    without: Machine,
    decides: AtomicBool,
}

impl Parts {
    pub(crate) fn of(machine: &Machine) -> Self {
        let edition = machine.edition();
        let candidate = |mutation: Mutation| {
            Some(Candidate {
                part: Part::dropped(mutation, machine)?,
                without: Machine::new(mutation.apply(edition), machine.readings()),
                decides: AtomicBool::new(false),
            })
        };
        Self { all: Mutation::all(edition).filter_map(candidate).collect() }
    }

    /// Finds out which parts decide a step out of a control state, of those that have decided none so far.
    pub(crate) fn look(&self, machine: &Machine, control: &Control, cache: &Cache) {
        let open = self.all.iter().filter(|candidate| {
            candidate.part.row.from == control.state && !candidate.decides.load(Ordering::Relaxed)
        });
        let idle = |machine: &Machine| machine.possible(control, cycle_ms(machine)).next().is_none();
        let with = machine.reads(control, cycle_ms(machine));
        // While a timer runs nothing may be possible, with the part or without it: then they are alike.
        let with_is_idle = idle(machine);
        for Candidate { without, decides, .. } in open {
            if with_is_idle && idle(without) {
                continue;
            }
            let less = without.reads(control, cycle_ms(without));
            let reads = Reads { atoms: with.atoms.union(less.atoms), faults: with.faults.union(less.faults) };
            let decided = cache.get(reads, Vectors::Read).iter().any(|&seen| {
                let after = |machine: &Machine| machine.react(control, seen, cycle_ms(machine)).control;
                after(machine) != after(without)
            });
            if decided {
                decides.store(true, Ordering::Relaxed);
            }
        }
    }

    /// Every part, and whether it has decided a step.
    pub(crate) fn all(&self) -> impl Iterator<Item = (Part, bool)> {
        self.all.iter().map(|candidate| (candidate.part.clone(), candidate.decides.load(Ordering::Relaxed)))
    }
}
