//! The virtual car: the VCU, the AI Computer and the vehicle on a bus, judged while they drive.

use std::fmt::Write as _;

use adsdv_can::ai::{Ai, Plan};
use adsdv_can::car::{Action, Missing, Switch, missing};
use adsdv_can::demo::{Bench, DemoOptions, Due, Slip, record};
use adsdv_can::scenario::{Player, Scenario};
use adsdv_oracle::candump::write_record;
use adsdv_oracle::judge::{JudgeOptions, Transition};
use adsdv_oracle::log::{LogJudge, LogOptions};
use adsdv_report::asked::agree;
use adsdv_report::json::{FindingJson, seconds};
use adsdv_spec::messages::{AsState, Frame};
use adsdv_spec::{Atom, Edition, Machine, Readings};
use serde::Serialize;
use serde_json::Value;

use crate::error::Refusal;
use crate::figure::FigureJson;
use crate::subject;

/// No more time goes on at once, in milliseconds: a page that was not looked at does not catch up.
const MOST_MS: u32 = 1000;
/// So many frames are kept for the log: half an hour.
const KEPT: usize = 2_500_000;

/// A drive.
#[derive(Debug)]
pub(crate) struct Drive {
    bench: Bench,
    edition: &'static Edition,
    player: Option<Player>,
    judge: LogJudge,
    slips: Vec<Slip>,
    state: Option<AsState>,
    /// Since when, in milliseconds.
    since_ms: u64,
    /// To what time it was to run, in nanoseconds.
    until_ns: i64,
    frames: Vec<(i64, Frame)>,
    did: Vec<(u64, String)>,
}

/// A drive that begins.
#[derive(Serialize)]
pub(crate) struct BegunJson {
    edition: &'static str,
    figure: FigureJson,
    messages: Value,
}

/// How a drive goes on.
#[derive(Serialize)]
pub(crate) struct RunJson {
    t: f64,
    /// `None` without power.
    state: Option<&'static str>,
    in_state: f64,
    go_signal: bool,
    faults: Vec<&'static str>,
    shutdown_cause: &'static str,
    speed_mps: f64,
    distance_m: f64,
    steer_deg: f64,
    switches: Vec<(&'static str, String)>,
    slips: Vec<&'static str>,
    /// What of the next arrow is missing.
    missing: Option<MissingJson>,
    /// Conditions of Figure 2 that hold.
    holds: Vec<&'static str>,
    /// What the scenario does next.
    next: Option<String>,
    frames: Vec<(f64, u16, String)>,
    kept: usize,
    full: bool,
    did: Vec<(f64, String)>,
    transitions: Vec<ChangeJson>,
    findings: Vec<Value>,
}

#[derive(Serialize)]
struct MissingJson {
    to: &'static str,
    section: &'static str,
    conditions: Vec<(String, Option<String>)>,
    then: Option<(String, Option<String>)>,
}

#[derive(Serialize)]
pub(crate) struct ChangeJson {
    t: f64,
    from: &'static str,
    to: &'static str,
    section: &'static str,
    justified: &'static str,
}

impl BegunJson {
    pub(crate) fn of(machine: &Machine, edition: &'static Edition) -> Self {
        let messages = adsdv_report::catalog(edition);
        Self { edition: edition.version, figure: FigureJson::of(machine), messages }
    }
}

impl Drive {
    pub(crate) fn begin(
        edition: Option<&str>,
        readings: &[String],
        scenario: Option<&str>,
    ) -> Result<Self, Refusal> {
        let edition = subject::edition(edition)?.unwrap_or(Edition::DEFAULT);
        let pins = subject::readings(readings)?;
        agree(edition, &pins).map_err(|error| Refusal::pin(&error))?;
        let machine = Machine::new(*edition, pins.into_iter().fold(edition.readings, Readings::with));
        let scenario = scenario.map(str::parse::<Scenario>).transpose();
        let scenario = scenario
            .map_err(|error| Refusal::new("the scenario", error.to_string(), "write it otherwise"))?;
        let options = LogOptions { judge: JudgeOptions::of(edition), ..LogOptions::default() };
        Ok(Self {
            bench: Bench::new(machine, Ai::new(edition, Plan::DEFAULT), DemoOptions::default().phase_ms),
            edition,
            player: scenario.as_ref().map(Player::new),
            judge: LogJudge::new(options),
            slips: Vec::new(),
            state: None,
            since_ms: 0,
            until_ns: 0,
            frames: Vec::new(),
            did: Vec::new(),
        })
    }

    pub(crate) fn begun(&self) -> BegunJson {
        BegunJson::of(self.bench.car().machine(), self.edition)
    }

    pub(crate) fn act(&mut self, action: &str) -> Result<(), Refusal> {
        let action: Action = action.parse().map_err(|error| Refusal::of_request(format!("{error}")))?;
        self.bench.car_mut().act(&action);
        self.did.push((self.time_ms(), action.to_string()));
        Ok(())
    }

    pub(crate) fn slip_named(&mut self, id: &str, on: bool) -> Result<(), Refusal> {
        let slip = Slip::ALL.into_iter().find(|slip| slip.id() == id);
        let slip = slip.ok_or_else(|| Refusal::of_request(format!("there is no mistake {id:?}")))?;
        self.slip(slip, on);
        let ends = if on { "" } else { " no longer" };
        self.did.push((self.time_ms(), format!("the AI Computer{ends} {}", slip.about())));
        Ok(())
    }

