//! Which requirements wrong answers break.
//!
//! - An output that is wrong breaks those requirements of the test that are about it, and if none is, the one that the output
//!   itself is. What is right breaks nothing, whatever else is wrong in the same test.
//! - Where the state goes wrong only the state counts, there and in all that follows: a VCU in another state has other outputs.
//!   What these would have checked is not checked by that test.
//! - A wrong state of which no requirement of the test is, as in a random scenario, breaks those of the tests of the row of
//!   Figure 2 that was not taken, or was.
//! - Where two rows held and the other one was taken, only what says which comes first is broken.

use adsdv_oracle::requirements::is_of_a_reading;
use adsdv_spec::{AsState, Edition, Machine, Outputs, Term};

use super::about::{NO_ARROW, STATE, STATE_MACHINE, only_in, own, shows};
use super::broken::{Row, Why, last_row, why};
use super::keys::Keys;
use super::vcu::Reply;
use crate::protocol::Shown;
use crate::suite::{Kind, Scenario, Test};

/// What is wrong in the answers to a scenario, for as long as the state is right.
#[derive(Clone, Debug, Default)]
pub(super) struct WrongAnswers {
    /// The outputs that are wrong before the state is, by the state in which they are.
    keys: Vec<(AsState, Keys)>,
    /// Whether the state is wrong at last.
    pub(super) loses_the_state: bool,
    /// What a wrong state has to do with Figure 2.
    state: Option<Why>,
    /// Where two rows held and the later one was taken: the requirements that say which comes first.
    order: &'static [&'static str],
}

impl WrongAnswers {
    /// What is wrong where this machine is what is expected, `late` steps late.
    pub(super) fn find(machine: &Machine, scenario: &Scenario, replies: &[Reply], late: usize) -> Self {
        let mut wrong = Self::default();
        if !replies.iter().take(late).all(Reply::is_initial) {
            wrong.loses_the_state = true;
            return wrong;
        }
        let shown = scenario.run(machine).zip(&scenario.steps);
        for (((_, outputs), step), reply) in shown.zip(replies.iter().skip(late)) {
            let different = match reply {
                Reply::Answer(answer) => {
                    let expected = Shown::of(machine.edition(), &outputs, &step.inputs);
                    let keys: Vec<_> = answer.differences(&expected).map(|one| one.key).collect();
                    Keys::of(&keys)
                }
                // Not even the state is shown.
                Reply::Nothing => Keys::of(&[STATE]),
            };
            if different.has(STATE) {
                wrong.loses_the_state = true;
                wrong.state = Some(why(machine, &outputs, reply));
                wrong.order = reply.state().map_or(&[], |state| overtaken(machine, &outputs, state));
                return wrong;
            }
            if !different.is_empty() {
                wrong.keys.push((outputs.state, different));
            }
        }
        wrong
    }

    /// Whether nothing is wrong.
    pub(super) fn is_nothing(&self) -> bool {
        self.keys.is_empty() && !self.loses_the_state
    }
}

/// Who is to blame for what.
#[derive(Debug)]
pub(super) struct Blame<'a> {
    edition: Edition,
    /// Each alternative of a row that a test is of, and the requirements of that test.
    rows: Vec<(Row, &'a [String])>,
}

impl<'a> Blame<'a> {
    /// That of a suite, as a machine runs it.
    pub(super) fn of(machine: &Machine, tests: &'a [Test]) -> Self {
        let rows = tests.iter().filter(|test| test.kind == Kind::Row);
        let of = |test: &'a Test| Some((last_row(machine, &test.scenario)?, test.requirements.as_slice()));
        Self { edition: *machine.edition(), rows: rows.filter_map(of).collect() }
    }

    /// The requirements that are broken in a scenario that names these.
    pub(super) fn broken(&self, named: &[String], wrong: &WrongAnswers) -> Vec<String> {
        let mut broken: Vec<String> = Vec::new();
        let mut add = |id: &str| {
            if !broken.iter().any(|other| other == id) {
                broken.push(id.to_owned());
            }
        };
        // It was wrong, and is right when it is asked for again: whatever it was, it is one of these.
        let unknown = wrong.is_nothing();
        let asks_for = |id: &str, state: AsState| only_in(id).is_none_or(|only| only == state);
        let is_broken = |id: &&String| {
            let about = shows(id);
            let by_output = |(state, keys): &(AsState, Keys)| asks_for(id, *state) && about.meets(*keys);
            let by_state = || wrong.order.is_empty() || wrong.order.contains(&id.as_str());
            unknown
                || (wrong.loses_the_state && about.has(STATE) && by_state())
                || wrong.keys.iter().any(by_output)
        };
        named.iter().filter(is_broken).for_each(|id| add(id));
        let counted = || named.iter().filter(|id| !is_of_a_reading(&self.edition, id));
        for (state, keys) in &wrong.keys {
            let is_covered = |key: &str| counted().any(|id| asks_for(id, *state) && shows(id).has(key));
            keys.iter().filter(|key| !is_covered(key)).for_each(|key| add(own(key, *state)));
        }
        if wrong.loses_the_state {
            wrong.order.iter().for_each(|id| add(id));
            if wrong.order.is_empty() && !counted().any(|id| shows(id).has(STATE)) {
                self.of_state(wrong.state.as_ref()).iter().for_each(|id| add(id));
            }
        }
        if unknown && counted().next().is_none() {
            add(STATE_MACHINE);
        }
        broken
    }

