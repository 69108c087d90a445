//! The operations of which a run consists, and how they are drawn.

use std::{fmt, iter};

use adsdv_conform::protocol::{Domain, INPUTS, InputField, Protocol, Value};
use adsdv_spec::messages::{AmiState, AsState, DirectionRequest, EbsState, MissionStatus, SignalValue as _};
use adsdv_spec::{Edition, Inputs, Readings};
use proptest::prelude::{Just, Strategy, any, prop_oneof};
use proptest::strategy::Union;
use proptest::{bool, collection, sample};

/// The part of the inputs that says how long the AI Computer's messages have been missing.
pub(crate) const SILENCES: &str = "ai_silence";

/// Something short that happens in a run.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Operation {
    /// Somebody sets one input of the VCU to a raw value.
    Set(&'static InputField, i32),
    /// All wheels turn this fast.
    Wheels(i32),
    /// The AI Computer answers the handshake from now on, or does not.
    Answers(bool),
    /// The VCU's power is switched off and on.
    PowerCycle,
    /// So many milliseconds pass.
    Wait(u32),
}

impl Operation {
    /// Sets the input of this name.
    pub(crate) fn set(key: &str, raw: i32) -> Self {
        let field = INPUTS.iter().find(|field| field.key == key);
        Self::Set(field.unwrap_or_else(|| panic!("{key} is an input")), raw)
    }

    /// Does what it is to the inputs, if it is something that is done to them.
    pub(crate) fn act(self, inputs: &mut Inputs) {
        match self {
            Self::Set(field, raw) => assert!((field.set)(inputs, raw), "{self} can be"),
            Self::Wheels(rpm) => {
                let wheels = INPUTS.iter().filter(|field| field.part == "vehicle.wheel_speeds");
                wheels.for_each(|field| assert!((field.set)(inputs, rpm), "{self} can be"));
            }
            Self::Answers(_) | Self::PowerCycle | Self::Wait(_) => {}
        }
    }

    /// Who does it; nobody lets time pass.
    pub(crate) fn actor(self) -> Option<Actor> {
        match self {
            Self::Set(InputField { part: "" | "sdc" | "reports", .. }, _) | Self::PowerCycle => {
                Some(Actor::Operator)
            }
            Self::Set(InputField { part: "vehicle" | "vehicle.wheel_speeds", .. }, _) | Self::Wheels(_) => {
                Some(Actor::Vehicle)
            }
            Self::Set(..) | Self::Answers(_) => Some(Actor::Ai),
            Self::Wait(_) => None,
        }
    }
}

/// Who does something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Actor {
    /// The operator, or the world around the car: what a scenario's line can do.
    Operator,
    Ai,
    Vehicle,
}

/// In the words of a scenario, where it has them.
impl fmt::Display for Operation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Set(field @ InputField { domain: Domain::Flag, .. }, raw) => {
                write!(f, "{} {}", field.key, if *raw == 0 { "off" } else { "on" })
            }
            Self::Set(field, raw) => {
                write!(f, "{} {}", field.key, Value { domain: field.domain, raw: Some(*raw) })
            }
            Self::Wheels(rpm) => write!(f, "all wheels {rpm}"),
            Self::Answers(true) => f.write_str("answers the handshake"),
            Self::Answers(false) => f.write_str("answers the handshake no more"),
            Self::PowerCycle => f.write_str("power cycle"),
            Self::Wait(ms) => write!(f, "wait {ms} ms"),
        }
    }
}

/// A whole run.
#[derive(Clone)]
pub(crate) struct Run {
    /// The edition of the interface, which every number here comes from.
    pub(crate) edition: &'static Edition,
    /// The answers to the open questions.
    pub(crate) readings: Readings,
    /// The time between two steps of the VCU, in milliseconds.
    pub(crate) cycle_ms: u32,
    /// What happens, in order. What happens at once is seen at the same step.
    pub(crate) operations: Vec<Operation>,
}

/// Briefly, for the file of what has failed; the timeline shows it to people.
impl fmt::Debug for Run {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { edition, readings, cycle_ms, operations } = self;
        write!(f, "edition {}, readings [{readings}], a step every {cycle_ms} ms:", edition.version)?;
        operations.iter().try_for_each(|operation| write!(f, " {operation};"))
    }
}

/// A cycle or two.
fn soon(edition: &Edition) -> Operation {
    Operation::Wait(u32::from(edition.rules.timing.cycle_ms) * 2)
}

/// AS_READY lasts for this long.
fn ready_dwell(edition: &Edition) -> Operation {
    Operation::Wait(edition.rules.timing.ready_dwell_ms.into())
}

