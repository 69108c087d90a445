//! How much the judge sees: every mutation of an edition, and every VCU that remembers something or shows a flag otherwise, drives missions, a recorder makes the recordings late or loses frames, and
//! the judge says what it can. And how little it sees where there is nothing: the same of the VCU of the specification.
//!
//! `scripts/sensitivity.sh` runs it, and says what the options are.

mod drive;
mod mutants;
mod observer;
mod profile;
mod words;

use std::collections::{BTreeMap, BTreeSet};
use std::io::IsTerminal;
use std::path::Path;
use std::process::ExitCode;

use adsdv_spec::{Edition, Machine};

use adsdv_tests::world::World;
use drive::{Run, missions};
use mutants::{Kind, Mutant};
use profile::{Detection, PROFILES, Profile};

/// Where the recordings are kept in which the specification is blamed.
const KEPT: &str = "target/sensitivity";

/// What was said of all mutants of a kind under one profile.
#[derive(Default)]
struct Tally {
    violations: usize,
    warnings: Vec<String>,
    nothing: Vec<String>,
    delays_ms: Vec<i64>,
}

/// What becomes of a mutant that an observer can tell.
struct Outcome {
    /// The judge calls it a violation, wherever it has to.
    told: bool,
    /// It breaks what a document says, and not only what was decided.
    breaks: bool,
}