    /// The requirements behind a wrong state.
    fn of_state(&self, why: Option<&Why>) -> Vec<&str> {
        // What all tests of a row have in common: one of them may be for something else besides.
        let of_rows = |is_it: &dyn Fn(&Row) -> bool| {
            let tests = || self.rows.iter().filter(|(row, _)| is_it(row)).map(|(_, ids)| *ids);
            let ids = tests().next().unwrap_or_default().iter();
            let ids = ids.filter(|id| shows(id).has(STATE) && !is_of_a_reading(&self.edition, id));
            ids.filter(|id| tests().all(|ids| ids.contains(id))).map(String::as_str).collect::<Vec<_>>()
        };
        let ids = match why {
            Some(Why::NotTaken(row) | Why::Taken(row, _)) => {
                let ids = of_rows(&|other| other == row);
                // An alternative that no test is of: its row.
                if ids.is_empty() { of_rows(&|other| other.place == row.place) } else { ids }
            }
            Some(Why::NoRow(..)) => vec![NO_ARROW],
            _ => Vec::new(),
        };
        if ids.is_empty() { vec![STATE_MACHINE] } else { ids }
    }
}

/// The requirements that say that the row which was due comes before one that held as well, and leads to this state; none where
/// that one did not hold, or where readings decide.
fn overtaken(machine: &Machine, outputs: &Outputs, state: AsState) -> &'static [&'static str] {
    let table = &machine.edition().rules.table;
    let Some(due) = outputs.taken.and_then(|taken| taken.row(table)) else { return &[] };
    let held = machine.arrows(outputs.from).any(|taken| {
        let leads = taken.row(table).is_some_and(|row| row.to == state && row.to != due.to);
        let holds = |term: &Term| term.literals().all(|(atom, on)| outputs.atoms.has(atom) == on);
        leads && taken.term(table).is_some_and(holds)
    });
    let order = due.cites.order;
    let decided = order.iter().any(|id| is_of_a_reading(machine.edition(), id));
    if held && !decided { order } else { &[] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::suite;

    const NOBODY: Blame<'_> = Blame { edition: Edition::V3_0, rows: Vec::new() };

    fn broken(named: &[&str], wrong: &WrongAnswers) -> Vec<String> {
        let named: Vec<String> = named.iter().map(ToString::to_string).collect();
        NOBODY.broken(&named, wrong)
    }

    #[test]
    fn some_requirements_are_about_one_state_only() {
        for (id, key, only) in [
            ("D-42", "hyd_press_f", AsState::Off),
            ("DRV-2", "direction", AsState::Ready),
            ("DRV-3", "steer", AsState::Ready),
            ("MSG-18", "front_axle_trq", AsState::Driving),
            ("MSG-25", "steer", AsState::Driving),
            ("D-43", "hyd_press_r", AsState::EmergencyBrake),
            ("FIN-5", "direction", AsState::Finished),
            ("FIN-6", "steer", AsState::Finished),
        ] {
            for state in AsState::ALL {
                let wrong = WrongAnswers { keys: vec![(state, Keys::of(&[key]))], ..WrongAnswers::default() };
                let expected = if state == only { id } else { own(key, state) };
                assert_eq!(broken(&[id], &wrong), [expected], "{key} in {state}");
            }
        }
    }

    /// A program that answers otherwise when it is asked again.
    #[test]
    fn what_is_not_found_again_may_be_any_of_what_was_asked_for() {
        let found_again = WrongAnswers::default();
        assert!(found_again.is_nothing());
        assert_eq!(broken(&["HS-1", "D-43"], &found_again), ["HS-1", "D-43"]);
        assert_eq!(broken(&[], &found_again), [STATE_MACHINE]);
        let lost = WrongAnswers { loses_the_state: true, ..WrongAnswers::default() };
        assert!(!lost.is_nothing());
        assert_eq!(broken(&["HS-1"], &lost), [STATE_MACHINE]);
        let output =
            WrongAnswers { keys: vec![(AsState::Off, Keys::of(&["handshake"]))], ..WrongAnswers::default() };
        assert!(!output.is_nothing());
        assert_eq!(broken(&["HS-1", "D-43"], &output), ["HS-1"]);
    }

    /// Alternatives of one row have requirements of their own.
    #[test]
    fn a_random_scenario_breaks_what_the_test_of_the_alternative_is_about() {
        let tests = suite::generate(Edition::DEFAULT);
        let blame = Blame::of(&Machine::REFERENCE, &tests);
        let (mut of_their_own, mut shared) = (0, 0);
        for (row, ids) in &blame.rows {
            let lost =
                |why| WrongAnswers { loses_the_state: true, state: Some(why), ..WrongAnswers::default() };
            let not_taken = blame.broken(&[], &lost(Why::NotTaken(row.clone())));
            let about_the_state = |id: &&String| shows(id).has(STATE) && !is_of_a_reading(&Edition::V3_0, id);
            let mut expected: Vec<String> = ids.iter().filter(about_the_state).cloned().collect();
            if expected.is_empty() {
                expected.push(STATE_MACHINE.to_owned());
            }
            assert_eq!(not_taken, expected, "{row}: {ids:?}");
            assert_eq!(not_taken, blame.broken(&[], &lost(Why::Taken(row.clone(), Vec::new()))));
            // A table in which the row has an alternative more: what all of them have in common, if anything.
            let more = Row { guard: vec!["something else".to_owned()], ..row.clone() };
            let in_common = blame.broken(&[], &lost(Why::NotTaken(more)));
            let nothing = in_common == [STATE_MACHINE];
            assert!(nothing || in_common.iter().all(|id| not_taken.contains(id)), "{row}: {in_common:?}");
            of_their_own += usize::from(in_common.len() < not_taken.len());
            shared += usize::from(!nothing);
        }
        assert!(of_their_own > 5 && shared > 5, "{of_their_own}, {shared}");
    }
}
