//! Logs to try: drives of the virtual car, made when they are asked for.

use adsdv_can::demo::Slip;
use adsdv_can::scenario::Scenario;
use adsdv_spec::messages::AsState;
use serde::Serialize;

use crate::drive::Drive;
use crate::error::Refusal;

/// A drive.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Example {
    id: &'static str,
    title: &'static str,
    edition: &'static str,
    #[serde(skip)]
    scenario: &'static str,
    /// What the AI Computer does wrong, so many milliseconds after a state began.
    #[serde(skip)]
    slip: Option<(Slip, AsState, u64)>,
}

/// No drive takes longer, in milliseconds.
const LONGEST_MS: u64 = 120_000;
/// So long a log goes on after the last line of its scenario, in milliseconds.
const TAIL_MS: u64 = 1000;
/// And so long after a mistake, which may keep the scenario from its end.
const AFTER_SLIP_MS: u64 = 8000;

impl Example {
    const fn new(
        id: &'static str,
        title: &'static str,
        edition: &'static str,
        scenario: &'static str,
    ) -> Self {
        Self { id, title, edition, scenario, slip: None }
    }

    const fn with(self, slip: Slip, state: AsState, after_ms: u64) -> Self {
        Self { slip: Some((slip, state, after_ms)), ..self }
    }
}

/// All of them.
pub(crate) const EXAMPLES: [Example; 8] = [
    Example::new("mission", "A mission from AS_OFF to AS_FINISHED", "3.0", "mission"),
    Example::new("mission-2026", "The same with the vehicle of 2026", "2026", "mission"),
    Example::new("finished", "FINISHED while the wheels still turn", "3.0", "mission").with(
        Slip::SaysFinished,
        AsState::Driving,
        4000,
    ),
    Example::new("torque", "Torque is asked for too early, and the car does not drive off", "3.0", "mission")
        .with(Slip::AsksForTorque, AsState::Ready, 1500),
    Example::new("handshake", "The AI Computer no longer answers the handshake", "4.0", "mission").with(
        Slip::HoldsHandshake,
        AsState::Driving,
        2500,
    ),
    Example::new("go-too-early", "\"Go\" is pressed too early", "2026", "go-too-early"),
    Example::new("remote-estop", "The remote E-stop ends the run", "2026", "remote-estop"),
    Example::new("power-cycle", "An emergency stop, and the power cycle after it", "3.0", "power-cycle"),
];

/// The log of one, as candump writes it.
pub(crate) fn log(id: &str) -> Result<String, Refusal> {
    let example = EXAMPLES.iter().find(|example| example.id == id);
    let example = example.ok_or_else(|| Refusal::of_request(format!("there is no example {id:?}")))?;
    let scenario = Scenario::sample(example.scenario).unwrap_or_default();
    let mut drive = Drive::begin(Some(example.edition), &[], Some(scenario))?;
    let mut ends_at = LONGEST_MS;
    let mut slipped = false;
    while drive.time_ms() < ends_at && !drive.is_over() {
        drive.run(10);
        if drive.is_done() {
            ends_at = ends_at.min(drive.time_ms() + TAIL_MS);
        }
        if let Some((slip, state, after_ms)) = example.slip
            && drive.state() == Some(state)
            && drive.in_state_ms() >= after_ms
            && !slipped
        {
            slipped = true;
            drive.slip(slip, true);
            ends_at = drive.time_ms() + AFTER_SLIP_MS;
        }
    }
    Ok(drive.log())
}
