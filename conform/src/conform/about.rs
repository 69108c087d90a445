//! Which outputs a requirement is about, and which requirement an output is.

use adsdv_oracle::requirements::is_decision;
use adsdv_spec::{Actuation, AsState, Fault};

use super::keys::Keys;
use crate::protocol::SHOWN;

/// The outputs that a requirement is about. It is checked where all of them are shown, and broken where one of them is wrong.
///
/// One that nothing here knows is taken to be about the state; a test of this file finds it.
pub(super) fn shows(id: &str) -> Keys {
    known(id).unwrap_or(Keys::of(&[STATE]))
}

/// The key of the state.
pub(super) const STATE: &str = "as_state";

/// The same; `None` of one that stands nowhere.
fn known(id: &str) -> Option<Keys> {
    let own = SHOWN.iter().filter(|field| field.requirements.contains(&id)).map(|field| field.key);
    let of_outputs = Keys::of(&own.chain(others(id).iter().copied()).collect::<Vec<_>>());
    if !of_outputs.is_empty() {
        return Some(of_outputs);
    }
    match id {
        "D-17" => Some(Keys::of(&FLAGS)),
        _ if is_of_the_state(id) => Some(Keys::of(&[STATE])),
        _ => None,
    }
}

/// The outputs that a requirement is about besides those that [name it](crate::protocol::ShownField::requirements).
fn others(id: &str) -> &'static [&'static str] {
    match id {
        "HS-1" | "HS-2" | "HS-4" | "HS-5" | "HS-6" | "HS-7" | "HS-8" | "HS-12" | "HS-14" | "HS-15"
        | "D-44" => &["handshake"],
        "MSG-18" => &["front_axle_trq", "front_motor_speed_max"],
        "DRV-14" | "D-7" => &["go_signal"],
        "HS-9" | "HS-13" | "HS-16" | "HS-17" | "HS-18" | "HS-19" | "D-8" | "D-18" | "D-26" | "D-52" => {
            &["ai_comms_lost"]
        }
        "D-15" | "D-16" => &["shutdown_cause"],
        "D-55" => &["ebs_fault", "shutdown_cause"],
        "D-12" | "D-13" | "D-14" => &["hvil_open_fault", "shutdown_cause"],
        "D-27" => &["autonomous_braking_fault", "mission_status_fault"],
        "IMP-9" => &["autonomous_braking_fault", "mission_status_fault", "brake_plausibility_fault"],
        // A fault of AS_DRIVING: it is raised, and the state is left.
        "IMP-5" => &[STATE, "mission_status_fault"],
        "IMP-6" => &[STATE, "autonomous_braking_fault"],
        "IMP-8" | "D-64" => &[STATE, "brake_plausibility_fault"],
        "DRV-2" | "FIN-5" => {
            &["front_axle_trq", "rear_axle_trq", "front_motor_speed_max", "rear_motor_speed_max", "direction"]
        }
        "MSG-25" | "DRV-3" | "FIN-6" => &["steer"],
        "D-42" => &["hyd_press_f", "hyd_press_r"],
        "D-43" => &["hyd_press_f", "hyd_press_r", "ebs_triggered"],
        _ => &[],
    }
}

/// Whether a requirement is about the state machine: those of sections 3 and 4 are, and the decisions about arrows.
fn is_of_the_state(id: &str) -> bool {
    let (prefix, _) = id.split_once('-').unwrap_or((id, ""));
    match prefix {
        "SM" | "RDY" | "DRV" | "FIN" | "FTO" | "RTE" | "RTO" | "DTE" | "FTE" | "ETO" | "IMP" => true,
        "MSG" => id == "MSG-9",
        "HS" => id == "HS-10",
        "D" => matches!(
            id,
            "D-1"
                | "D-2"
                | "D-3"
                | "D-4"
                | "D-5"
                | "D-6"
                | "D-9"
                | "D-10"
                | "D-11"
                | "D-22"
                | "D-23"
                | "D-24"
                | "D-25"
                | "D-36"
                | "D-45"
                | "D-51"
                | "D-53"
                | "D-54"
                | "D-62"
                | "D-63"
                | "D-65"
                | "D-67"
        ),
        _ => false,
    }
}

