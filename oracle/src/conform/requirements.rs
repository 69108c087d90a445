//! What was passed, failed and not checked, requirement by requirement.

use super::report::Failure;
use crate::suite::{Test, is_of_a_reading};

/// A requirement that tests name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Requirement {
    /// As `spec/REQUIREMENTS.md` numbers it, such as `RDY-5`.
    pub id: String,
    /// What came of it.
    pub outcome: Outcome,
    /// How many tests name it.
    pub tests: usize,
    /// The tests of it that failed, and the random scenarios that found a row broken which it is behind.
    pub failed: Vec<String>,
}

/// What came of a requirement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Every test of it was passed.
    Pass,
    /// A test of it was failed.
    Fail,
    /// The program does not show what it is about, or cannot be asked for it.
    NotChecked,
}

impl Outcome {
    /// In words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail => "fail",
            Self::NotChecked => "not checked",
        }
    }
}

/// The requirements that tests name, in the order of their prefixes' first tests, and by number.
///
/// `ran` tells of each test whether it was run and, if so, whether it was passed. A random scenario that failed counts
/// against the requirements behind the row that it found broken.
pub(super) fn table(
    tests: &[Test],
    ran: &[Option<bool>],
    answered: &[&str],
    random: &[Failure],
) -> Vec<Requirement> {
    let mut found: Vec<(Requirement, bool)> = Vec::new();
    for (test, ran) in tests.iter().zip(ran) {
        for id in test.requirements.iter().filter(|id| !is_of_a_reading(id)) {
            let place =
                found.iter().position(|(requirement, _)| requirement.id == *id).unwrap_or_else(|| {
                    let outcome = Outcome::NotChecked;
                    found
                        .push((Requirement { id: id.clone(), outcome, tests: 0, failed: Vec::new() }, false));
                    found.len() - 1
                });
            let Some((requirement, run)) = found.get_mut(place) else { continue };
            requirement.tests += 1;
            *run |= ran.is_some();
            if *ran == Some(false) {
                requirement.failed.push(test.name.clone());
            }
        }
    }
    let mut requirements: Vec<Requirement> = Vec::with_capacity(found.len());
    for (mut requirement, run) in found {
        let also = random.iter().filter(|failure| failure.requirements.contains(&requirement.id));
        requirement.failed.extend(also.map(|failure| failure.name.clone()));
        let is_shown = shows(&requirement.id).iter().any(|key| answered.contains(key));
        requirement.outcome = match (requirement.failed.is_empty(), run && is_shown) {
            (false, _) => Outcome::Fail,
            (true, true) => Outcome::Pass,
            (true, false) => Outcome::NotChecked,
        };
        requirements.push(requirement);
    }
    requirements.sort_by_key(|requirement| order(&requirement.id));
    requirements
}

/// The prefixes in the order of the document, and within them numbers.
fn order(id: &str) -> (usize, u32) {
    const PREFIXES: [&str; 14] =
        ["MSG", "ID", "HS", "SM", "RDY", "DRV", "FIN", "FTO", "RTE", "RTO", "DTE", "FTE", "ETO", "IMP"];
    let (prefix, number) = id.split_once('-').unwrap_or((id, ""));
    let place = PREFIXES.iter().position(|known| *known == prefix).unwrap_or(PREFIXES.len());
    (place, number.parse().unwrap_or(u32::MAX))
}

/// The outputs that a requirement is about: one of them at least has to be shown for it to be checked.
fn shows(id: &str) -> &'static [&'static str] {
    match id {
        "MSG-42" | "HS-1" | "HS-2" | "HS-3" | "HS-4" | "HS-5" | "HS-6" | "HS-7" | "HS-8" | "HS-12"
        | "HS-14" | "HS-15" | "D-44" => &["handshake"],
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
        "MSG-54" => &["ai_estop_request"],
        "MSG-55" => &["hvil_open_fault"],
        "MSG-56" => &["hvil_short_fault"],
        "MSG-57" => &["ebs_fault"],
        "MSG-58" => &["offboard_charger_fault"],
        "MSG-59" | "HS-9" | "HS-13" | "HS-16" | "D-8" | "D-18" | "D-26" => &["ai_comms_lost"],
        "MSG-60" => &["autonomous_braking_fault"],
        "MSG-61" => &["mission_status_fault"],
        "MSG-62" => &["charge_procedure_fault"],
        "MSG-63" => &["bms_fault"],
        "MSG-64" | "D-15" | "D-16" => &["shutdown_cause"],
        "D-12" | "D-13" | "D-14" => &["hvil_open_fault", "shutdown_cause"],
        "D-17" => &["fault_status", "hvil_open_fault", "ai_comms_lost", "ai_estop_request", "bms_fault"],
        "D-27" => &["autonomous_braking_fault", "mission_status_fault"],
        "DRV-2" | "FIN-5" => {
            &["front_axle_trq", "rear_axle_trq", "front_motor_speed_max", "rear_motor_speed_max", "direction"]
        }
        "DRV-3" | "FIN-6" => &["steer"],
        "D-21" => &["front_axle_trq", "rear_axle_trq", "steer"],
        "D-41" | "D-42" => &["hyd_press_f", "hyd_press_r"],
        "D-43" => &["hyd_press_f", "hyd_press_r", "ebs_triggered"],
        // The state machine.
        _ => &["as_state"],
    }
}
