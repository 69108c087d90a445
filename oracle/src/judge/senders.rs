//! Two VCUs in one recording: two cars on one bus, or recordings that were put together. Nothing can be said of either then.
//!
//! Where they differ in what 520h shows, that goes to and fro faster than one VCU can. Where they do not, 520h only comes twice as
//! often as it should. That may have other reasons, so it is a warning, and both are judged as one.

use adsdv_spec::messages::{Frame, Vcu2AiStatus};
use adsdv_spec::{AsState, Bus};

use super::finding::{Finding, Party, Rule, Severity};
use super::time::{FAR_NS, MS, SILENCE_NS, milliseconds};

/// After so many changes of the state to and fro, each sooner than a VCU can take a step, it is not one VCU.
const STATE_TURNS: u32 = 5;
/// The same of all that 520h shows: of one VCU, switches may go to and fro in every step, and a recorder may hold frames back.
const STATUS_TURNS: u32 = 50;
/// For as much time too many frames have come, half as many again allowed, before it is no recorder that held them back.
const TOO_OFTEN_NS: i64 = 10 * SILENCE_NS;

/// Whether 520h is of two VCUs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Senders {
    /// How often one VCU sends it, in nanoseconds.
    cycle: i64,
    state: Turns<AsState>,
    status: Turns<Vcu2AiStatus>,
    often: Often,
    /// Whether it is certain that there are two, and was reported.
    several: bool,
}

/// Something that changes to and fro.
#[derive(Clone, Copy, Debug)]
struct Turns<T> {
    /// What was shown before the last change.
    before: Option<T>,
    /// Since when it goes to and fro, and how often it did.
    since: i64,
    times: u32,
}

/// How often 520h comes.
#[derive(Clone, Copy, Debug, Default)]
struct Often {
    last: i64,
    /// Since when it comes too often, and how many times it did.
    since: i64,
    count: u32,
    /// How much longer one VCU would take for these, in nanoseconds.
    excess: i64,
    reported: bool,
}

impl Senders {
    pub(super) fn new(bus: &Bus) -> Self {
        let cycle = bus.message(Vcu2AiStatus::ID).map_or(0, |def| i64::from(def.cycle_ms) * MS);
        let (state, status) = (Turns::new(), Turns::new());
        Self { cycle, state, status, often: Often::default(), several: false }
    }

    /// Whether two VCUs send.
    pub(super) fn several(&self) -> bool {
        self.several
    }

    /// 520h shows something else than before. Tells of two VCUs if there are, once.
    pub(super) fn changed(&mut self, t: i64, both: [Vcu2AiStatus; 2], bus: &Bus) -> Option<Finding> {
        // The handshake's bit goes to and fro in one VCU, as fast as the AI Computer answers.
        let both = both.map(|status| Vcu2AiStatus { handshake: false, ..status });
        let by_state = self.state.changed(t, both.map(|status| status.as_state), self.cycle, STATE_TURNS);
        let by_status = self.status.changed(t, both, self.cycle, STATUS_TURNS);
        let (turns, since) = by_state.or(by_status)?;
        self.several = true;
        let seen = format!(
            "520h shows {} in turn, {turns} times in {:.0} ms, faster than one VCU can: two cars, or two recordings in one",
            difference(both, bus),
            milliseconds(t - since)
        );
        let expected = "one VCU: record each car by itself; nothing is said of a VCU from here on";
        let finding = Finding::violation(Party::Log, "2.2", Rule::TwoSenders, t).seen(seen);
        Some(finding.expected(expected))
    }

    /// 520h came. Tells that it comes twice as often as from one VCU, once.
    #[inline]
    pub(super) fn came(&mut self, t: i64) -> Option<Finding> {
        let (often, cycle) = (&mut self.often, self.cycle);
        let passed = (t - std::mem::replace(&mut often.last, t)).clamp(0, FAR_NS);
        often.excess += cycle - passed - passed / 2;
        often.count += 1;
        if often.excess <= 0 {
            (often.since, often.count, often.excess) = (t, 0, 0);
        }
        // Where the log's times are coarse, many frames are of one moment.
        let too_often = often.excess > TOO_OFTEN_NS && t - often.since > TOO_OFTEN_NS;
        let reports = too_often && !self.several && !std::mem::replace(&mut often.reported, true);
        reports.then(|| often.finding(t, cycle))
    }
}

