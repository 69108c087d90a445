//! The nearest explanation of those that explain as much: an answer to a question that the document leaves open is no mistake, and
//! a condition that is missing says less than one that needs another, or than an input that is not seen but here and there, or than an
//! answer with exceptions.

use adsdv_spec::mutation::{Change, TermChange};
use adsdv_spec::{AsState, Atoms, Choice, Choices, Inputs};

use crate::deviation::Deviation;
use crate::dials::dials;
use crate::fit::Fit;
use crate::interface::Interface;
use crate::model::Model;

/// Where an alternative is: its row, and its number there.
type Place = (usize, usize);

impl Fit<'_> {
    /// The set, or a nearer one that explains as much.
    pub(crate) fn nearest(&self, set: Vec<Deviation>) -> Vec<Deviation> {
        let (mut best, mut wrong) = (set, None);
        for _ in 0..best.len() {
            let before = best.clone();
            for nearer in self.nearer(&before) {
                let most = *wrong.get_or_insert_with(|| self.wrong(&best));
                if self.is_over() {
                    return best;
                }
                if self.wrong_at_most(&nearer, most).is_none() {
                    continue;
                }
                let nearer = self.without_the_needless(nearer);
                if distance(&nearer) < distance(&best) {
                    wrong = None;
                    best = nearer;
                    break;
                }
            }
            if best == before {
                break;
            }
        }
        best
    }

    /// Sets that would be nearer.
    fn nearer(&self, set: &[Deviation]) -> Vec<Vec<Deviation>> {
        let mut all: Vec<Vec<Deviation>> = Vec::new();
        let but = |is: &dyn Fn(&Deviation) -> bool| {
            set.iter().copied().filter(|one| !is(one)).collect::<Vec<Deviation>>()
        };
        for one in set {
            match *one {
                Deviation::Joined { row, one, other } => {
                    let of = |term: usize| term == one || term == other;
                    let is = |deviation: &Deviation| match *deviation {
                        Deviation::Joined { row: own, one, other } => own == row && (of(one) || of(other)),
                        Deviation::Changed(Change::Term(own, term, _)) => own == row && of(term),
                        _ => false,
                    };
                    let dropped = [one, other].map(|term| missing(row, term));
                    all.push([but(&is), dropped.to_vec()].concat());
                }
                Deviation::Ignores { key } => {
                    let sees = |one: &Deviation| match *one {
                        Deviation::Also { from, key: own, .. } if own == key => Some(from),
                        _ => None,
                    };
                    let states: Vec<AsState> = set.iter().filter_map(sees).collect();
                    if !states.is_empty() {
                        let rest = but(&|other| other == one || sees(other).is_some());
                        let blind = self.blind_to(key, &states);
                        all.push([rest.as_slice(), &blind].concat());
                        all.extend(self.answers().map(|choice| [&[choice], rest.as_slice()].concat()));
                    }
                }
                Deviation::Reads(choice) => {
                    let is_there = |&place: &Place| set.contains(&in_every_reading(place));
                    let (there, gone): (Vec<Place>, Vec<Place>) =
                        self.taken_away_by(choice).into_iter().partition(is_there);
                    if !there.is_empty() {
                        let there: Vec<Deviation> = there.into_iter().map(in_every_reading).collect();
                        let gone = gone.into_iter().map(|(row, term)| missing(row, term)).collect();
                        all.push([but(&|other| other == one || there.contains(other)), gone].concat());
                    }
                }
                _ => {}
            }
        }
        let known: Vec<Choice> = set.iter().filter_map(Deviation::choice).collect();
        let others = self.answers().filter(|answer| {
            answer.choice().is_some_and(|choice| known.iter().all(|own| own.reading() != choice.reading()))
        });
        all.extend(others.map(|answer| [&[answer], set].concat()));
        all
    }

    /// The answers to questions that the document leaves open.
    fn answers(&self) -> impl Iterator<Item = Deviation> + '_ {
        self.candidates.single.iter().copied().filter(|one| one.choice().is_some())
    }

    /// The alternatives that the edition has, and would not have with this answer.
    fn taken_away_by(&self, choice: Choice) -> Vec<Place> {
        let readings = self.edition.readings;
        let rows = self.edition.rules.table.rows().iter().enumerate();
        let terms = rows.flat_map(|(place, row)| {
            row.terms().iter().enumerate().map(move |(number, term)| ((place, number), term.readings))
        });
        let goes = |there: Choices| {
            there.is_subset(readings.choices()) && !there.is_subset(readings.with(choice).choices())
        };
        terms.filter(|(_, there)| goes(*there)).map(|(place, _)| place).collect()
    }

    /// The alternatives that see an input, each of them missing, but for those of some states.
    fn blind_to(&self, key: &str, but: &[AsState]) -> Vec<Deviation> {
        let usual = Model::new(self.edition, &[]);
        let rules = &self.edition.rules;
        let seen = |inputs: &Inputs| usual.machine().atoms_of(inputs.observe(&rules.thresholds));
        let plain = seen(&Inputs::default());
        let dials = dials(&usual, &Interface::default());
        let dial = dials.iter().find(|dial| dial.field.key == key);
        let atoms = dial.into_iter().flat_map(|dial| dial.values.iter().map(move |raw| (dial.field, *raw)));
        let atoms = atoms.fold(Atoms::NONE, |atoms, (field, raw)| {
            let mut inputs = Inputs::default();
            (field.set)(&mut inputs, raw);
            let with = seen(&inputs);
            atoms.union(with.difference(plain)).union(plain.difference(with))
        });
        let rows = rules.table.rows().iter().enumerate().filter(|(_, row)| !but.contains(&row.from));
        let terms = rows.flat_map(|(place, row)| {
            row.terms().iter().enumerate().map(move |(number, term)| (place, number, term))
        });
        let sighted = terms.filter(|(.., term)| term.literals().any(|(atom, _)| atoms.has(atom)));
        sighted.map(|(row, term, _)| missing(row, term)).collect()
    }
}

