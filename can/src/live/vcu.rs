//! The virtual VCU: the car on a bus.

use adsdv_oracle::judge::Meter;
use adsdv_spec::messages::{Ai2VcuStatus, AsState, Frame, Node};

use super::handle::Runner;
use super::line::LiveBus;
use super::note::{Note, REPORT_EVERY_MS};
use super::partner::Partner;
use crate::bus::{Bus, Received};
use crate::car::{Action, Car, Cycle, missing, missing_for};
use crate::scenario::Player;
use crate::status::{HappeningKind, Status};

/// The car on a bus: one [`turn`](Self::turn) is one cycle of the VCU.
///
/// ```no_run
/// use adsdv_can::live::Vcu;
///
/// let bus = adsdv_can::socket::open("vcan0")?;
/// let mut vcu = Vcu::new(bus, adsdv_spec::Machine::REFERENCE, None);
/// loop {
///     vcu.turn();
///     println!("{} frames sent", vcu.status().sent);
/// }
/// # #[allow(unreachable_code)]
/// # Ok::<(), adsdv_can::socket::OpenError>(())
/// ```
#[derive(Debug)]
pub struct Vcu<B> {
    line: LiveBus<B>,
    car: Car,
    player: Option<Player>,
    /// For how long the player may wait for a state, in milliseconds; `None` without end.
    patience_ms: Option<u64>,
    meter: Meter,
    partner: Partner,
    /// When the last frame of the AI Computer came, in nanoseconds since the beginning.
    heard_at: Option<i64>,
    /// Since when it is heard without a pause, in nanoseconds since the beginning; `None` while it is silent.
    heard_since: Option<i64>,
    /// Whether the status reported it last as heard, or as silent.
    heard: bool,
    /// Since when the state lasts, in milliseconds since the beginning.
    state_since: u64,
}

impl<B: Bus> Vcu<B> {
    /// A VCU that has just been switched on, with what the operator will do, if it is known.
    pub fn new(bus: B, machine: adsdv_spec::Machine, player: Option<Player>) -> Self {
        let car = Car::new(machine);
        Self {
            line: LiveBus::new(bus, car.machine().edition()),
            partner: Partner::new(Node::Ai, car.machine().edition()),
            car,
            player,
            patience_ms: None,
            meter: Meter::default(),
            heard_at: None,
            heard_since: None,
            heard: false,
            state_since: 0,
        }
    }

    /// The same, with a scenario that is given up when it has waited for a state for so many milliseconds: the VCU then
    /// [is over](Runner::is_over), and its status says why.
    #[must_use]
    pub fn with_patience(self, patience_ms: u64) -> Self {
        Self { patience_ms: Some(patience_ms), ..self }
    }

    /// One cycle: receives until it is due, lets the operator act, makes the step and sends its frames.
    pub fn turn(&mut self) {
        while let Some(frame) = self.line.next_frame() {
            self.hear(&frame);
        }
        let begun = self.line.begin();
        let before = self.car.outputs().map(|outputs| outputs.state);
        self.play(before);
        let cycle = self.car.cycle(begun.dt_ms);
        self.report(&cycle);
        if cycle.state() != before {
            self.changed(before, &cycle);
        }
        self.look_for_ai();
        self.fill();
    }

    /// What the operator does, before the next step.
    pub fn act(&mut self, action: &Action) {
        self.car.act(action);
        self.line.happen(HappeningKind::Did(action.to_string()));
    }

    /// How everything stands after the last turn.
    pub fn status(&self) -> &Status {
        &self.line.status
    }

    fn play(&mut self, state: Option<AsState>) {
        // By the grid of the cycles, so that a scenario takes the same course each time.
        let time_ms = self.line.cycle_time_ms();
        let due = self.player.as_mut().map(|player| player.due(time_ms, state)).unwrap_or_default();
        for action in due {
            self.act(&action);
        }
        if let (Some(player), Some(patience_ms)) = (&self.player, self.patience_ms) {
            self.line.status.stuck =
                player.stuck(time_ms, patience_ms, |state| missing_for(&self.car, state));
        }
    }

    fn hear(&mut self, received: &Received) {
        let Some(frame) = received.frame() else { return };
        self.line.listen(&mut self.partner, &frame);
        match self.car.machine().edition().bus.message(frame.id).map(|message| message.sender) {
            Some(Node::Vcu) => {
                self.line.status.foreign += 1;
                let id = frame.id;
                self.line.note(Note::Foreign, || {
                    HappeningKind::OtherVcu(format!("somebody else sends {id:03X}h, which is the VCU's"))
                });
            }
            Some(Node::Ai) => self.hear_ai(&frame),
            None => {}
        }
    }

