//! The car and the small AI Computer of any edition, and what watches a bus: any frames at any times, any switches.

use adsdv_can::ai::{Ai, Plan};
use adsdv_can::bus::{Disturbance, Received};
use adsdv_can::car::{Action, Car, Switch, missing_for};
use adsdv_can::live::Watch;
use adsdv_oracle::candump::FrameKind;
use adsdv_oracle::judge::JudgeOptions;
use adsdv_oracle::log::LogOptions;
use adsdv_oracle::remote::Remote;
use adsdv_spec::messages::{AnyMessage, AsState, Frame, MessageDef, Node, Vcu2LogStatus, WheelSpeed};
use adsdv_spec::{Bus, Edition, Machine, Rules};

use super::Bytes;
use crate::world::Chance;

/// Nothing goes on for longer than this many times.
const TURNS: u32 = 3000;

/// The body.
pub fn body(bytes: &[u8]) {
    reached(bytes);
}

/// A state that a VCU comes to, and the edition.
pub type Reached = (&'static str, AsState);

/// Runs the body; the states that the VCU comes to.
pub fn reached(bytes: &[u8]) -> Vec<Reached> {
    let mut reached = Vec::new();
    let mut bytes = Bytes::new(bytes);
    let edition = bytes.edition();
    let bus = &edition.bus;
    let readings = bytes.readings(edition);
    let mut car = Car::new(Machine::new(*edition, readings));
    let mut ai = Ai::new(edition, Plan::DEFAULT);
    let options = LogOptions { judge: JudgeOptions::of(edition), ..LogOptions::default() };
    let mut watch = Watch::new("can0", options);
    let switches: Vec<Switch> = Switch::all().collect();
    let mut time_ns: i64 = 1_000_000_000_000;
    let mut turns = 0;
    while bytes.are_left() && turns < TURNS {
        turns += 1;
        match bytes.below(8) {
            0 => {
                let switch = bytes.pick(&switches);
                let raw = if bytes.one_in(4) { bytes.any() } else { bytes.pick(&switch.positions()) };
                let before = switch.get(car.inputs());
                car.act(&Action::Set(switch, raw));
                let now = switch.get(car.inputs());
                let there = switch.positions().contains(&raw);
                assert_eq!(now, if there { raw } else { before }, "{} {raw}", switch.key());
            }
            1 if bytes.one_in(8) => car.act(&Action::PowerCycle),
            2 => {
                let frame = frame(bus, &mut bytes);
                let known = bus.decode(frame.id, frame.data());
                if let Err(error) = car.receive(&frame) {
                    assert_eq!(known, Err(error));
                }
                if let Err(error) = ai.receive(&frame) {
                    assert_eq!(known, Err(error));
                }
            }
            3 => seen(&mut watch, &mut bytes, time_ns),
            4 => {
                let wanted = bytes.pick(&AsState::ALL);
                let conditions = missing_for(&car, wanted).map(|missing| missing.conditions);
                for condition in conditions.unwrap_or_default() {
                    assert!(!condition.to_string().is_empty());
                    condition.action.iter().for_each(|action| car.act(action));
                }
            }
            _ => {
                let cycle_ms = car.cycle_ms();
                let dt_ms = match bytes.below(8) {
                    0 => bytes.any(),
                    1 => u32::try_from(bytes.below(20_000)).unwrap_or(0),
                    _ => cycle_ms,
                };
                for _ in 0..=bytes.below(16) {
                    let state = together(&mut car, &mut ai, &mut watch, time_ns, dt_ms);
                    let state = state.map(|state| (edition.version, state));
                    reached.extend(state.filter(|state| reached.last() != Some(state)));
                    time_ns = time_ns.saturating_add(i64::from(dt_ms) * 1_000_000);
                }
            }
        }
    }
    let _ = (watch.traffic(), watch.outages().len());
    if let Err(error) = watch.finish() {
        assert!(!error.to_string().is_empty());
    }
    reached
}

/// A cycle of both, and the bus between them; the state that the VCU is in then.
fn together(car: &mut Car, ai: &mut Ai, watch: &mut Watch, time_ns: i64, dt_ms: u32) -> Option<AsState> {
    let before = car.vehicle().distance_m();
    let cycle = car.cycle(dt_ms);
    let Edition { rules: Rules { timing, .. }, bus, .. } = *car.machine().edition();
    assert!(car.control().is_consistent(&timing, car.machine().readings()), "{:?}", car.control());
    assert_eq!(cycle.state(), cycle.outputs.map(|_| car.control().state));
    let each_cycle = |def: &&&MessageDef| def.sender == Node::Vcu && def.cycle_ms <= timing.cycle_ms;
    let least = bus.messages.iter().filter(each_cycle).count();
    assert!(cycle.frames.len() >= least || cycle.state().is_none(), "{} frames", cycle.frames.len());
    let (speed, distance) = (car.vehicle().speed_mps(), car.vehicle().distance_m());
    assert!(speed.is_finite() && speed >= 0.0, "{speed} m/s");
    assert!(distance.is_finite() && distance >= before, "{before} m, and then {distance} m");
    let wheels = car.inputs().vehicle.wheel_speeds;
    assert!(wheels.fl_wheel_speed <= WheelSpeed::MAX && wheels.rr_wheel_speed <= WheelSpeed::MAX);
    for frame in &cycle.frames {
        // The switches of the remote control are the operator's, as those of the car.
        if Remote::of(&bus).is_none_or(|remote| remote.message().id != frame.id) {
            sent(&bus, frame, Node::Vcu);
        }
        assert!(ai.receive(frame).is_ok());
        heard(watch, time_ns, frame);
    }
    for frame in ai.cycle(dt_ms) {
        sent(&bus, &frame, Node::Ai);
        assert!(car.receive(&frame).is_ok());
        heard(watch, time_ns, &frame);
    }
    watch.news();
    cycle.state()
}

/// Each node sends what is its own, and what can be read.
fn sent(bus: &Bus, frame: &Frame, node: Node) {
    assert!(bus.may_send(node, frame.id), "{frame}");
    let message = bus.decode(frame.id, frame.data()).expect("what is sent can be read");
    assert_eq!(message.sender(), node);
    assert!(frame.id != Vcu2LogStatus::ID || node == Node::Vcu);
}

fn heard(watch: &mut Watch, time_ns: i64, frame: &Frame) {
    let mut data = [0; 8];
    for (place, byte) in data.iter_mut().zip(frame.data()) {
        *place = *byte;
    }
    let len = u8::try_from(frame.data().len()).unwrap_or(8);
    watch.frame(&Received { time_ns, kind: FrameKind::Standard, id: frame.id.into(), len, data });
}

/// Anything that a bus may tell.
fn seen(watch: &mut Watch, bytes: &mut Bytes<'_>, now_ns: i64) {
    let time_ns = if bytes.one_in(4) { bytes.any() } else { now_ns };
    match bytes.below(7) {
        0 => watch.silence(time_ns),
        1 => {
            let troubles = [Disturbance::Down, Disturbance::Gone, Disturbance::BusOff, Disturbance::Full];
            watch.trouble(time_ns, &troubles[usize::from(bytes.any::<u8>()) % troubles.len()]);
        }
        2 => watch.up(time_ns),
        3 => drop(watch.dropped(bytes.any())),
        4 => {
            let received = Received::of_can_frame(time_ns, bytes.any());
            assert!(received.id <= received.kind.max_id() && received.len <= 8, "{received:?}");
            watch.frame(&received);
        }
        _ => {
            let (extended, len) = (bytes.any(), bytes.any());
            let kind = match bytes.below(8) {
                0 => FrameKind::Extended,
                1 => FrameKind::Error,
                2 => FrameKind::Remote { extended, len },
                3 => FrameKind::Fd { extended, flags: len },
                4 => FrameKind::Xl,
                _ => FrameKind::Standard,
            };
            let received = Received { time_ns, kind, id: bytes.any(), len: bytes.any(), data: bytes.any() };
            let logged = watch.frame(&received);
            assert!(logged.time_ns >= 0 && logged.data().len() <= 8);
            assert!(received.frame().is_none_or(|frame| frame.is_valid()));
        }
    }
}

fn frame(bus: &Bus, bytes: &mut Bytes<'_>) -> Frame {
    if bytes.one_in(2)
        && let Ok(message) = bytes.0.arbitrary::<AnyMessage>()
        && let Some(frame) = bus.encode(message)
    {
        return frame;
    }
    let id = if bytes.one_in(4) { bytes.any::<u16>() & 0x7FF } else { bytes.pick(bus.messages).id };
    Frame::new(id, bytes.some(8)).expect("the identifier and the length are those of a frame")
}