impl Often {
    #[cold]
    fn finding(&self, t: i64, cycle: i64) -> Finding {
        let lasted = milliseconds(t - self.since);
        let times = f64::from(self.count) * milliseconds(cycle) / lasted;
        let seen = format!(
            "520h came {} times in {:.3} s, {times:.1} times as often as from one VCU: two cars that show the same, or each frame recorded twice",
            self.count,
            lasted / 1e3
        );
        Finding::new(Severity::Warning, Party::Log, "2.2", Rule::TwoSenders, t)
            .seen(seen)
            .expected(format!("it every {:.0} ms: record each car by itself", milliseconds(cycle)))
            .unless("one VCU sends it that often")
    }
}

impl<T: Copy + PartialEq> Turns<T> {
    const fn new() -> Self {
        Self { before: None, since: 0, times: 0 }
    }

    /// It may have changed. Tells whether it has gone to and fro for too long, faster than one VCU can, how often and since when.
    fn changed(&mut self, t: i64, [from, to]: [T; 2], cycle: i64, most: u32) -> Option<(u32, i64)> {
        if from == to {
            return None;
        }
        // Jitter brings one VCU's steps together; those of two come twice in a cycle.
        let fast = t.saturating_sub(self.since) < i64::from(self.times) * cycle * 3 / 4;
        if self.before == Some(to) && fast {
            self.times += 1;
        } else {
            (self.since, self.times) = (t, 1);
        }
        self.before = Some(from);
        (self.times > most).then_some((most, self.since))
    }
}

/// What 520h shows of two VCUs, where that differs: their states, or the first of the other signals.
fn difference([one, other]: [Vcu2AiStatus; 2], bus: &Bus) -> String {
    let (one_state, other_state) = (one.as_state, other.as_state);
    let both = bus.encode(one).zip(bus.encode(other));
    let differs = |(one, other): (Frame, Frame)| {
        let values = bus.message(Vcu2AiStatus::ID)?.signals.iter().filter_map(|signal| {
            let values = (signal.raw(one.data())?, signal.raw(other.data())?);
            (values.0 != values.1).then(|| {
                format!("{} {} and {}", signal.name, signal.display(values.0), signal.display(values.1))
            })
        });
        { values }.next()
    };
    let states = || format!("{one_state} and {other_state}");
    both.filter(|_| one_state == other_state).and_then(differs).unwrap_or_else(states)
}

#[cfg(test)]
mod tests {
    use adsdv_spec::AsState::{Driving, Off, Ready};
    use adsdv_spec::Edition;
    use adsdv_spec::messages::AmiState;

    use super::*;

    const BUS: &Bus = &Edition::V3_0.bus;
    /// How often 520h comes.
    const CYCLE: i64 = 10 * MS;

    fn shows(as_state: AsState) -> Vcu2AiStatus {
        Vcu2AiStatus { as_state, ..Vcu2AiStatus::default() }
    }

    /// What the judge reports when 520h shows these, one after the other and again, each so long after the one before; and at the how manieth.
    fn turns(between: i64, shown: &[Vcu2AiStatus]) -> Option<(usize, String)> {
        let mut senders = Senders::new(BUS);
        let next = shown.iter().cycle().skip(1);
        shown.iter().cycle().zip(next).take(400).zip(0..).find_map(|((&from, &to), turn)| {
            let finding = senders.changed(turn * between, [from, to], BUS)?;
            assert!(senders.several());
            Some((usize::try_from(turn).expect("few"), finding.seen))
        })
    }

