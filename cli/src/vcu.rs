//! `adsdv vcu`: the reference VCU and its car on a CAN interface.

use std::path::Path;

use adsdv_can::bus::Bus;
use adsdv_can::live::Vcu;
use adsdv_can::scenario::{PATIENCE_MS, Player, Stuck};
use adsdv_can::socket;

use crate::args::{ChosenEdition, VcuArgs};
use crate::error::Error;
use crate::status::Status;
use crate::{demo, operate, pins, plain};

pub(crate) fn run(args: &VcuArgs) -> Result<Status, Error> {
    let chosen = args.edition.chosen()?;
    let machine = pins::machine(chosen.edition(), &args.readings)?;
    let scenario = args.scenario.as_deref().map(demo::read).transpose()?;
    let bus = socket::open(&args.interface)?;
    drive(Vcu::new(bus, machine, scenario.as_ref().map(Player::new)), chosen, args)
}

/// Lets the VCU run until it is stopped, or its scenario is over or given up.
fn drive<B: Bus + Send + 'static>(
    vcu: Vcu<B>,
    chosen: ChosenEdition,
    args: &VcuArgs,
) -> Result<Status, Error> {
    let asked = args.patience.map(|seconds| u64::from(seconds) * 1000);
    let status = if !args.plain && operate::has_screen() {
        // An operator at the keys can do what the scenario waits for.
        let vcu = match asked {
            Some(patience_ms) => vcu.with_patience(patience_ms),
            None => vcu,
        };
        operate::on_screen(vcu, chosen, args.color)?
    } else {
        plain::run(vcu.with_patience(asked.unwrap_or(PATIENCE_MS)), chosen, args.color)?
    };
    match &status.stuck {
        Some(stuck) => Err(given_up(args.scenario.as_deref(), stuck)),
        None => Ok(Status::Conforms),
    }
}

/// The scenario waits for a state that does not come.
fn given_up(scenario: Option<&Path>, stuck: &Stuck) -> Error {
    Error {
        what: scenario.map_or_else(|| "the scenario".to_owned(), demo::scenario_name),
        why: stuck.to_string(),
        hint:
            "see what is missing: the AI Computer has to do it, or the operator in a line before that one; \
               --patience waits longer"
                .to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use adsdv_can::ai::Ai;
    use adsdv_can::demo::LocalBus;
    use adsdv_can::scenario::Scenario;
    use clap::ColorChoice;

    use super::*;
    use crate::args::EditionArgs;

    #[test]
    fn a_scenario_that_waits_in_vain_is_given_up_with_what_it_waits_for()
    -> Result<(), Box<dyn std::error::Error>> {
        let args = VcuArgs {
            interface: "demo".to_owned(),
            scenario: Some("in-vain.txt".into()),
            patience: Some(1),
            readings: Vec::new(),
            plain: true,
            edition: EditionArgs::default(),
            color: ColorChoice::Never,
        };
        let scenario: Scenario = "0 ebs ARMED, asms on\nAS_READY end\n".parse()?;
        let chosen = args.edition.chosen()?;
        let machine = pins::machine(chosen.edition(), &[])?;
        let vcu = Vcu::new(LocalBus::new(Ai::default()), machine, Some(Player::new(&scenario)));
        let error = drive(vcu, chosen, &args).expect_err("no mission is selected").to_string();
        let expected = "in-vain.txt: line 2: expected AS_READY, found AS_OFF after 1 s; AS_READY (section 3.1) still needs: ";
        assert!(error.starts_with(expected) && error.contains("TS master switch ON"), "{error}");
        assert!(error.contains("--patience"), "{error}");
        Ok(())
    }
}
