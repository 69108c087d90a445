//! What came of it as text for a person.

use std::fmt::{self, Write as _};

use adsdv_conform::protocol::About;
use adsdv_conform::{ConformReport, Failure, Follows, Outcome, Requirement, Stretch};
use adsdv_spec::{Edition, Machine};

use super::JudgedProgram;
use crate::layout::{counted, wrapped};
use crate::report::style::{self, Styled};

/// The columns of a requirement.
const ID: usize = 8;
/// The columns of an outcome.
const OUTCOME: usize = 11;
/// The columns of a state.
const STATE: usize = 15;
/// The columns of how many tests there are.
const TESTS: usize = 10;
/// Where the inputs of a step stand.
const INPUTS: usize = 4 + 9 + 2 + 10 + 2 + STATE + 2 + STATE + 6;
/// The report lists so many names; of more only how many there are.
const NAMES: usize = 6;

pub(super) fn text(subject: &JudgedProgram<'_>, report: &ConformReport, width: usize) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, subject, report, width);
    text
}

fn write(out: &mut String, subject: &JudgedProgram<'_>, report: &ConformReport, width: usize) -> fmt::Result {
    header(out, subject, report, width)?;
    if let Some(program) = &subject.diagnosis {
        super::diagnosis::write(out, program, width)?;
    } else if let Some(why) = subject.undiagnosed {
        writeln!(out, "\n{}", Styled(style::HEADING, "DEVIATIONS"))?;
        wrapped(out, format!("not looked for: {why}").split(' '), 2, width);
    }
    let machine = Machine::new(*subject.edition.edition(), report.readings);
    // What a table of identifiers does not say the first failure shows, where no deviation says it before.
    let explained = subject.diagnosis.as_ref().is_some_and(|program| !program.deviations().is_empty());
    if explained || report.failures.is_empty() {
        requirements(out, subject.args.all, report, width)?;
        all_failures(out, subject, report, &machine, width)?;
    } else {
        all_failures(out, subject, report, &machine, width)?;
        requirements(out, subject.args.all, report, width)?;
    }
    if !report.observations.is_empty() {
        writeln!(out, "\n{}", Styled(style::HEADING, "OBSERVATIONS"))?;
        let about = "where the document is silent: otherwise than decided here, which is no failure but with --strict";
        wrapped(out, about.split(' '), 2, width);
        those(out, subject, &report.observations, &machine, width)?;
    }
    writeln!(out, "\n{}", Styled(style::HEADING, "READINGS"))?;
    for follows in &report.follows {
        match subject.args.readings.iter().find(|pin| pin.reading() == follows.reading) {
            Some(pin) => {
                writeln!(out, "  {:17} pinned to {}: {}", follows.reading, pin.id(), pin.text())?;
            }
            None if subject.diagnosis.as_ref().is_some_and(|program| program.is_unclear(follows.reading)) => {
                let weak = Styled(style::CARE, "not shown: answers that it decides are not explained");
                writeln!(out, "  {:17} {weak}", follows.reading)?;
            }
            None if subject.diagnosis.as_ref().is_some_and(|program| program.is_otherwise(follows)) => {
                let weak = Styled(style::CARE, "undecided: the deviations explain the tests of it");
                writeln!(out, "  {:17} {weak}", follows.reading)?;
            }
            None => reading(out, subject.edition.edition(), follows, width)?,
        }
    }
    if !subject.args.readings.is_empty() && !subject.conforms {
        let note = "what else the program may follow was not asked: leave the pins out to learn it";
        wrapped(out, note.split(' '), 2, width);
    }
    verdict(out, subject, report)
}

