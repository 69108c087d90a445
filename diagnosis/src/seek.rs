//! Looks for what an arrow wants besides that a program does not seem to have.

use adsdv_conform::ProgramError;
use adsdv_conform::protocol::{Domain, InputField};
use adsdv_oracle::chance::SplitMix64;
use adsdv_spec::messages::AsState;
use adsdv_spec::mutation::{Change, TermChange};
use adsdv_spec::{Edition, Term};

use crate::deviation::Deviation;
use crate::lead::lead;
use crate::pilot::Pilot;
use crate::record::Record;
use crate::subject::Subject;
use crate::walk::LONG_MS;
use crate::ways::Ways;

/// So many times an arrow is tried with inputs by chance.
const TRIES: usize = 600;
/// No more conditions of an alternative than these are looked for the other way round at once.
const AT_ONCE: usize = 3;
/// Beyond these an arrow is not late.
const LATEST: usize = 3;

/// An arrow that is looked for: it is taken by a model that has it.
pub(crate) struct Sought<'a> {
    pub(crate) ways: &'a Ways<'a>,
    pub(crate) from: AsState,
    pub(crate) to: AsState,
}

/// What was found of an arrow.
#[derive(Debug, Default)]
pub(crate) struct Sight {
    /// What was asked and answered.
    pub(crate) records: Vec<Record>,
    /// What the arrow may need, where it is taken at all: nothing if it only has to be waited for.
    pub(crate) needs: Option<Vec<Deviation>>,
}

/// When a long time passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wait {
    /// Before anything is done.
    Before,
    Not,
    /// While everything is as the arrow wants it.
    AtLast,
}

const WAITS: [Wait; 3] = [Wait::Before, Wait::Not, Wait::AtLast];

type Changes = Vec<(&'static InputField, i32)>;

impl Sought<'_> {
    /// Looks for it.
    pub(crate) fn look(
        &self,
        subject: &mut dyn Subject,
        random: &mut SplitMix64,
    ) -> Result<Sight, ProgramError> {
        let mut sight = Sight::default();
        let terms: Vec<Term> =
            self.ways.model.terms(self.from).filter(|(_, to)| *to == self.to).map(|(term, _)| term).collect();
        if terms.is_empty() || self.ways.to(self.from).is_none() {
            return Ok(sight);
        }
        for tried in 0..self.ways.interface.fewer(TRIES) {
            let Some(term) = terms.get(random.below(terms.len())) else { break };
            let Some(&wait) = WAITS.get(tried % WAITS.len()) else { break };
            let wanted = if tried < WAITS.len() { Vec::new() } else { self.by_chance(random) };
            let (mut changes, taken) = self.is_taken(subject, term, &wanted, wait, &mut sight.records)?;
            if !taken {
                continue;
            }
            let mut place = 0;
            while place < changes.len() {
                let mut fewer = changes.clone();
                fewer.remove(place);
                let (made, taken) = self.is_taken(subject, term, &fewer, wait, &mut sight.records)?;
                if taken {
                    changes = made;
                } else {
                    place += 1;
                }
            }
            sight.needs = Some(self.may_need(&changes));
            break;
        }
        Ok(sight)
    }

    /// Some inputs otherwise.
    fn by_chance(&self, random: &mut SplitMix64) -> Changes {
        let named = self.ways.dials.iter().filter(|dial| !matches!(dial.field.domain, Domain::Number { .. }));
        named
            .filter_map(|dial| {
                let raw = dial.values.get(random.below(dial.values.len()))?;
                (random.below(2) == 0).then_some((dial.field, *raw))
            })
            .collect()
    }

    /// Whether the arrow is taken after a long time with some inputs otherwise, as far as the model takes it with them; those inputs.
    fn is_taken(
        &self,
        subject: &mut dyn Subject,
        term: &Term,
        wanted: &Changes,
        wait: Wait,
        records: &mut Vec<Record>,
    ) -> Result<(Changes, bool), ProgramError> {
        let (done, record) = lead(subject, self.ways, |pilot| self.takes(pilot, term, wanted, wait))?;
        records.push(record);
        Ok(done)
    }

    fn takes(
        &self,
        pilot: &mut Pilot<'_>,
        term: &Term,
        wanted: &Changes,
        wait: Wait,
    ) -> Result<(Changes, bool), ProgramError> {
        let (mut made, mut taken) = (Vec::new(), false);
        if pilot.to(self.from)? {
            if wait == Wait::Before {
                pilot.wait(LONG_MS)?;
            }
            pilot.prepare(term, self.to, 0)?;
            for &(field, raw) in wanted {
                let before = pilot.inputs;
                if (field.get)(&before) == raw {
                    continue;
                }
                (field.set)(&mut pilot.inputs, raw);
                if pilot.is_led_to(self.to, term) {
                    made.push((field, raw));
                } else {
                    pilot.inputs = before;
                }
            }
            if !pilot.is_lost() {
                if wait == Wait::AtLast {
                    pilot.step(LONG_MS)?;
                } else {
                    pilot.take(term, self.to)?;
                }
                taken = pilot.state() == self.to;
                for _ in 0..LATEST {
                    pilot.cycles(1)?;
                    taken = taken || pilot.state() == self.to;
                }
            }
        }
        Ok((made, taken))
    }

    /// What an arrow may need that is taken with these inputs otherwise, and not with one of them less.
    fn may_need(&self, changes: &Changes) -> Vec<Deviation> {
        let (from, to) = (self.from, self.to);
        let need = |&(field, raw): &(&'static InputField, i32)| Deviation::Needs {
            from,
            to,
            key: field.key,
            raw,
            is: true,
        };
        changes.iter().map(need).collect()
    }

    /// Whether it is taken as the model has it, by any of its alternatives and after any of the times.
    pub(crate) fn look_once(&self, subject: &mut dyn Subject) -> Result<Sight, ProgramError> {
        let mut sight = Sight::default();
        if self.ways.to(self.from).is_none() {
            return Ok(sight);
        }
        for (term, _) in self.ways.model.terms(self.from).filter(|(_, to)| *to == self.to) {
            for wait in WAITS {
                let (_, taken) = self.is_taken(subject, &term, &Vec::new(), wait, &mut sight.records)?;
                if taken {
                    sight.needs = Some(Vec::new());
                    return Ok(sight);
                }
            }
        }
        Ok(sight)
    }
}