    #[test]
    fn states_in_turn_within_a_cycle_are_of_two_vcus() {
        let (turn, seen) = turns(CYCLE / 2, &[shows(Off), shows(Driving)]).expect("a report");
        assert_eq!(turn, STATE_TURNS as usize);
        assert!(seen.contains("AS_DRIVING and AS_OFF in turn, 5 times in 25 ms"), "{seen}");
    }

    #[test]
    fn what_else_is_shown_in_turn_is_of_two_vcus_if_it_is_for_longer() {
        let other = Vcu2AiStatus { ami_state: AmiState::Skidpad, ..shows(Ready) };
        let (turn, seen) = turns(CYCLE / 2, &[shows(Ready), other]).expect("a report");
        assert_eq!(turn, STATUS_TURNS as usize);
        assert!(seen.starts_with("520h shows AMI_STATE NOT_SELECTED and SKIDPAD in turn"), "{seen}");
    }

    #[test]
    fn the_handshake_goes_to_and_fro_in_one_vcu() {
        let other = Vcu2AiStatus { handshake: true, ..shows(Ready) };
        assert_eq!(turns(CYCLE / 2, &[shows(Ready), other]), None);
    }

    #[test]
    fn one_vcu_may_go_to_and_fro_once_a_cycle() {
        assert_eq!(turns(CYCLE, &[shows(Off), shows(Ready)]), None);
    }

    #[test]
    fn several_states_one_after_the_other_are_of_one() {
        assert_eq!(turns(0, &[Off, Ready, Driving].map(shows)), None);
    }

    #[test]
    fn centuries_between_two_states_are_none_the_worse() {
        let mut senders = Senders::new(BUS);
        for (t, from, to) in [(i64::MIN, Off, Ready), (i64::MAX, Ready, Off), (i64::MIN, Off, Ready)] {
            assert_eq!(senders.changed(t, [from, to].map(shows), BUS), None);
        }
    }

    /// When the judge reports that 520h comes too often, if it comes at these times.
    fn often(times: impl IntoIterator<Item = i64>) -> Option<(i64, String)> {
        let mut senders = Senders::new(BUS);
        times.into_iter().find_map(|t| Some((t, senders.came(t)?.message())))
    }

    #[test]
    fn two_cars_that_show_the_same_come_twice_as_often() {
        let (t, message) =
            often((0..).map(|frame| frame / 2 * CYCLE + frame % 2 * MS).take(4000)).expect("a report");
        assert!((9_900 * MS..10_100 * MS).contains(&t), "{t}");
        assert!(message.contains("2.0 times as often as from one VCU"), "{message}");
        assert!(message.ends_with("unless one VCU sends it that often"), "{message}");
    }

    #[test]
    fn it_is_reported_once() {
        let mut senders = Senders::new(BUS);
        let count = (0..10_000).filter(|frame| senders.came(frame * CYCLE / 2).is_some()).count();
        assert_eq!(count, 1);
    }

    /// One VCU, in a recording that stands still for `held` every now and then and has all that came meanwhile at once.
    fn held_back(held: i64) -> Option<(i64, String)> {
        often(
            (0..100_000)
                .map(|frame| frame * CYCLE)
                .map(|t| t - t % (20 * CYCLE) + (t % (20 * CYCLE)).max(held)),
        )
    }

    #[test]
    fn one_car_is_never_taken_for_two_however_its_frames_are_held_back() {
        assert_eq!(held_back(0), None);
        assert_eq!(held_back(2 * CYCLE), None);
        assert_eq!(held_back(20 * CYCLE), None);
        let once = (0..100_000).map(|frame| (frame * CYCLE).max(4_000 * MS));
        assert_eq!(often(once), None, "four seconds at once");
        assert_eq!(often((0..100_000).map(|frame| frame * CYCLE * 2 / 3)), None, "half as often again");
        for coarse in [1000 * MS, 10_000 * MS, i64::MAX] {
            let times = (0..100_000).map(|frame| frame * CYCLE).map(|t| t - t % coarse);
            assert_eq!(often(times), None, "times in steps of {coarse}");
        }
    }
}
