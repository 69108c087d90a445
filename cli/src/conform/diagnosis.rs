//! What the program does otherwise, each by itself.

pub(super) mod json;

use std::fmt::{self, Write as _};
use std::time::Duration;

use adsdv_conform::protocol::{Answer, Difference};
use adsdv_conform::suite::Step;
use adsdv_conform::{ConformReport, Failure, Follows, Program, ProgramError, Reply, Vcu as _};
use adsdv_diagnosis::{
    Arrow, Deviation, Diagnosis, Example, Interface, Model, Record, Subject, diagnose_within, examples,
    figure,
};
use adsdv_oracle::requirements::are_decisions;
use adsdv_spec::{AsState, Choices, Edition, Inputs, Machine, Reading, Readings};

use super::figure as drawn;
use super::start;
use crate::accept::Accepted;
use crate::args::ConformArgs;
use crate::layout::{counted, wrapped};
use crate::progress::ProgressLine;
use crate::report::style::{self, Styled};

/// Of so many deviations what shows them leaves room for all on a screen.
const WITHOUT_A_LIST: usize = 3;
/// Progress is shown after so many steps.
const SHOWN_EVERY: usize = 500;

/// What a program does otherwise, by an edition as it reads it.
#[derive(Clone, Debug)]
pub(super) struct DiagnosedProgram {
    edition: Edition,
    found: Diagnosis,
    /// What shows each of the deviations.
    examples: Vec<Option<Example>>,
    pub(super) figure: Vec<Arrow>,
    accepted: Accepted,
    /// Whether what is only against decisions of this project counts.
    strict: bool,
    /// How long the search was allowed to take.
    limit: Duration,
    /// The one time that a step of the program takes.
    cycle_ms: Option<u32>,
    /// The program as far as it was found out.
    model: Model,
}

/// Starts the program once more, and finds out.
///
/// Which readings it follows its failed tests tell badly: what is a deviation may look like another reading. So the search begins with
/// the default answers, as far as they are possible, and finds the others as it finds deviations.
pub(super) fn of(
    args: &ConformArgs,
    (edition, possible): (&Edition, Choices),
    report: &ConformReport,
    accepted: &Accepted,
) -> Result<DiagnosedProgram, ProgramError> {
    let mut program = Asked { program: start(args)?, steps: 0, line: ProgressLine::new() };
    program.program.hello(edition)?;
    let limit = args.diagnosis_limit;
    let interface =
        Interface::new(&report.about, &report.not_shown).allowing(possible).at_cycle(report.cycle_ms);
    let usual = edition.readings.choices().iter().filter(|choice| possible.has(*choice));
    let usual = usual.fold(report.readings, Readings::with);
    let found = diagnose_within(&mut program, &Edition { readings: usual, ..*edition }, &interface, limit)?;
    let readings = found.readings.iter().copied().fold(usual, Readings::with);
    let edition = Edition { readings, ..*edition };
    program.line.show(format_args!("diagnosis: the shortest scenarios of {}", found.deviations.len()));
    let deviations = &found.deviations;
    Ok(DiagnosedProgram {
        examples: examples(&edition, &interface.without(&found.left_out), deviations)?,
        figure: figure(&edition, deviations, &found.not_shown),
        accepted: accepted.clone(),
        strict: args.strict,
        limit: args.diagnosis_limit,
        cycle_ms: report.cycle_ms,
        model: Model::new(&edition, deviations),
        edition,
        found,
    })
}

impl DiagnosedProgram {
    /// The answers to the document's questions by which it was found out.
    pub(super) const fn readings(&self) -> Readings {
        self.edition.readings
    }

    /// Whether deviations explain what the tests of a question show, by another answer than these speak for.
    pub(super) fn is_otherwise(&self, follows: &Follows) -> bool {
        !follows.possible.contains(&self.edition.readings.choice(follows.reading))
    }

    /// Whether it is not known how the program answers a question: the search ended, and what it does in a state in which that
    /// counts was not explained.
    pub(super) fn is_unclear(&self, reading: Reading) -> bool {
        let counts = states_of(&self.edition, reading);
        self.found.cut && self.found.unclear.iter().any(|state| counts.is_empty() || counts.contains(state))
    }

    /// Whether it answered alike what it was asked again.
    pub(super) const fn repeats(&self) -> bool {
        self.found.repeats
    }

    /// The deviations.
    pub(super) fn deviations(&self) -> &[Deviation] {
        &self.found.deviations
    }

    fn ids(&self) -> Vec<String> {
        self.found.deviations.iter().map(|deviation| deviation.id(&self.edition)).collect()
    }

    /// The accepted deviations that the program does not have any more.
    pub(super) fn unused(&self) -> Vec<&str> {
        self.accepted.unused(&self.ids())
    }

