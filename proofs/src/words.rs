//! The document's sections 2.4, 3 and 4 once more, in its own words: plain `if`s over the raw inputs.
//!
//! Nothing of the specification's machinery is used here: no atoms, no table, no thresholds. Every number is written
//! out again, so that a slip in the one is not a slip in the other. Only the types are shared: what goes in
//! ([`Inputs`], [`Control`], [`Readings`]) and the [`Control`] that comes out.
//!
//! To review: hold each function against the section that its comment names. The proofs hold [`Machine::step`] against
//! it for every input; the tests do so on long runs, and with mutants.
//!
//! [`Machine::step`]: adsdv_spec::Machine::step

use adsdv_spec::messages::{
    AmiState, AsState, DirectionRequest, EbsState, MissionStatus, ShutdownCause, Vcu2AiStatus,
};
use adsdv_spec::{Choice, Control, Faults, Handshake, Inputs, Outputs, Readings};

/// An arrow of Figure 2, by the section of the document that describes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrow {
    /// 3.1, AS_OFF to AS_READY.
    OffToReady,
    /// 3.2, AS_READY to AS_DRIVING.
    ReadyToDriving,
    /// 3.3, AS_DRIVING to AS_FINISHED.
    DrivingToFinished,
    /// 3.4, AS_FINISHED to AS_OFF.
    FinishedToOff,
    /// 3.5, AS_READY to EMERGENCY_BRAKE.
    ReadyToEmergencyBrake,
    /// 3.6, AS_READY to AS_OFF.
    ReadyToOff,
    /// 3.7, AS_DRIVING to EMERGENCY_BRAKE.
    DrivingToEmergencyBrake,
    /// 3.8, AS_FINISHED to EMERGENCY_BRAKE.
    FinishedToEmergencyBrake,
    /// 3.9, EMERGENCY_BRAKE to AS_OFF.
    EmergencyBrakeToOff,
}

impl Arrow {
    /// Every arrow, by its section.
    pub const ALL: [Self; 9] = [
        Self::OffToReady,
        Self::ReadyToDriving,
        Self::DrivingToFinished,
        Self::FinishedToOff,
        Self::ReadyToEmergencyBrake,
        Self::ReadyToOff,
        Self::DrivingToEmergencyBrake,
        Self::FinishedToEmergencyBrake,
        Self::EmergencyBrakeToOff,
    ];

    /// The arrow between two states; there is at most one.
    pub const fn between(from: AsState, to: AsState) -> Option<Self> {
        use AsState::{Driving, EmergencyBrake, Finished, Off, Ready};
        match (from, to) {
            (Off, Ready) => Some(Self::OffToReady),
            (Ready, Driving) => Some(Self::ReadyToDriving),
            (Driving, Finished) => Some(Self::DrivingToFinished),
            (Finished, Off) => Some(Self::FinishedToOff),
            (Ready, EmergencyBrake) => Some(Self::ReadyToEmergencyBrake),
            (Ready, Off) => Some(Self::ReadyToOff),
            (Driving, EmergencyBrake) => Some(Self::DrivingToEmergencyBrake),
            (Finished, EmergencyBrake) => Some(Self::FinishedToEmergencyBrake),
            (EmergencyBrake, Off) => Some(Self::EmergencyBrakeToOff),
            _ => None,
        }
    }

    /// The section of the document that describes it.
    pub const fn section(self) -> &'static str {
        match self {
            Self::OffToReady => "3.1",
            Self::ReadyToDriving => "3.2",
            Self::DrivingToFinished => "3.3",
            Self::FinishedToOff => "3.4",
            Self::ReadyToEmergencyBrake => "3.5",
            Self::ReadyToOff => "3.6",
            Self::DrivingToEmergencyBrake => "3.7",
            Self::FinishedToEmergencyBrake => "3.8",
            Self::EmergencyBrakeToOff => "3.9",
        }
    }

    /// The state that it leads to.
    pub const fn to(self) -> AsState {
        match self {
            Self::OffToReady => AsState::Ready,
            Self::ReadyToDriving => AsState::Driving,
            Self::DrivingToFinished => AsState::Finished,
            Self::FinishedToOff | Self::ReadyToOff | Self::EmergencyBrakeToOff => AsState::Off,
            Self::ReadyToEmergencyBrake | Self::DrivingToEmergencyBrake | Self::FinishedToEmergencyBrake => {
                AsState::EmergencyBrake
            }
        }
    }
}