    /// The AI Computer makes a mistake, or no longer does.
    pub(crate) fn slip(&mut self, slip: Slip, on: bool) {
        self.slips.retain(|other| *other != slip);
        if on {
            self.slips.push(slip);
        }
        self.bench.slips(&self.slips);
    }

    pub(crate) fn time_ms(&self) -> u64 {
        self.bench.time_ms()
    }

    pub(crate) const fn state(&self) -> Option<AsState> {
        self.state
    }

    pub(crate) fn in_state_ms(&self) -> u64 {
        self.time_ms().saturating_sub(self.since_ms)
    }

    /// The scenario has nothing left to do.
    pub(crate) fn is_done(&self) -> bool {
        self.player.as_ref().is_some_and(Player::is_done)
    }

    /// The scenario has ended.
    pub(crate) fn is_over(&self) -> bool {
        self.player.as_ref().is_some_and(Player::is_over)
    }

    /// Goes on.
    pub(crate) fn run(&mut self, ms: u32) -> RunJson {
        let first = self.frames.len();
        self.until_ns += i64::from(ms.min(MOST_MS)) * 1_000_000;
        loop {
            match self.bench.advance() {
                Due::Frame(t_ns, frame) => self.heard(t_ns, &frame),
                Due::VcuCycle if self.bench.time_ns() >= self.until_ns => break,
                Due::VcuCycle => self.vcu_cycle(),
            }
        }
        self.judge.time_passes(self.bench.time_ns());
        self.json(first)
    }

    fn vcu_cycle(&mut self) {
        let now = self.time_ms();
        if let Some(player) = &mut self.player {
            for action in player.due(now, self.state) {
                self.bench.car_mut().act(&action);
                self.did.push((now, action.to_string()));
            }
        }
        let state = self.bench.vcu_cycle().state();
        if state != self.state {
            (self.state, self.since_ms) = (state, now);
        }
    }

    fn heard(&mut self, time_ns: i64, frame: &Frame) {
        self.judge.frame(&record(time_ns, frame));
        if self.frames.len() < KEPT {
            self.frames.push((time_ns, *frame));
        }
    }

    /// The log so far, as candump writes it.
    pub(crate) fn log(&self) -> String {
        let mut text = Vec::new();
        for (time_ns, frame) in &self.frames {
            // Memory takes it.
            let _ = write_record(&mut text, &record(*time_ns, frame));
        }
        String::from_utf8_lossy(&text).into_owned()
    }

    fn json(&mut self, first: usize) -> RunJson {
        let (transitions, findings) = self.judge.news();
        let car = self.bench.car();
        let inputs = car.inputs();
        let machine = car.machine();
        let seen = inputs.observe(&machine.edition().rules.thresholds);
        let atoms = machine.react(car.control(), seen, 0).atoms;
        let outputs = car.outputs();
        RunJson {
            t: seconds(self.bench.time_ns()),
            state: self.state.map(AsState::name),
            in_state: milliseconds(self.in_state_ms()),
            go_signal: outputs.is_some_and(|outputs| outputs.go_signal),
            faults: outputs
                .map(|outputs| outputs.faults.iter().map(adsdv_spec::Fault::flag).collect())
                .unwrap_or_default(),
            shutdown_cause: outputs.map_or("", |outputs| outputs.shutdown_cause.name()),
            speed_mps: car.vehicle().speed_mps(),
            distance_m: car.vehicle().distance_m(),
            steer_deg: inputs.vehicle.steer_angle.to_physical(),
            switches: Switch::all()
                .map(|switch| (switch.key(), switch.position(switch.get(inputs))))
                .collect(),
            slips: self.slips.iter().map(|slip| slip.id()).collect(),
            missing: missing(car).as_ref().map(MissingJson::of),
            holds: Atom::ALL.iter().filter(|atom| atoms.has(**atom)).map(|atom| atom.id()).collect(),
            next: self.player.as_ref().and_then(Player::next),
            frames: self.frames.iter().skip(first).map(frame).collect(),
            kept: self.frames.len(),
            full: self.frames.len() >= KEPT,
            did: std::mem::take(&mut self.did)
                .into_iter()
                .map(|(ms, what)| (milliseconds(ms), what))
                .collect(),
            transitions: transitions.iter().map(ChangeJson::of).collect(),
            findings: findings
                .iter()
                .filter_map(|finding| serde_json::to_value(FindingJson::from(finding)).ok())
                .collect(),
        }
    }
}

impl MissingJson {
    fn of(missing: &Missing) -> Self {
        let one = |condition: &adsdv_can::car::Condition| {
            (condition.to_string(), condition.action.map(|action| action.to_string()))
        };
        Self {
            to: missing.to.name(),
            section: missing.section,
            conditions: missing.conditions.iter().map(one).collect(),
            then: missing.then.as_ref().map(one),
        }
    }
}

impl ChangeJson {
    pub(crate) fn of(transition: &Transition) -> Self {
        let Transition { t_ns, from, to, section, justified, .. } = transition;
        Self { t: seconds(*t_ns), from: from.name(), to: to.name(), section, justified: justified.name() }
    }
}

fn frame((time_ns, frame): &(i64, Frame)) -> (f64, u16, String) {
    let mut hex = String::new();
    for byte in frame.data() {
        // Memory takes it.
        let _ = write!(hex, "{byte:02X}");
    }
    (seconds(*time_ns), frame.id, hex)
}

/// Milliseconds as seconds.
#[allow(clippy::cast_precision_loss, reason = "a drive of years has no precision to lose")]
fn milliseconds(ms: u64) -> f64 {
    ms as f64 / 1000.0
}
