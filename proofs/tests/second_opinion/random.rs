//! Random runs: sequences of raw inputs, drawn so that every state is reached and every boundary is stood on.

use adsdv_spec::messages::{
    AmiState, AsState, AxleTorqueRequest, BrakePressure, DirectionRequest, EbsState, MissionStatus,
    SteerAngle, WheelSpeed,
};
use adsdv_spec::{Control, Inputs, Machine, Reports, ShutdownCircuit};
use fastrand::Rng;

use crate::compare::{self, Count, Disagreement, ROWS};

/// Chance that is the same for the same seed, so that a failure can be repeated.
pub(crate) struct Prng(Rng);

impl Prng {
    pub(crate) fn new(seed: u64) -> Self {
        Self(Rng::with_seed(seed))
    }

    /// A number from 0 to below the limit.
    fn below(&mut self, limit: usize) -> usize {
        self.0.usize(..limit)
    }

    /// One of the values.
    pub(crate) fn pick<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.below(values.len())]
    }

    /// True `percent` times in a hundred.
    fn chance(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }
}

/// The time since the last step. The cycle of the reference VCU and the whole of a timer come often, so that handshakes
/// live and timers elapse.
const DT_MS: [u32; 23] = [
    10,
    10,
    10,
    10,
    10,
    10,
    5000,
    15000,
    0,
    1,
    9,
    11,
    49,
    50,
    99,
    100,
    101,
    1000,
    4999,
    5001,
    14999,
    u16::MAX as u32 + 1,
    u32::MAX,
];

/// What a run saw.
pub(crate) struct Run {
    /// How often each row was taken.
    pub(crate) taken: Count,
    /// The first step that was seen differently; the run ends there.
    pub(crate) disagreement: Option<Box<Disagreement>>,
}

impl Run {
    /// Compares this many steps, with a power cycle now and then.
    pub(crate) fn of(machine: &Machine, prng: &mut Prng, steps: u32) -> Self {
        let mut run = Self { taken: [0; ROWS], disagreement: None };
        let mut control = Control::INITIAL;
        for _ in 0..steps {
            // After an emergency little happens until the next power cycle.
            if prng.chance(if control.power_cycle_needed { 10 } else { 1 }) {
                control = Control::INITIAL;
            }
            let inputs = inputs(prng, &control);
            match compare::step(machine, &control, &inputs, prng.pick(&DT_MS), &mut run.taken) {
                Ok(after) => control = after,
                Err(disagreement) => {
                    run.disagreement = Some(disagreement);
                    break;
                }
            }
        }
        run
    }
}

/// Mostly what keeps a vehicle going in its state, with a few things changed; now and then anything at all.
fn inputs(prng: &mut Prng, control: &Control) -> Inputs {
    let mut inputs = Inputs::default();
    if prng.chance(15) {
        (0..FIELDS).for_each(|field| change(prng, &mut inputs, field));
    } else {
        keep_going(prng, control, &mut inputs);
        for _ in 0..prng.below(3) {
            let field = prng.below(FIELDS);
            change(prng, &mut inputs, field);
        }
    }
    inputs
}

fn keep_going(prng: &mut Prng, control: &Control, inputs: &mut Inputs) {
    inputs.asms = true;
    inputs.tsms = true;
    inputs.ami = AmiState::TrackDrive;
    inputs.ebs = EbsState::Armed;
    inputs.ai.status.handshake = control.handshake.bit == prng.chance(90);
    match control.state {
        AsState::Off => inputs.ai.status.mission_status = MissionStatus::Selected,
        AsState::Ready => inputs.go = control.go_seen_low,
        AsState::Driving => {
            inputs.go = true;
            inputs.ai.status.direction_request = DirectionRequest::Forward;
            if prng.chance(70) {
                inputs.vehicle.wheel_speeds.fl_wheel_speed = WheelSpeed::clamped(500);
                inputs.ai.status.mission_status = MissionStatus::Running;
            } else {
                inputs.ai.status.mission_status = MissionStatus::Finished;
            }
        }
        AsState::EmergencyBrake => inputs.asms = prng.chance(50),
        AsState::Finished => {
            inputs.asms = prng.chance(80);
            inputs.ai.status.mission_status = MissionStatus::Finished;
        }
    }
}