fn header(
    out: &mut String,
    subject: &JudgedProgram<'_>,
    report: &ConformReport,
    width: usize,
) -> fmt::Result {
    let JudgedProgram { edition, name, args, .. } = subject;
    writeln!(out, "{edition}")?;
    writeln!(
        out,
        "{name}: {}, {} (seed {}), {}",
        counted(report.tests as u64, "test"),
        counted(report.runs.into(), "random scenario"),
        args.seed,
        counted(report.steps, "step"),
    )?;
    for pin in &args.readings {
        writeln!(out, "reading {pin}: {}", pin.text())?;
    }
    if args.latency > 0 {
        writeln!(out, "outputs {} late", counted(report.late as u64, "step"))?;
    }
    if let Some(cycle_ms) = report.cycle_ms {
        let by = if args.cycle_ms.is_none() { ", as it says" } else { "" };
        writeln!(out, "cycle {cycle_ms} ms{by}")?;
    }
    if !report.not_run.is_empty() {
        let count = counted(report.not_run.len() as u64, "test");
        names(
            out,
            &format!("not run, for {}: {count}", why_not_run(report)),
            &report.not_run,
            args.all,
            width,
        );
    }
    if !report.not_shown.is_empty() {
        let count = report.not_shown.len();
        names(out, &format!("outputs that it does not show: {count}"), &report.not_shown, args.all, width);
    }
    for note in &report.notes {
        writeln!(out, "{} {note}", Styled(style::CARE, "note:"))?;
    }
    Ok(())
}

/// How many there are, and, if all are wanted, which.
fn names<S: AsRef<str>>(out: &mut String, count: &str, all: &[S], wanted: bool, width: usize) {
    if wanted {
        wrapped(out, format!("{count}:").split(' '), 0, width);
        let all: Vec<&str> = all.iter().map(AsRef::as_ref).collect();
        wrapped(out, all.join(", ").split(' '), 2, width);
    } else {
        wrapped(out, format!("{count} (--all lists them)").split(' '), 0, width);
    }
}

/// Why tests were not run.
pub(super) fn why_not_run(report: &ConformReport) -> &'static str {
    match (&report.about, report.cycle_ms) {
        (about, _) if about.wall_clock => "there is no time for them, or a clock cannot tell them",
        (About { inputs: Some(_), .. }, None) => "they need an input that it does not have",
        (About { inputs: Some(_), .. }, Some(_)) => {
            "they need an input that it does not have, or steps of its cycle cannot express them"
        }
        _ => "steps of it cannot express them",
    }
}

fn requirements(out: &mut String, all: bool, report: &ConformReport, width: usize) -> fmt::Result {
    writeln!(out, "\n{}", Styled(style::HEADING, "REQUIREMENTS"))?;
    // Those of a suite that somebody else wrote may be any.
    let about = match report.about_the_vcu.checked_sub(report.requirements.len()) {
        Some(more) if more > 0 => {
            format!("; {more} more about the VCU are in no test, for no output shows them")
        }
        _ => String::new(),
    };
    wrapped(out, format!("their sentences stand in spec/REQUIREMENTS.md{about}").split(' '), 2, width);
    let passed = report.requirements.iter().filter(|one| one.outcome == Outcome::Pass).count();
    if !all && passed > 0 {
        writeln!(out, "  {} (--all lists them)", Styled(style::GOOD, format!("{passed} pass")))?;
        if passed == report.requirements.len() {
            return Ok(());
        }
    }
    writeln!(out, "  {:ID$}  {:OUTCOME$}  {:>TESTS$}  FAILED", "ID", "RESULT", "TESTS")?;
    let listed = report.requirements.iter().filter(|one| all || one.outcome != Outcome::Pass);
    for Requirement { id, outcome, tests, checked, failed } in listed {
        let style = match outcome {
            Outcome::Pass => style::GOOD,
            Outcome::Fail => style::BAD,
            Outcome::Differs => style::CARE,
            Outcome::NotChecked => style::QUIET,
        };
        let tests = if checked == tests { tests.to_string() } else { format!("{checked} of {tests}") };
        write!(out, "  {id:ID$}  {:OUTCOME$}  {tests:>TESTS$}", Styled(style, outcome.name()))?;
        if failed.is_empty() {
            out.push('\n');
        } else {
            const INDENT: usize = 2 + ID + 2 + OUTCOME + 2 + TESTS + 2;
            let mut names = String::new();
            wrapped(&mut names, joined(failed).split(' '), INDENT, width.max(INDENT + 30));
            write!(out, "  {}", names.trim_start())?;
        }
    }
    Ok(())
}