/// What ends a mission, and how it is undone: each fault alone, and what is done at once with it where the order of the arrows
/// counts. Nothing is the way to AS_FINISHED.
fn stops(edition: &Edition) -> Vec<[Vec<Operation>; 2]> {
    let set = Operation::set;
    let faults = INPUTS.iter().filter(|field| matches!(field.part, "sdc" | "reports"));
    let faults = faults.map(|field| [vec![Operation::Set(field, 1)], vec![Operation::Set(field, 0)]]);
    let finished = set("mission_status", MissionStatus::Finished.to_raw());
    let neutral = set("direction_request", DirectionRequest::Neutral.to_raw());
    let moving = Operation::Wheels(edition.rules.thresholds.wheel_speed.raw() + 1);
    let at_rest = Operation::Wheels(edition.rules.thresholds.wheel_speed.raw() - 1);
    let (soon, ready_dwell) = (soon(edition), ready_dwell(edition));
    let newer = edition.rules.thresholds.missed_ms.map(newer_stops);
    iter::once([vec![], vec![]])
        .chain(faults)
        .chain(newer.into_iter().flatten())
        .chain([
            [vec![set("estop_request", 1)], vec![set("estop_request", 0)]],
            [vec![Operation::Answers(false)], vec![Operation::Answers(true)]],
            [vec![moving, soon, finished], vec![at_rest]],
            [vec![moving, soon, neutral], vec![at_rest]],
            [vec![at_rest, finished, set("go", 0)], vec![]],
            [vec![set("remote_estop", 1), set("asms", 0)], vec![set("remote_estop", 0)]],
            [vec![ready_dwell, soon, set("go", 1), set("asms", 0)], vec![]],
        ])
        .collect()
}

/// What ends a mission since version 4.0 alone: a message that is missed, an EBS that is not there, and torque of either axle with
/// either brake.
fn newer_stops(missed_ms: u16) -> Vec<[Vec<Operation>; 2]> {
    let set = Operation::set;
    let missed = INPUTS.iter().filter(|field| field.part == SILENCES);
    let missed =
        missed.map(|field| [vec![Operation::Set(field, missed_ms.into())], vec![Operation::Set(field, 0)]]);
    let ebs = |state: EbsState| vec![set("ebs", state.to_raw())];
    let axles = ["front_axle_trq_request", "rear_axle_trq_request"];
    let brakes = ["hyd_press_f_req", "hyd_press_r_req"];
    let both = axles.into_iter().flat_map(|axle| {
        brakes.map(|brake| [vec![set(axle, 1), set(brake, 1)], vec![set(axle, 0), set(brake, 0)]])
    });
    missed.chain([[ebs(EbsState::Unavailable), ebs(EbsState::Armed)]]).chain(both).collect()
}

/// What everybody does, in order, from AS_OFF to AS_OFF: a mission that comes so far, and is stopped there.
fn mission(edition: &Edition, upto: AsState, [stop, undo]: &[Vec<Operation>; 2]) -> Vec<Operation> {
    let set = Operation::set;
    let (soon, ready_dwell) = (soon(edition), ready_dwell(edition));
    let ready = [
        set("tsms", 1),
        set("ami", AmiState::TrackDrive.to_raw()),
        set("ebs", EbsState::Armed.to_raw()),
        set("direction_request", DirectionRequest::Neutral.to_raw()),
        set("mission_status", MissionStatus::Selected.to_raw()),
        set("asms", 1),
        soon,
    ];
    let driving = [
        // Only just straight.
        set("steer_angle", edition.rules.thresholds.straight.raw() - 1),
        ready_dwell,
        set("go", 1),
        soon,
        set("mission_status", MissionStatus::Running.to_raw()),
        set("direction_request", DirectionRequest::Forward.to_raw()),
        set("front_axle_trq_request", 100),
        soon,
        set("front_axle_trq_request", 0),
    ];
    let finished = [set("mission_status", MissionStatus::Finished.to_raw()), soon];
    let way: &[&[Operation]] = match upto {
        AsState::Ready => &[&ready],
        AsState::Driving => &[&ready, &driving],
        _ => &[&ready, &driving, &finished],
    };
    let ebs_timer = Operation::Wait(edition.rules.timing.ebs_timer_ms.into());
    let off = [set("go", 0), set("asms", 0), soon];
    [&way.concat(), stop, &[soon][..], undo, &[ebs_timer], &off].concat()
}

/// The raw values of an input that are worth trying: every value of a switch, the edge of a range or of a threshold.
fn values(edition: &Edition, field: &InputField, domain: Domain) -> Vec<i32> {
    match domain {
        Domain::Flag => vec![0, 1],
        Domain::Names(names) => names.iter().map(|&(raw, _)| raw).collect(),
        Domain::Number { min, max } => {
            let threshold = match field.part {
                "vehicle" => edition.rules.thresholds.straight.raw(),
                "vehicle.wheel_speeds" => edition.rules.thresholds.wheel_speed.raw(),
                SILENCES => edition.rules.thresholds.missed_ms.map_or(1, i32::from),
                _ => 1,
            };
            let near =
                [0, threshold - 1, threshold, threshold + 1, 1 - threshold, -threshold, -threshold - 1];
            let mut values: Vec<i32> = near.into_iter().filter(|raw| (min..=max).contains(raw)).collect();
            values.dedup();
            values
        }
    }
}