/// What one step of the VCU comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// What the VCU remembers for the next step.
    pub control: Control,
    /// `AS_STATE` after the step.
    pub state: AsState,
    /// The arrow that was taken; `None` if the state stays.
    pub arrow: Option<Arrow>,
    /// The fault flags of 520h.
    pub flags: Flags,
    /// `SHUTDOWN_CAUSE` of 520h.
    pub shutdown_cause: ShutdownCause,
    /// HANDSHAKE of 520h.
    pub handshake: bool,
    /// `GO_SIGNAL` of 520h.
    pub go_signal: bool,
}

impl Verdict {
    /// What a step of the specification came to, in the same terms.
    ///
    /// That a row was taken without an arrow between its states is no arrow at all.
    pub fn of(control: Control, outputs: &Outputs) -> Self {
        let arrow = match outputs.taken {
            Some(_) => Arrow::between(outputs.from, outputs.state),
            None => None,
        };
        Self {
            control,
            state: outputs.state,
            arrow,
            flags: Flags::of(outputs.faults),
            shutdown_cause: outputs.shutdown_cause,
            handshake: outputs.handshake,
            go_signal: outputs.go_signal,
        }
    }
}

/// The fault flags of 520h, each under its name there (section 2.2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Flags {
    /// The AI Computer requests an emergency stop.
    pub ai_estop_request: bool,
    /// The shutdown circuit, or the HVIL, is open.
    pub hvil_open_fault: bool,
    /// The shutdown circuit, or the HVIL, has a short circuit.
    pub hvil_short_fault: bool,
    /// The Emergency Braking System is faulty.
    pub ebs_fault: bool,
    /// The offboard charger is faulty.
    pub offboard_charger_fault: bool,
    /// The AI Computer does not answer the handshake.
    pub ai_comms_lost: bool,
    /// NEUTRAL was requested while the vehicle was moving.
    pub autonomous_braking_fault: bool,
    /// FINISHED was declared while the vehicle was moving.
    pub mission_status_fault: bool,
    /// A master switch is on while the battery is being charged.
    pub charge_procedure_fault: bool,
    /// The battery management system reports a critical fault.
    pub bms_fault: bool,
    /// Torque and hydraulic braking were requested at once.
    pub brake_plausibility_fault: bool,
}

impl Flags {
    /// The flags that 520h shows for these faults.
    pub fn of(faults: Faults) -> Self {
        let mut shown = Vcu2AiStatus::default();
        faults.show(&mut shown);
        Self {
            ai_estop_request: shown.ai_estop_request,
            hvil_open_fault: shown.hvil_open_fault,
            hvil_short_fault: shown.hvil_short_fault,
            ebs_fault: shown.ebs_fault,
            offboard_charger_fault: shown.offboard_charger_fault,
            ai_comms_lost: shown.ai_comms_lost,
            autonomous_braking_fault: shown.autonomous_braking_fault,
            mission_status_fault: shown.mission_status_fault,
            charge_procedure_fault: shown.charge_procedure_fault,
            bms_fault: shown.bms_fault,
            brake_plausibility_fault: shown.brake_plausibility_fault,
        }
    }
}

/// One step in the making: what it starts from, and what the clocks say once `dt` has passed.
#[derive(Clone, Copy, Debug)]
pub struct StepInWords<'a> {
    control: &'a Control,
    inputs: &'a Inputs,
    readings: Readings,
    /// Whether it is the document's version 4.0 that is read, and not 3.0.
    of_4_0: bool,
    /// The handshake after this step.
    handshake: Handshake,
    /// Time spent in `AS_READY` or `EMERGENCY_BRAKE`, this step included.
    in_state_ms: u16,
    ai_comms_lost: bool,
}

/// Section 3: one step of the state machine of Figure 2.
pub fn step(control: &Control, inputs: &Inputs, dt_ms: u32, readings: Readings) -> Verdict {
    verdict(StepInWords::of(control, inputs, dt_ms, readings))
}