fn all_failures(
    out: &mut String,
    subject: &JudgedProgram<'_>,
    report: &ConformReport,
    machine: &Machine,
    width: usize,
) -> fmt::Result {
    writeln!(out, "\n{}", Styled(style::HEADING, "FAILURES"))?;
    if report.failures.is_empty() {
        writeln!(out, "  none")?;
    }
    those(out, subject, &report.failures, machine, width)?;
    if report.more_failures > 0 {
        writeln!(out, "\n  and {} more", report.more_failures)?;
    }
    Ok(())
}

/// Some names, and how many more there are.
fn joined(all: &[String]) -> String {
    let listed: Vec<&str> = all.iter().take(NAMES).map(String::as_str).collect();
    let more = all.len() - listed.len();
    if more == 0 { listed.join(", ") } else { format!("{} and {more} more", listed.join(", ")) }
}

/// Those that the deviations do not explain; of the others only their names.
fn those(
    out: &mut String,
    subject: &JudgedProgram<'_>,
    all: &[Failure],
    machine: &Machine,
    width: usize,
) -> fmt::Result {
    let follows =
        |failure: &&Failure| subject.diagnosis.as_ref().is_some_and(|program| program.explains(failure));
    let (explained, rest): (Vec<&Failure>, Vec<&Failure>) =
        all.iter().partition(|failure| !subject.args.all && follows(failure));
    if !explained.is_empty() {
        let names: Vec<String> = explained.iter().map(|failure| failure.name.clone()).collect();
        let follow = if names.len() == 1 { "follows" } else { "follow" };
        let count = names.len();
        let text =
            format!("{count} {follow} from the deviations above: {} (--all prints them)", joined(&names));
        wrapped(out, text.split(' '), 2, width);
    }
    failures(out, &rest, machine, width)
}

fn failures(out: &mut String, failures: &[&Failure], machine: &Machine, width: usize) -> fmt::Result {
    for (place, one) in failures.iter().enumerate() {
        if place > 0 {
            out.push('\n');
        }
        failure(out, one, machine, width)?;
    }
    Ok(())
}

fn failure(out: &mut String, failure: &Failure, machine: &Machine, width: usize) -> fmt::Result {
    writeln!(out, "  {}", Styled(style::HEADING, &failure.name))?;
    if !failure.about.is_empty() {
        wrapped(out, failure.about.split(' '), 4, width);
    }
    let Some(found) = &failure.found else {
        let why = "its answers were wrong, and were right when it was asked again: the program does not answer the same \
                   questions alike; it may keep something over a reset";
        wrapped(out, why.split(' '), 4, width);
        also(out, failure, width);
        return Ok(());
    };
    let mut why = String::new();
    wrapped(&mut why, found.why.to_string().split(' '), 4, width);
    let line = why.trim_end();
    writeln!(out, "{}", Styled(style::BAD, line))?;
    writeln!(
        out,
        "    {:>9}  {:>10}  {:STATE$}  {:STATE$}      INPUTS THAT CHANGED",
        "STEP", "TIME", "EXPECTED", "ACTUAL"
    )?;
    for moment in failure.timeline() {
        step(out, &moment, width)?;
    }
    for difference in &found.differences {
        writeln!(out, "    {difference}")?;
    }
    also(out, failure, width);
    // On one line, however long: it is there to be copied.
    let line = failure.scenario.to_line(&failure.name, machine);
    writeln!(out, "    as a test for --suite: {}", Styled(style::QUIET, line))
}

