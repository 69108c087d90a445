//! "Go" that was pressed in vain.

use adsdv_spec::{AsState, Atom, Atoms, Knowledge, Rules};

/// "Go" that was switched on in `AS_READY` and started nothing: while a condition of section 3.2 failed, or though none did that
/// the bus shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GoPress {
    /// When, in nanoseconds since the first frame.
    pub t_ns: i64,
    /// For how long `AS_READY` had lasted, in nanoseconds.
    pub ready_for_ns: i64,
    /// The conditions that failed, of those that must be on.
    pub off: Atoms,
    /// The conditions that failed, of those that must be off.
    pub on: Atoms,
}

impl GoPress {
    /// Whether a condition failed, so that the VCU is right not to drive.
    pub const fn is_in_vain(&self) -> bool {
        !self.off.is_empty() || !self.on.is_empty()
    }

    /// What failed, in the words of Figure 2.
    pub fn why(&self, rules: &Rules) -> String {
        if !self.is_in_vain() {
            return "no other condition was seen to fail".to_owned();
        }
        let off = self.off.iter().map(|atom| rules.text(atom, false).to_string());
        let on = self.on.iter().map(|atom| rules.text(atom, true).to_string());
        off.chain(on).collect::<Vec<_>>().join(", ")
    }
}

/// "Go" as it is pressed at a time, with what fails then: of the alternatives, the one that fails least.
pub(super) fn pressed(rules: &Rules, t_ns: i64, ready_since: i64, known: Knowledge) -> GoPress {
    let rows =
        rules.table.rows().iter().filter(|row| (row.from, row.to) == (AsState::Ready, AsState::Driving));
    let presses = rows.flat_map(adsdv_spec::Row::terms).map(|term| GoPress {
        t_ns,
        ready_for_ns: t_ns - ready_since,
        off: term.on.without(Atom::GoEdge).without(Atom::GoOn).intersection(known.off()),
        on: term.off.intersection(known.on()),
    });
    let least = presses.min_by_key(|press| press.off.union(press.on).len());
    least.unwrap_or(GoPress { t_ns, ready_for_ns: t_ns - ready_since, off: Atoms::NONE, on: Atoms::NONE })
}
