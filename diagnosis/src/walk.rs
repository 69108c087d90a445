//! Walks by chance through the states: what nobody thought of trying.

use adsdv_conform::ProgramError;
use adsdv_conform::suite::Step;
use adsdv_oracle::chance::SplitMix64;
use adsdv_spec::messages::AsState;
use adsdv_spec::{Edition, Term};

use crate::deviation::Deviation;
use crate::interface::{Interface, Seen};
use crate::lead::lead;
use crate::model::Model;
use crate::pilot::Pilot;
use crate::record::Record;
use crate::subject::Subject;
use crate::ways::Ways;

/// So many things are done in a walk.
const MOVES: usize = 16;
/// A time that is longer than any that counts, in milliseconds.
pub(crate) const LONG_MS: u32 = 32_000;

/// A walk from power-on in the ways that a model knows: mostly along arrows, with inputs otherwise now and then.
pub(crate) fn walk(
    subject: &mut dyn Subject,
    ways: &Ways<'_>,
    random: &mut SplitMix64,
) -> Result<Record, ProgramError> {
    let (after, record) = lead(subject, ways, |pilot| {
        let mut random = random.clone();
        wander(pilot, ways, &mut random)?;
        Ok(random)
    })?;
    *random = after;
    Ok(record)
}

fn wander(pilot: &mut Pilot<'_>, ways: &Ways<'_>, random: &mut SplitMix64) -> Result<(), ProgramError> {
    let usual = Model::new(ways.model.usual(), &[]);
    let changes: Vec<_> = ways.changes().collect();
    if let Some(&state) = AsState::ALL.get(random.below(AsState::ALL.len())) {
        pilot.to(state)?;
    }
    for _ in 0..MOVES {
        pilot.find_again();
        let cycle = pilot.cycle_ms();
        match random.below(10) {
            0..=5 => {
                let state = pilot.state();
                let terms: Vec<(Term, AsState)> = ways.model.terms(state).chain(usual.terms(state)).collect();
                let Some((term, to)) = terms.get(random.below(terms.len())).copied() else {
                    pilot.step(cycle)?;
                    continue;
                };
                let early_ms = if random.below(8) == 0 { [1, 10, 100][random.below(3)] } else { 0 };
                pilot.prepare(&term, to, early_ms)?;
                for _ in 0..random.below(4) {
                    if let Some((field, raw)) = changes.get(random.below(changes.len())) {
                        (field.set)(&mut pilot.inputs, *raw);
                    }
                }
                if random.below(3) > 0 {
                    pilot.aim(to, cycle);
                }
                pilot.answers &= random.below(6) > 0;
                pilot.take(&term, to)?;
                pilot.answers = true;
                if random.below(2) == 0 {
                    pilot.find_again();
                    pilot.aim(pilot.state(), cycle);
                }
            }
            6 | 7 => {
                for _ in 0..=random.below(3) {
                    if let Some((field, raw)) = changes.get(random.below(changes.len())) {
                        (field.set)(&mut pilot.inputs, *raw);
                    }
                }
                pilot.step(cycle)?;
            }
            8 => {
                let left = pilot.left_ms();
                let times = [1, cycle, left.saturating_sub(1), left, left / 2, LONG_MS];
                pilot.wait(times.get(random.below(times.len())).copied().unwrap_or(cycle))?;
            }
            _ => {
                pilot.answers = random.below(2) == 0;
                let limit = u32::from(ways.model.machine().edition().rules.timing.handshake_ms);
                let times = [cycle, limit / 2, limit.saturating_sub(1), limit];
                pilot.step(times.get(random.below(times.len())).copied().unwrap_or(cycle))?;
            }
        }
    }
    Ok(())
}

/// Steps at whose end two models do not show the same, as far as a program has inputs and outputs, found in so many walks; `None` if
/// there are none among them.
pub fn difference(
    edition: &Edition,
    interface: &Interface,
    one: &[Deviation],
    other: &[Deviation],
    walks: usize,
    seed: u64,
) -> Option<Vec<Step>> {
    let (one, other) = (Model::new(edition, one), Model::new(edition, other));
    let mut random = SplitMix64(seed);
    for (leads, follows) in [(&one, &other), (&other, &one)] {
        let ways = Ways::of(leads, interface);
        let mut running = leads.clone().running();
        for _ in 0..walks {
            let mut compared = Seen { subject: &mut running, interface };
            let record = walk(&mut compared, &ways, &mut random).ok()?;
            let same = record.agrees(follows);
            if same < record.replies.len() {
                let mut steps = record.steps;
                steps.truncate(same + 1);
                return Some(steps);
            }
        }
    }
    None
}
