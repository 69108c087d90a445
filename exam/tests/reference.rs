//! The reference AI Computer passes, in every edition and every scenario.

use std::collections::BTreeSet;

use adsdv_exam::{ExamOptions, Outcome, Reference, exam, scenarios};
use adsdv_spec::Edition;

/// What no AI Computer can show, or the reference never does: it never asks for an emergency stop.
const NOT_SHOWN: [&str; 10] =
    ["MSG-2", "MSG-3", "MSG-4", "MSG-7", "MSG-11", "MSG-12", "MSG-13", "MSG-14", "MSG-15", "HS-13"];

#[test]
fn the_reference_passes_in_every_edition() {
    for edition in Edition::ALL {
        let options = ExamOptions::of(edition);
        let scenarios = scenarios();
        let report = exam(&mut Reference::default(), &scenarios, &options, &mut |_| {}).expect("it answers");
        let version = edition.version;
        for finding in &report.findings {
            let scenario = &scenarios[finding.scenario].name;
            eprintln!(
                "{version} {scenario} {} {:?}: {}; expected {}; {}",
                finding.t_ns, finding.requirements, finding.seen, finding.expected, finding.car
            );
        }
        for scenario in &report.scenarios {
            assert_eq!(scenario.stuck, None, "{version}: {}", scenario.name);
        }
        assert!(report.passes(), "{version}");
        assert_eq!(report.scenarios.len(), scenarios.len());
        assert_eq!(report.notes, [""; 0]);
        for one in &report.requirements {
            let expected = if NOT_SHOWN.contains(&one.id) { "not exercised" } else { "pass" };
            assert_eq!(one.outcome.name(), expected, "{version}: {} {:?}", one.id, one.outcome);
        }
        assert!(!report.requirements.iter().any(|one| matches!(one.outcome, Outcome::Fail(_))));
        // What passes is what some scenario puts to the test; not each puts all of it.
        let of_all: BTreeSet<&str> =
            report.scenarios.iter().flat_map(|one| &one.exercised).copied().collect();
        let passed = report.requirements.iter().filter(|one| one.outcome == Outcome::Pass);
        assert_eq!(of_all, passed.map(|one| one.id).collect(), "{version}");
        assert!(report.scenarios.iter().any(|one| one.exercised.len() < of_all.len()), "{version}");
        assert!(report.slowest.is_some());
    }
}
