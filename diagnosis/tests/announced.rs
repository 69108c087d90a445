//! A diagnosis of a program that announces what it has: it is asked for nothing else, and nothing is named about the rest.

use adsdv_conform::ProgramError;
use adsdv_conform::protocol::{About, Answer, INPUTS, Protocol};
use adsdv_conform::suite::Step;
use adsdv_diagnosis::{
    Deviation, Diagnosis, Interface, Model, Running, Subject, diagnose_within, examples, figure,
};
use adsdv_spec::messages::AsState;
use adsdv_spec::{Edition, Inputs};

const EDITION: &Edition = &Edition::V3_0;
const TIME: std::time::Duration = std::time::Duration::from_mins(10);

/// What the program of the documentation announces.
fn documented() -> About {
    let page = include_str!("../../docs/first-diagnosis.md");
    let (_, list) = page.split_once("ABOUT = ").expect("the page has a list");
    let (list, _) = list.split_once(",\n}").expect("it ends");
    about(&format!("{list}}}"))
}

fn about(line: &str) -> About {
    About::read(line, &Protocol::of(EDITION)).expect("keys that there are").expect("it announces something")
}

/// A program with what it announces: another input than these is a failure of the test.
struct Announced {
    program: Running,
    inputs: Vec<&'static str>,
    outputs: Vec<&'static str>,
}

impl Announced {
    fn has_all_of(&self, inputs: &Inputs) {
        for field in INPUTS.iter().filter(|field| !self.inputs.contains(&field.key)) {
            assert_eq!((field.get)(inputs), (field.get)(&Inputs::default()), "{}", field.key);
        }
    }
}

impl Subject for Announced {
    fn reset(&mut self) -> Result<(), ProgramError> {
        self.program.reset()
    }

    fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError> {
        self.has_all_of(inputs);
        Ok(self.program.step(dt_ms, inputs)?.among(&self.outputs))
    }
}

/// What is found of a program that announces this, has these deviations, and is blind to every input that it does not announce.
fn found(about: &About, deviations: &[Deviation]) -> Diagnosis {
    let (inputs, outputs) = (about.inputs.clone().expect("a list"), about.outputs.clone().expect("a list"));
    let interface = Interface::new(about, &[]);
    let blind = INPUTS.iter().map(|field| field.key).filter(|key| !inputs.contains(key));
    let all: Vec<Deviation> =
        deviations.iter().copied().chain(blind.map(|key| Deviation::Ignores { key })).collect();
    let mut program = Announced { program: Model::new(EDITION, &all).running(), inputs, outputs };
    let found = diagnose_within(&mut program, EDITION, &interface, TIME).expect("a model answers everything");
    let examples = examples(EDITION, &interface, &found.deviations).expect("a model answers everything");
    for example in examples.into_iter().map(|example| example.expect("each shows")) {
        example.scenario.steps.iter().for_each(|Step { inputs, .. }| program.has_all_of(inputs));
        for difference in example.differences {
            assert!(program.outputs.contains(&difference.key), "{difference}");
        }
    }
    found
}

fn names(about: &About, ids: &[&str]) {
    let find = |id: &&str| Deviation::find(EDITION, id).expect("there is such a deviation");
    let found = found(about, &ids.iter().map(find).collect::<Vec<_>>());
    let own: Vec<String> = found.deviations.iter().map(|one| one.id(EDITION)).collect();
    assert_eq!(own, ids);
    assert!(found.unexplained.is_empty() && !found.cut);
}

#[test]
fn the_documented_program_is_asked_for_what_it_announces_and_nothing_else_is_named() {
    names(&documented(), &[]);
}

#[test]
fn a_deviation_of_the_documented_program_is_named_alone() {
    names(&documented(), &["handshake:+450ms"]);
    names(&documented(), &["ready-off:missing"]);
}

#[test]
fn an_arrow_that_no_input_leads_to_is_not_shown_and_no_deviation() {
    let few = about(
        r#"{"inputs":["asms","tsms","ami","ebs","handshake","mission_status"],"outputs":["as_state"]}"#,
    );
    let found = found(&few, &[]);
    assert_eq!((found.deviations.len(), found.unexplained.len()), (0, 0));
    assert!(found.not_shown.contains(&(AsState::Driving, AsState::Finished)), "{:?}", found.not_shown);
    let figure = figure(EDITION, &[], &found.not_shown);
    let of = |from, to| figure.iter().find(|arrow| (arrow.from, arrow.to) == (from, to)).expect("an arrow");
    assert!(of(AsState::Ready, AsState::Driving).not_shown, "there is no \"Go\"");
    assert!(!of(AsState::Off, AsState::Ready).not_shown && !of(AsState::Off, AsState::Ready).missing);
}
