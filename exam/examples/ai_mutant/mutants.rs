//! AI Computers that do one thing wrong, each with the requirements that it breaks in the editions that have them.

use std::collections::VecDeque;

use adsdv_exam::{Reference, Stack, StackError};
use adsdv_spec::Edition;
use adsdv_spec::messages::{AnyMessage, AsState, Frame, WheelSpeed};

/// A mistake.
#[derive(Clone, Copy)]
pub(crate) struct Named {
    pub(crate) name: &'static str,
    /// At least these fail, of those that the edition has. Where it has none of them, the mistake cannot show in it.
    pub(crate) breaks: &'static [&'static str],
    change: fn(&mut Mutant, &mut Vec<Frame>),
}

const fn mutant(
    name: &'static str,
    breaks: &'static [&'static str],
    change: fn(&mut Mutant, &mut Vec<Frame>),
) -> Named {
    Named { name, breaks, change }
}

/// The tenth part of a second is more than any edition gives, 60 ms more than version 3.0 does.
const LATE_3_0: usize = 6;
const LATE: usize = 12;

/// All of them.
pub(crate) const MUTANTS: &[Named] = &[
    mutant(
        "silent",
        &["MSG-1", "MSG-5", "MSG-16", "MSG-20", "MSG-23", "MSG-26", "HS-5", "RDY-7"],
        |_, frames| {
            frames.clear();
        },
    ),
    mutant("never-selects", &["RDY-7"], |mutant, frames| mutant.set(frames, "mission_status", 0)),
    mutant("floods", &["MSG-98"], |_, frames| {
        let all = frames.clone();
        frames.extend(std::iter::repeat_n(all, 40).flatten());
    }),
    mutant("sends-twice", &["MSG-98"], |_, frames| {
        let all = frames.clone();
        frames.extend(all);
    }),
    mutant("sends-rarely", &["MSG-98"], |mutant, frames| {
        if !mutant.steps.is_multiple_of(4) {
            frames.clear();
        }
    }),
    mutant("answers-late", &["HS-5"], |mutant, frames| {
        let late = if mutant.edition().version == "3.0" { LATE_3_0 } else { LATE };
        mutant.later.push_back(std::mem::take(frames));
        if mutant.later.len() > late {
            *frames = mutant.later.pop_front().unwrap_or_default();
        }
    }),
    mutant("answers-the-opposite", &["HS-5"], |mutant, frames| {
        let bit = mutant.get(frames, "handshake").unwrap_or(0);
        mutant.set(frames, "handshake", 1 - bit);
    }),
    mutant("answers-0", &["HS-5"], |mutant, frames| mutant.set(frames, "handshake", 0)),
    mutant("goes-silent-in-an-emergency", &["HS-5"], |mutant, frames| {
        if mutant.state == Some(AsState::EmergencyBrake) {
            frames.clear();
        }
    }),
    mutant("sends-a-reserved-identifier", &["ID-8"], |_, frames| frames.extend(Frame::new(0x301, &[0]))),
    mutant("sends-for-the-vcu", &["ID-20"], |_, frames| frames.extend(Frame::new(0x526, &[0; 8]))),
    mutant("brakes-and-drives", &["IMP-8"], |mutant, frames| {
        if mutant.state == Some(AsState::Driving) {
            mutant.set(frames, "hyd_press_f_req", 10);
            mutant.set(frames, "hyd_press_r_req", 10);
        }
    }),
    mutant("finishes-at-speed", &["FIN-3"], |mutant, frames| {
        if mutant.driven > 200 {
            mutant.set(frames, "mission_status", 3);
        }
    }),
    mutant("neutral-at-speed", &["DTE-5", "IMP-6"], |mutant, frames| {
        if mutant.driven > 200 {
            mutant.set(frames, "direction_request", 0);
        }
    }),
    mutant("reverses", &["D-32", "MSG-10"], |mutant, frames| {
        if mutant.driven > 200 {
            mutant.set(frames, "direction_request", 2);
        }
    }),
    mutant("too-much-front-torque", &["MSG-17"], |mutant, frames| {
        if mutant.driven > 100 {
            mutant.set(frames, "front_axle_trq_request", 2000);
        }
    }),
    mutant("too-much-rear-torque", &["MSG-21"], |mutant, frames| {
        if mutant.driven > 100 {
            mutant.set(frames, "rear_axle_trq_request", 1951);
        }
    }),
    mutant("too-fast-front-motor", &["MSG-19"], |mutant, frames| {
        mutant.set(frames, "front_motor_speed_max", 4001);
    }),
    mutant("too-fast-rear-motor", &["MSG-22"], |mutant, frames| {
        mutant.set(frames, "rear_motor_speed_max", 5000);
    }),
    mutant("steers-too-far", &["MSG-24", "MSG-99", "MSG-105"], |mutant, frames| {
        if mutant.driven > 100 {
            mutant.set(frames, "steer_request", -301);
        }
    }),
    mutant("brakes-too-much-in-front", &["MSG-27"], |mutant, frames| {
        if mutant.driven > 100 {
            mutant.set(frames, "hyd_press_f_req", 201);
        }
    }),
    mutant("brakes-too-much-behind", &["MSG-28"], |mutant, frames| {
        if mutant.driven > 100 {
            mutant.set(frames, "hyd_press_r_req", 255);
        }
    }),
    mutant("no-501h", &["MSG-1"], |_, frames| frames.retain(|frame| frame.id != 0x501)),
    mutant("no-510h", &["MSG-5", "HS-5", "RDY-7"], |_, frames| frames.retain(|frame| frame.id != 0x510)),
    mutant("no-511h", &["MSG-16"], |_, frames| frames.retain(|frame| frame.id != 0x511)),
    mutant("no-512h", &["MSG-20"], |_, frames| frames.retain(|frame| frame.id != 0x512)),
    mutant("no-513h", &["MSG-23"], |_, frames| frames.retain(|frame| frame.id != 0x513)),
    mutant("no-514h", &["MSG-26"], |_, frames| frames.retain(|frame| frame.id != 0x514)),
    mutant("loses-514h-for-a-while", &["HS-18", "MSG-98"], |mutant, frames| {
        if (100..120).contains(&mutant.driven) {
            frames.retain(|frame| frame.id != 0x514);
        }
    }),
    mutant("501h-rarely", &["MSG-102"], |mutant, frames| {
        if !mutant.steps.is_multiple_of(10) {
            frames.retain(|frame| frame.id != 0x501);
        }
    }),
    mutant("too-short", &["MSG-26"], |_, frames| {
        for frame in frames.iter_mut().filter(|frame| frame.id == 0x514) {
            frame.len = 1;
        }
    }),
    mutant("another-length", &["MSG-97", "MSG-113", "D-30"], |_, frames| {
        for frame in frames.iter_mut().filter(|frame| frame.id == 0x513) {
            frame.len = 7;
        }
    }),
    mutant("front-torque-in-ready", &["DRV-5"], |mutant, frames| {
        if mutant.state == Some(AsState::Ready) {
            mutant.set(frames, "front_axle_trq_request", 10);
        }
    }),
    mutant("rear-torque-in-ready", &["DRV-6"], |mutant, frames| {
        if mutant.state == Some(AsState::Ready) {
            mutant.set(frames, "rear_axle_trq_request", 1);
        }
    }),
    mutant("steers-in-ready", &["DRV-7"], |mutant, frames| {
        if mutant.state == Some(AsState::Ready) {
            mutant.set(frames, "steer_request", 20);
        }
    }),
    mutant("forward-in-ready", &["DRV-8"], |mutant, frames| {
        if mutant.state == Some(AsState::Ready) {
            mutant.set(frames, "direction_request", 1);
        }
    }),
    mutant("never-forward", &["DRV-10"], |mutant, frames| mutant.set(frames, "direction_request", 0)),
    mutant("never-finishes", &["FIN-1", "FIN-3"], |mutant, frames| {
        if mutant.get(frames, "mission_status") == Some(3) {
            mutant.set(frames, "mission_status", 2);
        }
    }),
    mutant("rolls-out", &["FIN-2"], |mutant, frames| {
        mutant.set(frames, "hyd_press_f_req", 0);
        mutant.set(frames, "hyd_press_r_req", 0);
        if mutant.has_moved && mutant.rpm == [0; 4] {
            mutant.set(frames, "mission_status", 3);
        }
    }),
    mutant("looks-at-one-wheel", &["FIN-3"], |mutant, frames| {
        if mutant.has_moved && mutant.rpm[0] < 10 && mutant.rpm[0] > 0 && mutant.braked > 0 {
            mutant.set(frames, "mission_status", 3);
        }
    }),
    mutant("drives-once", &["RDY-7"], |mutant, frames| {
        mutant.done |= mutant.state == Some(AsState::Finished);
        if mutant.done {
            mutant.set(frames, "mission_status", 3);
        }
    }),
    mutant("never-recovers", &["RDY-7"], |mutant, frames| {
        mutant.done |= mutant.state == Some(AsState::EmergencyBrake);
        if mutant.done {
            mutant.set(frames, "mission_status", 0);
        }
    }),
    mutant("one-mission-only", &["RDY-7"], |mutant, frames| {
        if mutant.ami != 4 {
            mutant.set(frames, "mission_status", 0);
        }
    }),
];

