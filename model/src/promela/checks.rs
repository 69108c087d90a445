//! The properties and the goals, as checks at the end of each step.

use std::fmt;

use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Choice, Edition};

use super::words::{cause, is_one_of, one_of, shows};
use crate::document::Document;
use crate::goals::goals;
use crate::properties::PROPERTIES;
use crate::property::{Claim, Property, When};

/// What a property claims that is a function in Rust, stated again in Promela: the one place where that is done.
struct Stated {
    /// The property's name.
    property: &'static str,
    /// The states before the step for which there is something to check; none are all.
    from: &'static [AsState],
    /// What holds: the whole claim, or, of a claim that speaks of some states, its condition.
    holds: &'static str,
}

/// AI_COMMS_LOST, as the document has it.
const COMMS_LOST: &str = "document_comms_lost";

/// What several properties speak of.
const WORDS: &str = "#define dwelled (lasted_ms >= DOCUMENT_READY_DWELL_MS)
#define braked (lasted_ms >= DOCUMENT_EBS_TIMER_MS)
#define nothing_requested (front_torque_zero && rear_torque_zero && steer_request_zero && steer_straight && direction_neutral)
#define go_lawful (dwelled && nothing_requested && !go_on)
";

/// Writes what several properties speak of, and what an edition has to say of it.
fn words(f: &mut fmt::Formatter<'_>, document: &Document) -> fmt::Result {
    let has = |atom| document.scope.has(atom);
    let estop_acts_everywhere = document.edition.readings.is(Choice::EstopEveryState);
    let lost = "unanswered_ms >= DOCUMENT_HANDSHAKE_MS";
    let lost =
        if has(Atom::AiMessagesMissed) { format!("({lost} || ai_messages_missed)") } else { lost.into() };
    let mut anywhere = vec!["sdc_open", "document_comms_lost"];
    let mut driving = vec!["!asms", "!go_on", "((mission_finished || direction_neutral) && moving)"];
    if estop_acts_everywhere {
        anywhere.insert(1, "ai_estop");
    } else {
        driving.push("ai_estop");
    }
    let added = [
        (Atom::BrakeRequestZero, "(!(front_torque_zero && rear_torque_zero) && !brake_request_zero)"),
        (Atom::EbsUnavailable, "ebs_unavailable"),
        (Atom::BmsFault, "bms_fault"),
    ];
    driving.extend(added.into_iter().filter(|(atom, _)| has(*atom)).map(|(_, reason)| reason));
    f.write_str("/* What several properties speak of, in the document's words. */\n")?;
    writeln!(f, "#define document_comms_lost (handshake_active && {lost})")?;
    f.write_str(WORDS)?;
    writeln!(
        f,
        "#define reason_to_brake ({} || (before == AS_DRIVING && \\\n    ({})))",
        anywhere.join(" || "),
        driving.join(" || ")
    )
}