    /// Whether a failure follows from the deviations.
    pub(super) fn explains(&self, failure: &Failure) -> bool {
        let answers = failure.replies.iter().map(|reply| match reply {
            Reply::Answer(answer) => Some(*answer),
            Reply::Nothing => None,
        });
        let Some(replies) = answers.collect::<Option<Vec<Answer>>>() else { return false };
        let record = Record { steps: failure.scenario.steps.clone(), replies };
        failure.found.is_some() && !record.replies.is_empty() && record.is_explained(&self.model)
    }

    /// Whether every deviation is accepted, or only against decisions of this project.
    pub(super) fn is_accepted(&self) -> bool {
        let observed = |deviation: &Deviation| self.is_observed(*deviation);
        let accepted = |deviation: &Deviation| self.accepted.reason(&deviation.id(&self.edition)).is_some();
        self.found.deviations.iter().all(|one| accepted(one) || observed(one))
    }

    /// The first that counts, in words.
    pub(super) fn first_that_counts(&self) -> Option<String> {
        let counts = |one: &&Deviation| {
            self.accepted.reason(&one.id(&self.edition)).is_none() && !self.is_observed(**one)
        };
        let first = self.found.deviations.iter().find(counts)?;
        Some(first.text(&self.edition).to_string())
    }

    /// How long a search may take that finds more, in seconds, where this one ended early.
    pub(super) fn longer(&self) -> Option<f64> {
        self.found.cut.then_some(self.limit.as_secs_f64() * 10.0)
    }

    fn is_observed(&self, deviation: Deviation) -> bool {
        !self.strict && are_decisions(&deviation.requirements(&self.edition))
    }
}

/// The states that are left otherwise by another answer to a question; none where it is about more than the arrows.
fn states_of(edition: &Edition, reading: Reading) -> Vec<AsState> {
    let choices = reading.choices().iter().filter(|choice| edition.choices.has(**choice));
    let machines: Vec<Machine> =
        choices.map(|choice| Machine::new(*edition, edition.readings.with(*choice))).collect();
    let differs = |state: &AsState| {
        machines
            .iter()
            .zip(machines.iter().skip(1))
            .any(|(one, other)| !one.arrows(*state).eq(other.arrows(*state)))
    };
    AsState::ALL.into_iter().filter(differs).collect()
}

/// A program, with how many steps it was asked for on the terminal.
struct Asked {
    program: Program,
    steps: usize,
    line: ProgressLine,
}

impl Subject for Asked {
    fn reset(&mut self) -> Result<(), ProgramError> {
        Subject::reset(&mut self.program)
    }

    fn step(&mut self, dt_ms: u32, inputs: &Inputs) -> Result<Answer, ProgramError> {
        self.asks_for(1);
        Subject::step(&mut self.program, dt_ms, inputs)
    }

    fn steps(&mut self, steps: &[Step]) -> Result<Vec<Answer>, ProgramError> {
        self.asks_for(steps.len());
        Subject::steps(&mut self.program, steps)
    }

    fn is_waited_for(&self) -> bool {
        self.program.is_waited_for()
    }
}

impl Asked {
    /// Says how many steps were asked for each time when there are so many more.
    fn asks_for(&mut self, steps: usize) {
        let before = self.steps / SHOWN_EVERY;
        self.steps += steps;
        if self.steps / SHOWN_EVERY > before {
            self.line.show(format_args!("diagnosis: {} steps asked", self.steps));
        }
    }
}