/// The same of version 4.0.
pub fn step_of_4_0(control: &Control, inputs: &Inputs, dt_ms: u32, readings: Readings) -> Verdict {
    verdict(StepInWords::of_4_0(control, inputs, dt_ms, readings))
}

/// A step in the words of some document: [`step`], or [`step_of_4_0`].
pub type StepOfDocument = fn(&Control, &Inputs, u32, Readings) -> Verdict;

/// The step in the words of the document that an edition of this version follows; `None` if no words are written for it.
///
/// The vehicle of 2026 has no document of its own: those of that year say that 4.0 stays valid until it is written anew.
pub fn of_version(version: &str) -> Option<StepOfDocument> {
    match version {
        "3.0" => Some(step),
        "4.0" | "2026" => Some(step_of_4_0),
        _ => None,
    }
}

/// What a step comes to.
fn verdict(now: StepInWords<'_>) -> Verdict {
    let StepInWords { control, inputs, readings, handshake, .. } = now;
    let arrow = match control.state {
        AsState::Off => now.leaving_as_off(),
        AsState::Ready => now.leaving_as_ready(),
        AsState::Driving => now.leaving_as_driving(),
        AsState::Finished => now.leaving_as_finished(),
        AsState::EmergencyBrake => now.leaving_emergency_brake(),
    };
    let state = match arrow {
        Some(arrow) => arrow.to(),
        None => control.state,
    };
    let shut_down = state == AsState::EmergencyBrake && arrow.is_some();
    // What did not lead to an emergency, because AS_FINISHED or AS_OFF was read to come first, is no reason for one.
    let reasons = if shut_down { now.reasons() } else { Flags::default() };
    let shutdown_cause = if shut_down && control.shutdown_cause == ShutdownCause::NoShutdown {
        lowest(reasons)
    } else {
        control.shutdown_cause
    };
    let edges_count = readings.is(Choice::FaultEdge) && state == AsState::Driving;
    let ai = &inputs.ai.status;
    let control = Control {
        state,
        in_state_ms: if arrow.is_some() { 0 } else { now.in_state_ms },
        go_seen_low: state == AsState::Ready && now.section_3_2_item_3_seen_low(),
        was_running: edges_count && ai.mission_status == MissionStatus::Running,
        was_forward: edges_count && ai.direction_request == DirectionRequest::Forward,
        handshake,
        power_cycle_needed: control.power_cycle_needed || shut_down && readings.is(Choice::PowerCycleLatched),
        shutdown_cause,
    };
    Verdict {
        control,
        state,
        arrow,
        flags: now.shown(reasons, shutdown_cause),
        shutdown_cause,
        handshake: handshake.bit,
        go_signal: now.go_signal(state),
    }
}

/// Section 2.4: the VCU alternates its bit whenever the AI Computer has followed; 50 ms without that, in 4.0 100 ms, is
/// `AI_COMMS_LOST`.
fn section_2_4(
    before: Handshake,
    inputs: &Inputs,
    dt_ms: u32,
    readings: Readings,
    limit_ms: u16,
) -> Handshake {
    let performed = inputs.tsms || readings.is(Choice::HandshakeAlways);
    if !performed {
        Handshake { active: false, bit: false, unanswered_ms: 0 }
    } else if inputs.ai.status.handshake == before.bit {
        Handshake { active: true, bit: !before.bit, unanswered_ms: 0 }
    } else if before.active {
        Handshake {
            active: true,
            bit: before.bit,
            unanswered_ms: later(before.unanswered_ms, dt_ms, limit_ms),
        }
    } else {
        // It has only begun: nothing has been waited for yet.
        Handshake { active: true, bit: false, unanswered_ms: 0 }
    }
}

/// Section 2.4 of version 4.0: of one of the five messages ten in a row have not come, which are sent every 10 ms.
pub fn missed(inputs: &Inputs) -> bool {
    let silence = &inputs.ai_silence;
    silence.status_silence_ms >= 100
        || silence.drive_f_silence_ms >= 100
        || silence.drive_r_silence_ms >= 100
        || silence.steer_silence_ms >= 100
        || silence.brake_silence_ms >= 100
}