const STATED: &[Stated] = &[
    Stated {
        property: "ready-due",
        from: &[],
        holds: "cause_before == NO_SHUTDOWN && asms && tsms && ami_selected && mission_selected && ebs_armed",
    },
    Stated { property: "driving-dwell", from: &[], holds: "dwelled" },
    Stated {
        property: "driving-go",
        from: &[],
        // That it is armed too late or too early matters in the next cycle only.
        holds: "(before == AS_READY && state == AS_DRIVING -> armed_before && go_on :
            (state != AS_READY -> !go_seen_low :
            go_seen_low == (before == AS_READY && go_lawful)
            || (go_seen_low && in_state_ms + CYCLE_MS < DOCUMENT_READY_DWELL_MS)))",
    },
    Stated {
        property: "driving-due",
        from: &[],
        holds: "dwelled && armed_before && go_on && asms && nothing_requested && !reason_to_brake",
    },
    Stated { property: "ready-comms", from: &[], holds: COMMS_LOST },
    Stated { property: "driving-comms", from: &[], holds: COMMS_LOST },
    Stated { property: "finished-comms", from: &[], holds: COMMS_LOST },
    Stated {
        property: "comms-tsms",
        from: &[],
        holds: "(tsms || shutdown_cause == cause_before || shutdown_cause != CAUSE_AI_COMMS_LOST)",
    },
    Stated { property: "finished-due", from: &[], holds: "mission_finished && at_rest && !reason_to_brake" },
    Stated {
        property: "brake-founded",
        from: &[AsState::Off, AsState::Ready, AsState::Driving, AsState::Finished],
        holds: "(state != EMERGENCY_BRAKE || reason_to_brake)",
    },
    Stated {
        property: "off-founded",
        from: &[AsState::Ready, AsState::Finished],
        holds: "(state != AS_OFF || !asms)",
    },
    Stated {
        property: "actuators",
        from: &[],
        // Requests reach the actuators in AS_DRIVING.
        holds: "(state != AS_DRIVING || (asms && go_on && !sdc_open))",
    },
    Stated {
        property: "go-signal",
        from: &[],
        // GO_SIGNAL is the switch, as far as AS_DRIVING or the reading lets it through.
        holds: "(!go_on || (state == AS_DRIVING -> before == AS_DRIVING || armed_before : !GO_RAW))",
    },
    Stated {
        property: "brake-time",
        from: &[AsState::EmergencyBrake],
        holds: "(state == EMERGENCY_BRAKE || braked)",
    },
    Stated { property: "brake-due", from: &[], holds: "braked && !asms" },
    Stated {
        property: "power-cycle",
        from: &[],
        holds: "(cause_before == NO_SHUTDOWN || state == AS_OFF || state == EMERGENCY_BRAKE)",
    },
    Stated {
        property: "shutdown-cause",
        from: &[],
        holds: "(cause_before == NO_SHUTDOWN -> (shutdown_cause != NO_SHUTDOWN) == (state == EMERGENCY_BRAKE)
            : shutdown_cause == cause_before)",
    },
    Stated {
        property: "control-invariant",
        from: &[],
        holds:
            "(in_state_ms == (state == before -> (lasted_ms < limit(before) -> lasted_ms : limit(before)) : 0)
            && in_state_ms <= limit(state) && unanswered_ms <= HANDSHAKE_MS
            && (handshake_active || (!handshake_bit && unanswered_ms == 0))
            && (!go_seen_low || (state == AS_READY && (GO_EDGE_ENOUGH || in_state_ms >= LIMIT_AS_READY)))
            && ((FAULT_EDGE && state == AS_DRIVING) || !(was_running || was_forward))
            && (shutdown_cause != NO_SHUTDOWN || state != EMERGENCY_BRAKE)
            && power_cycle_needed == (shutdown_cause != NO_SHUTDOWN && POWER_CYCLE_LATCHED)
            && (!power_cycle_needed || state == EMERGENCY_BRAKE || state == AS_OFF))",
    },
];

fn stated(property: &Property) -> Option<&'static Stated> {
    STATED.iter().find(|stated| stated.property == property.name)
}

/// The condition of a claim.
fn condition(property: &Property, when: When) -> Option<String> {
    match when {
        When::Inputs { on, off } => Some(shows(on, off)),
        When::Step { .. } => stated(property).map(|stated| stated.holds.into()),
    }
}

/// What breaks a property in a step from a state; `None` if none can, or if nobody has stated the property in Promela.
fn breaks(document: &Document, property: &Property, from: AsState) -> Option<String> {
    match property.claim {
        Claim::Leads { from: states, when, to } if states.contains(&from) => {
            Some(format!("!({}) && {}", is_one_of("state", to), condition(property, when)?))
        }
        Claim::Only { from: before, to, when } if before == from => {
            Some(format!("state == {to} && !({})", condition(property, when)?))
        }
        Claim::Leads { .. } | Claim::Only { .. } => None,
        Claim::Each { .. } if property.name == ARROWS => {
            let arrows = document.edition.rules.table.rows().iter().filter(|row| row.from == from);
            let to: Vec<AsState> = arrows.map(|row| row.to).chain([from]).collect();
            Some(format!("!({})", is_one_of("state", &to)))
        }
        Claim::Each { .. } => {
            let stated = stated(property)?;
            let concerns = stated.from.is_empty() || stated.from.contains(&from);
            concerns.then(|| format!("!{}", stated.holds))
        }
    }
}

/// The property whose Promela is written from Figure 2.
const ARROWS: &str = "figure-2-arrows";

/// Writes how Spin reports results.
pub(super) fn reports(f: &mut fmt::Formatter<'_>, document: &Document) -> fmt::Result {
    let limit = AsState::ALL.into_iter().fold("0".into(), |otherwise: String, of| {
        format!("((of) == {of} -> LIMIT_{of} : \\\n    {otherwise})")
    });
    words(f, document)?;
    writeln!(f, "#define limit(of) {limit}\n\n/* The properties.\n *")?;
    for (_, property) in Property::of_edition(document.edition) {
        writeln!(f, " * {}: {}", property.name, property.statement_in(document.edition))?;
    }
    f.write_str(" */\n\n")?;
    writeln!(
        f,
        "/* What is found is printed once, and is no part of the state. */
c_decl {{
    static char printed[{}];
    static void tell(int place, const char *what) {{
        if (!printed[place]) {{
            printed[place] = 1;
            puts(what);
        }}
    }}
}}
#define FOUND(place, what, when) if :: when -> c_code {{ tell(place, what); }} :: else fi
{SHOW}",
        PROPERTIES.len() + goals(document.edition).len()
    )
}

