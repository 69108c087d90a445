//! The cases: every literal of every term of every row of Figure 2, in each edition that has a row of its own, and the world in
//! which it is put to the test.

use adsdv_oracle::judge::JudgeOptions;
use adsdv_spec::messages::{Vcu2AiBrake, Vcu2LogStatus};
use adsdv_spec::{Atom, Atoms, Choice, Choices, Edition, Machine, Readings, Row, Term};
use adsdv_tests::world::World;

/// One term of one row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Case {
    pub(crate) edition: &'static Edition,
    pub(crate) row: &'static Row,
    pub(crate) term: &'static Term,
}

/// What only time and the past decide.
pub(crate) const HISTORY: Atoms =
    Atoms::of(&[Atom::DwellElapsed, Atom::EbsTimerComplete, Atom::PowerCycleNeeded]);

/// The choices without which a condition does not show on the bus.
const SHOWN_BY: [(Atom, Choice); 2] =
    [(Atom::GoEdge, Choice::GoRaw), (Atom::PowerCycleNeeded, Choice::PowerCycleLatched)];

/// Every term of the table of the first edition, and of each later one those of the rows that none before it has.
pub(crate) fn all() -> impl Iterator<Item = Case> {
    Edition::ALL.iter().enumerate().flat_map(|(place, &edition)| {
        let before = &Edition::ALL[..place];
        let is_new = move |row: &&Row| !before.iter().any(|other| other.rules.table.rows().contains(row));
        let rows = edition.rules.table.rows().iter().filter(is_new);
        rows.flat_map(move |row| row.terms().iter().map(move |term| Case { edition, row, term }))
    })
}

impl Case {
    /// Where the case is in the table.
    pub(crate) fn name(&self) -> String {
        let text = |(atom, value)| self.edition.rules.text(atom, value).to_string();
        let conditions: Vec<String> = self.term.literals().map(text).collect();
        let Row { from, to, .. } = self.row;
        format!("{}: {from} -> {to}: {}", self.edition.version, conditions.join(" and "))
    }

    /// The choices that the term belongs to, and those that show its conditions.
    fn choices(&self) -> impl Iterator<Item = Choice> {
        let atoms = self.term.on.union(self.term.off);
        let shown_by = SHOWN_BY.iter().filter(move |(atom, _)| atoms.has(*atom)).map(|&(_, choice)| choice);
        self.term.readings.iter().chain(shown_by)
    }

    /// The judge with these choices and nothing else.
    pub(crate) fn options(&self) -> JudgeOptions {
        let open = JudgeOptions::of(self.edition);
        JudgeOptions { readings: self.choices().fold(open.readings, Choices::pin), ..open }
    }

    /// A world whose VCU follows these choices, in the state that the row leaves. What only the past decides is as the
    /// term wants it, but for the literal that is `broken`.
    pub(crate) fn world(&self, broken: Option<Atom>) -> World {
        let readings = self.choices().fold(self.edition.readings, Readings::with);
        let mut world = World::new(Machine::new(*self.edition, readings));
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

    /// Whether the message that shows a condition comes rarely: 502h does, and 524h has the state of the EBS as well since 4.0.
    pub(crate) fn shows_slowly(&self, atom: Atom) -> bool {
        let status_ebs = self.edition.bus.message(Vcu2AiBrake::ID).and_then(|def| def.signal("STATUS_EBS"));
        Vcu2LogStatus::SCOPE.has(atom) && status_ebs.is_none()
    }
}