/// The flags of the faults.
static FLAGS: [&str; Fault::ALL.len()] = {
    let mut flags = [""; Fault::ALL.len()];
    let mut count = 0;
    let mut place = 0;
    while place < SHOWN.len() {
        if SHOWN[place].fault.is_some() {
            flags[count] = SHOWN[place].key;
            count += 1;
        }
        place += 1;
    }
    assert!(count == flags.len(), "each fault has a flag");
    flags
};

/// The only state in which a requirement says anything of the outputs that it is about; `None`: in several, or in all of them.
pub(super) fn only_in(id: &str) -> Option<AsState> {
    let mut states = AsState::ALL.into_iter().filter(|&state| Actuation::requirements(state).contains(&id));
    states.next().filter(|_| states.next().is_none())
}

/// The requirement that an output itself is: what is broken if it is wrong in a state, and nothing more special asks for it.
///
/// That is what the document asks for in that state; else our decision about that state, or about when the output is what it
/// is, where the document is silent about that; else what it calls the output.
pub(super) fn own(key: &str, state: AsState) -> &'static str {
    let field = SHOWN.iter().find(|field| field.key == key && key != STATE);
    let Some(field) = field else { return STATE_MACHINE };
    let in_state = || Actuation::requirements(state).iter().filter(|id| shows(id).has(key));
    let of_document = in_state().find(|id| !is_decision(id));
    let decided = in_state().next().or_else(|| field.requirements.iter().find(|id| is_decision(id)));
    of_document.or(decided).or(field.requirements.first()).copied().unwrap_or(STATE_MACHINE)
}

/// What asks for the state machine as such.
pub(super) const STATE_MACHINE: &str = "SM-1";
/// What forbids to go where no arrow leads.
pub(super) const NO_ARROW: &str = "SM-18";

#[cfg(test)]
mod tests {
    use adsdv_spec::Edition;

    use super::*;
    use crate::suite;

    #[test]
    fn each_output_has_a_requirement_that_is_about_it() {
        for field in &SHOWN {
            for state in AsState::ALL {
                assert!(shows(own(field.key, state)).has(field.key), "{} in {state}", field.key);
            }
            assert!(field.requirements.iter().all(|id| shows(id).has(field.key)), "{}", field.key);
        }
    }

    #[test]
    fn what_the_document_asks_for_in_a_state_comes_before_what_we_decided() {
        for (key, state, id) in [
            ("front_axle_trq", AsState::Ready, "DRV-2"),
            ("front_axle_trq", AsState::EmergencyBrake, "D-21"),
            ("steer", AsState::Finished, "FIN-6"),
            ("hyd_press_f", AsState::Ready, "D-41"),
            ("hyd_press_f", AsState::Off, "D-42"),
            ("shutdown_request", AsState::EmergencyBrake, "D-38"),
            ("ai_comms_lost", AsState::Ready, Fault::AiCommsFault.requirement()),
            ("as_state", AsState::Off, STATE_MACHINE),
        ] {
            assert_eq!(own(key, state), id, "{key} in {state}");
        }
    }

    /// A requirement of a new edition that a test names, and that has no place here, would be reported as broken or passed by the
    /// state alone.
    #[test]
    fn what_tests_of_any_edition_name_is_known_to_be_about_something() {
        for edition in Edition::ALL {
            let shown = Keys::of_edition(edition);
            for test in suite::generate(edition) {
                for id in &test.requirements {
                    let about = known(id);
                    let is_about = about.is_some_and(|about| about.meets(shown));
                    assert!(is_about, "{}: {id} needs its place in `known` of this file", edition.version);
                }
            }
        }
        assert_eq!(["MSG-999", "HS-99", "D-999", "ID-1", "steer"].map(known), [None; 5]);
    }

    #[test]
    fn what_is_about_outputs_names_outputs_and_what_stands_in_the_document() {
        let requirements = include_str!("../../../spec/REQUIREMENTS.md");
        let ids = requirements.lines().filter_map(|line| line.strip_prefix("- **")?.split_once("**"));
        let mut about_others = 0;
        for (id, _) in ids {
            about_others += usize::from(!others(id).is_empty());
            assert!(others(id).iter().all(|key| SHOWN.iter().any(|field| field.key == *key)), "{id}");
        }
        assert!(about_others > 40, "{about_others}");
        for id in SHOWN.iter().flat_map(|field| field.requirements) {
            assert!(requirements.contains(&format!("- **{id}** ")), "{id}");
        }
    }
}