/// The reference AI Computer with one of these mistakes, or with none.
pub(crate) struct Mutant {
    reference: Reference,
    edition: Option<&'static Edition>,
    change: Option<fn(&mut Mutant, &mut Vec<Frame>)>,
    state: Option<AsState>,
    ami: i32,
    rpm: [i32; 4],
    has_moved: bool,
    /// For how many steps it has driven, and for how many braked.
    driven: u64,
    braked: u64,
    steps: u64,
    later: VecDeque<Vec<Frame>>,
    done: bool,
}

impl Mutant {
    pub(crate) fn new(name: &str) -> Self {
        Self {
            reference: Reference::default(),
            edition: None,
            change: MUTANTS.iter().find(|mutant| mutant.name == name).map(|mutant| mutant.change),
            state: None,
            ami: 0,
            rpm: [0; 4],
            has_moved: false,
            driven: 0,
            braked: 0,
            steps: 0,
            later: VecDeque::new(),
            done: false,
        }
    }

    fn edition(&self) -> &'static Edition {
        self.edition.unwrap_or(Edition::DEFAULT)
    }

    /// Gives a field of its messages another raw value.
    fn set(&self, frames: &mut [Frame], field: &str, raw: i32) {
        for frame in frames {
            let def = self.edition().bus.message(frame.id);
            if let Some(signal) = def.and_then(|def| def.signal_of(field)) {
                frame.data = signal.put(frame.data, raw);
            }
        }
    }

    fn get(&self, frames: &[Frame], field: &str) -> Option<i32> {
        frames.iter().find_map(|frame| {
            let signal = self.edition().bus.message(frame.id)?.signal_of(field)?;
            signal.raw(frame.data())
        })
    }

    fn hear(&mut self, frame: &Frame) {
        match self.edition().bus.decode(frame.id, frame.data()) {
            Ok(AnyMessage::Vcu2AiStatus(status)) => {
                if self.state != Some(status.as_state) {
                    (self.has_moved, self.driven, self.braked) = (false, 0, 0);
                }
                self.state = Some(status.as_state);
                self.ami = status.ami_state.raw();
            }
            Ok(AnyMessage::Vcu2AiWheelSpeeds(speeds)) => {
                let all = [
                    speeds.fl_wheel_speed,
                    speeds.fr_wheel_speed,
                    speeds.rl_wheel_speed,
                    speeds.rr_wheel_speed,
                ];
                self.rpm = all.map(WheelSpeed::raw);
                self.has_moved |= self.state == Some(AsState::Driving) && self.rpm[2] > 10;
            }
            _ => {}
        }
    }
}

impl Stack for Mutant {
    fn hello(&mut self, edition: &Edition) -> Result<(), StackError> {
        self.edition = Edition::ALL.iter().copied().find(|one| one.version == edition.version);
        self.reference.hello(edition)
    }

    fn reset(&mut self) -> Result<(), StackError> {
        let (edition, change) = (self.edition, self.change);
        let mut reference = self.reference.clone();
        reference.reset()?;
        *self = Self { reference, edition, change, ..Self::new("") };
        Ok(())
    }

    fn step(&mut self, time_ms: u64, frames: &[Frame]) -> Result<Vec<Frame>, StackError> {
        for frame in frames {
            self.hear(frame);
        }
        self.steps += 1;
        self.driven += u64::from(self.state == Some(AsState::Driving));
        let mut sent = self.reference.step(time_ms, frames)?;
        self.braked += u64::from(self.get(&sent, "hyd_press_f_req").is_some_and(|raw| raw > 0));
        if let Some(change) = self.change {
            change(self, &mut sent);
        }
        Ok(sent)
    }
}
