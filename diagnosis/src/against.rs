//! The requirements that a deviation is against: what the table cites for its rows, alternatives and conditions, and what the
//! document says of times and memory that no condition of Figure 2 tells.

use adsdv_conform::protocol::SHOWN;
use adsdv_oracle::requirements::of_edition;
use adsdv_spec::mutation::{Change, TermChange, Threshold, Time};
use adsdv_spec::{Atom, Edition, Row};

use crate::deviation::{Deviation, Remembers};

/// What is against Figure 2 as a whole: an arrow that it does not have, and an input that is not seen.
const FIGURE_2: &str = "SM-1";

impl Deviation {
    /// The requirements of the edition that it is against, as `spec/REQUIREMENTS.md` numbers them.
    ///
    /// ```
    /// use adsdv_diagnosis::Deviation;
    /// use adsdv_spec::Edition;
    ///
    /// let late = Deviation::find(&Edition::V3_0, "handshake:+450ms").unwrap();
    /// assert_eq!(late.requirements(&Edition::V3_0), ["HS-9"]);
    /// assert_eq!(late.requirements(&Edition::V4_0), ["HS-17"]);
    /// ```
    pub fn requirements(self, edition: &Edition) -> Vec<&'static str> {
        let mut all: Vec<&'static str> = Vec::new();
        for id in self.cited(edition).into_iter().flat_map(|id| of_edition(edition, id)) {
            if !all.contains(&id) {
                all.push(id);
            }
        }
        all
    }

    /// The same, some of them as an earlier edition numbers them.
    fn cited(self, edition: &Edition) -> Vec<&'static str> {
        let rows = edition.rules.table.rows();
        let of_row = |row: Option<&Row>| row.map_or(Vec::new(), |row| row.cites.requirements.to_vec());
        match self {
            Self::Changed(Change::RowDropped(row) | Change::RowLeadsTo(row, _))
            | Self::Joined { row, .. } => of_row(rows.get(row)),
            Self::Changed(Change::RowFirst(row)) => {
                rows.get(row).map_or(Vec::new(), |row| [row.cites.requirements, row.cites.order].concat())
            }
            Self::Changed(Change::Term(row, term, change)) => of_term(edition, row, term, change),
            Self::Changed(Change::Time(time, _)) => match time {
                Time::ReadyDwell => of_conditions(edition, &[Atom::DwellElapsed]),
                Time::EbsTimer => of_conditions(edition, &[Atom::EbsTimerComplete]),
                Time::Handshake => vec!["HS-9"],
            },
            Self::Changed(Change::Threshold(threshold, _)) => match threshold {
                Threshold::WheelSpeed => of_conditions(edition, &[Atom::Moving, Atom::AtRest]),
                Threshold::Straight => of_conditions(edition, &[Atom::SteerStraight]),
                Threshold::Missed => vec!["HS-18"],
            },
            Self::Needs { from, to, .. } | Self::Late { from, to, .. } => {
                of_row(rows.iter().find(|row| (row.from, row.to) == (from, to)))
            }
            Self::Opens { key: "tsms" | "ebs", .. } => vec!["D-36"],
            Self::Also { .. } | Self::Ignores { .. } | Self::Opens { .. } => vec![FIGURE_2],
            Self::Wheels(_) => of_conditions(edition, &[Atom::Moving, Atom::AtRest]),
            Self::GoLevel => of_conditions(edition, &[Atom::GoEdge]),
            Self::GoNeedsHandshake => vec!["DRV-15"],
            Self::Remembers(what) => match what {
                Remembers::CauseUntilLeft | Remembers::LatestCause => vec!["D-15"],
                Remembers::DwellOfAllVisits => of_conditions(edition, &[Atom::DwellElapsed]),
                Remembers::TimerWhileAsmsOff => vec!["ETO-2", "D-23"],
                Remembers::GoSeenOff => vec!["D-6"],
                Remembers::CommsLost | Remembers::CommsLostForGood => vec!["D-17", "D-18"],
                Remembers::Handshake | Remembers::HandshakeBit => vec!["HS-1", "D-8"],
                Remembers::HandshakeBeginsWithOne => vec!["HS-12", "D-44"],
                Remembers::LiveFlags => vec!["D-17"],
                Remembers::TimeBeforeHandshake => vec!["HS-16", "D-44"],
            },
            Self::Causes { .. } => vec!["D-15"],
            Self::Prefers { .. } => vec!["D-16"],
            Self::Reads(choice) => vec![choice.reading().decision()],
            Self::Shows { key, .. } | Self::Writes { key, .. } => {
                let field = SHOWN.iter().find(|field| field.key == key);
                field.map_or(Vec::new(), |field| field.requirements.to_vec())
            }
        }
    }
}

/// Those behind an alternative, or behind the one condition of it that is otherwise.
fn of_term(edition: &Edition, row: usize, term: usize, change: TermChange) -> Vec<&'static str> {
    let rows = edition.rules.table.rows();
    let Some((row, term)) = rows.get(row).and_then(|row| Some((row, row.terms().get(term)?))) else {
        return Vec::new();
    };
    let own = match change {
        TermChange::LiteralDropped(atom) | TermChange::LiteralFlipped(atom) => term.requirements_of(atom),
        _ => None,
    };
    let of_term =
        if term.cites.requirements.is_empty() { row.cites.requirements } else { term.cites.requirements };
    own.unwrap_or(of_term).to_vec()
}

/// Those behind conditions, wherever the edition's table has them.
fn of_conditions(edition: &Edition, atoms: &[Atom]) -> Vec<&'static str> {
    let terms = edition.rules.table.rows().iter().flat_map(Row::terms);
    let there = terms.filter(|term| term.readings.is_subset(edition.readings.choices()));
    there
        .flat_map(|term| atoms.iter().filter_map(|atom| term.requirements_of(*atom)))
        .flatten()
        .copied()
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_deviation_is_against_a_requirement() {
        for edition in Edition::ALL {
            for deviation in Deviation::every(edition) {
                assert!(!deviation.requirements(edition).is_empty(), "{}", deviation.id(edition));
            }
        }
    }

    #[test]
    fn times_and_thresholds_are_against_what_says_how_long_and_how_much() {
        for (id, in_3_0, in_4_0) in [
            ("handshake:+450ms", "HS-9", "HS-17"),
            ("ready-dwell:-7ms", "DRV-4", "DRV-4"),
            ("ebs-timer:+1ms", "ETO-1", "ETO-1"),
            ("straight:+1", "DRV-9", "DRV-9"),
            ("wheel-speed:+1", "IMP-4", "IMP-4"),
        ] {
            for (edition, expected) in [(&Edition::V3_0, in_3_0), (&Edition::V4_0, in_4_0)] {
                let found = Deviation::find(edition, id).map(|one| one.requirements(edition));
                assert!(found.unwrap_or_default().contains(&expected), "{id} in {}", edition.version);
            }
        }
        let missed =
            Deviation::find(&Edition::V4_0, "missed:+20").map(|one| one.requirements(&Edition::V4_0));
        assert_eq!(missed.unwrap_or_default(), ["HS-18"]);
    }
}