/// Section 4 of version 4.0: torque of either axle and a pressure of either brake are requested at once.
pub fn torque_and_brake(inputs: &Inputs) -> bool {
    let Inputs { ai, .. } = inputs;
    let torque = ai.drive_f.front_axle_trq_request.raw() > 0 || ai.drive_r.rear_axle_trq_request.raw() > 0;
    let brake = ai.brake.hyd_press_f_req.raw() > 0 || ai.brake.hyd_press_r_req.raw() > 0;
    torque && brake
}

/// A clock that stops at its limit.
fn later(clock_ms: u16, dt_ms: u32, limit_ms: u16) -> u16 {
    match u16::try_from(dt_ms) {
        Ok(dt_ms) => clock_ms.saturating_add(dt_ms).min(limit_ms),
        Err(_) => limit_ms,
    }
}

/// The arrows, each state's in the order in which they are tried; two that hold at once are a matter of reading.
impl StepInWords<'_> {
    fn leaving_as_off(&self) -> Option<Arrow> {
        if self.section_3_1() { Some(Arrow::OffToReady) } else { None }
    }

    fn leaving_as_ready(&self) -> Option<Arrow> {
        let off_first = self.readings.is(Choice::ReadyOffFirst);
        if off_first && self.section_3_6() {
            Some(Arrow::ReadyToOff)
        } else if self.section_3_5() {
            Some(Arrow::ReadyToEmergencyBrake)
        } else if self.section_3_6() {
            Some(Arrow::ReadyToOff)
        } else if self.section_3_2() {
            Some(Arrow::ReadyToDriving)
        } else {
            None
        }
    }

    fn leaving_as_driving(&self) -> Option<Arrow> {
        let finished_first = self.readings.is(Choice::DrivingFinishedFirst);
        if finished_first && self.section_3_3() {
            Some(Arrow::DrivingToFinished)
        } else if self.section_3_7() {
            Some(Arrow::DrivingToEmergencyBrake)
        } else if self.section_3_3() {
            Some(Arrow::DrivingToFinished)
        } else {
            None
        }
    }

    fn leaving_as_finished(&self) -> Option<Arrow> {
        let off_first = self.readings.is(Choice::FinishedOffFirst);
        if off_first && self.section_3_4() {
            Some(Arrow::FinishedToOff)
        } else if self.section_3_8() {
            Some(Arrow::FinishedToEmergencyBrake)
        } else if self.section_3_4() {
            Some(Arrow::FinishedToOff)
        } else {
            None
        }
    }

    fn leaving_emergency_brake(&self) -> Option<Arrow> {
        if self.section_3_9() { Some(Arrow::EmergencyBrakeToOff) } else { None }
    }
}

impl<'a> StepInWords<'a> {
    /// The step from a control state with these inputs, `dt_ms` after the last.
    pub fn of(control: &'a Control, inputs: &'a Inputs, dt_ms: u32, readings: Readings) -> Self {
        Self::of_version(control, inputs, dt_ms, readings, false)
    }

    /// The same in version 4.0.
    pub fn of_4_0(control: &'a Control, inputs: &'a Inputs, dt_ms: u32, readings: Readings) -> Self {
        Self::of_version(control, inputs, dt_ms, readings, true)
    }

    fn of_version(
        control: &'a Control,
        inputs: &'a Inputs,
        dt_ms: u32,
        readings: Readings,
        of_4_0: bool,
    ) -> Self {
        let limit_ms = if of_4_0 { 100 } else { 50 };
        let handshake = section_2_4(control.handshake, inputs, dt_ms, readings, limit_ms);
        let watched = handshake.active || readings.is(Choice::WatchAlways);
        Self {
            control,
            inputs,
            readings,
            of_4_0,
            handshake,
            in_state_ms: match control.state {
                AsState::Ready => later(control.in_state_ms, dt_ms, 5000),
                AsState::EmergencyBrake => later(control.in_state_ms, dt_ms, 15000),
                AsState::Off | AsState::Driving | AsState::Finished => 0,
            },
            ai_comms_lost: handshake.unanswered_ms == limit_ms || of_4_0 && watched && missed(inputs),
        }
    }

