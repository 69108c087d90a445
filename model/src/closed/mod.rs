//! The closed model: the VCU together with those it works with, each acting one change at a time.
//!
//! ```text
//! Operator --switches--> VCU --drives, brakes--> Vehicle
//!                       |   ^
//!            520h, 521h v   | 510h to 514h            (frames that wait on the bus)
//!                    AI Computer
//! ```
//!
//! The VCU is the specification's [`Machine`], stepped every [`Timing::cycle_ms`]. The AI Computer is the reference one, a small
//! program that follows the document ([`adsdv_ai`]). They know of each other only what real frames say, encoded and decoded by
//! the specification's codec, which arrive one by one and late ([`bus`]).
//!
//! # What a conforming AI Computer is assumed to do
//!
//! Whatever can happen between two steps of the VCU may happen in any order, and may be put off past its next steps, within
//! these limits, which forbid the step that would exceed them:
//!
//! - A frame waits on the bus for less than two cycles. One that waits is replaced by a newer one with its identifier, as in
//!   a controller with one mailbox for each. A frame that tells its receiver nothing new is not shown.
//! - From the step at which the VCU changes its HANDSHAKE bit to the arrival of the answer less than
//!   [`Timing::handshake_ms`] pass (HS-9): at most [`Closed::response_cycles`] steps without the answer, which makes 40 ms
//!   of the 50 of version 3.0, and 90 of the 100 of version 4.0. This includes the bus, both ways. While the handshake rests, everything else that the VCU says is answered
//!   within as many steps.
//!
//! The limit is that of the document, not of the machine that is checked: a machine with less patience is found out.
//!
//! It sends all of its messages in every cycle. As each waits for less than two cycles, none is ever missed: what an edition
//! says of missed messages is in the open model.
//!
//! # What the vehicle is assumed to do
//!
//! It moves only when it is driven, stops when it is braked, and its wheels are straight. The one fault is the remote E-stop
//! button, which opens the shutdown circuit as every other cause does. Vehicles that roll and wheels that are turned are in
//! the open model.
//!
//! # The operators
//!
//! [`Operator::Any`] moves any switch at any time. [`Operator::WellBehaved`] follows sections 3.1 to 3.4 ([`operator`]), and
//! dawdles for at most [`DAWDLE_CYCLES`] before each act, as do the AI Computer before it decides to stop and the vehicle
//! before it slows down when it brakes. So time runs out on every path, and the graph has no cycles.
//!
//! A run ends in AS_OFF when the mission is over, or after an emergency.
//!
//! # Why "eventually" can be trusted here
//!
//! The checker's `eventually` looks at the ends of paths only. It misses paths that end in a cycle, and, where paths join,
//! forgets on which of them the condition held. So the graph is acyclic: every action raises the state's [`Rank`], which the
//! property `every-action-moves-on` checks. And the condition is latched in the state ([`Mission`]): once it holds it holds
//! to the end, so that the end tells the truth about every path to it.
//!
//! # Scaled timers
//!
//! [`Closed::scaled`] shortens the dwell to [`dwell_cycles`] and the EBS timer to [`EBS_CYCLES`] steps; the handshake keeps
//! its real time. It rests on a lemma: *while a timer runs, a step depends on it only through whether it has elapsed*. What
//! the others do meanwhile is not bounded by the timer. The scaled dwell is longer than an answer may take, so that
//! whatever is going on when AS_READY is entered can end before it elapses, or still go on then. In EMERGENCY_BRAKE only
//! the handshake still counts of what the AI Computer says, and it lasts past the timer for as long as ASMS is on.
//!
//! With a well-behaved operator the real times are explored as well, in less than a second: [`Closed::new`].

pub mod action;
pub mod ai;
pub mod bus;
mod family;
mod figure;
mod meaning;
pub mod operator;
mod properties;
mod real_time;
mod sequence;
mod state;
mod svg;
mod switches;
mod time;
mod words;

use std::sync::Arc;
use std::sync::atomic::AtomicUsize;

use adsdv_spec::messages::{AsState, DirectionRequest, Frame, ShutdownCause};
use adsdv_spec::{AiMessages, Control, Edition, Inputs, Machine, Outputs, Readings, Timing};
use stateright::{Model, Path, Property};

use crate::document::Document;

/// Whether a property is to hold always, in the end, or once.
pub use stateright::Expectation;

