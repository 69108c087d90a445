//! What there is to choose from.

use adsdv_can::car::{Action, Switch};
use adsdv_can::demo::Slip;
use adsdv_can::scenario::Scenario;
use adsdv_report::json::ReadingsJson;
use adsdv_spec::{Edition, Inputs};
use serde::Serialize;

use crate::error::formats;
use crate::examples::{EXAMPLES, Example};

/// What the page begins with.
#[derive(Serialize)]
pub(crate) struct AboutJson {
    version: &'static str,
    formats: Vec<&'static str>,
    editions: Vec<EditionJson>,
    examples: [Example; EXAMPLES.len()],
    switches: Vec<SwitchJson>,
    power_cycle: [&'static str; 2],
    slips: Vec<[&'static str; 2]>,
    scenarios: Vec<&'static str>,
}

#[derive(Serialize)]
struct EditionJson {
    document: &'static str,
    #[serde(flatten)]
    readings: ReadingsJson,
}

#[derive(Serialize)]
struct SwitchJson {
    key: &'static str,
    about: &'static str,
    /// `sdc` opens the shutdown circuit, `reports` is reported to the VCU, and the others are of the car itself.
    part: &'static str,
    /// Its positions; the first is where it is at the beginning.
    positions: Vec<String>,
}

impl AboutJson {
    pub(crate) fn new() -> Self {
        let edition = |edition: &&Edition| EditionJson {
            document: edition.document,
            readings: ReadingsJson::new(edition),
        };
        Self {
            version: env!("CARGO_PKG_VERSION"),
            formats: formats(),
            editions: Edition::ALL.iter().map(edition).collect(),
            examples: EXAMPLES,
            switches: Switch::all().map(switch).collect(),
            power_cycle: [Action::POWER_CYCLE, Action::ABOUT_POWER_CYCLE],
            slips: Slip::ALL.iter().map(|slip| [slip.id(), slip.about()]).collect(),
            scenarios: Scenario::SAMPLES.iter().map(|(name, _)| *name).collect(),
        }
    }
}

fn switch(switch: Switch) -> SwitchJson {
    let first = switch.get(&Inputs::default());
    let mut raws = switch.positions();
    raws.sort_by_key(|raw| *raw != first);
    SwitchJson {
        key: switch.key(),
        about: switch.about(),
        part: switch.part(),
        positions: raws.into_iter().map(|raw| switch.position(raw)).collect(),
    }
}
