//! The cases: every literal of every term of every row of Figure 2, and the world in which it is put to the test.

use adsdv_oracle::judge::JudgeOptions;
use adsdv_spec::messages::Vcu2LogStatus;
use adsdv_spec::{Atom, Atoms, Choice, Choices, Edition, Machine, Readings, Row, Term};
use adsdv_tests::world::World;

use crate::check::all_pinned;

/// One term of one row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Case {
    pub(crate) row: &'static Row,
    pub(crate) term: &'static Term,
}

/// What only time and the past decide.
pub(crate) const HISTORY: Atoms =
    Atoms::of(&[Atom::DwellElapsed, Atom::EbsTimerComplete, Atom::PowerCycleNeeded]);

/// The choices without which a condition does not show on the bus.
const SHOWN_BY: [(Atom, Choice); 2] =
    [(Atom::GoEdge, Choice::GoRaw), (Atom::PowerCycleNeeded, Choice::PowerCycleLatched)];

/// Every term of the table.
pub(crate) fn all() -> impl Iterator<Item = Case> {
    static TABLE: adsdv_spec::Table = Edition::DEFAULT.rules.table;
    TABLE.rows().iter().flat_map(|row| row.terms().iter().map(move |term| Case { row, term }))
}

impl Case {
    /// Where the case is in the table.
    pub(crate) fn name(&self) -> String {
        let text = |(atom, value)| Edition::DEFAULT.rules.text(atom, value).to_string();
        let conditions: Vec<String> = self.term.literals().map(text).collect();
        format!("{} -> {}: {}", self.row.from, self.row.to, conditions.join(" and "))
    }

    /// The choices that the term belongs to, and those that show its conditions.
    fn choices(&self) -> impl Iterator<Item = Choice> {
        let atoms = self.term.on.union(self.term.off);
        let shown_by = SHOWN_BY.iter().filter(move |(atom, _)| atoms.has(*atom)).map(|&(_, choice)| choice);
        self.term.readings.iter().chain(shown_by)
    }

    /// The judge with these choices and nothing else.
    pub(crate) fn options(&self) -> JudgeOptions {
        all_pinned(self.choices().fold(Choices::NONE, Choices::pin))
    }

    /// A world whose VCU follows these choices, in the state that the row leaves. What only the past decides is as the
    /// term wants it, but for the literal that is `broken`.
    pub(crate) fn world(&self, broken: Option<Atom>) -> World {
        let readings = self.choices().fold(Readings::DEFAULT, Readings::with);
        let mut world = World::new(Machine::new(*Edition::DEFAULT, readings));
        if broken == Some(Atom::PowerCycleNeeded) {
            world.after_emergency();
        } else {
            world.arrive(self.row.from);
        }
        let timed = self.wanted(broken).any(|(atom, value)| HISTORY.has(atom) && value);
        if timed && broken != Some(Atom::PowerCycleNeeded) {
            world.wait(i64::from(world.vcu.edition().rules.timing.in_state_limit(self.row.from)));
        }
        world
    }

    /// The conditions of the term with their values, that of the literal `broken` turned round.
    pub(crate) fn wanted(&self, broken: Option<Atom>) -> impl Iterator<Item = (Atom, bool)> {
        self.term.literals().map(move |(atom, value)| (atom, value != (Some(atom) == broken)))
    }

    /// Sets the conditions of the term, but for what the past decides.
    pub(crate) fn set(&self, world: &mut World, broken: Option<Atom>) {
        for (atom, value) in self.wanted(broken) {
            world.set(atom, value);
        }
    }
}

/// Whether the message that shows a condition comes rarely.
pub(crate) fn shows_slowly(atom: Atom) -> bool {
    Vcu2LogStatus::SCOPE.has(atom)
}