fn main() -> ExitCode {
    let mut args = std::env::args().skip(1);
    let version = args.next().unwrap_or_else(|| Edition::DEFAULT.version.to_owned());
    let runs: u64 = args.next().and_then(|runs| runs.parse().ok()).unwrap_or(1000);
    let Some(edition) = Edition::ALL.iter().find(|edition| edition.version == version).copied() else {
        eprintln!("sensitivity: no edition {version}");
        return ExitCode::from(2);
    };
    // Only mutants of one kind, or only that nobody is blamed who is right.
    let only = args.next();
    if only.as_deref() != Some("soundness") && !is_possible(edition) {
        return ExitCode::FAILURE;
    }
    match only.as_deref() {
        Some("soundness") => {}
        None => sensitivity(edition, &Kind::ALL, &mutants::all(edition), false),
        Some(name) => {
            let Some(kind) = Kind::ALL.into_iter().find(|kind| kind.id() == name) else {
                eprintln!("sensitivity: no mutants of {name}; expected table, time, memory or flag");
                return ExitCode::from(2);
            };
            let part = args.next();
            let says = part.is_some();
            let part = part.unwrap_or_default();
            let named = named(edition, kind, &part);
            if named.is_empty() {
                eprintln!(
                    "sensitivity: no {} of {version} whose name contains {part:?}; without -m all are driven",
                    kind.name()
                );
                return ExitCode::from(2);
            }
            sensitivity(edition, &[kind], &named, says);
        }
    }
    if soundness(edition, runs) { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Whether the observer takes the VCU of the specification for what it is.
fn is_possible(edition: &'static Edition) -> bool {
    let specification = Machine::new(*edition, edition.readings);
    let runs = missions(edition, &World::of(edition), true);
    let tells = |run: &&Run| {
        observer::can_tell(&specification, &run.world) || words::can_tell(&specification, &run.world)
    };
    let told = runs.iter().filter(tells).count();
    if told > 0 {
        eprintln!(
            "sensitivity: an observer takes {told} of {} runs of the specification for another",
            runs.len()
        );
    }
    told == 0
}

/// The mutants of a kind whose names contain `part`, in capitals or not.
fn named(edition: &'static Edition, kind: Kind, part: &str) -> Vec<Mutant> {
    let part = part.to_ascii_lowercase();
    let is_named = |mutant: &Mutant| mutant.kind == kind && mutant.name.to_ascii_lowercase().contains(&part);
    mutants::all(edition).into_iter().filter(is_named).collect()
}

/// Judges the missions of these mutants, and prints a table for each kind of them; with `says`, what is said of each as well.
fn sensitivity(edition: &'static Edition, kinds: &[Kind], mutants: &[Mutant], says: bool) {
    let shows_progress = std::io::stderr().is_terminal();
    let mut done = 0;
    for &kind in kinds {
        let mut tallies: Vec<Tally> = PROFILES.iter().map(|_| Tally::default()).collect();
        let (mut unseen, mut breaking, mut missed) = (Vec::new(), 0, Vec::new());
        let of_kind: Vec<&Mutant> = mutants.iter().filter(|mutant| mutant.kind == kind).collect();
        for mutant in &of_kind {
            if shows_progress {
                eprint!("\r{done} of {} mutants", mutants.len());
            }
            done += 1;
            if says {
                print_said(edition, mutant);
            }
            match drives(edition, mutant, &mut tallies) {
                None => unseen.push(mutant.name.as_str()),
                Some(outcome) if outcome.breaks => {
                    breaking += 1;
                    if !outcome.told {
                        missed.push(mutant.name.as_str());
                    }
                }
                Some(_) => {}
            }
        }
        if shows_progress {
            eprint!("\r");
        }
        println!(
            "edition {}, {}: {} mutants, of which {} show in no recording",
            edition.version,
            kind.name(),
            of_kind.len(),
            unseen.len()
        );
        print_table(tallies);
        println!(
            "{breaking} break what a document says; late by up to 5 ms, --complete, {} of them are violations",
            breaking - missed.len()
        );
        for name in &missed {
            println!("    breaks what a document says, and is no violation: {name}");
        }
        if matches!(kind, Kind::Memory | Kind::Flag) {
            for name in &unseen {
                println!("    shows in no recording: {name}");
            }
        }
        println!();
    }
}

/// Has a mutant drive missions, and counts what is said of it under each profile; `None` if it shows in no recording at all, so that
/// an observer who misses nothing cannot tell it.
fn drives(edition: &'static Edition, mutant: &Mutant, tallies: &mut [Tally]) -> Option<Outcome> {
    let runs: Vec<Run> = missions(edition, &mutant.world, mutant.kind == Kind::Memory);
    let specification = Machine::new(*edition, edition.readings);
    if !runs.iter().any(|run| run.differs_at.is_some() && observer::can_tell(&specification, &run.world)) {
        return None;
    }
    let mut told = true;
    let detected = |profile: &Profile| {
        runs.iter().map(|run| profile.judge(edition, run)).max().unwrap_or(Detection::Nothing)
    };
    for (profile, tally) in PROFILES.iter().zip(tallies) {
        let detected = detected(profile);
        told &= !profile.is_to_tell() || matches!(detected, Detection::Violation { .. });
        match detected {
            Detection::Violation { delay_ms } => {
                tally.violations += 1;
                tally.delays_ms.push(delay_ms);
            }
            Detection::Warning(rule) => tally.warnings.push(format!("{}: {}", mutant.name, rule.id())),
            Detection::Nothing => tally.nothing.push(mutant.name.clone()),
        }
    }
    let breaks = |run: &Run| run.differs_at.is_some() && words::can_tell(&specification, &run.world);
    Some(Outcome { told, breaks: runs.iter().any(breaks) })
}

/// What is said of a mutant under each profile: the first of the most serious.
fn print_said(edition: &'static Edition, mutant: &Mutant) {
    println!("{}", mutant.name);
    let runs: Vec<Run> = missions(edition, &mutant.world, mutant.kind == Kind::Memory);
    for profile in &PROFILES {
        let said = runs.iter().filter_map(|run| profile.worst(edition, run)).min_by_key(|one| one.severity);
        let said = said.map_or("nothing".to_owned(), |one| {
            format!("{} {}: {}", one.severity.name(), one.rule.id(), one.message())
        });
        println!("  {:<44} {said}", profile.to_string());
    }
}

fn print_table(tallies: Vec<Tally>) {
    let mut named = BTreeSet::new();
    println!("{:<44} {:>10} {:>8} {:>8}  median delay", "recording", "violation", "warning", "nothing");
    for (profile, mut tally) in PROFILES.iter().zip(tallies) {
        tally.delays_ms.sort_unstable();
        let delay =
            tally.delays_ms.get(tally.delays_ms.len() / 2).map_or("-".to_owned(), |ms| format!("{ms} ms"));
        println!(
            "{:<44} {:>10} {:>8} {:>8}  {delay}",
            profile.to_string(),
            tally.violations,
            tally.warnings.len(),
            tally.nothing.len(),
        );
        // What was named above is so here as well, or worse.
        let warned = tally.warnings.into_iter().map(|mutant| format!("only warned of {mutant}"));
        let unsaid = tally.nothing.into_iter().map(|mutant| format!("nothing is said of {mutant}"));
        for line in warned.chain(unsaid).filter(|line| named.insert(line.clone())) {
            println!("    {line}");
        }
    }
}

/// Judges the VCU of the specification, which is never to be blamed; prints how often it is warned of.
fn soundness(edition: &'static Edition, runs: u64) -> bool {
    let mut blamed = 0;
    println!("\n{:<44} {:>10} {:>8} {:>8}", "the specification itself", "violation", "warning", "nothing");
    for profile in &PROFILES {
        let (mut violations, mut nothing, mut warnings) = (0, 0, BTreeMap::<&str, u64>::new());
        for seed in 0..runs / PROFILES.len() as u64 {
            let run = drive::any_run(edition, seed);
            match profile.judge(edition, &run) {
                Detection::Violation { .. } => {
                    violations += 1;
                    let blame = profile.blame(edition, &run).join("\n  ");
                    let kept = match profile.keep(Path::new(KEPT), &run) {
                        Ok(path) => format!("the recording is {}", path.display()),
                        Err(error) => format!("the recording cannot be written to {KEPT}: {error}"),
                    };
                    eprintln!(
                        "seed {seed}, {profile}, {}: the VCU is blamed; {kept}\n  {blame}",
                        run.world.vcu.readings()
                    );
                }
                Detection::Warning(rule) => *warnings.entry(rule.id()).or_default() += 1,
                Detection::Nothing => nothing += 1,
            }
        }
        blamed += violations;
        let warned: u64 = warnings.values().sum();
        println!("{:<44} {violations:>10} {warned:>8} {nothing:>8}", profile.to_string());
        for (rule, count) in warnings {
            println!("    {count} warned of by {rule}");
        }
    }
    blamed == 0
}
