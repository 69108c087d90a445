//! A scenario that takes place.

use adsdv_spec::messages::AsState;

use super::{Line, Scenario, Seconds, Stuck, Waiting, When};
use crate::car::{Action, Missing};

/// Plays a scenario: says at each cycle what the operator does.
///
/// ```
/// use adsdv_can::scenario::{Player, Scenario};
/// use adsdv_spec::messages::AsState;
///
/// let scenario: Scenario = "0.5 asms on\nAS_READY +5 go on, end\n".parse()?;
/// let mut player = Player::new(&scenario);
/// assert!(player.due(0, Some(AsState::Off)).is_empty());
/// assert_eq!(player.next().as_deref(), Some("at 0.5 s: asms on"));
/// assert_eq!(player.due(500, Some(AsState::Off))[0].to_string(), "asms on");
/// assert!(player.due(510, Some(AsState::Ready)).is_empty());
/// assert_eq!(player.next().as_deref(), Some("AS_READY for 5 s: go on, end"));
/// assert_eq!(player.due(5510, Some(AsState::Ready))[0].to_string(), "go on");
/// assert!(player.is_over());
/// # Ok::<(), adsdv_can::scenario::Unreadable>(())
/// ```
#[derive(Clone, Debug)]
pub struct Player {
    scenario: Scenario,
    /// How many lines have taken place.
    done: usize,
    /// When the last of them did.
    done_at: u64,
    /// The state that was last seen, and since when.
    state: Option<AsState>,
    since: u64,
    over: bool,
}

impl Player {
    /// At the start.
    pub fn new(scenario: &Scenario) -> Self {
        Self { scenario: scenario.clone(), done: 0, done_at: 0, state: None, since: 0, over: false }
    }

    /// What the operator does now, in the order of the lines. To be asked before each cycle of the VCU.
    ///
    /// `time_ms` is the time since the start, and `state` that of the last cycle; `None` before the first, and while the VCU
    /// is without power.
    pub fn due(&mut self, time_ms: u64, state: Option<AsState>) -> Vec<Action> {
        if self.state != state {
            self.state = state;
            self.since = time_ms;
        }
        let mut actions = Vec::new();
        let mut acted = false;
        while let Some(line) = self.line() {
            let is_due = match line.when {
                When::At(ms) => u64::from(ms) <= time_ms,
                When::After(ms) => self.done_at.saturating_add(ms.into()) <= time_ms,
                // What was done in this cycle has had no effect on the state yet.
                When::State(wanted, ms) => {
                    !acted && state == Some(wanted) && self.since.saturating_add(ms.into()) <= time_ms
                }
            };
            if !is_due {
                break;
            }
            acted = true;
            actions.extend(&line.actions);
            self.over |= line.ends;
            self.done += 1;
            self.done_at = time_ms;
        }
        actions
    }

    /// Whether the scenario has come to its `end`, so that the program stops.
    pub const fn is_over(&self) -> bool {
        self.over
    }

    /// Whether every line has taken place.
    pub fn is_done(&self) -> bool {
        self.line().is_none()
    }

    /// What is done next and when, in words; `None` if every line has taken place.
    pub fn next(&self) -> Option<String> {
        let line = self.line()?;
        let when = match line.when {
            When::At(_) => format!("at {} s", line.when),
            When::After(ms) => {
                format!("at {} s", Seconds(self.done_at.saturating_add(ms.into())))
            }
            When::State(state, 0) => state.to_string(),
            When::State(state, ms) => format!("{state} for {} s", Seconds(ms.into())),
        };
        Some(format!("{when}: {}", line.doings().join(", ")))
    }

    /// The line that waits for a state that is not there, if the next one does.
    pub fn waiting_for(&self) -> Option<Waiting> {
        let line = self.line()?;
        let When::State(wanted, _) = line.when else { return None };
        // The state has been another since the line began to wait, or since it was left.
        let since_ms = self.done_at;
        (self.state != Some(wanted)).then_some(Waiting { line: line.number, state: wanted, since_ms })
    }

    /// Whether it has waited for a state for so long that no patience is left, and for what. All times are in milliseconds, and
    /// `missing` is asked for that state, and only then.
    pub(crate) fn stuck(
        &self,
        time_ms: u64,
        patience_ms: u64,
        missing: impl FnOnce(AsState) -> Option<Missing>,
    ) -> Option<Stuck> {
        let waiting = self.waiting_for()?;
        let waited_ms = time_ms.saturating_sub(waiting.since_ms);
        let missing = || missing(waiting.state);
        (waited_ms >= patience_ms).then(|| Stuck {
            waiting,
            state: self.state,
            waited_ms,
            missing: missing(),
        })
    }

    fn line(&self) -> Option<&Line> {
        self.scenario.lines.get(self.done)
    }
}