    fn hear_ai(&mut self, frame: &Frame) {
        let now = self.line.now_ns();
        self.is_heard(now);
        match self.car.receive(frame) {
            Ok(true) if frame.id == Ai2VcuStatus::ID => {
                let answer = self.car.inputs().ai.status.handshake;
                if let Some(ns) = self.meter.ai(now, answer) {
                    self.line.status.responses.add(ns);
                    self.line.status.last_response_ms = Some(milliseconds(ns));
                }
            }
            Ok(_) => {}
            Err(error) => {
                self.line.status.refused += 1;
                let id = frame.id;
                self.line.note(Note::Refused(id), || HappeningKind::Refused(format!("{id:03X}h: {error}")));
            }
        }
    }

    /// The AI Computer is heard. The status reports one that pauses again and again once as silent, and as heard when it has stopped
    /// doing so.
    fn is_heard(&mut self, now: i64) {
        let paused = self.heard_at.replace(now).map(|before| elapsed_ms(before, now));
        let since = *self.heard_since.get_or_insert(now);
        let long = paused.is_none_or(|paused| paused >= REPORT_EVERY_MS);
        if !self.heard && (long || elapsed_ms(since, now) >= REPORT_EVERY_MS) {
            self.heard = true;
            self.line.happen(HappeningKind::AiHeard);
        }
    }

    /// Sends the frames of a cycle.
    fn report(&mut self, cycle: &Cycle) {
        let all = self.line.send_all(&cycle.frames);
        match &cycle.outputs {
            // An edge that was not sent cannot be answered.
            Some(outputs) if all => self.meter.vcu(self.line.now_ns(), outputs.handshake),
            _ => self.meter.restart(),
        }
    }

    fn changed(&mut self, from: Option<AsState>, cycle: &Cycle) {
        self.state_since = self.line.time_ms();
        let machine = self.car.machine();
        let term = cycle.outputs.as_ref().and_then(|outputs| outputs.term(machine));
        let row = cycle.outputs.as_ref().and_then(|outputs| outputs.row(machine));
        let text = |(atom, value)| machine.edition().rules.text(atom, value).to_string();
        let conditions = term.map(|term| term.literals().map(text).collect());
        let why = conditions.map(|conditions: Vec<String>| conditions.join(", ")).unwrap_or_default();
        let section = row.map_or("", |row| row.section);
        self.line.happen(HappeningKind::State { from, to: cycle.state(), section, why });
    }

    /// Notes that the AI Computer has fallen silent: for longer than an answer may take.
    fn look_for_ai(&mut self) {
        let silent = self.ai_silent_ms();
        let limit = self.car.machine().edition().rules.timing.handshake_ms.into();
        if silent.is_some_and(|silent| silent > limit) {
            self.heard_since = None;
            if std::mem::replace(&mut self.heard, false) {
                self.line.happen(HappeningKind::AiSilent);
            }
        }
    }

    fn ai_silent_ms(&self) -> Option<u64> {
        let heard_at = self.heard_at?;
        Some(elapsed_ms(heard_at, self.line.now_ns()))
    }

    fn fill(&mut self) {
        let ai_silent_ms = self.ai_silent_ms();
        self.line.end();
        let status = &mut self.line.status;
        status.inputs = *self.car.inputs();
        status.outputs = self.car.outputs().copied();
        status.in_state_ms = status.time_ms.saturating_sub(self.state_since);
        status.missing = missing(&self.car);
        status.ai_silent_ms = ai_silent_ms;
        status.speed_mps = self.car.vehicle().speed_mps();
        status.distance_m = self.car.vehicle().distance_m();
        status.next = self.player.as_ref().and_then(Player::next);
    }
}

impl<B: Bus> Runner for Vcu<B> {
    fn turn(&mut self) {
        Self::turn(self);
    }

    fn act(&mut self, action: &Action) {
        Self::act(self, action);
    }

    fn status(&self) -> &Status {
        Self::status(self)
    }

    fn is_over(&self) -> bool {
        self.line.status.stuck.is_some() || self.player.as_ref().is_some_and(Player::is_over)
    }
}

/// From a time in nanoseconds to another.
fn elapsed_ms(from: i64, to: i64) -> u64 {
    to.saturating_sub(from).max(0).unsigned_abs() / 1_000_000
}

#[expect(clippy::cast_precision_loss, reason = "a duration for display")]
fn milliseconds(ns: i64) -> f64 {
    ns as f64 / 1e6
}
