//! Two VCUs in one recording: two cars on one bus, or recordings that were put together. Nothing can be said of either then.

use adsdv_spec::AsState;

use super::finding::{Finding, Party, Rule};
use super::time::milliseconds;

/// After so many changes to and fro, each sooner than a VCU can take a step, it is not one VCU.
const TURNS: u32 = 5;

/// Whether 520h shows two states in turn.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Senders {
    /// The state before the last.
    before: Option<AsState>,
    /// Since when it goes to and fro, and how often it did.
    since: i64,
    turns: u32,
    /// Whether it is certain that there are two, and was reported.
    several: bool,
}

impl Senders {
    /// Whether two VCUs send.
    pub(super) fn several(&self) -> bool {
        self.several
    }

    /// 520h shows another state than before. Tells of two VCUs if there are, once.
    pub(super) fn changed(
        &mut self,
        t: i64,
        (from, to): (AsState, AsState),
        cycle: i64,
        now: i64,
    ) -> Option<Finding> {
        let (since, intervals) = (self.since, i64::from(self.turns));
        // Jitter brings one VCU's steps together; those of two come twice in a cycle.
        let fast = t.saturating_sub(since) < intervals * cycle * 3 / 4;
        if self.before == Some(to) && fast {
            self.turns += 1;
        } else {
            (self.since, self.turns) = (t, 1);
        }
        self.before = Some(from);
        self.several = self.turns > TURNS;
        if !self.several {
            return None;
        }
        let seen = format!(
            "520h shows {from} and {to} in turn, {TURNS} times in {:.0} ms, faster than one VCU can: two cars, or two recordings in one",
            milliseconds(t.saturating_sub(since))
        );
        let expected = "one VCU: record each car by itself; nothing is said of a VCU from here on";
        let finding = Finding::violation(Party::Log, "2.2", Rule::TwoSenders, now).seen(seen);
        Some(finding.expected(expected))
    }
}

#[cfg(test)]
mod tests {
    use super::{Senders, TURNS};
    use adsdv_spec::AsState::{Driving, Off, Ready};

    const CYCLE: i64 = 10;

    #[test]
    fn states_in_turn_within_a_cycle_are_of_two_vcus() {
        let mut senders = Senders::default();
        let mut states = [(Off, Driving), (Driving, Off)].into_iter().cycle();
        let told = (0..100).position(|turn| {
            let (from, to) = states.next().expect("it goes on");
            senders.changed(turn * CYCLE / 2, (from, to), CYCLE, 0).is_some()
        });
        assert_eq!(told, Some(TURNS as usize));
        assert!(senders.several());
    }

    #[test]
    fn one_vcu_may_go_to_and_fro_once_a_cycle() {
        let mut senders = Senders::default();
        for turn in 0..100 {
            let (from, to) = if turn % 2 == 0 { (Off, Ready) } else { (Ready, Off) };
            assert!(senders.changed(turn * CYCLE, (from, to), CYCLE, 0).is_none(), "{turn}");
        }
    }

    #[test]
    fn centuries_between_two_states_are_none_the_worse() {
        let mut senders = Senders::default();
        for (t, from, to) in [(i64::MIN, Off, Ready), (i64::MAX, Ready, Off), (i64::MIN, Off, Ready)] {
            assert!(senders.changed(t, (from, to), CYCLE, 0).is_none());
        }
    }

    #[test]
    fn several_states_one_after_the_other_are_of_one() {
        let mut senders = Senders::default();
        let states = [Off, Ready, Driving];
        for turn in 0..100 {
            let (from, to) = (states[turn % 3], states[(turn + 1) % 3]);
            assert!(senders.changed(0, (from, to), CYCLE, 0).is_none(), "{turn}");
        }
    }
}