fn step(out: &mut String, moment: &Stretch, width: usize) -> fmt::Result {
    let Stretch { first, last, time_ms, changes, expected, actual, wrong } = moment;
    let steps = if first == last { first.to_string() } else { format!("{first}-{last}") };
    let state = |state: &Option<_>| state.as_ref().map_or("-".to_owned(), ToString::to_string);
    write!(out, "    {steps:>9}  {time_ms:>7} ms  {:STATE$}  ", state(expected))?;
    if *wrong {
        write!(out, "{:STATE$} {}", Styled(style::BAD, state(actual)), Styled(style::BAD, "<--"))?;
    } else {
        write!(out, "{:STATE$}    ", state(actual))?;
    }
    if changes.is_empty() {
        return writeln!(out);
    }
    let last = changes.len() - 1;
    let words = changes
        .iter()
        .enumerate()
        .map(|(place, (key, value))| format!("{key} {value}{}", if place == last { "" } else { "," }));
    let mut inputs = String::new();
    wrapped(&mut inputs, words, INPUTS, width.max(INPUTS + 30));
    write!(out, "  {}", inputs.trim_start())
}

fn also(out: &mut String, failure: &Failure, width: usize) {
    let mut more = |what: &str, all: &[String]| {
        if !all.is_empty() {
            let mut line = what.to_owned();
            line += " ";
            line += &joined(all);
            wrapped(out, line.split(' '), 4, width);
        }
    };
    more("requirements:", &failure.requirements);
    more("fail likewise:", &failure.also);
    let choices: Vec<String> = failure.explained_by.iter().map(ToString::to_string).collect();
    more("right under:", &choices);
}

fn reading(out: &mut String, edition: &Edition, follows: &Follows, width: usize) -> fmt::Result {
    let Follows { reading, possible, mixes } = follows;
    write!(out, "  {reading:17} ")?;
    if !mixes.is_empty() {
        writeln!(out, "{}", Styled(style::BAD, "MIXES"))?;
        for side in mixes {
            let line = format!("{}: {}", side.choice.id(), joined(&side.tests));
            wrapped(out, line.split(' '), 6, width);
        }
        return Ok(());
    }
    match possible.as_slice() {
        [] => writeln!(out, "{}", Styled(style::CARE, "undecided: no choice explains the tests of it")),
        [only] => {
            let usual = if edition.readings.is(*only) { " (the default)" } else { "" };
            writeln!(out, "follows {}: {}{usual}", only.id(), only.text())
        }
        several => {
            let ids: Vec<&str> = several.iter().map(|choice| choice.id()).collect();
            writeln!(out, "{} {}", Styled(style::CARE, "undecided:"), ids.join(" or "))
        }
    }
}

fn verdict(out: &mut String, subject: &JudgedProgram<'_>, report: &ConformReport) -> fmt::Result {
    let verdict = if subject.conforms {
        Styled(style::GOOD, "conforms")
    } else {
        Styled(style::BAD, "does not conform")
    };
    let count = |wanted: Outcome| {
        let count = report.requirements.iter().filter(|requirement| requirement.outcome == wanted).count();
        format!("{count} {}", wanted.name())
    };
    writeln!(
        out,
        "\n{}: {verdict} (requirements: {}, {}, {}, of {} about the VCU; failed: {} of {}, {} of {})",
        subject.name,
        count(Outcome::Pass),
        count(Outcome::Fail),
        count(Outcome::NotChecked),
        report.about_the_vcu,
        report.failed_tests,
        counted(report.tests as u64, "test"),
        report.failed_runs,
        counted(report.runs.into(), "random scenario"),
    )?;
    if !report.observations.is_empty() {
        let (tests, runs) = (report.observed_tests as u64, u64::from(report.observed_runs));
        let many = format!("{} and {}", counted(tests, "test"), counted(runs, "random scenario"));
        let rest = format!("otherwise than decided here, where the document is silent: {many}");
        wrapped(out, rest.split(' '), 0, usize::MAX);
    }
    Ok(())
}
