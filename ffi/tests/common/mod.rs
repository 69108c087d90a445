//! What the tests share: runs through all states, and C structs by the names of their fields.
#![allow(dead_code, reason = "each test uses some of it")]

use std::ffi::{CStr, c_char};

use adsdv::{adsdv_edition, adsdv_edition_find, adsdv_error, adsdv_status};
use adsdv_conform::protocol::{Domain, InputField, Protocol};
use adsdv_spec::messages::{AmiState, DirectionRequest, EbsState, MissionStatus, ShutdownCause, SignalValue};
use adsdv_spec::{AsState, Control, Edition, Inputs};
use adsdv_tests::world::{Chance, Random};

/// The numbers of a struct by the names of its fields, from how it shows itself with `{:?}`. A list and no map: a test makes hundreds
/// of thousands.
pub(crate) fn fields(shown: &str) -> Vec<(&str, i64)> {
    let body = shown.split_once(" { ").and_then(|(_, body)| body.strip_suffix(" }")).expect("a struct");
    body.split(',')
        .filter_map(|field| field.split_once(": "))
        .filter_map(|(name, value)| Some((name.strip_prefix(' ').unwrap_or(name), value.parse().ok()?)))
        .collect()
}

/// Takes a field out of them.
pub(crate) fn take(fields: &mut Vec<(&str, i64)>, name: &str) -> Option<i64> {
    let place = fields.iter().position(|(own, _)| *own == name)?;
    Some(fields.swap_remove(place).1)
}

/// A text that a function wrote into an array.
pub(crate) fn text(array: &[c_char]) -> String {
    let bytes: Vec<u8> = array.iter().map(|&byte| byte.to_ne_bytes()[0]).collect();
    CStr::from_bytes_until_nul(&bytes).expect("a NUL").to_str().expect("UTF-8").to_owned()
}

/// An error that no function has written.
pub(crate) fn no_error() -> adsdv_error {
    adsdv_error::default()
}

/// A call's status; a failure is the error's text.
pub(crate) fn outcome(
    call: impl FnOnce(*mut adsdv_error) -> adsdv_status,
) -> Result<(), (adsdv_status, String)> {
    let mut error = no_error();
    match call(&raw mut error) {
        adsdv_status::ADSDV_OK => {
            assert_eq!(
                (error.status, text(&error.text).as_str()),
                (0, ""),
                "an error was written without one"
            );
            Ok(())
        }
        status => {
            assert_eq!(error.status, status as i32);
            Err((status, text(&error.text)))
        }
    }
}

/// The number that the library has for an edition.
pub(crate) fn number(edition: &Edition) -> adsdv_edition {
    let version = std::ffi::CString::new(edition.version).expect("no NUL");
    let mut number = adsdv_edition::MAX;
    // SAFETY: the pointers are to what they are said to be.
    outcome(|error| unsafe { adsdv_edition_find(version.as_ptr(), &raw mut number, error) })
        .expect("an edition");
    number
}

/// Steps of a VCU that is led through all of its states, and disturbed now and then.
pub(crate) struct Run {
    random: Random,
    edition: &'static Edition,
    /// The inputs that it has.
    fields: Vec<(&'static InputField, Domain)>,
}

impl Run {
    /// A VCU of the default edition.
    pub(crate) fn new(seed: u64) -> Self {
        Self::of(Edition::DEFAULT, seed)
    }

    pub(crate) fn of(edition: &'static Edition, seed: u64) -> Self {
        Self { random: Random::with_seed(seed), edition, fields: Protocol::of(edition).inputs().collect() }
    }

