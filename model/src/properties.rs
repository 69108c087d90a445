//! The properties of the open model, as data: each with its name, what it says, and the requirements that it covers.
//!
//! They are stated of many steps at once, that lead from one control state to another: what the steps have in common is a `bool`, what
//! their inputs show a bit for each of them.
//!
//! They are stated in the document's words, over conditions and states, and never look at the table of the machine that
//! is checked: a table with a mistake in it must not be able to excuse itself. Times are those of the document's version; what
//! stands in braces is one of them. A property covers the requirements of every edition that has it, each where it is asked for.

use adsdv_spec::messages::{AsState, ShutdownCause};
use adsdv_spec::{Atom, Atoms, Choice, Control, Edition, Timing};

use crate::property::{Claim, Harm, Property, When};
use crate::steps::every_one;

use AsState::{Driving, EmergencyBrake, Finished, Off, Ready};

/// The states in which the vehicle stands and the Autonomous System is switched on.
const STANDING: &[AsState] = &[Ready, Finished];
const STOPPED: &[AsState] = &[EmergencyBrake];

/// "AI_COMMS_LOST": the VCU's edge has been unanswered, or a message that is watched has been missing, for too long.
const COMMS_LOST: When = When::Step { holds: |steps| steps.comms_lost(), reads: Atoms::NONE };

/// For what does not look at the inputs, or only where the machine does anyway.
fn nothing(_: &Control, _: &Timing) -> Atoms {
    Atoms::NONE
}

/// What every edition has.
fn every(_: &Edition) -> bool {
    true
}

/// An emergency stop that the AI Computer asks for acts outside of AS_DRIVING too.
fn estop_acts_everywhere(edition: &Edition) -> bool {
    edition.readings.is(Choice::EstopEveryState)
}

/// The edition takes the drive motors to be in torque control mode, unless somebody answers otherwise.
fn braking_against_torque_is_a_fault(edition: &Edition) -> bool {
    driving_has_ten_alternatives(edition) && edition.readings.is(Choice::TorqueAlways)
}

/// The conditions that version 4.0 added to the way from AS_DRIVING into EMERGENCY_BRAKE.
fn driving_has_ten_alternatives(edition: &Edition) -> bool {
    Atoms::of(&[Atom::BrakeRequestZero, Atom::BmsFault, Atom::EbsUnavailable]).is_subset(edition.scope())
}

/// What the text and Figure 2 together ask for before AS_READY.
const READY_CONDITIONS: Atoms =
    Atoms::of(&[Atom::Asms, Atom::Tsms, Atom::AmiSelected, Atom::MissionSelected, Atom::EbsArmed]);

/// What section 3.2, item 2, asks for before AS_DRIVING.
const DRIVING_CONDITIONS: Atoms = Atoms::of(&[
    Atom::FrontTorqueZero,
    Atom::RearTorqueZero,
    Atom::SteerRequestZero,
    Atom::SteerStraight,
    Atom::DirectionNeutral,
]);