/// How many things [`change`] can change.
const FIELDS: usize = 32;

/// Draws one of the things that the VCU looks at afresh.
fn change(prng: &mut Prng, inputs: &mut Inputs, field: usize) {
    // Faults are rare, or no run would get anywhere.
    let fault = prng.chance(20);
    let on = prng.chance(50);
    let ShutdownCircuit {
        remote_estop,
        res_link_lost,
        vehicle_estop,
        crash_sensor,
        critical_fault,
        bms_fault,
        mpp_dongle_removed,
    } = &mut inputs.sdc;
    let Reports { hvil_open, hvil_short, ebs_fault, offboard_charger_fault, charging, .. } =
        &mut inputs.reports;
    let ai = &mut inputs.ai;
    let wheels = &mut inputs.vehicle.wheel_speeds;
    let torque = AxleTorqueRequest::clamped(prng.pick(&[0, 0, 0, 1, 2, 1950]));
    let steer = SteerAngle::clamped(prng.pick(&[0, 0, 1, -1, 49, -49, 50, -50, 51, -51, 240, -240]));
    let brake = BrakePressure::clamped(prng.pick(&[0, 0, 0, 1, 200]));
    let speed = WheelSpeed::clamped(prng.pick(&[0, 1, 9, 10, 11, 12, 1250]));
    match field {
        0 => *remote_estop = fault,
        1 => *res_link_lost = fault,
        2 => *vehicle_estop = fault,
        3 => *crash_sensor = fault,
        4 => *critical_fault = fault,
        5 => *bms_fault = fault,
        6 => *mpp_dongle_removed = fault,
        7 => *hvil_open = fault,
        8 => *hvil_short = fault,
        9 => *ebs_fault = fault,
        10 => *offboard_charger_fault = fault,
        11 => *charging = fault,
        12 => ai.status.estop_request = fault,
        13 => inputs.asms = on,
        14 => inputs.tsms = on,
        // What matters since version 4.0.
        29 => ai.brake.hyd_press_f_req = brake,
        30 => ai.brake.hyd_press_r_req = brake,
        31 => {
            let silence = &mut inputs.ai_silence;
            let all = [
                &mut silence.status_silence_ms,
                &mut silence.drive_f_silence_ms,
                &mut silence.drive_r_silence_ms,
                &mut silence.steer_silence_ms,
                &mut silence.brake_silence_ms,
            ];
            let place = prng.below(all.len());
            let missed = prng.pick(&[0, 0, 0, 10, 99, 99, 100, 101, u16::MAX]);
            all.into_iter().skip(place).take(1).for_each(|silence_ms| *silence_ms = missed);
        }
        15 => inputs.go = on,
        16 => ai.status.handshake = on,
        17 => inputs.ami = prng.pick(&AmiState::ALL),
        18 => inputs.ebs = prng.pick(&EbsState::ALL),
        19 => ai.status.mission_status = prng.pick(&MissionStatus::ALL),
        20 => ai.status.direction_request = prng.pick(&DirectionRequest::ALL),
        21 => ai.drive_f.front_axle_trq_request = torque,
        22 => ai.drive_r.rear_axle_trq_request = torque,
        23 => ai.steer.steer_request = steer,
        24 => inputs.vehicle.steer_angle = steer,
        25 => wheels.fl_wheel_speed = speed,
        26 => wheels.fr_wheel_speed = speed,
        27 => wheels.rl_wheel_speed = speed,
        _ => wheels.rr_wheel_speed = speed,
    }
}
