//! Inputs that show what is wanted: [`Inputs::show`], [`Inputs::show_fault`] and [`Inputs::showing`] against
//! [`Inputs::observe`], over random inputs.

use adsdv_spec::messages::{
    AmiState, AxleTorqueRequest, BrakePressure, DirectionRequest, EbsState, MissionStatus, SteerAngle,
    Vcu2AiWheelSpeeds, WheelSpeed,
};
use adsdv_spec::{AiSilence, Atom, Atoms, Edition, Fault, Faults, Inputs, Observation, Reads, Thresholds};

use crate::random::Random;

/// Those of an edition that has a limit for everything.
const THRESHOLDS: Thresholds = Edition::V4_0.rules.thresholds;

impl Random {
    fn pick<T: Copy>(&mut self, values: &[T]) -> T {
        let place = self.next() % values.len() as u64;
        values[usize::try_from(place).unwrap_or_default()]
    }

    /// True as often as false.
    fn coin(&mut self) -> bool {
        self.pick(&[false, true])
    }

    fn atoms(&mut self) -> Atoms {
        Atom::ALL.iter().filter(|_| self.coin()).copied().fold(Atoms::NONE, Atoms::with)
    }

    /// Few faults or many.
    fn faults(&mut self) -> Faults {
        let rare = self.pick(&[1, 2, 8]);
        Fault::ALL.iter().filter(|_| self.next() % rare == 0).copied().fold(Faults::NONE, Faults::with)
    }

    /// Any inputs, boundary values among them.
    fn inputs(&mut self) -> Inputs {
        let mut inputs = Inputs {
            asms: self.coin(),
            tsms: self.coin(),
            ami: self.pick(&AmiState::ALL),
            ebs: self.pick(&EbsState::ALL),
            go: self.coin(),
            ..Inputs::default()
        };
        let sdc = &mut inputs.sdc;
        for cause in [
            &mut sdc.remote_estop,
            &mut sdc.res_link_lost,
            &mut sdc.vehicle_estop,
            &mut sdc.crash_sensor,
            &mut sdc.critical_fault,
            &mut sdc.bms_fault,
            &mut sdc.mpp_dongle_removed,
        ] {
            *cause = self.pick(&[false, false, false, true]);
        }
        let reports = &mut inputs.reports;
        for report in [
            &mut reports.hvil_open,
            &mut reports.hvil_short,
            &mut reports.ebs_fault,
            &mut reports.offboard_charger_fault,
            &mut reports.charging,
        ] {
            *report = self.coin();
        }
        let status = &mut inputs.ai.status;
        status.handshake = self.coin();
        status.estop_request = self.coin();
        status.mission_status = self.pick(&MissionStatus::ALL);
        status.direction_request = self.pick(&DirectionRequest::ALL);
        inputs.ai.drive_f.front_axle_trq_request = AxleTorqueRequest::clamped(self.pick(&[0, 1, 1950]));
        inputs.ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::clamped(self.pick(&[0, 1, 1950]));
        let brake = &mut inputs.ai.brake;
        brake.hyd_press_f_req = BrakePressure::clamped(self.pick(&[0, 0, 1, 200]));
        brake.hyd_press_r_req = BrakePressure::clamped(self.pick(&[0, 0, 1, 200]));
        let silence = &mut inputs.ai_silence;
        for silence_ms in [
            &mut silence.status_silence_ms,
            &mut silence.drive_f_silence_ms,
            &mut silence.drive_r_silence_ms,
            &mut silence.steer_silence_ms,
            &mut silence.brake_silence_ms,
        ] {
            *silence_ms = self.pick(&[0, 0, 10, 10, 99, 100, u16::MAX]);
        }
        inputs.ai.steer.steer_request = SteerAngle::clamped(self.pick(&[-240, -1, 0, 1, 240]));
        inputs.vehicle.steer_angle = SteerAngle::clamped(self.pick(&[-240, -50, -49, -1, 0, 1, 49, 50, 240]));
        let mut speed = || WheelSpeed::clamped(self.pick(&[0, 9, 10, 11, 1250]));
        inputs.vehicle.wheel_speeds = Vcu2AiWheelSpeeds {
            fl_wheel_speed: speed(),
            fr_wheel_speed: speed(),
            rl_wheel_speed: speed(),
            rr_wheel_speed: speed(),
        };
        inputs
    }

