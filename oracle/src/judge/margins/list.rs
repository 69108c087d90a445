//! The margins, from what was kept.

use adsdv_spec::messages::MessageDef;
use adsdv_spec::{AsState, Atom, Row};

use super::super::ai::AT_SPEED;
use super::super::exercised::cited;
use super::super::finding::Party;
use super::super::{Judge, MS, STEER, WHEEL_SPEEDS};
use super::kept::{Peak, Reaction};
use super::notice::ANGLE;
use super::{Basis, Margin, Measure};

/// The requirement behind the time for an answer, as version 3.0 has it.
const ANSWER: &str = "HS-9"; //= HS-9, HS-17
/// The requirement behind the time for which a message may be missing.
const MISSED: &str = "HS-18"; //= HS-18
/// The section of both.
const COMMUNICATION: &str = "2.4";

#[allow(clippy::cast_precision_loss, reason = "a measured value for display")]
fn ms(ns: i64) -> f64 {
    ns as f64 / 1e6
}

impl Judge {
    /// All margins, the closest first; those of a cycle last.
    pub(in crate::judge) fn margins(&self) -> Vec<Margin> {
        let mut margins: Vec<Margin> = self.of_answers().into_iter().chain(self.of_gaps()).collect();
        margins.extend(self.of_reactions().into_iter().chain(self.of_speeds()).chain(self.of_go()));
        margins.sort_by(Margin::order);
        margins
    }

    fn of_answers(&self) -> Option<Margin> {
        let Peak { value, t } = self.margins.answer?;
        let limit = ms(self.handshake_limit());
        let requirements = cited::of_edition(&self.edition, &[ANSWER]);
        let (what, section) = (Measure::HandshakeAnswer, COMMUNICATION);
        Some(Margin { requirements, ..margin(what, Party::Ai, section, ms(value), limit, "ms", t) })
    }

    fn of_gaps(&self) -> Vec<Margin> {
        let kept = self.margins.gaps.iter().zip(&self.slots).enumerate();
        let seen = kept.filter(|(_, (gap, _))| gap.value > 0);
        seen.filter_map(|(index, (gap, slot))| Some(self.of_gap(index, *gap, slot.def?))).collect()
    }

    fn of_gap(&self, index: usize, gap: Peak, def: &MessageDef) -> Margin {
        let of = |section, limit| {
            let party = Party::from(def.sender);
            let margin = margin(Measure::MessageGap, party, section, ms(gap.value), limit, "ms", gap.t);
            Margin { message: Some(def.id), ..margin }
        };
        match self.watched_limit(index) {
            Some(limit) => Margin { requirements: vec![MISSED], ..of(COMMUNICATION, ms(limit)) },
            None => Margin { basis: Basis::Cycle, ..of(def.section, f64::from(def.cycle_ms)) },
        }
    }

    fn of_reactions(&self) -> Vec<Margin> {
        let measured = [
            (Measure::SlowestReaction, self.margins.slowest),
            (Measure::FastestReaction, self.margins.fastest),
        ];
        let limit = ms(self.deadline);
        let of = |(what, reaction): (Measure, Option<Reaction>)| {
            let Reaction { took, way, from } = reaction?;
            let row = self.row(from, AsState::EmergencyBrake)?;
            let requirements = cited::of_edition(&self.edition, &cited::of_term(row, &way.term));
            let margin = margin(what, Party::Vcu, way.section, ms(took.value), limit, "ms", took.t);
            Some(Margin { requirements, basis: Basis::Deadline, ..margin })
        };
        measured.into_iter().filter_map(of).collect()
    }

    fn of_speeds(&self) -> Vec<Margin> {
        let Some(signal) = self.slots.get(WHEEL_SPEEDS).and_then(|slot| slot.def?.signals.first()) else {
            return Vec::new();
        };
        let limit = self.edition.rules.thresholds.wheel_speed.to_physical();
        let measured = [Measure::FinishedSpeed, Measure::NeutralSpeed].into_iter().zip(AT_SPEED);
        let of = |((what, fault), kept): (_, Option<Peak>)| {
            let Peak { value, t } = kept?;
            let terms = self.variants.terms(AsState::Driving);
            let cites = terms.iter().find(|term| term.fault == Some(fault))?.cites;
            let value = signal.physical(i32::try_from(value).ok()?);
            let margin = margin(what, Party::Ai, "3.7", value, limit, signal.unit, t);
            Some(Margin { requirements: cited::of_edition(&self.edition, cites.requirements), ..margin })
        };
        measured.zip(self.margins.speeds).filter_map(of).collect()
    }

    /// The margins of the way into AS_DRIVING.
    fn of_go(&self) -> Vec<Margin> {
        let Some(row) = self.row(AsState::Ready, AsState::Driving) else { return Vec::new() };
        let of = |what, atom, value, limit, unit, t| {
            let own = row.terms().iter().find_map(|term| term.requirements_of(atom)).unwrap_or_default();
            let margin = margin(what, Party::Vcu, row.section, value, limit, unit, t);
            Margin { requirements: cited::of_edition(&self.edition, own), ..margin }
        };
        let steer = self.margins.angle.and_then(|Peak { value, t }| {
            let signal = self.slots.get(STEER)?.def?.signal_of(ANGLE)?;
            let value = signal.physical(i32::try_from(value).ok()?);
            let limit = self.edition.rules.thresholds.straight.to_physical();
            Some(of(Measure::SteerAtGo, Atom::SteerStraight, value, limit, signal.unit, t))
        });
        let dwell = self.margins.dwell.map(|Peak { value, t }| {
            let limit = f64::from(self.edition.rules.timing.ready_dwell_ms);
            of(Measure::ReadyDwell, Atom::DwellElapsed, ms(value), limit, "ms", t)
        });
        steer.into_iter().chain(dwell).collect()
    }

    /// The row of an arrow.
    pub(in crate::judge) fn row(&self, from: AsState, to: AsState) -> Option<&Row> {
        self.edition.rules.table.rows().iter().find(|row| (row.from, row.to) == (from, to))
    }

    /// How long this message may be missing, in nanoseconds; `None` if nobody watches it.
    pub(in crate::judge) fn watched_limit(&self, index: usize) -> Option<i64> {
        let ms = self.edition.rules.thresholds.missed_ms?;
        super::super::missed::is_watched(index).then_some(i64::from(ms) * MS)
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