/// What pan prints when it is asked to: control states when the steps out of them are tried, which is once, and steps.
const SHOW: &str = r#"
#if FAULT_EDGE
#define CONTROL now.state, now.in_state_ms, now.go_seen_low, now.was_running, now.was_forward, \
    now.handshake_active, now.handshake_bit, now.unanswered_ms, now.power_cycle_needed, now.shutdown_cause
#else
#define CONTROL now.state, now.in_state_ms, now.go_seen_low, 0, 0, \
    now.handshake_active, now.handshake_bit, now.unanswered_ms, now.power_cycle_needed, now.shutdown_cause
#endif

/* With spin -DSTATES -a, pan prints each control state. */
#ifdef STATES
#define SHOW_STATE c_code { printf("state: %d %d %d %d %d %d %d %d %d %d\n", CONTROL); };
#else
#define SHOW_STATE
#endif

/* With spin -DSTEPS -a, pan prints each step: the control state before it, the inputs as bits, and the one after it. */
#ifdef STEPS
c_decl { static char begun[128]; }
#define BEGIN_STEP c_code { snprintf(begun, sizeof begun, "%d %d %d %d %d %d %d %d %d %d", CONTROL); };
#define END_STEP ; c_code { printf("step: %s %d %d %d %d %d %d %d %d %d %d %d %d\n", begun, ATOMS, FAULTS, CONTROL); }
#else
#define BEGIN_STEP
#define END_STEP
#endif
"#;

/// Writes what is checked after a step from a state.
pub(super) fn of_step(f: &mut fmt::Formatter<'_>, document: &Document, from: AsState) -> fmt::Result {
    for (place, property) in Property::of_edition(document.edition) {
        if let Some(breaks) = breaks(document, property, from) {
            let name = property.name;
            writeln!(f, "        FOUND({place}, \"violated: {name}\",\n            {breaks});")?;
        }
    }
    f.write_str("        if\n        :: state != before || shutdown_cause != cause_before ->\n")?;
    for (place, goal) in goals(document.edition).iter().enumerate() {
        if let Some(reached) = reached(document.edition, goal.name, from) {
            let place = PROPERTIES.len() + place;
            writeln!(f, "            FOUND({place}, \"reached: {}\", {reached});", goal.name)?;
        }
    }
    f.write_str("            skip\n        :: else\n        fi\n        END_STEP\n")
}
/// What reaches a goal in a step from a state that changes the state or the cause.
fn reached(edition: &Edition, goal: &str, from: AsState) -> Option<String> {
    if let Some(section) = goal.strip_prefix("arrow-") {
        let rows = edition.rules.table.rows().iter();
        let rows = rows.filter(|row| row.section == section && row.from == from);
        let to: Vec<AsState> = rows.map(|row| row.to).collect();
        (!to.is_empty()).then(|| is_one_of("state", &to))
    } else if let Some(number) = goal.strip_prefix("cause-") {
        let faults = edition.faults.iter().filter(|&fault| (fault as u8).to_string() == number);
        Some(one_of(
            faults.map(|fault| format!("cause_before == NO_SHUTDOWN && shutdown_cause == {}", cause(fault))),
        ))
    } else {
        (from == AsState::Finished).then(|| "state == AS_OFF && shutdown_cause == NO_SHUTDOWN".into())
    }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::Edition;
    use adsdv_spec::messages::AsState;

    use super::{ARROWS, Document, STATED, breaks, reached};
    use crate::goals::goals;
    use crate::property::{Claim, Property, When};

    #[test]
    fn every_property_is_stated() {
        for document in Edition::ALL.iter().map(|edition| Document::of(edition)) {
            for (_, property) in Property::of_edition(document.edition) {
                let stated = AsState::ALL.into_iter().any(|from| breaks(document, property, from).is_some());
                assert!(stated, "{}: say in STATED what it claims, in Promela", property.name);
            }
        }
    }

    #[test]
    fn what_is_data_is_not_stated_again() {
        for stated in STATED {
            let name = stated.property;
            let property = Property::find(name).unwrap_or_else(|| panic!("there is no property {name}"));
            let data = match property.claim {
                Claim::Leads { when, .. } | Claim::Only { when, .. } => matches!(when, When::Inputs { .. }),
                Claim::Each { .. } => name == ARROWS,
            };
            assert!(!data, "{name} is written from its data");
        }
    }

    #[test]
    fn every_goal_can_be_reached() {
        for edition in Edition::ALL {
            for goal in goals(edition) {
                let stated = AsState::ALL
                    .into_iter()
                    .filter_map(|from| reached(edition, goal.name, from))
                    .any(|text| text != "false");
                assert!(stated, "{}: {}", edition.version, goal.name);
            }
        }
    }
}
