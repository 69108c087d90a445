//! Asks, explains, and asks again with what was learnt.

use std::time::{Duration, Instant};

use adsdv_conform::ProgramError;
use adsdv_oracle::chance::SplitMix64;
use adsdv_spec::Edition;
use adsdv_spec::messages::AsState;

use crate::again;
use crate::candidates::{self, Candidates};
use crate::cycles::each;
use crate::deviation::Deviation;
use crate::experiments;
use crate::fit::Fit;
use crate::fixed::Fixed;
use crate::found::Diagnosis;
use crate::in_the_way;
use crate::interface::{Interface, Seen};
use crate::model::Model;
use crate::record::{Record, Records};
use crate::seek::{self, Sought};
use crate::stays::Stay;
use crate::subject::Subject;
use crate::turn;
use crate::walk::{difference, walk};
use crate::ways::Ways;

/// No more rounds of experiments than these: each begins with what the one before has found.
const ROUNDS: u64 = 12;
/// After so many it is asked whether an output stands in the way.
const EARLY: u64 = 2;
/// Where less than one of so many experiments is not explained, no output stands in the way.
const FEW: usize = 50;
/// So many times what was found leads to what else is measured and looked for, before all is tried again.
const DEEPER: usize = 3;
/// So many arrows that the program does not take are looked for where nothing explains that.
const SOUGHT: usize = 2;
/// Nobody waits longer for a diagnosis.
const LONGEST: Duration = Duration::from_mins(10);
/// So many walks by chance at the end of a round in which all was explained.
const WALKS: usize = 600;
/// So many walks by chance of two models, to find where they differ.
const COMPARED: usize = 60;

/// What a program that has these inputs and outputs answers to the experiments that a model leads to.
///
/// # Errors
///
/// Fails if the program does: it ends, does not answer in time, or answers what is none.
pub fn records(
    subject: &mut dyn Subject,
    model: &Model,
    interface: &Interface,
) -> Result<Vec<Record>, ProgramError> {
    experiments::all(subject, &Ways::of(model, interface), 0, &AsState::ALL, None)
}

/// Finds out what a program does otherwise than an edition says.
///
/// # Errors
///
/// As [`records`].
pub fn diagnose(subject: &mut dyn Subject, edition: &Edition) -> Result<Diagnosis, ProgramError> {
    diagnose_within(subject, edition, &Interface::default(), LONGEST)
}

/// The same of a program that has these inputs and outputs, in this time: one that does what no deviation explains can be looked at
/// for very long.
///
/// # Errors
///
/// As [`records`].
pub fn diagnose_within(
    subject: &mut dyn Subject,
    edition: &Edition,
    interface: &Interface,
    time: Duration,
) -> Result<Diagnosis, ProgramError> {
    let now = Instant::now();
    let at = |share: Duration| now.checked_add(share).unwrap_or(now);
    let mut seen = Seen { subject, interface };
    let mut search = Search::new(&mut seen, edition, interface, at(time / 3));
    let explained = search.run(EARLY)?;
    let in_the_way = search.in_the_way();
    if in_the_way.is_empty() {
        search.until = at(time);
        if !explained {
            search.run(ROUNDS)?;
        }
        return search.result();
    }
    if !search.repeats()? {
        // Nothing that is looked for would explain that.
        return search.result();
    }
    // What one output shows may hide what is wrong with the state machine.
    let narrower = interface.without(&in_the_way);
    let mut seen = Seen { subject: &mut *search.subject.subject, interface: &narrower };
    let mut few = Search::new(&mut seen, edition, &narrower, at(time / 3 * 2));
    let others_are_explained = few.run(ROUNDS)?;
    let few = Diagnosis { left_out: in_the_way, ..few.result()? };
    let answers = few.readings.iter().map(|choice| Deviation::Reads(*choice));
    search.found = answers.chain(few.deviations.iter().copied()).collect();
    search.until = at(time);
    if others_are_explained {
        // What changes the states is known, and one more look tells whether what is left can be explained.
        search.records = Records::default();
        search.candidates.single.retain(Deviation::is_about_outputs);
        search.candidates.several.clear();
        search.is_explained_by_experiments(0)?;
        search.explain(1)?;
        if !search.records.unexplained(&search.model()).is_empty() {
            return Ok(few);
        }
    }
    search.run(ROUNDS)?;
    let all = search.result()?;
    let explains_more = few.unexplained.len() * all.experiments < all.unexplained.len() * few.experiments;
    Ok(if explains_more { few } else { all })
}

struct Search<'a, 'b> {
    subject: &'a mut Seen<'b>,
    edition: &'a Edition,
    interface: &'a Interface,
    candidates: Candidates,
    records: Records,
    found: Vec<Deviation>,
    random: SplitMix64,
    /// The arrows that were looked for with conditions the other way round, each with what the program was thought to do.
    sought: Vec<(Vec<Deviation>, AsState, AsState)>,
    /// What was found and tried with something else remembered.
    remembered: Vec<Vec<Deviation>>,
    until: Instant,
}