pub use crate::search::MEMBERS;
pub use action::{Act, ClosedAction};
pub use adsdv_ai::{AiComputer, Stage};
pub use ai::Conduct;
pub use bus::{Bus, WaitingFrames};
pub use family::{FamilyExploration, explore_family};
pub use properties::{CLOSED_PROPERTIES, ClosedExploration, ClosedProperty, EXHAUSTIVE, Found};
pub use state::{ClosedState, Mission, Motion, Rank, Wheels};
pub use switches::{Operator, Switches};

/// For how many steps of the VCU a well-behaved operator may put an act off.
pub const DAWDLE_CYCLES: u16 = 2;

/// How many steps of the VCU the EBS timer takes when it is scaled.
pub const EBS_CYCLES: u16 = 2;

/// The closed model.
#[derive(Clone, Debug)]
pub struct Closed {
    /// The VCU.
    pub machine: Machine,
    /// The times that the AI Computer and the operator go by: the document's, whatever the VCU's are.
    pub timing: Timing,
    /// The document that the AI Computer follows: that of the machine's version.
    document: &'static Document,
    /// Who moves the switches.
    pub operator: Operator,
    /// Whether the remote E-stop button is pressed and released at any time.
    pub faults: bool,
    /// How the AI Computer behaves.
    pub conduct: Conduct,
    /// Whether [`ClosedAction::TimePasses`] is offered: for people, who do not want to click through 500 cycles.
    pub skips_time: bool,
    /// How many states an exploration has looked at.
    looked_at: Arc<AtomicUsize>,
}

impl Closed {
    /// A machine with a conforming AI Computer. Any operator comes with faults, a well-behaved one without.
    pub fn new(machine: Machine, operator: Operator) -> Self {
        let document = Document::of_machine(&machine);
        Self {
            machine,
            timing: *document.timing(),
            document,
            operator,
            faults: matches!(operator, Operator::Any),
            conduct: Conduct::Reference,
            skips_time: false,
            looked_at: Arc::default(),
        }
    }

    /// The same with the dwell and the EBS timer scaled down, for the machine and for those who go by it.
    ///
    /// ```
    /// use adsdv_model::closed::{Closed, Operator, dwell_cycles};
    /// use adsdv_spec::Edition;
    ///
    /// for edition in Edition::ALL {
    ///     let model = Closed::scaled(**edition, edition.readings, Operator::WellBehaved);
    ///     assert_eq!(model.timing.ready_dwell_ms, dwell_cycles(&model.timing) * model.timing.cycle_ms);
    ///     assert_eq!(model.timing.handshake_ms, edition.rules.timing.handshake_ms);
    /// }
    /// ```
    pub fn scaled(edition: Edition, readings: Readings, operator: Operator) -> Self {
        let document = Document::of(&edition).timing();
        let short = |timing: &Timing| Timing {
            ready_dwell_ms: dwell_cycles(document) * document.cycle_ms,
            ebs_timer_ms: EBS_CYCLES * document.cycle_ms,
            ..*timing
        };
        let machine = Machine::new(edition.with_timing(short(&edition.rules.timing)), readings);
        Self { timing: short(document), ..Self::new(machine, operator) }
    }

    /// The model for people: real times, any operator, faults, and a way to let time pass.
    pub fn explorer(machine: Machine) -> Self {
        Self { skips_time: true, ..Self::new(machine, Operator::Any) }
    }

    /// The same with another AI Computer.
    #[must_use]
    pub fn with_conduct(self, conduct: Conduct) -> Self {
        Self { conduct, ..self }
    }

    /// What the VCU sees in each of its cycles along a run.
    pub fn inputs(run: &Path<ClosedState, ClosedAction>) -> Vec<Inputs> {
        let run = run.clone().into_vec();
        let cycles = run.iter().filter(|(_, action)| *action == Some(ClosedAction::VcuCycle));
        cycles.map(|(state, _)| state.inputs()).collect()
    }

    /// For how many steps of the VCU an answer of a conforming AI Computer may be missing: the next one would be
    /// [`Timing::handshake_ms`] after the edge.
    pub const fn response_cycles(&self) -> u16 {
        answer_cycles(&self.timing).saturating_sub(1)
    }

