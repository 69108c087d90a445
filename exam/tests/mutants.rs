//! Each mistake of an AI Computer fails the requirement that it breaks, and the table of `TESTING.md` says so.

#[path = "../examples/ai_mutant/mutants.rs"]
mod mutants;

use adsdv_exam::{ExamOptions, ExamReport, exam, scenarios};
use adsdv_spec::Edition;
use mutants::{MUTANTS, Mutant, Named};

/// The scenarios in which they show: a mission, another one, an end, and a wheel that spins. All of them would show no more.
const SHOWS: [&str; 6] = [
    "mission-acceleration",
    "mission-track-drive",
    "two-missions",
    "estop-in-ready",
    "go-withdrawn",
    "wheel-spins",
];

fn examined(mutant: &Named, edition: &'static Edition) -> ExamReport {
    let scenarios: Vec<_> =
        scenarios().into_iter().filter(|one| SHOWS.contains(&one.name.as_str())).collect();
    assert_eq!(scenarios.len(), SHOWS.len());
    let options = ExamOptions { mission_ms: 30_000, ..ExamOptions::of(edition) };
    exam(&mut Mutant::new(mutant.name), &scenarios, &options, &mut |_| {}).expect("it answers")
}

fn failed(report: &ExamReport) -> Vec<&'static str> {
    report.requirements.iter().filter(|one| one.outcome.name() == "fail").map(|one| one.id).collect()
}

/// `TESTING.md` has what fails of each in each edition.
#[test]
fn each_mutant_fails_with_its_requirements_as_the_table_says() {
    let testing = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../TESTING.md"));
    let testing = testing.expect("it is there");
    let mut wrong = Vec::new();
    let versions: Vec<&str> = Edition::ALL.iter().map(|edition| edition.version).collect();
    let heading = format!("| mistake | {} |\n|{}", versions.join(" | "), "---|".repeat(1 + versions.len()));
    if !testing.contains(&heading) {
        wrong.push(format!("not in TESTING.md: {heading}"));
    }
    for mutant in MUTANTS {
        let mut row = format!("| `{}` |", mutant.name);
        let reports: Vec<ExamReport> = std::thread::scope(|scope| {
            let each = Edition::ALL.iter().map(|edition| scope.spawn(|| examined(mutant, edition)));
            let each: Vec<_> = each.collect();
            each.into_iter().map(|one| one.join().expect("the exam does not panic")).collect()
        });
        for (edition, report) in Edition::ALL.iter().zip(reports) {
            let known: Vec<&str> = report.requirements.iter().map(|one| one.id).collect();
            let expected: Vec<&str> = mutant.breaks.iter().copied().filter(|id| known.contains(id)).collect();
            for finding in &report.findings {
                let exercised = &report.scenarios[finding.scenario].exercised;
                assert!(
                    finding.requirements.iter().all(|id| exercised.contains(id)),
                    "{finding:?}: {exercised:?}"
                );
            }
            let failed = failed(&report);
            // The vehicle of 2026 lets torque and brakes come at once (D-67).
            let can_show = mutant.name != "brakes-and-drives" || !edition.requirements.has("D-67");
            if can_show && !expected.iter().all(|id| failed.contains(id)) {
                wrong.push(format!("{} {}: {failed:?}, not {expected:?}", edition.version, mutant.name));
            }
            let cell = match (&failed[..], report.passes()) {
                ([], true) => "-".to_owned(),
                ([], false) => "a finding against no single one".to_owned(),
                (failed, _) => failed.join(" "),
            };
            row.extend([" ", &cell, " |"]);
        }
        println!("{row}");
        if !testing.contains(&row) {
            wrong.push(format!("not in TESTING.md: {row}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn one_without_a_mistake_passes() {
    let report = exam(&mut Mutant::new(""), &scenarios(), &ExamOptions::of(Edition::DEFAULT), &mut |_| {});
    assert!(report.expect("it answers").passes());
}

#[test]
fn a_flood_is_reported_in_an_edition_without_cycles() {
    let floods = MUTANTS.iter().find(|mutant| mutant.name == "floods").expect("a mutant");
    let report = examined(floods, &Edition::V3_0);
    assert!(!report.passes());
    assert!(report.findings.iter().any(|finding| finding.seen.contains("the bus cannot carry")));
}
