//! What happens in each run.

use adsdv_oracle::judge::JudgeOptions;
use adsdv_oracle::remote::Remote;
use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuStatus, Ai2VcuSteer, AmiState, AsState, AxleTorqueRequest, BrakePressure,
    DirectionRequest, EbsState, MissionStatus, Node, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelSpeeds,
    Vcu2LogStatus, WheelSpeed,
};
use adsdv_spec::{AiMessages, Atom, Choice, Choices, Edition, Machine};
use adsdv_tests::bus::def_of;
use adsdv_tests::world::{MS, Recorded, World};

/// A run, and its recording.
pub(crate) struct Run {
    pub(crate) name: String,
    pub(crate) world: World,
    pub(crate) log: Vec<Recorded>,
    pub(crate) options: JudgeOptions,
    /// Whether the VCU follows the document, and the recording is as the bus was.
    pub(crate) honest: bool,
}

/// Something that happens to a vehicle.
type Happens = fn(&mut World);

/// What the recorder makes of it.
type Recorder = fn(&mut Vec<Recorded>);

/// All runs.
pub(crate) fn runs() -> Vec<Run> {
    let honest = HONEST.iter().map(|&(name, happens)| run(name, &Edition::V3_0, &[], happens, true));
    let wrong = WRONG.iter().map(|&(name, happens)| run(name, &Edition::V3_0, &[], happens, false));
    let read =
        READ.iter().map(|&(name, pin, happens, honest)| run(name, &Edition::V3_0, &[pin], happens, honest));
    let newer =
        NEWER.iter().map(|&(name, edition, happens, honest)| run(name, edition, &[], happens, honest));
    let recorded = RECORDED.iter().map(|&(name, recorder)| {
        let mut run = run(name, &Edition::V3_0, &[], mission, false);
        recorder(&mut run.log);
        run
    });
    honest.chain(wrong).chain(read).chain(newer).chain(recorded).collect()
}

/// A run of a VCU that follows these choices, of which the judge knows.
fn run(name: &str, edition: &'static Edition, pins: &[Choice], happens: Happens, honest: bool) -> Run {
    let readings = pins.iter().fold(edition.readings, |readings, &pin| readings.with(pin));
    let mut world = World::new(Machine::new(*edition, readings));
    happens(&mut world);
    let open = JudgeOptions::of(edition);
    let readings = pins.iter().copied().fold(open.readings, Choices::pin);
    let (name, log) = (name.to_owned(), world.log.clone());
    Run { name, log, world, options: JudgeOptions { readings, ..open }, honest }
}

/// Another car on the same bus, so many milliseconds behind.
fn another_car(log: &mut Vec<Recorded>, happens: Happens, behind_ms: i64) {
    let mut other = World::reference();
    happens(&mut other);
    let later = |recorded: &Recorded| Recorded { t: recorded.t + behind_ms * MS + MS / 8, ..*recorded };
    log.extend(other.log.iter().map(later));
    log.sort_by_key(|recorded| recorded.t);
}

/// From AS_OFF to AS_OFF, through AS_FINISHED.
fn mission(world: &mut World) {
    world.finished();
    (world.inputs.asms, world.inputs.go) = (false, false);
    world.wait(500);
}

/// Something happens in AS_DRIVING, at rest.
fn stopped(world: &mut World, happens: Happens) {
    world.stopped();
    happens(world);
    world.wait(500);
}

/// Something happens in AS_DRIVING, at speed.
fn driving(world: &mut World, happens: Happens) {
    world.driving();
    happens(world);
    world.wait(500);
}

/// The VCU goes to a state in which nothing happens for a while.
fn forced(world: &mut World, to: AsState) {
    world.force(to);
    world.wait(300);
}

/// The VCU shows something that is not so.
fn shows(world: &mut World, lie: fn(&mut Vcu2AiStatus)) {
    world.stopped();
    world.shows = lie;
    world.wait(300);
}