/// As text, below the header.
pub(super) fn write(out: &mut String, program: &DiagnosedProgram, width: usize) -> fmt::Result {
    let DiagnosedProgram { edition, found, accepted, limit, .. } = program;
    writeln!(out, "\n{}", Styled(style::HEADING, "DEVIATIONS"))?;
    let experiments = counted(found.experiments as u64, "experiment");
    let (limit, longer) = (limit.as_secs_f64(), limit.as_secs_f64() * 10.0);
    if found.deviations.is_empty() {
        let undecided = Styled(style::CARE, "undecided:");
        let text = match (found.cut, found.unexplained.len()) {
            (true, _) => format!(
                "{undecided} the search ended after {limit} s and names nothing; see FAILURES; run again with --diagnosis-limit {longer}"
            ),
            (false, 0) => format!("none in {experiments}"),
            (false, _) => {
                format!(
                    "{undecided} nothing that can be named explains what it does; mend the first of FAILURES, and run again"
                )
            }
        };
        wrapped(out, text.split(' '), 2, width);
    }
    let machine = Machine::new(*edition, edition.readings);
    let mut each: Vec<(&Deviation, &Option<Example>)> =
        found.deviations.iter().zip(&program.examples).collect();
    // What counts comes first.
    each.sort_by_key(|(one, _)| (program.is_observed(**one), accepted.reason(&one.id(edition)).is_some()));
    if each.len() > WITHOUT_A_LIST {
        list(out, program, &each, width);
    }
    for (deviation, example) in each {
        let id = deviation.id(edition);
        let requirements = deviation.requirements(edition).join(", ");
        let of = if requirements.is_empty() { String::new() } else { format!(" ({requirements})") };
        let mut text = String::new();
        wrapped(&mut text, format!("{}{of}", deviation.text(edition)).split(' '), 2, width);
        let reason = accepted.reason(&id);
        let observed = program.is_observed(*deviation);
        let style = if reason.is_some() || observed { style::CARE } else { style::BAD };
        writeln!(out, "{}", Styled(style, text.trim_end_matches('\n')))?;
        if let Some(reason) = reason {
            wrapped(out, format!("accepted: {reason}").split(' '), 6, width);
        }
        if observed {
            wrapped(
                out,
                "no failure: the document is silent, and this is only decided here".split(' '),
                6,
                width,
            );
        }
        shown(out, (&id, example.as_ref()), (edition, &machine), width)?;
    }
    for choice in &found.readings {
        let (reading, text) = (choice.reading(), choice.text());
        let text = format!(
            "no deviation: {} {text} ({choice}, {}): the document leaves it open",
            reading.question(),
            reading.decision()
        );
        wrapped(out, text.split(' '), 2, width);
    }
    if !found.unexplained.is_empty() {
        let by = if found.deviations.is_empty() { "" } else { " by that" };
        let rest = format!("not explained{by}: {} of {experiments}", found.unexplained.len());
        wrapped(out, rest.split(' '), 2, width);
    }
    if !found.left_out.is_empty() {
        let rest = format!(
            "left out: {}: what is shown there nothing that can be named explains, and all above is about the other outputs; see FAILURES",
            found.left_out.join(", ")
        );
        wrapped(out, rest.split(' '), 2, width);
    }
    if found.cut && !found.deviations.is_empty() {
        let note = Styled(style::CARE, "note:");
        let rest = format!(
            "{note} the search ended after {limit} s: there may be more; run again with --diagnosis-limit {longer}"
        );
        wrapped(out, rest.split(' '), 2, width);
    }
    if let Some(cycle_ms) = program.cycle_ms {
        let rest = format!(
            "at a fixed cycle: fewer experiments, and a time is known to {cycle_ms} ms; what begins and ends within a cycle is not seen"
        );
        wrapped(out, rest.split(' '), 2, width);
    }
    for id in program.unused() {
        let text = format!("{id} is accepted, and is not there any more: take it out of the file");
        writeln!(out, "  {} {text}", Styled(style::CARE, "warning:"))?;
    }
    if !found.deviations.is_empty() {
        drawn::write(out, &program.figure, width)?;
    }
    Ok(())
}

/// The deviations at a glance: what shows them takes more than a screen.
fn list(out: &mut String, program: &DiagnosedProgram, each: &[(&Deviation, &Option<Example>)], width: usize) {
    let all = counted(each.len() as u64, "deviation");
    let silent = each.iter().filter(|(one, _)| program.is_observed(**one)).count();
    let of_which = match silent {
        0 => String::new(),
        silent => format!(", {silent} of them no failure, where the document is silent"),
    };
    wrapped(out, format!("{all}{of_which}; below, each with what shows it").split(' '), 2, width);
    for (one, _) in each {
        let text = one.text(&program.edition).to_string();
        let short = text.split("; expected").next().unwrap_or_default();
        let mut line = String::new();
        wrapped(&mut line, format!("- {short}").split(' '), 4, width);
        out.push_str(&line);
    }
    out.push('\n');
}

/// The scenario that shows a deviation.
fn shown(
    out: &mut String,
    (id, example): (&str, Option<&Example>),
    (edition, machine): (&Edition, &Machine),
    width: usize,
) -> fmt::Result {
    let Some(Example { scenario, differences, beside }) = example else {
        return writeln!(out, "      {}", Styled(style::QUIET, format!("id {id}")));
    };
    let steps = counted(scenario.steps.len() as u64, "step");
    // In another state all outputs are others.
    let state = differences.iter().filter(|one| one.key == "as_state");
    let listed: Vec<&Difference> = match state.collect::<Vec<_>>() {
        state if state.is_empty() => differences.iter().collect(),
        state => state,
    };
    let wrong: Vec<String> = listed.iter().map(ToString::to_string).collect();
    wrapped(out, format!("after {steps}: {}", wrong.join(", ")).split(' '), 6, width);
    if !beside.is_empty() {
        let others: Vec<String> = beside.iter().map(|other| other.id(edition)).collect();
        wrapped(out, format!("shown beside {}", others.join(", ")).split(' '), 6, width);
    }
    let line = format!("as a test for --suite: {}", scenario.to_line(id, machine));
    writeln!(out, "      {}", Styled(style::QUIET, line))
}
