//! An edition of the interface: one version of the document, as a value.
//!
//! Another edition is another [`Edition`] value, written as its difference to the one before it, and not another program. A
//! mutant, with which test suites are measured, is an edition with one of its [`Rules`] changed.

use crate::atoms::{Atom, Atoms};
use crate::bus::Bus;
use crate::faults::Faults;
use crate::limits::{Thresholds, Timing};
use crate::observation::Observation;
use crate::readings::{Choice, Choices, Reading, Readings};
use crate::requirements::Requirements;
use crate::table::{Priority, Table, Term};

/// One edition of the interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Edition {
    /// The version by which it is named: the document's, or that of the CAN database that changes it.
    pub version: &'static str,
    /// What describes it, by its full name.
    pub document: &'static str,
    /// What the state machine follows.
    pub rules: Rules,
    /// The faults that 520h can show.
    pub faults: Faults,
    /// The answers that are possible. A question with only one of them is settled: the document does not leave it open.
    pub choices: Choices,
    /// The answers that hold where nobody gives others, one of the possible ones to each question.
    pub readings: Readings,
    /// What is on the bus.
    pub bus: Bus,
    /// What it asks for, by the numbers of `REQUIREMENTS.md`.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub requirements: &'static Requirements,
}

/// What the state machine follows: Figure 2, the order of its arrows, the times and the thresholds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Rules {
    /// The arrows of Figure 2.
    pub table: Table,
    /// The arrows that a reading lets overtake others.
    pub priorities: &'static [Priority],
    /// How long things last.
    pub timing: Timing,
    /// Where measured values begin to count.
    pub thresholds: Thresholds,
}

impl Edition {
    /// The edition of this version.
    ///
    /// ```
    /// use adsdv_spec::Edition;
    /// assert_eq!(Edition::find("3.0"), Some(&Edition::V3_0));
    /// assert_eq!(Edition::find("2.9"), None);
    /// ```
    pub fn find(version: &str) -> Option<&'static Self> {
        Self::ALL.iter().copied().find(|edition| edition.version == version)
    }

    /// The questions that the document leaves open.
    pub fn questions(&self) -> impl Iterator<Item = Reading> + Clone + use<> {
        let choices = self.choices;
        Reading::ALL.iter().copied().filter(move |&reading| choices.of_reading(reading).count() > 1)
    }

    /// The possible answers that are not the default.
    pub const fn alternatives(&self) -> Choices {
        self.choices.difference(self.readings.choices())
    }

    /// These answers, but the default to each question to which the answer is not possible.
    #[must_use]
    pub const fn admit(&self, readings: Readings) -> Readings {
        let mut admitted = self.readings;
        let mut i = 0;
        while i < Reading::ALL.len() {
            let choice = readings.choice(Reading::ALL[i]);
            if self.choices.has(choice) {
                admitted = admitted.with(choice);
            }
            i += 1;
        }
        admitted
    }

    /// The conditions of the inputs that can matter under any of the possible answers: those that the table names, that the
    /// handshake and the watch of messages go by, and that the VCU remembers. What an edition lacks is not among them.
    ///
    /// ```
    /// use adsdv_spec::{Atom, Edition};
    /// assert!(Edition::V3_0.scope().has(Atom::Asms));
    /// assert!(!Edition::V3_0.scope().has(Atom::EbsUnavailable)); // a condition of version 4.0
    /// ```
    pub const fn scope(&self) -> Atoms {
        let mut atoms = Atoms::of(&[Atom::Tsms, Atom::AiHandshake]);
        if self.rules.thresholds.missed_ms.is_some() {
            atoms = atoms.with(Atom::AiMessagesMissed);
        }
        if self.choices.has(Choice::FaultEdge) {
            atoms = atoms.with(Atom::MissionRunning).with(Atom::DirectionNeutral);
        }
        let rows = self.rules.table.rows();
        let mut row = 0;
        while row < rows.len() {
            let terms = rows[row].terms();
            let mut term = 0;
            while term < terms.len() {
                let Term { on, off, readings, .. } = terms[term];
                if readings.is_subset(self.choices) {
                    atoms = atoms.union(on).union(off);
                }
                term += 1;
            }
            row += 1;
        }
        let mut i = 0;
        while i < Atom::ALL.len() {
            if let (true, Some(input)) = (atoms.has(Atom::ALL[i]), Atom::ALL[i].input()) {
                atoms = atoms.with(input);
            }
            i += 1;
        }
        atoms.intersection(Observation::SCOPE)
    }

    /// The edition with another Figure 2.
    #[must_use]
    pub const fn with_table(self, table: Table) -> Self {
        Self { rules: Rules { table, ..self.rules }, ..self }
    }

    /// The edition with other times, such as shorter ones, which a model explores sooner.
    #[must_use]
    pub const fn with_timing(self, timing: Timing) -> Self {
        Self { rules: Rules { timing, ..self.rules }, ..self }
    }
}

impl Default for Edition {
    /// [`Edition::DEFAULT`].
    fn default() -> Self {
        *Self::DEFAULT
    }
}