    /// Whether an emergency has brought the run to its end: the vehicle cannot be driven before a power cycle (ETO-3), of
    /// which the model has none, and what else a reading may allow after it changes nothing that the properties look at.
    /// People may still want to look around then.
    fn is_shut_down(&self, state: &ClosedState) -> bool {
        state.control.shutdown_cause != ShutdownCause::NoShutdown && !self.skips_time
    }

    /// Whether nothing more can come of the run.
    fn is_over(&self, state: &ClosedState) -> bool {
        let off = state.control.state == AsState::Off;
        //= ETO-4
        state.mission == Mission::Over || off && self.is_shut_down(state)
    }

    /// What the VCU does in its next cycle.
    fn step(&self, state: &ClosedState) -> (Control, Outputs, Inputs) {
        let inputs = state.inputs();
        let cycle = u32::from(self.timing.cycle_ms);
        let (control, outputs) = self.machine.step(&state.control, &inputs, cycle);
        (control, outputs, inputs)
    }

    /// Whether the AI Computer has answered what the VCU says: its HANDSHAKE bit, or, while the handshake rests, all.
    fn answered(&self, state: &ClosedState) -> bool {
        let handshake = state.control.handshake;
        if handshake.active {
            state.received.status.handshake == handshake.bit
        } else {
            state.bus.to_ai.is_empty() && state.bus.to_vcu.is_empty() && !self.ai_has_news(state)
        }
    }

    /// Whether the AI Computer's next cycle changes anything.
    fn ai_has_news(&self, state: &ClosedState) -> bool {
        ai::cycle(state.ai, self.conduct) != state.ai
    }

    /// Whether the VCU's cycle may end now, with all others as late as they are.
    fn may_step(&self, state: &ClosedState) -> bool {
        let in_time = self.conduct == Conduct::Mute
            || self.answered(state)
            || u16::from(state.late_cycles) < self.response_cycles();
        in_time && !state.bus.to_ai.is_overdue() && !state.bus.to_vcu.is_overdue() && self.has_patience(state)
    }

    fn vcu_cycle(&self, state: &mut ClosedState) {
        let answered = self.answered(state);
        let (control, outputs, inputs) = self.step(state);
        let edge = control.handshake.bit != state.control.handshake.bit;
        state.late_cycles = if answered || edge || self.conduct == Conduct::Mute {
            0
        } else {
            state.late_cycles.saturating_add(1)
        };
        state.bus.to_ai.a_cycle_ends();
        state.bus.to_vcu.a_cycle_ends();
        state.control = control;
        state.rested = self.operator == Operator::WellBehaved;
        state.acted = false;
        if self.is_shut_down(state) {
            // Nothing reads these switches any more: how they stand makes no difference.
            state.switches = Switches { ebs_armed: false, go: false, ..state.switches };
        }
        let messages = outputs.messages(&inputs);
        let heard = state.ai.heard;
        let is_news = |frame: &Frame| heard.with(frame, self.document.edition) != heard;
        state.bus.to_ai.send(ai::listens_to(&messages, self.bus()), is_news);
        let actuation = outputs.actuation(&inputs);
        let pressed =
            [actuation.hyd_press_f, actuation.hyd_press_r].iter().any(|pressure| pressure.raw() > 0);
        let torque = actuation.front_axle_trq.raw() > 0 || actuation.rear_axle_trq.raw() > 0;
        state.motion.braked = pressed || actuation.ebs_triggered;
        state.motion.driven =
            torque && !state.motion.braked && actuation.direction == DirectionRequest::Forward;
        if self.operator == Operator::WellBehaved {
            state.mission = state.mission.after(control.state);
        }
    }

    /// The state after an action, where that is possible.
    fn after(&self, before: &ClosedState, action: ClosedAction) -> Option<ClosedState> {
        let mut state = before.clone();
        match action {
            ClosedAction::VcuCycle => self.vcu_cycle(&mut state),
            ClosedAction::AiCycle => {
                state.ai = ai::cycle(state.ai, self.conduct);
                self.ai_sends(&mut state);
            }
            ClosedAction::FrameToAi => {
                state.ai.heard = state.ai.heard.with(&state.bus.to_ai.next()?, self.document.edition);
            }
            ClosedAction::FrameToVcu => {
                state.received = self.received(&state.received, &state.bus.to_vcu.next()?);
            }
            ClosedAction::AiDecidesToStop => {
                state.ai = ai::decides_to_stop(state.ai);
                self.ai_sends(&mut state);
            }
            ClosedAction::Operator(act) => {
                state.switches.turn(act);
                match self.operator {
                    Operator::WellBehaved => {
                        state.acts = state.acts.saturating_add(1);
                        state.rested = false;
                    }
                    Operator::Any => state.acted = !self.skips_time,
                }
            }
            ClosedAction::RemoteEstop(pressed) => {
                state.remote_estop = pressed;
                state.acted = !self.skips_time;
            }
            ClosedAction::Faster => state.motion.wheels = state.motion.wheels.faster()?,
            ClosedAction::Slower => state.motion.wheels = state.motion.wheels.slower()?,
            ClosedAction::TimePasses => (state, _) = self.time_passes(before),
        }
        self.count_patience(before, action, &mut state);
        Some(state)
    }