    /// What is only passed on, and so not in the protocol: any value of each.
    fn report(&mut self, inputs: &mut Inputs) {
        let status = &mut inputs.ai.status;
        status.lap_counter = self.any();
        status.cones_count_actual = self.any();
        status.cones_count_all = self.any();
        status.veh_speed_actual = self.any();
        status.veh_speed_demand = self.any();
        if self.edition.rules.thresholds.missed_ms.is_none() {
            // Where nobody looks at it.
            let silence = &mut inputs.ai_silence;
            (silence.status_silence_ms, silence.drive_f_silence_ms) = (self.any(), self.any());
            (silence.drive_r_silence_ms, silence.steer_silence_ms) = (self.any(), self.any());
            silence.brake_silence_ms = self.any();
        }
        let vehicle = &mut inputs.vehicle;
        vehicle.steer_angle_max = self.any();
        let counts = &mut vehicle.wheel_counts;
        (counts.fl_pulse_count, counts.fr_pulse_count) = (self.any(), self.any());
        (counts.rl_pulse_count, counts.rr_pulse_count) = (self.any(), self.any());
        (vehicle.front_axle_trq, vehicle.rear_axle_trq) = (self.any(), self.any());
        (vehicle.front_axle_trq_max, vehicle.rear_axle_trq_max) = (self.any(), self.any());
        (vehicle.hyd_press_f, vehicle.hyd_press_r) = (self.any(), self.any());
        vehicle.speed = self.any();
        *inputs = inputs.held_by(&self.edition.bus);
    }

    fn any<T: SignalValue>(&mut self) -> T {
        let above = self.random.below(u64::from(T::MAX.abs_diff(T::MIN)) + 1);
        T::from_raw(T::MIN + i32::try_from(above).unwrap()).unwrap()
    }

    /// Whether the VCU is to be power-cycled: it would not leave AS_OFF again.
    pub(crate) fn is_over(control: &Control) -> bool {
        control.state == AsState::Off && control.shutdown_cause != ShutdownCause::NoShutdown
    }

    /// What the VCU sees next, in the control state that it has reached, and how much later.
    pub(crate) fn next(&mut self, control: &Control) -> (u32, Inputs) {
        let mut inputs = leading_on(control);
        inputs.go &= self.random.one_in(2);
        inputs.asms &= !self.random.one_in(20);
        while self.random.one_in(4) {
            let (field, domain) = self.random.pick(&self.fields);
            let raw = match domain {
                Domain::Flag => self.random.pick(&[0, 1]),
                Domain::Names(names) => self.random.pick(names).0,
                Domain::Number { min, max } => {
                    let any =
                        i64::from(min) + self.random.below(u64::from(max.abs_diff(min)) + 1).cast_signed();
                    let any = i32::try_from(any).unwrap();
                    self.random.pick(&[min, max, 0, 9, 10, 11, 49, 50, -50, any]).clamp(min, max)
                }
            };
            // Some numbers are none of the field's: then it stays.
            let _ = (field.set)(&mut inputs, raw);
        }
        if self.random.one_in(3) {
            self.report(&mut inputs);
        }
        let any = u32::try_from(self.random.below(20_000)).unwrap();
        (self.random.pick(&[10, 10, 10, 10, 0, 1, 40, 4990, 5000, 14_990, 15_000, u32::MAX, any]), inputs)
    }
}

/// Inputs that lead a VCU from its state to the next.
fn leading_on(control: &Control) -> Inputs {
    let mut inputs = Inputs {
        asms: control.state != AsState::EmergencyBrake && control.state != AsState::Finished,
        tsms: true,
        ami: AmiState::TrackDrive,
        ebs: EbsState::Armed,
        go: matches!(control.state, AsState::Ready | AsState::Driving),
        ..Inputs::default()
    };
    let status = &mut inputs.ai.status;
    status.handshake = control.handshake.bit;
    status.mission_status = match control.state {
        AsState::Off | AsState::Ready => MissionStatus::Selected,
        _ => MissionStatus::Running,
    };
    if control.state == AsState::Driving {
        status.direction_request = DirectionRequest::Forward;
        if control.was_forward || control.handshake.bit {
            status.mission_status = MissionStatus::Finished;
        }
    }
    inputs
}