    /// Anything that inputs can show.
    fn possible(&mut self) -> Observation {
        loop {
            let seen = Observation::new(self.atoms(), self.faults());
            if seen.is_possible() {
                return seen;
            }
        }
    }
}

/// Where a fault or an atom is the effect of another: what may change along with it.
fn taken_along(atom: Atom) -> Atoms {
    let with_it = match atom {
        Atom::MissionSelected | Atom::MissionRunning | Atom::MissionFinished => {
            Atoms::of(&[Atom::MissionSelected, Atom::MissionRunning, Atom::MissionFinished])
        }
        Atom::Moving | Atom::AtRest => Atoms::of(&[Atom::Moving, Atom::AtRest]),
        Atom::EbsArmed | Atom::EbsUnavailable => Atoms::of(&[Atom::EbsArmed, Atom::EbsUnavailable]),
        Atom::Asms | Atom::Tsms | Atom::BmsFault => Atoms::NONE.with(Atom::SdcOpen),
        Atom::SdcOpen => Atoms::NONE.with(Atom::BmsFault),
        _ => Atoms::NONE,
    };
    with_it.with(atom)
}

#[test]
fn an_atom_that_is_shown_is_seen_and_takes_little_along() {
    let mut random = Random::with_seed(0x5EED_1001);
    for _ in 0..200_000 {
        let before = random.inputs();
        let atom = random.pick(Atom::ALL);
        let value = random.coin();
        let mut after = before;
        after.show(atom, value, &THRESHOLDS);
        let (was, is) = (before.observe(&THRESHOLDS).atoms(), after.observe(&THRESHOLDS).atoms());
        if !Observation::SCOPE.has(atom) || was.has(atom) == value {
            assert_eq!(after, before, "{atom} {value}: nothing to do");
        } else {
            assert_eq!(is.has(atom), value, "{atom} {value} from {before:?}");
            let changed = was.difference(is).union(is.difference(was));
            assert!(changed.is_subset(taken_along(atom)), "{atom} {value} changes {changed}");
        }
    }
}

#[test]
fn where_a_threshold_decides_the_value_is_next_to_it() {
    let limit = THRESHOLDS.wheel_speed.raw();
    let straight = THRESHOLDS.straight.raw();
    let fast = WheelSpeed::clamped(limit + 100);
    let shown = |mut inputs: Inputs, atom, value| {
        inputs.show(atom, value, &THRESHOLDS);
        inputs
    };
    let rpm = |inputs: Inputs| inputs.vehicle.wheel_speeds.rr_wheel_speed.raw();
    let mut moving = Inputs::default();
    moving.vehicle.wheel_speeds.fr_wheel_speed = fast;
    assert_eq!(rpm(shown(Inputs::default(), Atom::Moving, true)), limit + 1);
    assert_eq!(rpm(shown(moving, Atom::Moving, false)), limit);
    assert_eq!(rpm(shown(moving, Atom::AtRest, true)), limit - 1);
    assert_eq!(rpm(shown(Inputs::default(), Atom::AtRest, false)), limit);
    let bent = shown(Inputs::default(), Atom::SteerStraight, false);
    assert_eq!(bent.vehicle.steer_angle.raw(), straight);
    assert_eq!(shown(bent, Atom::SteerStraight, true).vehicle.steer_angle.raw(), straight - 1);
    let asked = shown(Inputs::default(), Atom::SteerRequestZero, false);
    assert_eq!(asked.ai.steer.steer_request.raw(), 1);
    let silent = shown(Inputs::default(), Atom::AiMessagesMissed, true);
    assert_eq!(silent.ai_silence, AiSilence::of(100));
    assert_eq!(shown(silent, Atom::AiMessagesMissed, false).ai_silence, AiSilence::of(99));
    let braking = shown(Inputs::default(), Atom::BrakeRequestZero, false);
    assert_eq!((braking.ai.brake.hyd_press_f_req.raw(), braking.ai.brake.hyd_press_r_req.raw()), (1, 0));
}