/// A VCU that follows the document.
const HONEST: [(&str, Happens); 27] = [
    ("AS_OFF, and all switches stay off", |world| world.wait(1000)),
    ("a whole mission", mission),
    ("a mission that ends by the remote E-stop, and a power cycle is needed", World::after_emergency),
    ("AS_OFF: no mission status", |world| {
        world.prepare();
        world.ai.status.mission_status = MissionStatus::NotSelected;
        world.wait(100);
        world.inputs.asms = true;
        world.wait(1000);
    }),
    ("AS_READY: ASMS off", |world| {
        world.ready();
        world.inputs.asms = false;
        world.wait(500);
    }),
    ("AS_READY: torque is requested when \"Go\" comes", |world| {
        world.dwelt();
        world.ai.drive_f.front_axle_trq_request = AxleTorqueRequest::clamped(100);
        world.wait(200);
        world.inputs.go = true;
        world.wait(500);
    }),
    ("AS_READY: \"Go\" before the five seconds are over", |world| {
        world.ready();
        world.inputs.go = true;
        world.wait(6000);
    }),
    ("AS_READY: the remote E-stop", |world| {
        world.ready();
        world.inputs.sdc.remote_estop = true;
        world.wait(500);
    }),
    ("AS_DRIVING: \"Go\" off", |world| driving(world, |world| world.inputs.go = false)),
    ("AS_DRIVING: ASMS off", |world| driving(world, |world| world.inputs.asms = false)),
    ("AS_DRIVING: the remote E-stop", |world| driving(world, |world| world.inputs.sdc.remote_estop = true)),
    ("AS_DRIVING: the AI Computer asks for an emergency stop", |world| {
        driving(world, |world| world.set(Atom::AiEstop, true));
    }),
    ("AS_DRIVING: FINISHED at speed", |world| {
        driving(world, |world| world.ai.status.mission_status = MissionStatus::Finished);
    }),
    ("AS_DRIVING: NEUTRAL at speed", |world| {
        driving(world, |world| world.ai.status.direction_request = DirectionRequest::Neutral);
    }),
    ("AS_DRIVING: FINISHED from SELECTED at speed", |world| {
        driving(world, |world| world.ai.status.mission_status = MissionStatus::Selected);
        world.ai.status.mission_status = MissionStatus::Finished;
        world.wait(500);
    }),
    ("AS_DRIVING: NEUTRAL, one wheel at rest, three at 400 rpm", |world| {
        driving(world, |world| {
            world.wheels(400);
            world.inputs.vehicle.wheel_speeds.fl_wheel_speed = WheelSpeed::clamped(0);
        });
        world.ai.status.direction_request = DirectionRequest::Neutral;
        world.wait(500);
    }),
    ("AS_DRIVING: the handshake is answered after 20 ms", |world| {
        driving(world, |world| {
            world.ai_answers = false;
            world.wait(20);
            world.ai_answers = true;
        });
    }),
    ("AS_DRIVING: the handshake is answered after 100 ms", |world| {
        driving(world, |world| {
            world.ai_answers = false;
            world.wait(100);
            world.ai_answers = true;
        });
    }),
    ("AS_DRIVING: the AI Computer falls silent", |world| driving(world, |world| world.ai_sends = false)),
    ("AS_DRIVING: the AI Computer restarts", |world| {
        driving(world, |world| {
            world.ai_sends = false;
            world.wait(2000);
            world.ai = AiMessages::default();
            world.ai_sends = true;
        });
    }),
    ("AS_DRIVING: a fault of the battery opens the circuit", |world| {
        driving(world, |world| world.inputs.sdc.bms_fault = true);
    }),
    ("AS_FINISHED: the remote E-stop", |world| {
        world.finished();
        world.inputs.sdc.remote_estop = true;
        world.wait(500);
    }),
    ("AS_FINISHED: the handshake is lost", |world| {
        world.finished();
        world.ai_answers = false;
        world.wait(500);
    }),
    ("EMERGENCY_BRAKE: ASMS off before the EBS timer is over", |world| {
        world.braking();
        world.inputs.asms = false;
        world.wait(500);
    }),
    ("AS_OFF: the AI Computer is never heard", |world| {
        world.ai_sends = false;
        world.wait(500);
        world.inputs.tsms = true;
        world.wait(1000);
    }),
    ("AS_READY and AS_OFF in turn", |world| {
        world.ready();
        for _ in 0..5 {
            world.inputs.asms = !world.inputs.asms;
            world.wait(200);
        }
    }),
    ("AS_DRIVING: a warning of the battery", |world| {
        driving(world, |world| world.inputs.reports.batt_soc_low = true);
    }),
];

