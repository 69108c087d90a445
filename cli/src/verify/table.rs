//! The outcome as text for a person.

use std::fmt::{self, Write as _};
use std::time::Duration;

use adsdv_model::Part;
use adsdv_oracle::judge::Verdict;
use adsdv_spec::Choice;

use super::counterexample::{self, Failure};
use super::outcome::{Checked, Claim, Explored, Outcome, Role};
use crate::args::ChosenEdition;
use crate::layout::{counted, wrapped};
use crate::report::style::{self, Styled};
use crate::report::{self, JudgedLog};

/// For a counterexample that the judge of logs lets pass.
const UNCERTAIN: &str = "The property fails all the same: a log is sampled and silent about the shutdown circuit, and what \
                         happens here is too short, or too hidden, for a judge of logs to be certain of it.";
/// The columns of a property's name.
const NAME: usize = 33;
/// The columns of a result.
const RESULT: usize = 22;

pub(super) fn text(
    chosen: ChosenEdition,
    outcome: &Outcome,
    pins: &[Choice],
    failures: &[Failure],
    width: usize,
) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, chosen, outcome, pins, failures, width);
    text
}

fn write(
    out: &mut String,
    chosen: ChosenEdition,
    outcome: &Outcome,
    pins: &[Choice],
    failures: &[Failure],
    width: usize,
) -> fmt::Result {
    writeln!(out, "{chosen}")?;
    for pin in pins {
        writeln!(out, "reading {pin}: {}", pin.text())?;
    }
    for model in &outcome.models {
        model_table(out, model, width)?;
    }
    if !outcome.parts.is_empty() {
        parts(out, outcome)?;
    }
    for failure in failures {
        failed(out, chosen, outcome, failure, width)?;
    }
    verdict(out, outcome)
}

fn model_table(out: &mut String, model: &Explored, width: usize) -> fmt::Result {
    let Explored { name, about, states, transitions, depth, time, complete, results } = model;
    writeln!(out, "\n{}", Styled(style::HEADING, name.to_uppercase()))?;
    wrapped(out, about.split(' '), 2, width);
    let complete =
        if *complete { Styled(style::GOOD, "complete") } else { Styled(style::BAD, "NOT COMPLETE") };
    #[allow(clippy::cast_precision_loss, reason = "it is shown with two digits")]
    let rate = *transitions as f64 / time.as_secs_f64().max(1e-9) / 1e6;
    writeln!(
        out,
        "  {}, {}, {depth} deep, {}, {rate:.1} million steps/s: {complete}\n",
        counted(*states, "state"),
        counted(*transitions, "step"),
        Elapsed(*time),
    )?;
    writeln!(
        out,
        "  {:<NAME$} {:<RESULT$} {:>9} {:>8}  REQUIREMENTS",
        "PROPERTY", "RESULT", "STATES", "TIME"
    )?;
    for result in results {
        let requirements = result.requirements.join(", ");
        let text = shown(result);
        let style = if result.holds { style::GOOD } else { style::BAD };
        write!(
            out,
            "  {:<NAME$} {:<RESULT$} {states:>9} {:>8}  ",
            result.name,
            Styled(style, text),
            Elapsed(*time).to_string(),
        )?;
        let indent = 2 + NAME + 1 + RESULT + 1 + 9 + 1 + 8 + 2;
        let mut lines = String::new();
        wrapped(&mut lines, requirements.split(' '), indent, width.max(indent + 20));
        out.push_str(lines.trim_start());
        if requirements.is_empty() {
            out.push_str("-\n");
        }
    }
    Ok(())
}

/// The result in words.
fn shown(result: &Checked) -> String {
    let steps = result.steps.map(|steps| counted(steps as u64, "step"));
    match (result.claim, result.holds, steps) {
        (Claim::Sometimes, true, Some(steps)) => format!("reached in {steps}"),
        (Claim::Sometimes, true, None) => "reached".to_owned(),
        (Claim::Sometimes, false, _) => "NOT REACHED".to_owned(),
        (Claim::Always | Claim::Eventually, true, _) => "holds".to_owned(),
        (Claim::Always | Claim::Eventually, false, Some(steps)) => format!("FAILS in {steps}"),
        (Claim::Always | Claim::Eventually, false, None) => "FAILS".to_owned(),
    }
}

/// How many parts of the table decide a step, and which do not.
fn parts(out: &mut String, outcome: &Outcome) -> fmt::Result {
    writeln!(out, "\n{}", Styled(style::HEADING, "TABLE OF FIGURE 2"))?;
    let kind_of = |part: &Part| match (part.term, part.literal) {
        (None, _) => "rows",
        (Some(_), None) => "alternatives",
        (Some(_), Some(_)) => "conditions",
    };
    for kind in ["rows", "alternatives", "conditions"] {
        let of_kind = || outcome.parts.iter().filter(|(part, _)| kind_of(part) == kind);
        let alive = of_kind().filter(|(_, role)| *role == Role::Decides).count();
        writeln!(out, "  {kind:<12} {alive} of {} decide some step", of_kind().count())?;
    }
    for (part, choice) in outcome.moot() {
        writeln!(out, "  moot  {part}; with --reading {choice} it decides")?;
    }
    for part in outcome.dead() {
        writeln!(out, "  {}  {part}", Styled(style::BAD, "DEAD"))?;
    }
    Ok(())
}