#[test]
fn where_no_silence_is_too_long_none_is_shown() {
    let thresholds = Edition::V3_0.rules.thresholds;
    let mut inputs = Inputs { ai_silence: AiSilence::of(u16::MAX), ..Inputs::default() };
    assert!(!inputs.observe(&thresholds).atoms().has(Atom::AiMessagesMissed));
    inputs.show(Atom::AiMessagesMissed, true, &thresholds);
    assert!(!inputs.observe(&thresholds).atoms().has(Atom::AiMessagesMissed));
}

#[test]
fn a_fault_that_is_shown_is_present_and_no_other_changes() {
    let mut random = Random::with_seed(0x5EED_1002);
    for _ in 0..200_000 {
        let before = random.inputs();
        let fault = random.pick(Fault::ALL);
        let value = random.coin();
        let mut after = before;
        after.show_fault(fault, value);
        if !Observation::FAULTS.has(fault) || before.faults().has(fault) == value {
            assert_eq!(after, before, "{fault} {value}: nothing to do");
            continue;
        }
        let mut switched_on = after;
        if fault == Fault::ChargeProcedureFault {
            switched_on.tsms = true;
        }
        let expected = if value { before.faults().with(fault) } else { before.faults().without(fault) };
        assert_eq!(switched_on.faults(), expected, "{fault} {value} from {before:?}");
        let (now, then) = (after.observe(&THRESHOLDS).atoms(), before.observe(&THRESHOLDS).atoms());
        let effects = Atoms::of(&[Atom::SdcOpen, Atom::AiEstop, Atom::BmsFault]);
        assert_eq!(now.difference(effects), then.difference(effects), "{fault} {value}");
    }
}

#[test]
fn inputs_look_like_what_they_show_in_all_that_is_read() {
    let mut random = Random::with_seed(0x5EED_1003);
    for _ in 0..500_000 {
        let (before, seen) = (random.inputs(), random.possible());
        let reads = Reads { atoms: random.atoms(), faults: random.faults() };
        let after = before.showing(seen, &reads, &THRESHOLDS);
        assert_eq!(
            reads.of(after.observe(&THRESHOLDS)),
            reads.of(seen),
            "reads {reads:?}, seen {seen:?}, from {before:?}"
        );
    }
}

#[test]
fn what_shows_already_stays_as_it_is() {
    let mut random = Random::with_seed(0x5EED_1004);
    for _ in 0..200_000 {
        let inputs = random.inputs();
        let reads = Reads { atoms: random.atoms(), faults: random.faults() };
        assert_eq!(inputs.showing(inputs.observe(&THRESHOLDS), &reads, &THRESHOLDS), inputs);
    }
}

#[test]
fn what_is_not_read_stays_as_it_is() {
    let mut random = Random::with_seed(0x5EED_1005);
    for _ in 0..200_000 {
        let (before, seen) = (random.inputs(), random.possible());
        let reads = Reads { atoms: random.atoms(), faults: Faults::NONE };
        let after = before.showing(seen, &reads, &THRESHOLDS);
        let (was, is) = (before.observe(&THRESHOLDS).atoms(), after.observe(&THRESHOLDS).atoms());
        let changed = was.difference(is).union(is.difference(was));
        let allowed = reads.atoms.iter().fold(Atoms::NONE, |all, atom| all.union(taken_along(atom)));
        assert!(changed.is_subset(allowed), "reads {}, changes {changed}", reads.atoms);
        assert_eq!(after.sdc, before.sdc);
        assert_eq!(after.reports, before.reports);
    }
}
