//! Which outputs a requirement is about, and which requirement an output is.

use adsdv_spec::{AsState, Fault};

use crate::protocol::SHOWN;

/// The outputs that a requirement is about. It is checked where all of them are shown, and broken where one of them is wrong.
pub(super) fn shows(id: &str) -> &'static [&'static str] {
    match id {
        "MSG-42" | "HS-1" | "HS-2" | "HS-3" | "HS-4" | "HS-5" | "HS-6" | "HS-7" | "HS-8" | "HS-12"
        | "HS-14" | "HS-15" | "D-44" => &["handshake"],
        "MSG-18" => &["front_axle_trq", "front_motor_speed_max"],
        "MSG-43" | "D-38" => &["shutdown_request"],
        "MSG-44" => &["as_switch_status"],
        "MSG-45" => &["ts_switch_status"],
        "MSG-46" | "DRV-14" | "D-7" => &["go_signal"],
        "MSG-47" | "D-37" => &["steering_status"],
        "MSG-49" | "RDY-6" => &["ami_state"],
        "MSG-50" | "D-40" => &["fault_status"],
        "MSG-51" | "D-39" => &["warning_status"],
        "MSG-52" => &["warn_batt_temp_high"],
        "MSG-53" => &["warn_batt_soc_low"],
        "HS-9" | "HS-13" | "HS-16" | "HS-17" | "HS-18" | "HS-19" | "D-8" | "D-18" | "D-26" | "D-52" => {
            &["ai_comms_lost"]
        }
        "MSG-64" | "MSG-85" | "D-15" | "D-16" => &["shutdown_cause"],
        "D-55" => &["ebs_fault", "shutdown_cause"],
        "D-12" | "D-13" | "D-14" => &["hvil_open_fault", "shutdown_cause"],
        "D-17" => &FLAGS,
        "D-27" => &["autonomous_braking_fault", "mission_status_fault"],
        "IMP-9" => &["autonomous_braking_fault", "mission_status_fault", "brake_plausibility_fault"],
        // A fault of AS_DRIVING: it is raised, and the state is left.
        "IMP-5" => &["as_state", "mission_status_fault"],
        "IMP-6" => &["as_state", "autonomous_braking_fault"],
        "IMP-8" | "D-64" => &["as_state", "brake_plausibility_fault"],
        "DRV-2" | "FIN-5" => {
            &["front_axle_trq", "rear_axle_trq", "front_motor_speed_max", "rear_motor_speed_max", "direction"]
        }
        "MSG-25" | "DRV-3" | "FIN-6" => &["steer"],
        "D-21" => &[
            "front_axle_trq",
            "rear_axle_trq",
            "front_motor_speed_max",
            "rear_motor_speed_max",
            "direction",
            "steer",
        ],
        "D-41" | "D-42" => &["hyd_press_f", "hyd_press_r"],
        "D-43" => &["hyd_press_f", "hyd_press_r", "ebs_triggered"],
        _ => match FLAGS.iter().position(|flag| own(flag) == id) {
            Some(place) => std::slice::from_ref(&FLAGS[place]),
            // The state machine.
            None => &["as_state"],
        },
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

/// The only state in which a requirement says anything of the outputs that it is about; `None`: in all of them.
pub(super) fn only_in(id: &str) -> Option<AsState> {
    match id {
        "D-42" => Some(AsState::Off),
        "DRV-2" | "DRV-3" => Some(AsState::Ready),
        "MSG-18" | "MSG-25" => Some(AsState::Driving),
        "D-43" => Some(AsState::EmergencyBrake),
        "FIN-5" | "FIN-6" => Some(AsState::Finished),
        _ => None,
    }
}

/// The requirement that an output itself is: what is broken if it is wrong where nothing more special asks for it.
pub(super) fn own(key: &str) -> &'static str {
    let flag = SHOWN.iter().find(|field| field.key == key).and_then(|field| field.fault);
    if let Some(fault) = flag {
        return fault.requirement();
    }
    match key {
        "handshake" => "MSG-42",
        "shutdown_request" => "MSG-43",
        "as_switch_status" => "MSG-44",
        "ts_switch_status" => "MSG-45",
        "go_signal" => "MSG-46",
        "steering_status" => "MSG-47",
        "ami_state" => "MSG-49",
        "fault_status" => "MSG-50",
        "warning_status" => "MSG-51",
        "warn_batt_temp_high" => "MSG-52",
        "warn_batt_soc_low" => "MSG-53",
        "shutdown_cause" => "MSG-64",
        "hyd_press_f" | "hyd_press_r" => "D-41",
        "ebs_triggered" => "D-43",
        "front_axle_trq"
        | "rear_axle_trq"
        | "front_motor_speed_max"
        | "rear_motor_speed_max"
        | "direction"
        | "steer" => "D-21",
        _ => STATE_MACHINE,
    }
}

/// What asks for the state machine as such.
pub(super) const STATE_MACHINE: &str = "SM-1";
/// What forbids to go where no arrow leads.
pub(super) const NO_ARROW: &str = "SM-18";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_output_has_a_requirement_that_is_about_it() {
        for field in &SHOWN {
            assert!(shows(own(field.key)).contains(&field.key), "{}", field.key);
        }
    }

    #[test]
    fn what_requirements_are_about_are_outputs() {
        let requirements = include_str!("../../../spec/REQUIREMENTS.md");
        let ids = requirements.lines().filter_map(|line| line.strip_prefix("- **")?.split_once("**"));
        let mut count = 0;
        for (id, _) in ids {
            count += 1;
            assert!(shows(id).iter().all(|key| SHOWN.iter().any(|field| field.key == *key)), "{id}");
        }
        assert!(count > 100, "{count}");
        for field in &SHOWN {
            assert!(requirements.contains(&format!("**{}**", own(field.key))), "{}", field.key);
        }
    }
}