    /// 3.1, AS_OFF to AS_READY: TSMS on, ASMS on, a mission selected, the EBS armed; and, by 3.9, not after an
    /// emergency that asks for a power cycle.
    pub fn section_3_1(&self) -> bool {
        let on_the_ami = self.inputs.ami != AmiState::NotSelected;
        let confirmed = self.inputs.ai.status.mission_status == MissionStatus::Selected;
        let mission_selected = if self.readings.is(Choice::MissionAmi) {
            on_the_ami
        } else if self.readings.is(Choice::MissionStatusOnly) {
            confirmed
        } else {
            on_the_ami && confirmed
        };
        self.inputs.tsms
            && self.inputs.asms
            && mission_selected
            && self.inputs.ebs == EbsState::Armed
            && !self.control.power_cycle_needed
    }

    /// 3.2, AS_READY to AS_DRIVING: items 1 and 2 hold, and item 3's rising edge of "Go" is there.
    pub fn section_3_2(&self) -> bool {
        let rising_edge = self.inputs.go && self.control.go_seen_low;
        self.section_3_2_items_1_and_2() && rising_edge
    }

    /// 3.2, items 1 and 2: five seconds in AS_READY, no torque and no steering requested, NEUTRAL, wheels straight.
    pub fn section_3_2_items_1_and_2(&self) -> bool {
        let Inputs { ai, vehicle, .. } = self.inputs;
        // In tenths of a degree.
        let steer_angle = vehicle.steer_angle.raw();
        self.in_state_ms >= 5000
            && ai.drive_f.front_axle_trq_request.raw() == 0
            && ai.drive_r.rear_axle_trq_request.raw() == 0
            && ai.steer.steer_request.raw() == 0
            && ai.status.direction_request == DirectionRequest::Neutral
            && -50 < steer_angle
            && steer_angle < 50
    }

    /// 3.2, item 3: "Go" is off, "once the above conditions have been satisfied"; what is switched on from here is an
    /// edge.
    pub fn section_3_2_item_3_seen_low(&self) -> bool {
        let monitored = self.control.state == AsState::Ready && self.section_3_2_items_1_and_2();
        !self.inputs.go && (monitored || self.readings.is(Choice::GoEdgeEnough))
    }

    /// 3.3, AS_DRIVING to AS_FINISHED: the mission is completed and the vehicle at rest.
    pub fn section_3_3(&self) -> bool {
        self.finished() && self.at_rest()
    }

    /// 3.4, AS_FINISHED to AS_OFF: ASMS off.
    pub fn section_3_4(&self) -> bool {
        !self.inputs.asms
    }

    /// 3.5, AS_READY to EMERGENCY_BRAKE: the shutdown circuit is open.
    pub fn section_3_5(&self) -> bool {
        self.emergency_in_every_active_state()
    }

    /// 3.5: what opens the shutdown circuit, with the faults of 520h among what "the VCU detects".
    pub fn section_3_5_sdc_open(&self) -> bool {
        let sdc = &self.inputs.sdc;
        let reports = &self.inputs.reports;
        sdc.remote_estop
            || sdc.res_link_lost
            || sdc.vehicle_estop
            || sdc.crash_sensor
            || sdc.critical_fault
            || sdc.bms_fault && !self.readings.is(Choice::BmsDriving)
            || sdc.mpp_dongle_removed
            || reports.hvil_open
            || reports.hvil_short
            || reports.ebs_fault
            || reports.offboard_charger_fault
            || self.charge_procedure_fault()
    }

    /// 3.6, AS_READY to AS_OFF: ASMS off.
    pub fn section_3_6(&self) -> bool {
        !self.inputs.asms
    }

    /// 3.7, AS_DRIVING to EMERGENCY_BRAKE: any of the criteria.
    pub fn section_3_7(&self) -> bool {
        self.emergency_in_every_active_state()
            || self.inputs.ai.status.estop_request
            || !self.inputs.go
            || !self.inputs.asms
            || self.finished_at_speed()
            || self.neutral_at_speed()
            || self.figure_2_of_4_0()
    }

    /// Figure 2 of version 4.0, AS_DRIVING to EMERGENCY_BRAKE: what version 3.0 does not have there.
    fn figure_2_of_4_0(&self) -> bool {
        self.of_4_0
            && (self.ai_comms_lost
                || self.inputs.sdc.bms_fault
                || self.inputs.ebs == EbsState::Unavailable
                || self.brake_plausibility_fault())
    }