/// A VCU that does something else.
const WRONG: [(&str, Happens); 20] = [
    ("AS_OFF is not left", |world| {
        world.prepare();
        world.hold_state();
        world.inputs.asms = true;
        world.wait(500);
    }),
    ("AS_READY though ASMS is off", |world| {
        world.prepare();
        forced(world, AsState::Ready);
    }),
    ("AS_READY though the EBS is not armed", |world| {
        world.prepare();
        world.inputs.ebs = EbsState::Unavailable;
        world.inputs.asms = true;
        world.wait(500);
        forced(world, AsState::Ready);
    }),
    ("AS_OFF -> AS_DRIVING", |world| {
        world.prepare();
        forced(world, AsState::Driving);
    }),
    ("AS_READY is left too early", |world| {
        world.ready();
        world.inputs.go = true;
        forced(world, AsState::Driving);
    }),
    ("AS_READY is not left though ASMS is off", |world| {
        world.ready();
        world.hold_state();
        world.inputs.asms = false;
        world.wait(500);
    }),
    ("AS_DRIVING goes on though FINISHED at rest", |world| {
        stopped(world, |world| {
            world.hold_state();
            world.ai.status.mission_status = MissionStatus::Finished;
        });
    }),
    ("AS_DRIVING goes on though FINISHED at speed", |world| {
        driving(world, |world| {
            world.hold_state();
            world.ai.status.mission_status = MissionStatus::Finished;
        });
    }),
    ("AS_DRIVING goes on though an emergency stop is asked for, and no flag shows it", |world| {
        stopped(world, |world| {
            world.hold_state();
            world.shows = |status| status.ai_estop_request = false;
            world.set(Atom::AiEstop, true);
        });
    }),
    ("AS_DRIVING goes on though the handshake is lost, and no flag shows it", |world| {
        driving(world, |world| {
            world.hold_state();
            world.shows = |status| (status.ai_comms_lost, status.fault_status) = (false, false);
            world.ai_answers = false;
        });
    }),
    ("AS_FINISHED at speed", |world| {
        world.driving();
        world.ai.status.mission_status = MissionStatus::Finished;
        forced(world, AsState::Finished);
    }),
    ("AS_FINISHED -> AS_READY", |world| {
        world.finished();
        forced(world, AsState::Ready);
    }),
    ("EMERGENCY_BRAKE is left before the EBS timer is over", |world| {
        world.braking();
        world.inputs.asms = false;
        world.wait(200);
        forced(world, AsState::Off);
    }),
    ("EMERGENCY_BRAKE is not left though all is done", |world| {
        world.braking();
        world.wait(15_000);
        world.hold_state();
        world.inputs.asms = false;
        world.wait(500);
    }),
    ("AI_ESTOP_REQUEST that nobody made", |world| shows(world, |status| status.ai_estop_request = true)),
    ("MISSION_STATUS_FAULT at rest", |world| {
        shows(world, |status| (status.mission_status_fault, status.fault_status) = (true, true));
    }),
    ("AI_COMMS_LOST though the handshake is answered", |world| {
        world.driving();
        world.hold_state();
        world.shows = |status| (status.ai_comms_lost, status.fault_status) = (true, true);
        world.wait(300);
    }),
    ("FAULT_STATUS is 0 though a fault is shown", |world| {
        world.stopped();
        world.inputs.reports.hvil_short = true;
        world.shows = |status| status.fault_status = false;
        world.wait(300);
    }),
    ("502h shows another state", |world| {
        world.stopped();
        let since = world.t;
        world.wait(1000);
        world.falsify(def_of::<Vcu2LogStatus>(), "State_ASSI", since, AsState::Ready as i32);
    }),
    ("HANDSHAKE stays 0", |world| shows(world, |status| status.handshake = false)),
];

/// What depends on a reading that the judge knows.
const READ: [(&str, Choice, Happens, bool); 4] = [
    (
        "FINISHED from SELECTED at speed, where the change counts",
        Choice::FaultEdge,
        |world| {
            driving(world, |world| world.ai.status.mission_status = MissionStatus::Selected);
            world.ai.status.mission_status = MissionStatus::Finished;
            world.wait(500);
        },
        true,
    ),
    (
        "\"Go\" since before AS_READY, and AS_DRIVING, where GO_SIGNAL is the switch",
        Choice::GoRaw,
        |world| {
            world.prepare();
            world.inputs.go = true;
            world.wait(200);
            world.inputs.asms = true;
            world.wait(6000);
            forced(world, AsState::Driving);
        },
        false,
    ),
    (
        "\"Go\" is passed over, where GO_SIGNAL is the switch",
        Choice::GoRaw,
        |world| {
            world.dwelt();
            world.hold_state();
            world.inputs.go = true;
            world.wait(500);
        },
        false,
    ),
    (
        "AS_READY after an emergency without a power cycle",
        Choice::PowerCycleLatched,
        |world| {
            world.after_emergency();
            world.inputs.asms = true;
            world.wait(500);
            forced(world, AsState::Ready);
        },
        false,
    ),
];

