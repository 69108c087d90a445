//! What the operator and the AI Computer do to bring the vehicle into each state.

use adsdv_spec::AsState;
use adsdv_spec::messages::{
    AmiState, DirectionRequest, EbsState, MissionStatus, Vcu2AiWheelSpeeds, WheelSpeed,
};

use super::World;

impl World {
    /// Sets all four wheel speeds.
    pub fn wheels(&mut self, rpm: i32) {
        let speed = WheelSpeed::clamped(rpm);
        self.inputs.vehicle.wheel_speeds = Vcu2AiWheelSpeeds {
            fl_wheel_speed: speed,
            fr_wheel_speed: speed,
            rl_wheel_speed: speed,
            rr_wheel_speed: speed,
        };
    }

    /// The operator prepares: everything that leads to AS_READY but ASMS.
    pub fn prepare(&mut self) {
        self.wait(300);
        self.inputs.tsms = true;
        self.inputs.ami = AmiState::TrackDrive;
        self.inputs.ebs = EbsState::Armed;
        self.wait(500);
        self.ai.status.mission_status = MissionStatus::Selected;
        self.wait(500);
    }

    /// To AS_READY.
    pub fn ready(&mut self) {
        self.prepare();
        self.inputs.asms = true;
        self.wait(500);
    }

    /// To AS_READY, with the dwell over.
    pub fn dwelt(&mut self) {
        self.ready();
        self.wait(6000);
    }

    /// To AS_DRIVING, with the wheels turning.
    pub fn driving(&mut self) {
        self.dwelt();
        self.inputs.go = true;
        self.wait(500);
        self.ai.status.mission_status = MissionStatus::Running;
        self.ai.status.direction_request = DirectionRequest::Forward;
        self.wait(500);
        self.wheels(200);
        self.wait(1000);
    }

    /// To AS_DRIVING, stopped again.
    pub fn stopped(&mut self) {
        self.driving();
        self.wheels(0);
        self.wait(500);
    }

    /// To AS_FINISHED.
    pub fn finished(&mut self) {
        self.stopped();
        self.ai.status.mission_status = MissionStatus::Finished;
        self.wait(500);
    }

    /// To EMERGENCY_BRAKE, by the remote E-stop button, which is released again.
    pub fn braking(&mut self) {
        self.stopped();
        self.inputs.sdc.remote_estop = true;
        self.wait(1000);
        self.inputs.sdc.remote_estop = false;
        self.wait(500);
    }

    /// To AS_OFF again, after an emergency.
    pub fn after_emergency(&mut self) {
        self.braking();
        self.wait(i64::from(self.vcu.edition().rules.timing.ebs_timer_ms));
        self.inputs.asms = false;
        self.inputs.go = false;
        self.wait(500);
    }

    /// To a state, in the shortest way.
    ///
    /// # Panics
    ///
    /// If the VCU does not go there.
    pub fn arrive(&mut self, state: AsState) {
        match state {
            AsState::Off => self.wait(500),
            AsState::Ready => self.ready(),
            AsState::Driving => self.stopped(),
            AsState::EmergencyBrake => self.braking(),
            AsState::Finished => self.finished(),
        }
        assert_eq!(self.control.state, state, "the route leads there");
    }
}