impl<'a, 'b> Search<'a, 'b> {
    fn new(
        subject: &'a mut Seen<'b>,
        edition: &'a Edition,
        interface: &'a Interface,
        until: Instant,
    ) -> Self {
        Self {
            subject,
            edition,
            interface,
            candidates: Candidates {
                single: candidates::all(edition, interface),
                several: candidates::several(edition),
            },
            records: Records::default(),
            found: Vec::new(),
            random: SplitMix64(1),
            sought: Vec::new(),
            remembered: Vec::new(),
            until,
        }
    }

    /// Asks and explains until all is explained, nothing more can be, there were so many rounds, or the time is over. Tells whether all
    /// is explained.
    fn run(&mut self, rounds: u64) -> Result<bool, ProgramError> {
        for round in 0..rounds {
            if self.is_over() {
                break;
            }
            let before = self.found.clone();
            if self.is_explained_by_experiments(round)?
                && self.differs_from_others()?
                && self.is_explained_by_walks()?
            {
                self.come_nearer();
                if self.found == before {
                    return Ok(true);
                }
                continue;
            }
            self.explain(if rounds == ROUNDS { DEEPER } else { 1 })?;
            if self.found == before && round > 2 {
                break;
            }
        }
        // What explains all answers so far may be wrong about the next.
        if rounds == ROUNDS && !self.is_over() {
            self.come_nearer();
            self.is_explained_by_experiments(rounds)?;
            self.differs_from_others()?;
            self.is_explained_by_walks()?;
        }
        Ok(false)
    }