const fn missing(row: usize, term: usize) -> Deviation {
    Deviation::Changed(Change::Term(row, term, TermChange::Dropped))
}

const fn in_every_reading((row, term): Place) -> Deviation {
    Deviation::Changed(Change::Term(row, term, TermChange::InEveryReading))
}

/// The smaller, the nearer: an answer to an open question is no deviation, and two contradictions are more than two things that are
/// missing.
fn distance(set: &[Deviation]) -> (usize, usize) {
    let of = |one: &Deviation| match *one {
        Deviation::Reads(_) => 0,
        Deviation::Joined { .. } => 5,
        Deviation::Ignores { key } => {
            let sees = |other: &&Deviation| matches!(other, Deviation::Also { key: own, .. } if *own == key);
            2 + 8 * set.iter().filter(sees).count()
        }
        _ => 2,
    };
    (set.iter().map(of).sum(), set.len())
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use adsdv_spec::Edition;

    use super::*;
    use crate::candidates::{self, Candidates};
    use crate::record::Records;

    const EDITION: &Edition = &Edition::V3_0;

    fn find(id: &str) -> Deviation {
        Deviation::find(EDITION, id).expect("there is such a deviation")
    }

    /// What is nearest to a set, by the answers of a program that has these deviations, all of which the set explains.
    fn nearest(program: &[&str], set: &[&str]) -> Vec<String> {
        let program: Vec<Deviation> = program.iter().map(|id| find(id)).collect();
        let program = Model::new(EDITION, &program);
        let mut records = Records::default();
        let asked = crate::diagnose::records(&mut program.clone().running(), &program, &Interface::default());
        records.extend(asked.expect("a model answers everything"));
        let single = candidates::all(EDITION, &Interface::default());
        let candidates = Candidates { single, several: Vec::new() };
        let until = Instant::now() + Duration::from_mins(10);
        let fit = Fit::new(EDITION, records.kept(), &candidates, until);
        let set: Vec<Deviation> = set.iter().map(|id| find(id)).collect();
        assert_eq!(fit.wrong(&set), 0, "the set explains the answers");
        let mut ids: Vec<String> = fit.nearest(set).iter().map(|one| one.id(EDITION)).collect();
        ids.sort();
        ids
    }

    /// A program that is never stopped for what does not fit: two alternatives that it lacks, and not two that contradict each other.
    #[test]
    fn two_alternatives_that_are_missing_are_nearer_than_two_that_contradict_each_other() {
        let missing = ["driving-brake:4:missing", "driving-brake:6:missing"];
        let contradicts = ["driving-brake:4:and:6", "driving-brake:4:opposite:moving"];
        assert_eq!(nearest(&missing, &contradicts), missing);
    }

    #[test]
    fn an_answer_to_an_open_question_is_nearer_than_a_condition_that_is_missing() {
        let answers = [find("off-ready:1:without:power-cycle-needed")];
        assert_eq!(distance(&answers), (2, 1));
        let own = format!("reads:{}", Choice::PowerCycleNotLatched);
        assert_eq!(nearest(&[own.as_str()], &["off-ready:1:without:power-cycle-needed"]), [own.as_str()]);
    }

    #[test]
    fn an_input_that_is_not_seen_is_one_thing_and_farther_the_more_states_see_it() {
        let (ignores, also) = (find("ignores:estop_request"), find("driving-brake:also:estop_request=1"));
        assert!(distance(&[find("go:level")]) == distance(&[ignores]));
        assert!(
            distance(&[ignores, also])
                > distance(&[find("ready-brake:3:missing"), find("finished-brake:3:missing")])
        );
    }

    #[test]
    fn an_alternative_that_is_missing_is_nearer_than_an_answer_with_an_exception() {
        let missing = ["finished-brake:3:missing"];
        let own = format!("reads:{}", Choice::EstopDriving);
        assert_eq!(nearest(&missing, &[own.as_str(), "ready-brake:3:in-every-reading"]), missing);
        assert_eq!(nearest(&[own.as_str()], &[own.as_str()]), [own.as_str()]);
    }

    #[test]
    fn what_is_right_stays_what_it_is() {
        for ids in [
            &["handshake:+450ms", "ready-off:missing"][..],
            &["ignores:charging"],
            &["driving-brake:2:and:3"],
        ] {
            assert_eq!(nearest(ids, ids), ids);
        }
    }
}
