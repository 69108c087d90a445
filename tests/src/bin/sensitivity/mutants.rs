//! What is wrong with the VCUs that drive, one thing with each.

use adsdv_conform::protocol::{Domain, Protocol};
use adsdv_diagnosis::{Deviation, Remembers};
use adsdv_spec::messages::Vcu2AiStatus;
use adsdv_spec::mutation::Change;
use adsdv_spec::{Edition, Machine, Mutation};
use adsdv_tests::world::World;

/// What it is that is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A row, a term or a condition of Figure 2.
    Table,
    /// A time or a threshold.
    Time,
    /// Something is remembered otherwise.
    Memory,
    /// A flag of 520h is stuck, in one state or in all of them.
    Flag,
}

impl Kind {
    pub(crate) const ALL: [Self; 4] = [Self::Table, Self::Time, Self::Memory, Self::Flag];

    /// As the command line has it.
    pub(crate) const fn id(self) -> &'static str {
        match self {
            Self::Table => "table",
            Self::Time => "time",
            Self::Memory => "memory",
            Self::Flag => "flag",
        }
    }

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Table => "rows, terms and conditions",
            Self::Time => "times and thresholds",
            Self::Memory => "memory",
            Self::Flag => "flags",
        }
    }
}

/// A VCU with one thing that is wrong.
pub(crate) struct Mutant {
    pub(crate) kind: Kind,
    pub(crate) name: String,
    /// A world with it, in which nothing has happened yet.
    pub(crate) world: World,
}

/// Every mutant of an edition.
pub(crate) fn all(edition: &Edition) -> Vec<Mutant> {
    let of_rules = Mutation::all(edition).map(|mutation| {
        let kind = match mutation.change {
            Change::Time(..) | Change::Threshold(..) => Kind::Time,
            _ => Kind::Table,
        };
        let vcu = Machine::new(mutation.apply(edition), edition.readings);
        Mutant { kind, name: mutation.to_string(), world: World::new(vcu) }
    });
    let deviating = |kind| {
        move |deviation: Deviation| {
            let (name, world) = (deviation.text(edition).to_string(), World::deviating(edition, deviation));
            Mutant { kind, name, world }
        }
    };
    let memory = Remembers::ALL.map(Deviation::Remembers).into_iter().chain([Deviation::GoLevel]);
    let flags = Deviation::every(edition).into_iter().filter(|deviation| sticks(edition, deviation));
    of_rules.chain(memory.map(deviating(Kind::Memory))).chain(flags.map(deviating(Kind::Flag))).collect()
}

/// Whether it is that a flag of 520h has one value, whatever it should have.
fn sticks(edition: &Edition, deviation: &Deviation) -> bool {
    let (Deviation::Shows { key, .. } | Deviation::Writes { key, .. }) = *deviation else { return false };
    let protocol = Protocol::of(edition);
    let is_flag = protocol.shown().any(|(field, domain)| field.key == key && matches!(domain, Domain::Flag));
    let status = edition.bus.message(Vcu2AiStatus::ID);
    is_flag && status.is_some_and(|status| status.signal_of(key).is_some())
}