    /// The outputs of which there are answers that nothing explains.
    fn in_the_way(&self) -> Vec<&'static str> {
        let model = self.model();
        let unexplained = self.records.unexplained(&model);
        // Of a few another look tells more.
        if unexplained.len() * FEW < self.records.count {
            return Vec::new();
        }
        in_the_way::outputs(&unexplained, &model)
    }

    fn is_over(&self) -> bool {
        Instant::now() >= self.until
    }

    fn model(&self) -> Model {
        Model::new(self.edition, &self.found)
    }

    /// Keeps records, and tells whether all of them are explained.
    fn keep(&mut self, records: Vec<Record>, model: &Model) -> bool {
        let all = records.iter().all(|record| record.is_explained(model));
        self.records.extend(records);
        all
    }

    fn is_explained_by_experiments(&mut self, round: u64) -> Result<bool, ProgramError> {
        let model = self.model();
        let ways = Ways::of(&model, self.interface);
        let records = experiments::all(self.subject, &ways, round, &AsState::ALL, Some(self.until))?;
        Ok(self.keep(records, &model))
    }

    /// Whether a program does what these deviations do, and not what others do that explain as much.
    fn differs_from_others(&mut self) -> Result<bool, ProgramError> {
        let model = self.model();
        let alike = self.a_fit().alternatives(&self.found);
        let mut asked = Vec::new();
        for other in alike {
            let seed = self.random.below(usize::MAX) as u64;
            if let Some(steps) = difference(self.edition, self.interface, &self.found, &other, COMPARED, seed)
            {
                let record = match self.interface.cycle_ms() {
                    Some(cycle_ms) => Record::of(self.subject, &each(&steps, &model, cycle_ms))?.joined(),
                    None => Record::of(self.subject, &steps)?,
                };
                asked.push(record);
            }
        }
        Ok(self.keep(asked, &model))
    }

    fn is_explained_by_walks(&mut self) -> Result<bool, ProgramError> {
        let model = self.model();
        let ways = Ways::of(&model, self.interface);
        let mut records = Vec::new();
        for _ in (0..self.interface.fewer(WALKS)).take_while(|_| Instant::now() < self.until) {
            records.push(walk(self.subject, &ways, &mut self.random)?);
        }
        Ok(self.keep(records, &model))
    }

    /// Explains what was answered, and measures and looks for what the explanation leads to, so many times.
    fn explain(&mut self, deeper: usize) -> Result<(), ProgramError> {
        for _ in 0..deeper {
            let before = self.found.clone();
            self.measure(&self.found.clone())?;
            self.fit();
            let mut missing = seek::missing(self.edition, &self.found);
            if self.found == before {
                // What nothing explains may be an arrow that wants several things at once.
                let untaken = self.a_fit().untaken(&self.found);
                missing.extend(untaken.into_iter().take(SOUGHT).map(|(from, to)| (before.clone(), from, to)));
            }
            for (without, from, to) in &missing {
                if self.is_over() {
                    break;
                }
                self.seek(without, *from, *to)?;
            }
            if !missing.is_empty() {
                self.fit();
            }
            if self.found == before || self.is_over() {
                break;
            }
        }
        Ok(())
    }

    fn fit(&mut self) {
        let mut found = self.a_fit().run(self.found.clone());
        if !self.remembered.contains(&found) {
            self.remembered.push(found.clone());
            found = self.a_fit().else_remembered(found);
        }
        self.found = found;
    }

    fn come_nearer(&mut self) {
        let found = self.a_fit().nearest(self.found.clone());
        self.found = found;
    }

    fn a_fit(&self) -> Fit<'_> {
        Fit::new(self.edition, self.records.kept(), &self.candidates, self.until)
    }

    /// The numbers that turn a program that has these deviations.
    fn measure(&mut self, with: &[Deviation]) -> Result<(), ProgramError> {
        let model = Model::new(self.edition, with);
        let mut measured = turn::all(self.subject, &Ways::of(&model, self.interface), self.until)?;
        measured.retain(|one| !self.candidates.single.contains(one));
        self.candidates.add_measured(measured);
        Ok(())
    }

    /// Looks for an arrow, and for what it needs.
    fn seek(&mut self, without: &[Deviation], from: AsState, to: AsState) -> Result<(), ProgramError> {
        let model = Model::new(self.edition, without);
        let ways = Ways::of(&model, self.interface);
        let sight = Sought { ways: &ways, from, to }.look(self.subject, &mut self.random)?;
        self.records.extend(sight.records);
        let found = match sight.needs {
            Some(needs) => Some(needs),
            None => self.seek_with_opposites(without, from, to)?,
        };
        if let Some(needs) = found {
            let with: Vec<Deviation> = without.iter().copied().chain(needs.iter().copied()).collect();
            self.measure(&with)?;
            if !needs.is_empty() && !self.candidates.several.contains(&needs) {
                self.candidates.several.push(needs);
            }
        }
        Ok(())
    }

    /// Looks for an arrow some of whose conditions have to be the other way round, once for each set of deviations.
    fn seek_with_opposites(
        &mut self,
        without: &[Deviation],
        from: AsState,
        to: AsState,
    ) -> Result<Option<Vec<Deviation>>, ProgramError> {
        let sought = (without.to_vec(), from, to);
        if self.sought.contains(&sought) {
            return Ok(None);
        }
        self.sought.push(sought);
        let mut tried = seek::opposites(self.edition, from, to);
        tried.retain(|opposite| opposite.iter().all(|one| !without.contains(one)));
        for opposites in tried {
            if self.is_over() {
                break;
            }
            let model = Model::new(self.edition, &[without, &opposites].concat());
            let sight =
                Sought { ways: &Ways::of(&model, self.interface), from, to }.look_once(self.subject)?;
            self.records.extend(sight.records);
            if sight.needs.is_some() {
                return Ok(Some(opposites));
            }
        }
        Ok(None)
    }

    /// Whether the program answers alike what it is asked again. Like steps of a fixed cycle are kept as one, and cannot be asked.
    fn repeats(&mut self) -> Result<bool, ProgramError> {
        let unexplained = self.records.unexplained(&self.model());
        Ok(self.interface.cycle_ms().is_some() || again::is_alike(self.subject, &self.records, &unexplained)?)
    }

    fn result(mut self) -> Result<Diagnosis, ProgramError> {
        let repeats = self.repeats()?;
        let Self { edition, interface, ref candidates, ref records, ref found, until, .. } = self;
        let cut = Instant::now() >= until;
        let fit = Fit::new(edition, records.kept(), candidates, until);
        let certain = fit.certain(found.clone());
        let told = fit.told_from_others(certain, |one, other| {
            difference(edition, interface, one, other, COMPARED, 1).is_some()
        });
        let deviations = if cut { fit.of_explained_states(told) } else { told };
        let model = Model::new(edition, &deviations);
        let unexplained = records.unexplained(&model);
        let stays = fit.stays(&deviations);
        let is_clear = |(state, stays): &&(AsState, Vec<Stay<'_>>)| {
            !stays.is_empty() && fit.wrong_in(*state, &deviations) == 0
        };
        let clear: Vec<AsState> = stays.iter().filter(is_clear).map(|(state, _)| *state).collect();
        let unclear: Vec<AsState> = AsState::ALL.into_iter().filter(|state| !clear.contains(state)).collect();
        let fixed = Fixed::of(edition, interface);
        let arrows = edition.rules.table.rows().iter().map(|row| (row.from, row.to));
        let is_shown =
            |&(from, to): &(AsState, AsState)| clear.contains(&from) && fixed.can_be_taken(edition, from, to);
        let not_shown = arrows.filter(|arrow| !is_shown(arrow)).collect();
        let (answers, deviations): (Vec<Deviation>, Vec<Deviation>) =
            deviations.into_iter().partition(|one| one.choice().is_some());
        Ok(Diagnosis {
            deviations,
            readings: answers.iter().filter_map(Deviation::choice).collect(),
            unexplained,
            experiments: records.count,
            left_out: Vec::new(),
            cut,
            unclear,
            not_shown,
            repeats,
        })
    }
}
