//! What the benchmarks run on: inputs of a run on the track, and frames over the whole range of every signal.

use adsdv_spec::messages::{
    AmiState, AxleTorqueRequest, DirectionRequest, EbsState, Frame, MessageDef, MissionStatus, MotorSpeedMax,
    ShutdownCause, SteerAngle, WheelSpeed,
};
use adsdv_spec::{AsState, Control, Edition, Inputs, Machine};

/// How many samples there are of each thing: even, because the handshake alternates.
pub(crate) const COUNT: u8 = 8;

/// Samples, one after the other, over and over.
pub(crate) struct Ring<T> {
    items: Vec<T>,
    next: usize,
}

impl<T> Ring<T> {
    pub(crate) fn new(items: impl IntoIterator<Item = T>) -> Self {
        let items: Vec<T> = items.into_iter().collect();
        assert!(!items.is_empty(), "a ring of nothing has no next");
        Self { items, next: 0 }
    }

    #[inline]
    pub(crate) fn next(&mut self) -> &T {
        let item = &self.items[self.next];
        self.next += 1;
        if self.next == self.items.len() {
            self.next = 0;
        }
        item
    }

    pub(crate) fn map<U>(self, change: impl FnMut(T) -> U) -> Ring<U> {
        Ring::new(self.items.into_iter().map(change))
    }

    pub(crate) fn into_items(self) -> Vec<T> {
        self.items
    }
}

/// A control state, and inputs that keep the VCU in its AS state.
pub(crate) struct Stay {
    pub(crate) control: Control,
    pub(crate) inputs: Ring<Inputs>,
}

impl Stay {
    pub(crate) fn in_state(state: AsState) -> Self {
        let timing = Edition::V3_0.rules.timing;
        let braking = state == AsState::EmergencyBrake;
        let start = Control {
            state,
            in_state_ms: timing.in_state_limit(state),
            power_cycle_needed: braking,
            shutdown_cause: if braking { ShutdownCause::HvilOpenFault } else { ShutdownCause::NoShutdown },
            ..Control::INITIAL
        };
        let samples: Vec<Inputs> = (0..COUNT).map(|index| inputs_in(state, index)).collect();
        let mut control = start;
        for inputs in &samples {
            control = Machine::REFERENCE.step(&control, inputs, 10).0;
            assert_eq!(control.state, state, "the inputs are meant to keep the state");
        }
        Self { control: start, inputs: Ring::new(samples) }
    }
}

/// AS_DRIVING, and inputs with a request for an emergency stop, which is the last reason that its row looks at.
pub(crate) fn before_emergency_brake() -> (Control, Ring<Inputs>) {
    let Stay { control, inputs } = Stay::in_state(AsState::Driving);
    let inputs = inputs.map(|mut inputs| {
        inputs.ai.status.estop_request = true;
        inputs
    });
    (control, inputs)
}

/// The sample of this index of a vehicle in this state: everything is switched on, and "Go" where one drives.
fn inputs_in(state: AsState, index: u8) -> Inputs {
    let varied = i32::from(index);
    let mut inputs = Inputs {
        asms: true,
        tsms: true,
        ami: AmiState::TrackDrive,
        ebs: EbsState::Armed,
        go: matches!(state, AsState::Driving | AsState::Finished),
        ..Inputs::default()
    };
    let status = &mut inputs.ai.status;
    status.handshake = index % 2 == 1;
    status.mission_status = match state {
        AsState::Off => MissionStatus::NotSelected,
        AsState::Ready => MissionStatus::Selected,
        AsState::Driving | AsState::EmergencyBrake => MissionStatus::Running,
        AsState::Finished => MissionStatus::Finished,
    };
    inputs.vehicle.steer_angle = SteerAngle::clamped(varied * 7 - 28);
    if state == AsState::Driving {
        status.direction_request = DirectionRequest::Forward;
        inputs.ai.steer.steer_request = SteerAngle::clamped(varied * 11 - 40);
        inputs.ai.drive_f.front_axle_trq_request = AxleTorqueRequest::clamped(100 + varied * 31);
        inputs.ai.drive_f.front_motor_speed_max = MotorSpeedMax::clamped(500);
        inputs.ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::clamped(120 + varied * 29);
        inputs.ai.drive_r.rear_motor_speed_max = MotorSpeedMax::clamped(500);
        let speeds = &mut inputs.vehicle.wheel_speeds;
        speeds.fl_wheel_speed = WheelSpeed::clamped(180 + varied);
        speeds.fr_wheel_speed = WheelSpeed::clamped(184 - varied);
        speeds.rl_wheel_speed = WheelSpeed::clamped(181 + varied);
        speeds.rr_wheel_speed = WheelSpeed::clamped(185 - varied);
    }
    inputs
}

/// Frames of a message whose signals go from the lowest value that is allowed to the highest.
pub(crate) fn frames(def: &MessageDef) -> Ring<Frame> {
    Ring::new((0..COUNT).map(|index| {
        let data = def.signals.iter().fold([0; 8], |data, signal| {
            let raw = match signal.values.get(usize::from(index) % signal.values.len().max(1)) {
                Some((value, _)) => *value,
                None => signal.min + (signal.max - signal.min) / i32::from(COUNT - 1) * i32::from(index),
            };
            signal.put(data, raw)
        });
        Frame { id: def.id, len: def.len, data }
    }))
}