/// Every safety property, in the order of the document.
pub const PROPERTIES: &[Property] = &[
    Property {
        name: "figure-2-arrows",
        statement: "The state changes only along an arrow of Figure 2",
        requirements: &["SM-18"],
        harm: Harm::SetsOff,
        holds_in: every,
        claim: Claim::Each {
            holds: |_, steps| {
                let (from, to) = (steps.before.state, steps.after().state);
                let rows = steps.document.edition.rules.table.rows();
                every_one(from == to || rows.iter().any(|row| (row.from, row.to) == (from, to)))
            },
            reads: nothing,
        },
    },
    Property {
        name: "ready-switches",
        statement: "AS_READY is entered only with ASMS and TSMS on and the EBS ARMED",
        requirements: &["RDY-1", "RDY-2", "RDY-4"],
        harm: Harm::MadeReady,
        holds_in: every,
        claim: Claim::Only {
            from: Off,
            to: Ready,
            when: When::on(&[Atom::Asms, Atom::Tsms, Atom::EbsArmed]),
        },
    },
    Property {
        name: "ready-ami",
        statement: "AS_READY is entered only with a mission selected on the AMI",
        requirements: &["RDY-3"],
        harm: Harm::MadeReady,
        holds_in: every,
        claim: Claim::Only { from: Off, to: Ready, when: When::on(&[Atom::AmiSelected]) },
    },
    Property {
        name: "ready-mission-status",
        statement: "AS_READY is entered only with MISSION_STATUS SELECTED",
        requirements: &["SM-9"],
        harm: Harm::MadeReady,
        holds_in: every,
        claim: Claim::Only { from: Off, to: Ready, when: When::on(&[Atom::MissionSelected]) },
    },
    Property {
        name: "ready-due",
        statement: "AS_READY is entered as soon as all of its conditions hold, unless a power cycle is needed",
        requirements: &["RDY-5", "SM-9"],
        harm: Harm::RunLost,
        holds_in: every,
        claim: Claim::Leads {
            from: &[Off],
            when: When::Step {
                holds: |steps| {
                    if steps.before.shutdown_cause == ShutdownCause::NoShutdown {
                        steps.show(READY_CONDITIONS, Atoms::NONE)
                    } else {
                        0
                    }
                },
                reads: READY_CONDITIONS,
            },
            to: &[Ready],
        },
    },
    Property {
        name: "driving-dwell",
        statement: "AS_DRIVING is entered only after {ready_dwell} in AS_READY",
        requirements: &["DRV-4"],
        harm: Harm::SetsOff,
        holds_in: every,
        claim: Claim::Only {
            from: Ready,
            to: Driving,
            when: When::Step { holds: |steps| every_one(steps.have_lasted()), reads: Atoms::NONE },
        },
    },
    Property {
        name: "driving-requests",
        statement: "AS_DRIVING is entered only with zero torque and steering requests, straight wheels and NEUTRAL",
        requirements: &["DRV-5", "DRV-6", "DRV-7", "DRV-8", "DRV-9"],
        harm: Harm::SetsOff,
        holds_in: every,
        claim: Claim::Only {
            from: Ready,
            to: Driving,
            when: When::Inputs { on: DRIVING_CONDITIONS, off: Atoms::NONE },
        },
    },
    Property {
        name: "driving-go",
        statement: "AS_DRIVING is entered only when \"Go\" comes on, just after it was seen off while all else held",
        requirements: &["DRV-11", "DRV-12", "D-6"],
        harm: Harm::SetsOff,
        holds_in: every,
        claim: Claim::Each {
            holds: |_, steps| match (steps.before.state, steps.after().state) {
                (Ready, Driving) if steps.before.go_seen_low => steps.see(Atom::GoOn),
                (Ready, Driving) => 0,
                (before, Ready) => {
                    let lawful = if before == Ready && steps.have_lasted() {
                        steps.show(DRIVING_CONDITIONS, Atoms::of(&[Atom::GoOn]))
                    } else {
                        0
                    };
                    // What is seen of "Go" matters to the next step, if that can set off.
                    let is_lawful = if steps.after().go_seen_low { lawful } else { !lawful };
                    is_lawful | !lawful & every_one(!steps.next_have_lasted())
                }
                _ => every_one(!steps.after().go_seen_low),
            },
            reads: |before, document| {
                let next_ms =
                    before.in_state_ms.saturating_add(document.cycle_ms).saturating_add(document.cycle_ms);
                let counts = before.state == Ready && next_ms >= document.ready_dwell_ms;
                if counts { DRIVING_CONDITIONS.with(Atom::GoOn) } else { Atoms::NONE }
            },
        },
    },
    Property {
        name: "driving-due",
        statement: "AS_DRIVING is entered at the accepted edge of \"Go\", unless AS_READY has to be left otherwise",
        requirements: &["DRV-15", "SM-11"],
        harm: Harm::RunLost,
        holds_in: every,
        claim: Claim::Leads {
            from: &[Ready],
            when: When::Step {
                holds: |steps| {
                    if !steps.have_lasted() || !steps.before.go_seen_low {
                        return 0;
                    }
                    let due = DRIVING_CONDITIONS.with(Atom::GoOn).with(Atom::Asms);
                    steps.show(due, Atoms::NONE) & !steps.have_reason_to_brake()
                },
                reads: Atoms::NONE,
            },
            to: &[Driving],
        },
    },
    Property {
        name: "driving-sdc",
        statement: "An open shutdown circuit in AS_DRIVING leads to EMERGENCY_BRAKE",
        requirements: &["DTE-1"],
        harm: Harm::DrivesOn,
        holds_in: every,
        claim: Claim::Leads { from: &[Driving], when: When::on(&[Atom::SdcOpen]), to: STOPPED },
    },
    Property {
        name: "driving-asms",
        statement: "ASMS off in AS_DRIVING leads to EMERGENCY_BRAKE",
        requirements: &["DTE-3"],
        harm: Harm::DrivesOn,
        holds_in: every,
        claim: Claim::Leads { from: &[Driving], when: When::off(&[Atom::Asms]), to: STOPPED },
    },
    Property {
        name: "driving-go-off",
        statement: "\"Go\" off in AS_DRIVING leads to EMERGENCY_BRAKE",
        requirements: &["DTE-2"],
        harm: Harm::DrivesOn,
        holds_in: every,
        claim: Claim::Leads { from: &[Driving], when: When::off(&[Atom::GoOn]), to: STOPPED },
    },
    Property {
        name: "driving-finished",
        statement: "FINISHED while moving leads to EMERGENCY_BRAKE",
        requirements: &["DTE-4", "DTE-6", "DTE-7", "IMP-3", "IMP-4", "IMP-5"],
        harm: Harm::DrivesOn,
        holds_in: every,
        claim: Claim::Leads {
            from: &[Driving],
            when: When::on(&[Atom::MissionFinished, Atom::Moving]),
            to: STOPPED,
        },
    },
    Property {
        name: "driving-neutral",
        statement: "NEUTRAL while moving leads to EMERGENCY_BRAKE",
        requirements: &["DTE-5", "DTE-6", "DTE-8", "IMP-2", "IMP-4", "IMP-6"],
        harm: Harm::DrivesOn,
        holds_in: every,
        claim: Claim::Leads {
            from: &[Driving],
            when: When::on(&[Atom::DirectionNeutral, Atom::Moving]),
            to: STOPPED,
        },
    },
    Property {
        name: "driving-comms",
        statement: "A handshake or a message that is lost in AS_DRIVING leads to EMERGENCY_BRAKE",
        requirements: &["HS-9", "HS-10", "HS-17", "HS-18", "DTE-6", "DTE-11", "IMP-7"],
        harm: Harm::DrivesOn,
        holds_in: every,
        claim: Claim::Leads { from: &[Driving], when: COMMS_LOST, to: STOPPED },
    },
    Property {
        name: "driving-estop",
        statement: "ESTOP_REQUEST in AS_DRIVING leads to EMERGENCY_BRAKE",
        requirements: &["D-9", "D-62", "DTE-10"],
        harm: Harm::DrivesOn,
        holds_in: every,
        claim: Claim::Leads { from: &[Driving], when: When::on(&[Atom::AiEstop]), to: STOPPED },
    },
    Property {
        name: "driving-front-brake",
        statement: "Torque of the front axle and a brake requested at once in AS_DRIVING lead to EMERGENCY_BRAKE",
        requirements: &["DTE-6", "DTE-9", "IMP-8"],
        harm: Harm::DrivesOn,
        holds_in: braking_against_torque_is_a_fault,
        claim: Claim::Leads {
            from: &[Driving],
            when: When::off(&[Atom::FrontTorqueZero, Atom::BrakeRequestZero]),
            to: STOPPED,
        },
    },
    Property {
        name: "driving-rear-brake",
        statement: "Torque of the rear axle and a brake requested at once in AS_DRIVING lead to EMERGENCY_BRAKE",
        requirements: &["DTE-6", "DTE-9", "IMP-8"],
        harm: Harm::DrivesOn,
        holds_in: braking_against_torque_is_a_fault,
        claim: Claim::Leads {
            from: &[Driving],
            when: When::off(&[Atom::RearTorqueZero, Atom::BrakeRequestZero]),
            to: STOPPED,
        },
    },
    Property {
        name: "driving-bms",
        statement: "BMS_FAULT in AS_DRIVING leads to EMERGENCY_BRAKE",
        requirements: &["DTE-12"],
        harm: Harm::DrivesOn,
        holds_in: driving_has_ten_alternatives,
        claim: Claim::Leads { from: &[Driving], when: When::on(&[Atom::BmsFault]), to: STOPPED },
    },
    Property {
        name: "driving-ebs",
        statement: "An EBS that is UNAVAILABLE in AS_DRIVING leads to EMERGENCY_BRAKE",
        requirements: &["DTE-13"],
        harm: Harm::DrivesOn,
        holds_in: driving_has_ten_alternatives,
        claim: Claim::Leads { from: &[Driving], when: When::on(&[Atom::EbsUnavailable]), to: STOPPED },
    },
    Property {
        name: "ready-sdc",
        statement: "An open shutdown circuit in AS_READY leads to EMERGENCY_BRAKE",
        requirements: &["RTE-1", "SM-12"],
        harm: Harm::NotBraked,
        holds_in: every,
        claim: Claim::Leads { from: &[Ready], when: When::on(&[Atom::SdcOpen]), to: STOPPED },
    },
    Property {
        name: "finished-sdc",
        statement: "An open shutdown circuit in AS_FINISHED leads to EMERGENCY_BRAKE",
        requirements: &["FTE-1", "SM-15"],
        harm: Harm::NotBraked,
        holds_in: every,
        claim: Claim::Leads { from: &[Finished], when: When::on(&[Atom::SdcOpen]), to: STOPPED },
    },
    Property {
        name: "ready-asms",
        statement: "ASMS off leads out of AS_READY",
        requirements: &["RTO-1", "SM-10"],
        harm: Harm::NotBraked,
        holds_in: every,
        claim: Claim::Leads { from: &[Ready], when: When::off(&[Atom::Asms]), to: &[Off, EmergencyBrake] },
    },
    Property {
        name: "finished-asms",
        statement: "ASMS off leads out of AS_FINISHED",
        requirements: &["FTO-1", "SM-16"],
        harm: Harm::NotBraked,
        holds_in: every,
        claim: Claim::Leads { from: &[Finished], when: When::off(&[Atom::Asms]), to: &[Off, EmergencyBrake] },
    },
    Property {
        name: "ready-comms",
        statement: "A handshake or a message that is lost in AS_READY leads to EMERGENCY_BRAKE",
        requirements: &["HS-9", "HS-10", "HS-17", "HS-18"],
        harm: Harm::NotBraked,
        holds_in: every,
        claim: Claim::Leads { from: &[Ready], when: COMMS_LOST, to: STOPPED },
    },
    Property {
        name: "finished-comms",
        statement: "A handshake or a message that is lost in AS_FINISHED leads to EMERGENCY_BRAKE",
        requirements: &["HS-9", "HS-10", "HS-17", "HS-18"],
        harm: Harm::NotBraked,
        holds_in: every,
        claim: Claim::Leads { from: &[Finished], when: COMMS_LOST, to: STOPPED },
    },
    Property {
        name: "ready-estop",
        statement: "ESTOP_REQUEST in AS_READY leads to EMERGENCY_BRAKE",
        requirements: &["D-9"],
        harm: Harm::NotBraked,
        holds_in: estop_acts_everywhere,
        claim: Claim::Leads { from: &[Ready], when: When::on(&[Atom::AiEstop]), to: STOPPED },
    },
    Property {
        name: "finished-estop",
        statement: "ESTOP_REQUEST in AS_FINISHED leads to EMERGENCY_BRAKE",
        requirements: &["D-9"],
        harm: Harm::NotBraked,
        holds_in: estop_acts_everywhere,
        claim: Claim::Leads { from: &[Finished], when: When::on(&[Atom::AiEstop]), to: STOPPED },
    },
    Property {
        name: "comms-tsms",
        statement: "With TSMS off, no silence of the AI Computer causes an emergency",
        requirements: &["D-8"],
        harm: Harm::RunLost,
        holds_in: every,
        claim: Claim::Each {
            holds: |_, steps| {
                let (before, after) = (steps.before.shutdown_cause, steps.after().shutdown_cause);
                if after == before || after != ShutdownCause::AiCommsFault {
                    return every_one(true);
                }
                steps.see(Atom::Tsms)
            },
            reads: |_, _| Atoms::of(&[Atom::Tsms]),
        },
    },
    Property {
        name: "finished-at-rest",
        statement: "AS_FINISHED is entered only with FINISHED and all wheels at rest",
        requirements: &["FIN-4", "SM-14"],
        harm: Harm::NotBraked,
        holds_in: every,
        claim: Claim::Only {
            from: Driving,
            to: Finished,
            when: When::on(&[Atom::MissionFinished, Atom::AtRest]),
        },
    },
    Property {
        name: "finished-due",
        statement: "FINISHED with all wheels at rest leads to AS_FINISHED, unless the vehicle has to brake",
        requirements: &["FIN-4", "SM-14"],
        harm: Harm::RunLost,
        holds_in: every,
        claim: Claim::Leads {
            from: &[Driving],
            when: When::Step {
                holds: |steps| {
                    steps.show(Atoms::of(&[Atom::MissionFinished, Atom::AtRest]), Atoms::NONE)
                        & !steps.have_reason_to_brake()
                },
                reads: Atoms::of(&[Atom::MissionFinished, Atom::AtRest]),
            },
            to: &[Finished],
        },
    },
    Property {
        name: "brake-founded",
        statement: "EMERGENCY_BRAKE is entered only for a reason that the document names",
        requirements: &["SM-12", "SM-13", "SM-15", "HS-10"],
        harm: Harm::RunLost,
        holds_in: every,
        claim: Claim::Each {
            holds: |_, steps| {
                if steps.before.state == EmergencyBrake || steps.after().state != EmergencyBrake {
                    return every_one(true);
                }
                steps.have_reason_to_brake()
            },
            reads: nothing,
        },
    },
    Property {
        name: "off-founded",
        statement: "AS_READY and AS_FINISHED are left for AS_OFF only with ASMS off",
        requirements: &["SM-10", "SM-16"],
        harm: Harm::NotBraked,
        holds_in: every,
        claim: Claim::Each {
            holds: |_, steps| {
                if !STANDING.contains(&steps.before.state) || steps.after().state != Off {
                    return every_one(true);
                }
                !steps.see(Atom::Asms)
            },
            reads: nothing,
        },
    },
    Property {
        name: "actuators",
        statement: "Drive and steering requests reach the actuators only in AS_DRIVING, with ASMS and \"Go\" on and the shutdown circuit closed",
        requirements: &["DRV-2", "DRV-3", "FIN-5", "FIN-6", "D-21"],
        harm: Harm::DrivesOn,
        holds_in: every,
        claim: Claim::Each {
            holds: |machine, steps| {
                let mut may_drive = 0;
                if steps.after().state == Driving {
                    may_drive = steps.show(Atoms::of(&[Atom::Asms, Atom::GoOn]), Atoms::of(&[Atom::SdcOpen]));
                    if steps.all_among(may_drive) {
                        return every_one(true);
                    }
                }
                may_drive | !steps.drive(machine)
            },
            reads: nothing,
        },
    },
    Property {
        name: "go-signal",
        statement: "GO_SIGNAL is 1 exactly in AS_DRIVING while \"Go\" is on, once its rising edge has been accepted",
        requirements: &["DRV-14", "D-7"],
        harm: Harm::Misled,
        holds_in: every,
        claim: Claim::Each {
            holds: |machine, steps| {
                let shown = steps.go_signal(machine);
                let accepted = steps.before.state == Driving || steps.before.go_seen_low;
                let due = if steps.after().state == Driving { steps.see(Atom::GoOn) } else { 0 };
                !(shown ^ due) & (!shown | every_one(accepted))
            },
            reads: |_, _| Atoms::of(&[Atom::GoOn]),
        },
    },
    Property {
        name: "brake-time",
        statement: "EMERGENCY_BRAKE lasts at least {ebs_timer}",
        requirements: &["ETO-1"],
        harm: Harm::SetsOff,
        holds_in: every,
        claim: Claim::Each {
            holds: |_, steps| {
                every_one(
                    steps.before.state != EmergencyBrake
                        || steps.after().state == EmergencyBrake
                        || steps.have_lasted(),
                )
            },
            reads: nothing,
        },
    },
    Property {
        name: "brake-asms",
        statement: "EMERGENCY_BRAKE is left only with ASMS off",
        requirements: &["ETO-2"],
        harm: Harm::SetsOff,
        holds_in: every,
        claim: Claim::Only { from: EmergencyBrake, to: Off, when: When::off(&[Atom::Asms]) },
    },
    Property {
        name: "brake-due",
        statement: "EMERGENCY_BRAKE is left for AS_OFF when it has lasted {ebs_timer} and ASMS is off",
        requirements: &["ETO-2", "SM-17", "D-23"],
        harm: Harm::RunLost,
        holds_in: every,
        claim: Claim::Leads {
            from: STOPPED,
            when: When::Step {
                holds: |steps| if steps.have_lasted() { !steps.see(Atom::Asms) } else { 0 },
                reads: Atoms::NONE,
            },
            to: &[Off],
        },
    },
    Property {
        name: "power-cycle",
        statement: "After EMERGENCY_BRAKE, AS_READY and all that follows need a power cycle",
        requirements: &["ETO-3", "ETO-4", "D-11"],
        harm: Harm::SetsOff,
        holds_in: every,
        claim: Claim::Each {
            holds: |_, steps| {
                every_one(
                    steps.before.shutdown_cause == ShutdownCause::NoShutdown
                        || matches!(steps.after().state, Off | EmergencyBrake),
                )
            },
            reads: nothing,
        },
    },
    Property {
        name: "shutdown-cause",
        statement: "SHUTDOWN_CAUSE is never 0 after an emergency, and never changes",
        requirements: &["D-15"],
        harm: Harm::Misled,
        holds_in: every,
        claim: Claim::Each {
            holds: |_, steps| {
                let (before, after) = (steps.before.shutdown_cause, steps.after().shutdown_cause);
                every_one(if before == ShutdownCause::NoShutdown {
                    (after != before) == (steps.after().state == EmergencyBrake)
                } else {
                    after == before
                })
            },
            reads: nothing,
        },
    },
    Property {
        name: "control-invariant",
        statement: "The control state keeps its invariant; the handshake and the time in a state are counted as they pass",
        requirements: &["HS-4", "HS-6", "HS-7", "HS-9", "HS-17", "D-8", "D-11", "D-44"],
        harm: Harm::Misled,
        holds_in: every,
        claim: Claim::Each {
            holds: |machine, steps| {
                let timing = &machine.edition().rules.timing;
                let limit = u32::from(timing.in_state_limit(steps.before.state));
                let stays = steps.before.state == steps.after().state;
                let counted = if stays { steps.lasted_ms().min(limit) } else { 0 };
                if !steps.after().is_consistent(timing, machine.readings())
                    || u32::from(steps.after().in_state_ms) != counted
                {
                    return 0;
                }
                steps.handshake_is_counted(timing)
            },
            reads: nothing,
        },
    },
];

const _: () = assert!(PROPERTIES.len() <= 64, "sets of properties are 64 bits");
