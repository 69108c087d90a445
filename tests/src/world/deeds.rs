//! What an operator, a vehicle and an AI Computer may do at any time, chosen by chance or by a fuzzer.

use adsdv_spec::messages::{
    AmiState, AxleTorqueRequest, BrakePressure, DirectionRequest, EbsState, MissionStatus, SteerAngle,
    WheelSpeed,
};
use adsdv_spec::{AiMessages, Choice, Edition, Readings};

use super::{MS, World};

/// Where choices come from.
pub trait Chance {
    /// A number below `n`, or 0.
    fn below(&mut self, n: u64) -> u64;

    /// True once in `n` times.
    fn one_in(&mut self, n: u64) -> bool {
        self.below(n) == 0
    }

    /// One of the values; there is at least one.
    fn pick<T: Copy>(&mut self, values: &[T]) -> T {
        values[usize::try_from(self.below(values.len() as u64)).unwrap_or(0)]
    }
}

/// The usual readings of an edition, but for one in three of the questions that it leaves open.
pub fn any_readings(chance: &mut impl Chance, edition: &Edition) -> Readings {
    edition.questions().fold(edition.readings, |readings, reading| {
        let possible: Vec<Choice> = edition.choices.of_reading(reading).collect();
        if chance.one_in(3) { readings.with(chance.pick(&possible)) } else { readings }
    })
}

fn mostly(chance: &mut impl Chance) -> bool {
    !chance.one_in(4)
}

/// How many sorts of deeds there are.
const DEEDS: u64 = 20;

/// 502h shows the EBS every 100 ms: what lasts for less does not show, and an EBS does not flicker.
const EBS_LASTS: i64 = 300 * MS;

impl World {
    /// Somebody does something.
    pub fn anything(&mut self, chance: &mut impl Chance) {
        match chance.below(DEEDS) {
            0 => self.inputs.asms = mostly(chance),
            1 => self.inputs.tsms = mostly(chance),
            2 => {
                self.inputs.ami =
                    chance.pick(&[AmiState::NotSelected, AmiState::Skidpad, AmiState::TrackDrive]);
            }
            3 => self.inputs.reports.batt_temp_high = chance.one_in(2),
            4 | 5 => self.inputs.go = mostly(chance),
            6 => self.ai.status.mission_status = chance.pick(&MissionStatus::ALL),
            7 => self.ai.status.mission_status = MissionStatus::Selected,
            8 => self.ai.status.direction_request = chance.pick(&DirectionRequest::ALL),
            9 => {
                let rpm = chance.pick(&[0, 5, 9, 10, 11, 12, 300]);
                self.wheels(rpm);
                if chance.one_in(3) {
                    self.inputs.vehicle.wheel_speeds.rl_wheel_speed = WheelSpeed::clamped(11);
                }
            }
            10 => {
                self.ai.drive_f.front_axle_trq_request =
                    AxleTorqueRequest::clamped(chance.pick(&[0, 0, 1, 100]));
            }
            11 => {
                self.ai.drive_r.rear_axle_trq_request =
                    AxleTorqueRequest::clamped(chance.pick(&[0, 0, 1, 100]));
            }
            12 => self.ai.steer.steer_request = SteerAngle::clamped(chance.pick(&[0, 0, 1, -1])),
            13 => self.inputs.vehicle.steer_angle = SteerAngle::clamped(chance.pick(&[0, 49, 50, -49, -50])),
            14 => self.inputs.sdc.remote_estop = chance.one_in(4),
            15 => self.inputs.reports.hvil_short = chance.one_in(4),
            16 => self.inputs.reports.charging = chance.one_in(6),
            17 => self.ai.status.estop_request = chance.one_in(3),
            18 => self.ai_answers = mostly(chance),
            _ => self.ai_sends = mostly(chance),
        }
    }

    /// Somebody does something that matters since version 4.0.
    pub fn anything_newer(&mut self, chance: &mut impl Chance) {
        match chance.below(5) {
            0 => self.ai.brake.hyd_press_f_req = BrakePressure::clamped(chance.pick(&[0, 0, 1, 200])),
            1 => self.ai.brake.hyd_press_r_req = BrakePressure::clamped(chance.pick(&[0, 0, 1, 200])),
            2 => self.inputs.sdc.bms_fault = chance.one_in(4),
            3 => self.mutes.clear(),
            _ => self.mutes.push(chance.pick(&AiMessages::IDS)),
        }
    }

    /// The EBS changes, unless it has only just done so.
    pub fn ebs_changes(&mut self, chance: &mut impl Chance) {
        if self.t - self.ebs_changed > EBS_LASTS {
            self.inputs.ebs = chance.pick(&[EbsState::Armed, EbsState::Armed, EbsState::Unavailable]);
            self.ebs_changed = self.t;
        }
    }

    /// On one of the routes, as far as it goes.
    pub fn sets_out(&mut self, chance: &mut impl Chance) {
        match chance.below(6) {
            0 => {}
            1 => self.ready(),
            2 => self.dwelt(),
            3 => self.driving(),
            4 => self.stopped(),
            _ => self.finished(),
        }
        self.ebs_changed = self.t;
    }
}