/// Times that are worth waiting for, the shortest first: a little, and each limit of the document, just missed and just met.
fn waits(edition: &Edition) -> Vec<u32> {
    let timing = &edition.rules.timing;
    let limits = [timing.handshake_ms, timing.ready_dwell_ms, timing.ebs_timer_ms].map(u32::from);
    let near = limits.into_iter().flat_map(|limit| [limit - 1, limit, limit + 1]);
    [1, timing.cycle_ms.into()].into_iter().chain(near).collect()
}

/// Anything that anybody may do.
fn anything(edition: &'static Edition) -> impl Strategy<Value = Operation> {
    let protocol = Protocol::of(edition);
    let inputs = || protocol.inputs().map(|(field, _)| field);
    // The bit of the handshake is the AI Computer's to answer with.
    let fields: Vec<_> = inputs().filter(|field| field.key != "handshake").collect();
    let any_field = sample::select(fields).prop_flat_map(|field| set_to_any(edition, field));
    let often = ["asms", "go", "mission_status", "direction_request"];
    let often: Vec<_> = inputs().filter(|field| often.contains(&field.key)).collect();
    let wheel_speed = edition.rules.thresholds.wheel_speed.raw();
    prop_oneof![
        5 => sample::select(waits(edition)).prop_map(Operation::Wait),
        5 => any_field,
        3 => sample::select(often).prop_flat_map(|field| set_to_any(edition, field)),
        1 => (wheel_speed - 1..=wheel_speed + 1).prop_map(Operation::Wheels),
        1 => any::<bool>().prop_map(Operation::Answers),
        1 => Just(Operation::PowerCycle),
    ]
}

fn set_to_any(edition: &Edition, field: &'static InputField) -> impl Strategy<Value = Operation> + use<> {
    let domain = Protocol::of(edition).inputs().find(|(other, _)| other.key == field.key);
    let (_, domain) = domain.expect("the edition has it");
    sample::select(values(edition, field, domain)).prop_map(move |raw| Operation::Set(field, raw))
}

/// Part of the way of a mission, now and then with a step of it left out or done otherwise, or with something else in between.
fn part_of(edition: &'static Edition, mission: Vec<Operation>) -> impl Strategy<Value = Vec<Operation>> {
    let steps = mission.len();
    let along: Vec<_> = mission
        .into_iter()
        .map(|operation| {
            let often = if matches!(operation, Operation::Wait(_)) { 0.9 } else { 0.98 };
            let between = prop_oneof![
                9 => Just(Vec::new()),
                1 => collection::vec(anything(edition), 0..4),
            ];
            (bool::weighted(often), mostly(edition, operation), between)
        })
        .collect();
    let upto = prop_oneof![0..=steps, Just(steps)];
    (along, upto, collection::vec(anything(edition), 0..6)).prop_map(|(along, upto, then)| {
        let along = along.into_iter().take(upto).flat_map(|(is_done, operation, between)| {
            is_done.then_some(operation).into_iter().chain(between)
        });
        along.chain(then).collect()
    })
}

/// Mostly this operation; now and then the same input is set to something else.
fn mostly(edition: &Edition, operation: Operation) -> impl Strategy<Value = Operation> + use<> {
    match operation {
        Operation::Set(field, _) => {
            prop_oneof![24 => Just(operation), 1 => set_to_any(edition, field)].boxed()
        }
        _ => Just(operation).boxed(),
    }
}

/// A few missions, one after the other, with a power cycle between them or without.
fn operations(edition: &'static Edition) -> impl Strategy<Value = Vec<Operation>> {
    let stops = stops(edition);
    let upto = [AsState::Ready, AsState::Driving, AsState::Finished];
    let missions = stops.iter().flat_map(|stop| {
        // There are many causes of an emergency, and few cases in which the order of the arrows counts.
        let weight = if stop.iter().flatten().count() > 2 { 3 } else { 1 };
        upto.map(|upto| (weight, part_of(edition, mission(edition, upto, stop))))
    });
    let any_mission = Union::new_weighted(missions.collect());
    let power = any::<bool>().prop_map(|cycled| cycled.then_some(Operation::PowerCycle));
    collection::vec((any_mission, power), 1..4).prop_map(|missions| {
        missions.into_iter().flat_map(|(mission, power)| mission.into_iter().chain(power)).collect()
    })
}

/// Any run, of a VCU of any edition with any readings.
pub(crate) fn runs() -> impl Strategy<Value = Run> {
    Union::new(Edition::ALL.iter().map(|edition| runs_of(edition)))
}

/// Any run, of a VCU of this edition with any readings.
pub(crate) fn runs_of(edition: &'static Edition) -> impl Strategy<Value = Run> {
    let readings =
        prop_oneof![Just(edition.readings), any::<Readings>().prop_map(|readings| edition.admit(readings))];
    let cycle_ms = prop_oneof![Just(u32::from(edition.rules.timing.cycle_ms)), Just(1), 2..=20_u32];
    (readings, cycle_ms, operations(edition)).prop_map(move |(readings, cycle_ms, operations)| Run {
        edition,
        readings,
        cycle_ms,
        operations,
    })
}