    /// What the edition has on the bus.
    const fn bus(&self) -> &adsdv_spec::Bus {
        &self.machine.edition().bus
    }

    fn ai_sends(&self, state: &mut ClosedState) {
        let received = state.received;
        let is_news = |frame: &Frame| self.received(&received, frame) != received;
        state.bus.to_vcu.send(ai::frames(state.ai, self.bus()), is_news);
    }

    /// What the VCU has received, after one more frame.
    fn received(&self, before: &AiMessages, frame: &Frame) -> AiMessages {
        let mut after = *before;
        // A frame that does not decode changes nothing (D-20).
        let _ = after.receive(self.bus(), frame.id, frame.data());
        after
    }
}

/// For how many steps of the VCU an edge of its HANDSHAKE bit may be unanswered before that is a fault.
const fn answer_cycles(timing: &Timing) -> u16 {
    match timing.handshake_ms.checked_div(timing.cycle_ms) {
        Some(cycles) => cycles,
        None => 0,
    }
}

/// How many steps of the VCU the dwell takes when it is scaled, with the document's times: one more than an answer may.
pub const fn dwell_cycles(document: &Timing) -> u16 {
    answer_cycles(document) + 1
}

impl Model for Closed {
    type State = ClosedState;
    type Action = ClosedAction;

    fn init_states(&self) -> Vec<ClosedState> {
        // The "Go" switch may be found on (DRV-13).
        let found = |go| ClosedState {
            switches: Switches { go, ..Switches::default() },
            document: self.document,
            ..ClosedState::default()
        };
        match self.operator {
            Operator::WellBehaved => vec![found(false), found(true)],
            Operator::Any => vec![found(false)],
        }
    }

    fn actions(&self, state: &ClosedState, actions: &mut Vec<ClosedAction>) {
        if self.is_over(state) {
            return;
        }
        if self.skips_time {
            actions.push(ClosedAction::TimePasses);
        }
        self.acts(state, actions);
        if state.acted {
            // What comes before the VCU's cycle could as well have come before the act, which only the VCU sees.
            if self.may_step(state) {
                actions.push(ClosedAction::VcuCycle);
            }
            return;
        }
        if ai::may_decide_to_stop(state.ai) {
            actions.push(ClosedAction::AiDecidesToStop);
        }
        if state.motion.driven && state.motion.wheels.faster().is_some() {
            actions.push(ClosedAction::Faster);
        }
        if state.motion.must_slow_down() {
            actions.push(ClosedAction::Slower);
        }
        if !state.bus.to_ai.is_empty() {
            actions.push(ClosedAction::FrameToAi);
        }
        if self.ai_has_news(state) {
            actions.push(ClosedAction::AiCycle);
        }
        if !state.bus.to_vcu.is_empty() {
            actions.push(ClosedAction::FrameToVcu);
        }
        if self.may_step(state) {
            actions.push(ClosedAction::VcuCycle);
        }
    }

    fn next_state(&self, last_state: &ClosedState, action: ClosedAction) -> Option<ClosedState> {
        self.after(last_state, action)
    }

    fn format_action(&self, action: &ClosedAction) -> String {
        action.to_string()
    }

    fn format_step(&self, last_state: &ClosedState, action: ClosedAction) -> Option<String> {
        self.after(last_state, action).map(|state| words::step(self, last_state, action, &state))
    }

    fn as_svg(&self, path: Path<ClosedState, ClosedAction>) -> Option<String> {
        Some(svg::draw(&self.machine, &sequence::of(self, &path.into_vec())))
    }

    fn properties(&self) -> Vec<Property<Self>> {
        properties::of(self)
    }
}