    /// 4 of version 4.0: torque and hydraulic braking at once, with the drive motors in torque control mode.
    fn brake_plausibility_fault(&self) -> bool {
        self.of_4_0 && torque_and_brake(self.inputs) && !self.readings.is(Choice::TorqueNever)
    }

    /// 3.8, AS_FINISHED to EMERGENCY_BRAKE: the shutdown circuit is open.
    pub fn section_3_8(&self) -> bool {
        self.emergency_in_every_active_state()
    }

    /// 3.9, EMERGENCY_BRAKE to AS_OFF: the 15 second timer has elapsed and ASMS is off.
    pub fn section_3_9(&self) -> bool {
        self.in_state_ms >= 15000 && !self.inputs.asms
    }

    /// 3.7's and 4's FINISHED while moving: the level of 3.7, or the change from RUNNING of section 4, item 2.
    pub fn finished_at_speed(&self) -> bool {
        let changed = self.control.was_running;
        self.finished() && self.moving() && (changed || self.readings.is(Choice::FaultLevel))
    }

    /// 3.7's and 4's NEUTRAL while moving: the level of 3.7, or the change from FORWARD of section 4, item 1.
    pub fn neutral_at_speed(&self) -> bool {
        let changed = self.control.was_forward;
        let neutral = self.inputs.ai.status.direction_request == DirectionRequest::Neutral;
        neutral && self.moving() && (changed || self.readings.is(Choice::FaultLevel))
    }

    /// 3.5 and 3.8, and what other sections add to every active state: the AI Computer's request (2.1) and the loss
    /// of communications (2.4).
    fn emergency_in_every_active_state(&self) -> bool {
        let estop = self.readings.is(Choice::EstopEveryState) && self.inputs.ai.status.estop_request;
        let comms = self.readings.is(Choice::CommsEveryState) && self.ai_comms_lost;
        self.section_3_5_sdc_open() || estop || comms
    }

    /// `MISSION_STATUS` is FINISHED.
    pub fn finished(&self) -> bool {
        self.inputs.ai.status.mission_status == MissionStatus::Finished
    }

    /// 3.7: any of the wheel speeds is greater than 10 rpm.
    pub fn moving(&self) -> bool {
        self.wheel_speeds().iter().any(|&rpm| rpm > 10)
    }

    /// Figure 2: all wheel speeds are less than 10 rpm.
    pub fn at_rest(&self) -> bool {
        self.wheel_speeds().iter().all(|&rpm| rpm < 10)
    }

    fn wheel_speeds(&self) -> [i32; 4] {
        let speeds = &self.inputs.vehicle.wheel_speeds;
        [
            speeds.fl_wheel_speed.raw(),
            speeds.fr_wheel_speed.raw(),
            speeds.rl_wheel_speed.raw(),
            speeds.rr_wheel_speed.raw(),
        ]
    }

    /// 2.2: a master switch is on when the battery is being charged.
    fn charge_procedure_fault(&self) -> bool {
        self.inputs.reports.charging && (self.inputs.asms || self.inputs.tsms)
    }
}

