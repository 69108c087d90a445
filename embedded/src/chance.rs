//! What may happen next, by chance that is the same each time.

use adsdv_spec::messages::{DirectionRequest, MissionStatus, WheelSpeed};
use adsdv_spec::{AsState, Inputs};

/// A generator after Marsaglia (xorshift), which needs no more than shifts. Its numbers stay as they are: TESTING.md has what was
/// measured with them.
pub(crate) struct Chance(u32);

impl Chance {
    pub(crate) fn new() -> Self {
        Self(0x2545_F491)
    }

    fn next(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0
    }

    /// True once in so many times, in the mean.
    pub(crate) fn one_of(&mut self, times: u32) -> bool {
        self.next() % times == 0
    }

    /// How long a step takes: mostly one cycle, now and then long enough for a timer.
    pub(crate) fn time(&mut self) -> u32 {
        if self.one_of(20) { self.next() % 16_000 } else { 10 }
    }

    /// Leads on to the next state, with something wrong now and then.
    pub(crate) fn change(&mut self, inputs: &mut Inputs, state: AsState) {
        let status = &mut inputs.ai.status;
        match state {
            AsState::Off => {
                inputs.go = false;
                inputs.asms = true;
                status.mission_status = MissionStatus::Selected;
                status.direction_request = DirectionRequest::Neutral;
                status.estop_request = false;
                inputs.sdc = Default::default();
                inputs.reports = Default::default();
                self.wheels(inputs, 0);
            }
            AsState::Ready => inputs.go = self.one_of(4),
            AsState::Driving => {
                status.mission_status = MissionStatus::Running;
                status.direction_request = DirectionRequest::Forward;
                let speed = self.next() % 4;
                self.wheels(inputs, speed * 100);
                if self.one_of(30) {
                    self.wheels(inputs, 0);
                    inputs.ai.status.mission_status = MissionStatus::Finished;
                }
            }
            AsState::Finished | AsState::EmergencyBrake => inputs.asms = !self.one_of(8),
        }
        if self.one_of(40) {
            self.go_wrong(inputs);
        }
    }

    fn wheels(&mut self, inputs: &mut Inputs, rpm: u32) {
        let speed = |rpm: u32| {
            i32::try_from(rpm).ok().and_then(|rpm| WheelSpeed::from_raw(rpm).ok()).unwrap_or_default()
        };
        let wheels = &mut inputs.vehicle.wheel_speeds;
        wheels.fl_wheel_speed = speed(rpm);
        wheels.fr_wheel_speed = speed(rpm);
        wheels.rl_wheel_speed = speed(rpm);
        wheels.rr_wheel_speed = speed(rpm + self.next() % 9);
    }

    fn go_wrong(&mut self, inputs: &mut Inputs) {
        let what = self.next() % 12;
        let sdc = &mut inputs.sdc;
        match what {
            0 => sdc.remote_estop = true,
            1 => sdc.vehicle_estop = true,
            2 => inputs.tsms = !inputs.tsms,
            3 => inputs.asms = !inputs.asms,
            4 => inputs.ai.status.estop_request = true,
            5 => inputs.ai.status.direction_request = DirectionRequest::Neutral,
            6 => inputs.reports.hvil_open = true,
            7 => inputs.reports.ebs_fault = true,
            8 => inputs.reports.charging = !inputs.reports.charging,
            9 => sdc.bms_fault = true,
            10 => inputs.ai_silence.status_silence_ms = (self.next() % 300) as u16,
            _ => inputs.ai.status.mission_status = MissionStatus::NotSelected,
        }
    }

    /// The AI Computer answers the handshake, mostly.
    pub(crate) fn answer(&mut self, inputs: &mut Inputs, bit: bool) {
        if !self.one_of(50) {
            inputs.ai.status.handshake = bit;
        }
    }
}