/// A property that fails: what it says, and its run as the judge of logs tells it.
fn failed(
    out: &mut String,
    chosen: ChosenEdition,
    outcome: &Outcome,
    failure: &Failure,
    width: usize,
) -> fmt::Result {
    let Failure { name, log, pins, report } = failure;
    let results = outcome.models.iter().flat_map(|model| &model.results);
    let statement = results
        .filter(|result| result.name == *name)
        .map(|result| result.statement.as_str())
        .next()
        .unwrap_or_default();
    writeln!(out, "\n{} {}", Styled(style::BAD, "FAILS"), Styled(style::HEADING, name))?;
    wrapped(out, statement.split(' '), 2, width);
    let log = log.display().to_string();
    write!(out, "\n$ adsdv check")?;
    let version = chosen.edition().version;
    write!(out, " --edition {version}")?;
    for pin in pins {
        write!(out, " --reading {pin}")?;
    }
    writeln!(out, " {}", quoted(&log))?;
    let options = counterexample::options(chosen.edition(), pins);
    out.push_str(&report::text(
        &JudgedLog {
            edition: Some(&format!("edition {version}")),
            name: &log,
            options: &options,
            pins,
            required: &[],
        },
        report,
        width,
    ));
    if report.verdict() == Verdict::Conforms {
        writeln!(out)?;
        wrapped(out, UNCERTAIN.split(' '), 2, width);
    }
    Ok(())
}

fn verdict(out: &mut String, outcome: &Outcome) -> fmt::Result {
    let results = || outcome.models.iter().flat_map(|model| &model.results);
    let failing = results().filter(|result| !result.holds).count() as u64;
    let dead = outcome.dead().count() as u64;
    let incomplete = outcome.models.iter().any(|model| !model.complete);
    writeln!(out)?;
    if outcome.holds() {
        let properties = counted(results().count() as u64, "property").replace("propertys", "properties");
        return writeln!(out, "{}: {properties}", Styled(style::GOOD, "all hold"));
    }
    if incomplete {
        writeln!(out, "{}: an exploration was not complete", Styled(style::BAD, "NOTHING IS CERTAIN"))?;
    }
    let failing = counted(failing, "property").replace("propertys", "properties");
    write!(out, "{}: {failing}", Styled(style::BAD, "fail"))?;
    if dead > 0 {
        let verb = if dead == 1 { "decides" } else { "decide" };
        write!(out, "; {} of the table {verb} nothing", counted(dead, "part"))?;
    }
    writeln!(out)
}

/// A path as a shell takes it for one word, and `adsdv check` for no option.
fn quoted(path: &str) -> String {
    let path = if path.starts_with('-') { format!("./{path}") } else { path.to_owned() };
    let plain = |c: char| c.is_ascii_alphanumeric() || "-._/+,:@%".contains(c);
    if path.chars().all(plain) { path } else { format!("'{}'", path.replace('\'', "'\\''")) }
}

/// A duration in seconds.
struct Elapsed(Duration);

impl fmt::Display for Elapsed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.2} s", self.0.as_secs_f64())
    }
}

#[cfg(test)]
mod tests {
    use adsdv_model::{Options, Vectors, short_timers};
    use adsdv_spec::{Choice, Edition, Machine};

    use super::super::{json, outcome};
    use super::{parts, quoted};
    use crate::args::Models;

    /// The alternative for a fault of the battery, which opens the shutdown circuit unless it is read otherwise.
    #[test]
    fn a_part_that_another_answer_brings_to_life_is_moot_and_no_failure() {
        let edition = Edition::find("4.0").expect("it has the question");
        let short = edition.with_timing(short_timers(edition));
        let printed = |readings| {
            let machine = Machine::new(short, readings);
            let outcome = {
                let document = machine.edition().rules.timing;
                let options = Options { vectors: Vectors::Few, threads: 1, document, ..Options::default() };
                outcome::explore(&machine, Models::Open, options)
            };
            assert!(outcome.dead().next().is_none());
            let mut text = String::new();
            parts(&mut text, &outcome).expect("a string");
            (text, json::text(&outcome, &[]))
        };
        let (text, json) = printed(edition.readings);
        let part = "AS_DRIVING -> EMERGENCY_BRAKE (3.7): BMS_FAULT == TRUE";
        assert!(text.contains("alternatives 20 of 21 decide some step\n"), "{text}");
        let line = format!("  moot  {part}; with --reading bms-fault=driving it decides\n");
        assert!(text.ends_with(&line) && !text.contains("DEAD"), "{text}");
        let object = format!(
            r#""dead_parts":[],"moot_parts":[{{"part":"{part}","decides_with":"bms-fault=driving"}}]"#
        );
        assert!(json.contains(&object), "{json}");
        let (text, json) = printed(edition.readings.with(Choice::BmsDriving));
        assert!(!text.contains("moot") && json.contains(r#""moot_parts":[]"#), "{text}{json}");
    }

    #[test]
    fn a_path_can_be_pasted_into_a_shell() {
        assert_eq!(quoted("./runs/a-b.log"), "./runs/a-b.log");
        assert_eq!(quoted("my runs/x.log"), "'my runs/x.log'");
        assert_eq!(quoted("it's"), r"'it'\''s'");
        assert_eq!(quoted("-x.log"), "./-x.log");
    }
}
