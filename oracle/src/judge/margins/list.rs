//! The margins, from what was kept.

use adsdv_spec::messages::MessageDef;
use adsdv_spec::{AsState, Atom};

use super::kept::{AT_SPEED, Peak, Reaction};
use super::notice::ANGLE;
use super::{Basis, Margin, Measure};
use crate::judge::book::Book;
use crate::judge::estimator::base::Estimator;
use crate::judge::estimator::readings::{row_of, section_of};
use crate::judge::exercised::cited;
use crate::judge::finding::Party;
use crate::judge::sampler::places::{STEER, WHEEL_SPEEDS};
use crate::requirements::of_term;

/// The requirement behind the time for an answer, as version 3.0 has it.
const ANSWER: &str = "HS-9"; //= HS-9, HS-17
/// The section of both.
const COMMUNICATION: &str = "2.4";

#[allow(clippy::cast_precision_loss, reason = "a measured value for display")]
fn ms(ns: i64) -> f64 {
    ns as f64 / 1e6
}

impl Book {
    /// All margins, the closest first; those of a cycle last.
    pub(in crate::judge) fn margins(&self, est: &Estimator) -> Vec<Margin> {
        let mut margins: Vec<Margin> = self.of_answers(est).into_iter().chain(self.of_gaps(est)).collect();
        margins.extend(self.of_reactions(est).into_iter().chain(self.of_speeds(est)).chain(self.of_go(est)));
        margins.sort_by(Margin::order);
        margins
    }

    fn of_answers(&self, est: &Estimator) -> Option<Margin> {
        let Peak { value, t } = self.margins.answer?;
        let limit = ms(est.handshake_limit());
        let requirements = cited::of_edition(&est.edition, &[ANSWER]);
        let (what, section) = (Measure::HandshakeAnswer, COMMUNICATION);
        Some(Margin { requirements, ..margin(what, Party::Ai, section, ms(value), limit, "ms", t) })
    }

    fn of_gaps(&self, est: &Estimator) -> Vec<Margin> {
        let kept = self.margins.gaps.iter().zip(&est.sampler.slots).enumerate();
        let seen = kept.filter(|(_, (gap, _))| gap.value > 0);
        seen.filter_map(|(index, (gap, slot))| Some(of_gap(est, index, *gap, slot.def?))).collect()
    }

    fn of_reactions(&self, est: &Estimator) -> Vec<Margin> {
        let measured = [
            (Measure::SlowestReaction, self.margins.slowest),
            (Measure::FastestReaction, self.margins.fastest),
        ];
        let limit = ms(est.deadline);
        let of = |(what, reaction): (Measure, Option<Reaction>)| {
            let Reaction { took, way, from } = reaction?;
            let row = row_of(&est.edition, from, AsState::EmergencyBrake)?;
            let requirements = cited::of_edition(&est.edition, &of_term(row, &way.term));
            let margin = margin(what, Party::Vcu, way.section, ms(took.value), limit, "ms", took.t);
            Some(Margin { requirements, basis: Basis::Deadline, ..margin })
        };
        measured.into_iter().filter_map(of).collect()
    }

    fn of_speeds(&self, est: &Estimator) -> Vec<Margin> {
        let Some(signal) = est.sampler.def(WHEEL_SPEEDS).and_then(|def| def.signals.first()) else {
            return Vec::new();
        };
        let limit = est.edition.rules.thresholds.wheel_speed.to_physical();
        let measured = [Measure::FinishedSpeed, Measure::NeutralSpeed].into_iter().zip(AT_SPEED);
        let of = |((what, fault), kept): (_, Option<Peak>)| {
            let Peak { value, t } = kept?;
            let ways = est.readings.ways(AsState::Driving);
            let cites = ways.iter().find(|way| way.term.fault == Some(fault))?.term.cites;
            let value = signal.physical(i32::try_from(value).ok()?);
            let margin =
                margin(what, Party::Ai, section_of(&est.edition, fault), value, limit, signal.unit, t);
            Some(Margin { requirements: cited::of_edition(&est.edition, cites.requirements), ..margin })
        };
        measured.zip(self.margins.speeds).filter_map(of).collect()
    }

    /// The margins of the way into AS_DRIVING.
    fn of_go(&self, est: &Estimator) -> Vec<Margin> {
        let Some(row) = row_of(&est.edition, AsState::Ready, AsState::Driving) else { return Vec::new() };
        let of = |what, atom, value, limit, unit, t| {
            let own = row.terms().iter().find_map(|term| term.requirements_of(atom)).unwrap_or_default();
            let margin = margin(what, Party::Vcu, row.section, value, limit, unit, t);
            Margin { requirements: cited::of_edition(&est.edition, own), ..margin }
        };
        let asks_for = |atom| row.terms().iter().any(|term| term.on.union(term.off).has(atom));
        let angle = self.margins.angle.filter(|_| asks_for(Atom::SteerStraight));
        let steer = angle.and_then(|Peak { value, t }| {
            let signal = est.sampler.def(STEER)?.signal_of(ANGLE)?;
            let value = signal.physical(i32::try_from(value).ok()?);
            let limit = est.edition.rules.thresholds.straight.to_physical();
            Some(of(Measure::SteerAtGo, Atom::SteerStraight, value, limit, signal.unit, t))
        });
        let dwell = self.margins.dwell.map(|Peak { value, t }| {
            let limit = f64::from(est.edition.rules.timing.ready_dwell_ms);
            of(Measure::ReadyDwell, Atom::DwellElapsed, ms(value), limit, "ms", t)
        });
        steer.into_iter().chain(dwell).collect()
    }
}

fn of_gap(est: &Estimator, index: usize, gap: Peak, def: &MessageDef) -> Margin {
    let of = |section, limit| {
        let party = Party::from(def.sender);
        let margin = margin(Measure::MessageGap, party, section, ms(gap.value), limit, "ms", gap.t);
        Margin { message: Some(def.id), ..margin }
    };
    match est.silences.limit_of(index) {
        Some(limit) => Margin { requirements: vec![cited::MISSED], ..of(COMMUNICATION, ms(limit)) },
        None => Margin { basis: Basis::Cycle, ..of(def.section, f64::from(def.cycle_ms)) },
    }
}

/// A margin that the document sets, with nothing behind it yet.
fn margin(
    what: Measure,
    party: Party,
    section: &'static str,
    value: f64,
    limit: f64,
    unit: &'static str,
    t_ns: i64,
) -> Margin {
    let (message, requirements, basis) = (None, Vec::new(), Basis::Document);
    Margin { what, message, party, section, requirements, value, limit, unit, basis, t_ns }
}
