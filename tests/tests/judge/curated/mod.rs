//! About sixty runs that a person can review: what the judge says of each is in `curated.txt` to the letter, and each keeps to what
//! holds of any run.
//!
//! ```text
//! runs (what happens) --> text (what is said) --> curated.txt
//!    +--> laws: losing frames adds no violation; the judge of a live bus says what the judge of a log says; a VCU that follows
//!         the document is not blamed; what is found is shown by frames
//! ```
//!
//! `UPDATE_EXPECT=1 cargo test -p adsdv-tests --test judge curated` writes `curated.txt` anew; a change of it is to be read.

pub(crate) mod laws;
mod runs;
mod text;

use std::collections::BTreeSet;

use adsdv_oracle::judge::{Finding, Party};
use adsdv_tests::world::judge;
use expect_test::expect_file;

use runs::runs;
use text::printed;

#[test]
fn what_is_said_of_each_run_is_as_written() {
    let all: Vec<String> = runs().iter().map(|run| format!("## {}\n{}\n", run.name, printed(run))).collect();
    expect_file!["curated.txt"].assert_eq(&all.join("\n"));
}

#[test]
fn each_run_has_a_name_of_its_own_and_they_are_about_sixty() {
    let runs = runs();
    let names: BTreeSet<&str> = runs.iter().map(|run| run.name.as_str()).collect();
    assert_eq!(names.len(), runs.len());
    assert!((60..=75).contains(&runs.len()), "{}", runs.len());
}

#[test]
fn each_run_keeps_to_the_laws() {
    for run in runs() {
        for seed in 0..4 {
            let added = laws::losing_frames_adds_nothing(&run.log, run.options, seed);
            added.unwrap_or_else(|broken| panic!("{}: {broken}", run.name));
        }
        let live = laws::live_is_the_same(&run.log, run.options);
        live.unwrap_or_else(|broken| panic!("{}: {broken}", run.name));
    }
}

#[test]
fn what_is_found_is_shown_by_frames_and_names_requirements_that_there_are() {
    let (mut shown, mut named) = (0, 0);
    for run in runs() {
        let report = judge(&run.log, run.options);
        let of_a_side = |finding: &&Finding| matches!(finding.party, Party::Vcu | Party::Ai);
        for finding in report.findings.iter().filter(of_a_side) {
            let broken = laws::shown_wrongly(finding, &run.log);
            assert_eq!(broken, None, "{}: {finding:#?}", run.name);
            shown += finding.evidence.len();
            named += finding.requirements.len();
        }
    }
    assert!(shown > 100 && named > 50, "{shown} frames, {named} requirements");
}

#[test]
fn a_vcu_that_follows_the_document_is_not_blamed() {
    let runs = runs();
    let honest = runs.iter().filter(|run| run.honest);
    for run in honest.clone() {
        for seed in 0..8 {
            let blamed = laws::blame_of_the_vcu(run, seed);
            assert!(blamed.is_empty(), "{}, seed {seed}: {blamed:#?}", run.name);
        }
    }
    assert!(honest.count() > 20, "many are");
}