/// The fault flags and `SHUTDOWN_CAUSE` of section 2.2.
impl StepInWords<'_> {
    /// The faults of the inputs and the handshake, whatever the state.
    pub fn live(&self) -> Flags {
        let sdc = &self.inputs.sdc;
        let reports = &self.inputs.reports;
        Flags {
            ai_estop_request: self.inputs.ai.status.estop_request,
            hvil_open_fault: reports.hvil_open
                || sdc.remote_estop
                || sdc.res_link_lost
                || sdc.vehicle_estop
                || sdc.crash_sensor
                || sdc.critical_fault
                || sdc.mpp_dongle_removed,
            hvil_short_fault: reports.hvil_short,
            ebs_fault: reports.ebs_fault,
            offboard_charger_fault: reports.offboard_charger_fault,
            ai_comms_lost: self.ai_comms_lost,
            autonomous_braking_fault: false,
            mission_status_fault: false,
            charge_procedure_fault: self.charge_procedure_fault(),
            bms_fault: sdc.bms_fault,
            // Version 3.0 allows both at once.
            brake_plausibility_fault: false,
        }
    }

    /// The faults that are a reason for `EMERGENCY_BRAKE` in the state of this step.
    pub fn reasons(&self) -> Flags {
        let driving = self.control.state == AsState::Driving;
        let active = driving || matches!(self.control.state, AsState::Ready | AsState::Finished);
        if !active {
            return Flags::default();
        }
        let live = self.live();
        Flags {
            ai_estop_request: live.ai_estop_request && (driving || self.readings.is(Choice::EstopEveryState)),
            hvil_open_fault: live.hvil_open_fault || driving && (!self.inputs.asms || !self.inputs.go),
            ebs_fault: live.ebs_fault || driving && self.of_4_0 && self.inputs.ebs == EbsState::Unavailable,
            ai_comms_lost: live.ai_comms_lost
                && (self.readings.is(Choice::CommsEveryState) || driving && self.of_4_0),
            brake_plausibility_fault: driving && self.brake_plausibility_fault(),
            autonomous_braking_fault: driving && self.neutral_at_speed(),
            mission_status_fault: driving && self.finished_at_speed(),
            ..live
        }
    }

    /// The flags on the bus: what is live, what is a reason, and the cause for as long as it stands.
    fn shown(&self, reasons: Flags, cause: ShutdownCause) -> Flags {
        let live = self.live();
        let is = |number| cause == number;
        Flags {
            ai_estop_request: live.ai_estop_request || is(ShutdownCause::AiComputerRequest),
            hvil_open_fault: live.hvil_open_fault
                || reasons.hvil_open_fault
                || is(ShutdownCause::HvilOpenFault),
            hvil_short_fault: live.hvil_short_fault || is(ShutdownCause::HvilShortFault),
            ebs_fault: live.ebs_fault || reasons.ebs_fault || is(ShutdownCause::EbsFault),
            offboard_charger_fault: live.offboard_charger_fault || is(ShutdownCause::OffboardChargerFault),
            ai_comms_lost: live.ai_comms_lost || is(ShutdownCause::AiCommsFault),
            autonomous_braking_fault: reasons.autonomous_braking_fault
                || is(ShutdownCause::AutonomousBrakingFault),
            mission_status_fault: reasons.mission_status_fault || is(ShutdownCause::MissionStatusFault),
            charge_procedure_fault: live.charge_procedure_fault || is(ShutdownCause::ChargeProcedureFault),
            bms_fault: live.bms_fault || is(ShutdownCause::BmsFault),
            brake_plausibility_fault: reasons.brake_plausibility_fault
                || is(ShutdownCause::BrakePlausibilityFault),
        }
    }

    /// 3.2, item 3: `GO_SIGNAL` tells the AI Computer of the edge that lets the vehicle drive, or it is the switch.
    fn go_signal(&self, state: AsState) -> bool {
        self.inputs.go && (state == AsState::Driving || self.readings.is(Choice::GoRaw))
    }
}

/// The fault with the lowest number of section 2.2.
fn lowest(faults: Flags) -> ShutdownCause {
    if faults.ai_estop_request {
        ShutdownCause::AiComputerRequest
    } else if faults.hvil_open_fault {
        ShutdownCause::HvilOpenFault
    } else if faults.hvil_short_fault {
        ShutdownCause::HvilShortFault
    } else if faults.ebs_fault {
        ShutdownCause::EbsFault
    } else if faults.offboard_charger_fault {
        ShutdownCause::OffboardChargerFault
    } else if faults.ai_comms_lost {
        ShutdownCause::AiCommsFault
    } else if faults.autonomous_braking_fault {
        ShutdownCause::AutonomousBrakingFault
    } else if faults.mission_status_fault {
        ShutdownCause::MissionStatusFault
    } else if faults.charge_procedure_fault {
        ShutdownCause::ChargeProcedureFault
    } else if faults.bms_fault {
        ShutdownCause::BmsFault
    } else if faults.brake_plausibility_fault {
        ShutdownCause::BrakePlausibilityFault
    } else {
        ShutdownCause::NoShutdown
    }
}