/// The conditions of an arrow the other way round: one, two, or three of an alternative at once, the fewest first.
pub(crate) fn opposites(edition: &Edition, from: AsState, to: AsState) -> Vec<Vec<Deviation>> {
    let mut all: Vec<Vec<Deviation>> = Vec::new();
    let rows = edition.rules.table.rows().iter().enumerate();
    for (row, of) in rows.filter(|(_, row)| (row.from, row.to) == (from, to)) {
        for (place, term) in of.terms().iter().enumerate() {
            if !term.readings.is_subset(edition.readings.choices()) {
                continue;
            }
            let opposite =
                |(atom, _)| Deviation::Changed(Change::Term(row, place, TermChange::LiteralFlipped(atom)));
            let each: Vec<Deviation> = term.literals().map(opposite).collect();
            let mut sets: Vec<Vec<Deviation>> = vec![Vec::new()];
            for one in each {
                let more = sets.iter().filter(|set| set.len() < AT_ONCE);
                sets.extend(more.map(|set| [set.as_slice(), &[one]].concat()).collect::<Vec<_>>());
            }
            all.extend(sets.into_iter().filter(|set| !set.is_empty()));
        }
    }
    all.sort_by_key(Vec::len);
    all
}

/// The arrows that a program with these deviations does not seem to have, each with what is left when it has them.
pub(crate) fn missing(edition: &Edition, found: &[Deviation]) -> Vec<(Vec<Deviation>, AsState, AsState)> {
    let rows = edition.rules.table.rows();
    let mut all = Vec::new();
    for one in found {
        let row = match *one {
            Deviation::Changed(Change::RowDropped(row) | Change::Term(row, _, TermChange::Dropped))
            | Deviation::Joined { row, .. } => rows.get(row).map(|row| (row.from, row.to)),
            Deviation::Needs { from, to, .. } => Some((from, to)),
            _ => None,
        };
        if let Some((from, to)) = row {
            let without: Vec<Deviation> = found.iter().copied().filter(|other| other != one).collect();
            all.push((without, from, to));
        }
    }
    all
}
