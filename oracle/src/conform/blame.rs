//! Which requirements wrong answers break.
//!
//! - An output that is wrong breaks those requirements of the test that are about it, and if none is, the one that the output
//!   itself is. What is right breaks nothing, whatever else is wrong in the same test.
//! - Where the state goes wrong only the state counts, there and in all that follows: a VCU in another state has other outputs.
//!   What these would have checked is not checked by that test.
//! - A wrong state of which no requirement of the test is, as in a random scenario, breaks those of the tests of the row of
//!   Figure 2 that was not taken, or was.

use adsdv_spec::{AsState, Machine};

use super::about::{NO_ARROW, STATE_MACHINE, only_in, own, shows};
use super::broken::{Row, Why, last_row, why};
use super::keys::Keys;
use super::vcu::Reply;
use crate::protocol::Shown;
use crate::suite::{Kind, Scenario, Test, is_of_a_reading};

/// The key of the state.
const STATE: &str = "as_state";

/// What is wrong in the answers to a scenario, for as long as the state is right.
#[derive(Clone, Debug, Default)]
pub(super) struct Wrong {
    /// The outputs that are wrong before the state is, by the state in which they are.
    keys: Vec<(AsState, Keys)>,
    /// Whether the state is wrong at last.
    pub(super) loses_the_state: bool,
    /// What a wrong state has to do with Figure 2.
    state: Option<Why>,
}

impl Wrong {
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
                    let expected = Shown::of(&outputs, &step.inputs);
                    let keys: Vec<_> = answer.differences(&expected).map(|one| one.key).collect();
                    Keys::of(&keys)
                }
                // Not even the state is shown.
                Reply::Nothing => Keys::of(&[STATE]),
            };
            if different.has(STATE) {
                wrong.loses_the_state = true;
                wrong.state = Some(why(machine, &outputs, reply));
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
    /// Each alternative of a row that a test is of, and the requirements of that test.
    rows: Vec<(Row, &'a [String])>,
}

impl<'a> Blame<'a> {
    /// That of a suite, as a machine runs it.
    pub(super) fn of(machine: &Machine, tests: &'a [Test]) -> Self {
        let rows = tests.iter().filter(|test| test.kind == Kind::Row);
        let of = |test: &'a Test| Some((last_row(machine, &test.scenario)?, test.requirements.as_slice()));
        Self { rows: rows.filter_map(of).collect() }
    }

    /// The requirements that are broken in a scenario that names these.
    pub(super) fn broken(&self, named: &[String], wrong: &Wrong) -> Vec<String> {
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
            let about = Keys::of(shows(id));
            let by_output = |(state, keys): &(AsState, Keys)| asks_for(id, *state) && about.meets(*keys);
            unknown || (wrong.loses_the_state && about.has(STATE)) || wrong.keys.iter().any(by_output)
        };
        named.iter().filter(is_broken).for_each(|id| add(id));
        let counted = || named.iter().filter(|id| !is_of_a_reading(id));
        for (state, keys) in &wrong.keys {
            let is_told = |key: &str| counted().any(|id| asks_for(id, *state) && shows(id).contains(&key));
            keys.iter().filter(|key| !is_told(key)).for_each(|key| add(own(key)));
        }
        if wrong.loses_the_state && !counted().any(|id| shows(id).contains(&STATE)) {
            self.of_state(wrong.state.as_ref()).iter().for_each(|id| add(id));
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
            let ids = ids.filter(|id| shows(id).contains(&STATE) && !is_of_a_reading(id));
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