/// What the later editions add.
const NEWER: [(&str, &Edition, Happens, bool); 8] = [
    ("4.0: a whole mission", &Edition::V4_0, mission, true),
    (
        "4.0: the brake message is missed",
        &Edition::V4_0,
        |world| {
            driving(world, |world| world.mutes.push(Ai2VcuBrake::ID));
        },
        true,
    ),
    (
        "4.0: torque and brakes at once",
        &Edition::V4_0,
        |world| {
            driving(world, |world| {
                world.ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::clamped(100);
                world.ai.brake.hyd_press_f_req = BrakePressure::clamped(20);
            });
        },
        true,
    ),
    (
        "4.0: the EBS becomes unavailable",
        &Edition::V4_0,
        |world| {
            driving(world, |world| world.inputs.ebs = EbsState::Unavailable);
        },
        true,
    ),
    (
        "4.0: the VCU does not watch messages",
        &Edition::V4_0,
        |world| {
            driving(world, |world| {
                world.hold_state();
                world.shows = |status| (status.ai_comms_lost, status.fault_status) = (false, false);
                world.mutes.push(Ai2VcuSteer::ID);
            });
        },
        false,
    ),
    ("2026: a whole mission", &Edition::V2026, mission, true),
    (
        "2026: \"Go\" is passed over",
        &Edition::V2026,
        |world| {
            world.dwelt();
            world.hold_state();
            world.inputs.go = true;
            world.wait(500);
        },
        false,
    ),
    (
        "2026: the remote control's frames stop",
        &Edition::V2026,
        |world| {
            world.driving();
            let remote = Remote::of(&Edition::V2026.bus).map(|remote| remote.message().id);
            let since = world.t - 500 * MS;
            world.log.retain(|recorded| Some(recorded.frame.id) != remote || recorded.t < since);
            world.wait(200);
        },
        false,
    ),
];

/// A whole mission, and what a recorder makes of it.
const RECORDED: [(&str, Recorder); 14] = [
    ("recorded: the AI Computer only", |log| log.retain(|recorded| recorded.sender() == Some(Node::Ai))),
    ("recorded: the VCU only", |log| log.retain(|recorded| recorded.sender() == Some(Node::Vcu))),
    ("recorded: from AS_DRIVING on", |log| log.retain(|recorded| recorded.t >= 9000 * MS)),
    ("recorded: two seconds are written behind those that follow", |log| {
        let late: Vec<Recorded> = log.extract_if(.., |one| (4000 * MS..6000 * MS).contains(&one.t)).collect();
        let behind = log.partition_point(|recorded| recorded.t < 8000 * MS);
        log.splice(behind..behind, late);
    }),
    ("recorded: another car three seconds behind, on the same bus", |log| another_car(log, mission, 3000)),
    ("recorded: another car in the same state, with another mission, on the same bus", |log| {
        let with_another_mission = |world: &mut World| {
            world.shows = |status| status.ami_state = AmiState::Skidpad;
            mission(world);
        };
        another_car(log, with_another_mission, 0);
    }),
    ("recorded: another car that shows the same, on the same bus", |log| another_car(log, mission, 0)),
    ("recorded: AS_DRIVING is not left, and 30 of 60 ms of 510h and 525h are lost", |log| {
        let mut world = World::reference();
        world.stopped();
        world.shows = |status| (status.as_state, status.go_signal) = (AsState::Driving, true);
        world.ai.status.mission_status = MissionStatus::Finished;
        world.wait(1000);
        *log = world.log;
        let lost = |one: &Recorded| {
            [Ai2VcuStatus::ID, Vcu2AiWheelSpeeds::ID].contains(&one.frame.id) && one.t / (30 * MS) % 2 == 0
        };
        log.retain(|one| one.t < 9000 * MS || !lost(one));
    }),
    ("recorded: the VCU is switched off and on in AS_DRIVING", |log| {
        log.retain(|recorded| recorded.t < 9000 * MS || recorded.sender() == Some(Node::Ai));
        let mut again = World::reference();
        again.wait(1500);
        let vcu = again.log.iter().filter(|recorded| recorded.sender() == Some(Node::Vcu));
        log.extend(vcu.map(|recorded| Recorded { t: recorded.t + 9800 * MS, ..*recorded }));
        log.sort_by_key(|recorded| recorded.t);
    }),
    ("recorded: in steps of 20 ms", |log| {
        for recorded in log {
            recorded.t -= recorded.t.rem_euclid(20 * MS);
        }
    }),
    ("recorded: without three seconds", |log| {
        log.retain(|recorded| !(4000 * MS..7000 * MS).contains(&recorded.t));
    }),
    ("recorded: the clock is set back by 100 s", |log| {
        for recorded in log.iter_mut().filter(|recorded| recorded.t >= 5000 * MS) {
            recorded.t -= 100_000 * MS;
        }
    }),
    ("recorded: 521h is cut off", |log| {
        for recorded in log.iter_mut().filter(|recorded| recorded.frame.id == Vcu2AiSteer::ID) {
            recorded.frame.len = 3;
        }
    }),
    ("recorded: STEER_REQUEST of 513h is out of range", |log| {
        let steer = def_of::<Ai2VcuSteer>();
        let beyond = steer.signals[0].max + 10;
        for recorded in log.iter_mut().filter(|recorded| recorded.frame.id == steer.id) {
            recorded.frame.data = steer.signals[0].put(recorded.frame.data, beyond);
        }
    }),
];
