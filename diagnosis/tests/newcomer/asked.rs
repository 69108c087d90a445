//! What newcomers' state machines have in common: the inputs and outputs of the book's page, and how they are diagnosed.

use std::collections::BTreeSet;
use std::time::Duration;

use adsdv_conform::ProgramError;
use adsdv_conform::protocol::{About, Answer, INPUTS, Protocol, SHOWN};
use adsdv_diagnosis::{Diagnosis, Interface, Model, Subject, diagnose_within};
use adsdv_spec::{Choice, Edition, Inputs};

pub(crate) const EDITION: &Edition = &Edition::V3_0;
const TIME: Duration = Duration::from_mins(10);

/// What each of them shows.
const OUTPUTS: [&str; 4] = ["as_state", "handshake", "ai_comms_lost", "shutdown_cause"];

/// A state machine.
pub(crate) trait Newcomer {
    /// The same after power-on.
    fn anew(&self) -> Self;

    /// One step: AS_STATE, HANDSHAKE, AI_COMMS_LOST and SHUTDOWN_CAUSE afterwards, as raw numbers.
    fn one_step(&mut self, dt_ms: u32, inputs: &Inputs) -> [i32; 4];
}

/// An input by its key in the protocol.
pub(crate) fn raw(inputs: &Inputs, key: &str) -> i32 {
    INPUTS.iter().find(|field| field.key == key).map(|field| (field.get)(inputs)).expect(key)
}

struct Asked<N>(N);

impl<N: Newcomer> Subject for Asked<N> {
    fn reset(&mut self) -> Result<(), ProgramError> {
        self.0 = self.0.anew();
        Ok(())
    }

    fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError> {
        let any = Model::new(EDITION, &[]).running().shown(0, &Inputs::default());
        let values = OUTPUTS.iter().zip(self.0.one_step(dt_ms, inputs));
        let shown = values.fold(any, |shown, (key, raw)| {
            let place = SHOWN.iter().position(|field| field.key == *key).expect("an output");
            shown.with(place, raw)
        });
        Ok(Answer::from(shown).among(&OUTPUTS))
    }
}

/// What is found out about a state machine that announces what the page announces.
pub(crate) fn found(newcomer: impl Newcomer) -> Diagnosis {
    let page = include_str!("../../../docs/first-diagnosis.md");
    let (_, list) = page.split_once("ABOUT = ").expect("the page has a list");
    let (list, _) = list.split_once(",\n}").expect("it ends");
    let about = About::read(&format!("{list}}}"), &Protocol::of(EDITION)).expect("keys that there are");
    let interface = Interface::new(&about.expect("it announces something"), &[]);
    diagnose_within(&mut Asked(newcomer), EDITION, &interface, TIME).expect("it answers everything")
}

/// Just these are named, deviations by their ids and answers to open questions, and all is explained.
#[track_caller]
pub(crate) fn names<'a>(found: &Diagnosis, expected: impl Iterator<Item = &'a &'a str>) {
    let ids = found.deviations.iter().map(|one| one.id(EDITION));
    let named: BTreeSet<String> = ids.chain(found.readings.iter().map(Choice::to_string)).collect();
    assert_eq!(named, expected.map(|id| (*id).to_owned()).collect());
    assert_eq!((found.unexplained.len(), &found.left_out[..], found.cut), (0, &[][..], false));
}
