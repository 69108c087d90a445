//! What is fuzzed, without a fuzzer: every input of the corpus, every input that went wrong once, and small random ones; and
//! that nothing of `fuzz/` is left behind.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use adsdv_spec::messages::AsState;
use adsdv_spec::{Edition, Taken};
use adsdv_tests::fuzzed::{TARGETS, belief, car, database, judge_any, replay, seeds, step};

/// The body that stands with the border to C, and is run again by the tests there.
const C_BORDER: &str = "c_border";

/// What each body may cost, as the number of random inputs: some make a whole run of each.
const FEW: [(&str, u64); 4] = [("conform", 100), ("judge_reference", 300), ("car", 1000), ("suite", 1000)];

fn fuzz() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz")
}

/// The names in a folder.
fn names(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("UTF-8")).collect()
}

/// The bodies, that of the border to C among them.
fn bodies() -> BTreeSet<String> {
    TARGETS.iter().map(|(name, _)| *name).chain([C_BORDER]).map(str::to_owned).collect()
}

#[test]
fn every_input_of_the_corpus_and_every_regression_holds() {
    for (target, body) in TARGETS {
        let run = replay::files(&fuzz(), target, body);
        assert!(run > 0, "fuzz/corpus/{target} has seeds");
    }
}

#[test]
fn small_random_inputs_hold() {
    for (target, body) in TARGETS {
        let count = FEW.iter().find(|(name, _)| *name == target).map_or(3000, |&(_, count)| count);
        replay::random(count, body);
    }
}

/// The fuzzers of `fuzz/Cargo.toml`, each with its file.
fn fuzzers() -> BTreeMap<String, String> {
    let manifest = fs::read_to_string(fuzz().join("Cargo.toml")).expect("fuzz/Cargo.toml");
    let value = |line: &str, key: &str| {
        let value = line.strip_prefix(key)?.trim_start().strip_prefix('=')?.trim();
        Some(value.trim_matches('"').to_owned())
    };
    let found = manifest.split("[[bin]]").skip(1).map(|bin| {
        let of = |key| bin.lines().find_map(|line| value(line, key)).expect("a name and a path");
        (of("name"), of("path"))
    });
    found.collect()
}

#[test]
fn each_body_has_a_fuzzer_and_each_fuzzer_a_body() {
    let fuzzers = fuzzers();
    assert_eq!(fuzzers.keys().cloned().collect::<BTreeSet<_>>(), bodies(), "left: fuzz/Cargo.toml");
    let files: BTreeSet<String> = bodies().iter().map(|name| format!("{name}.rs")).collect();
    assert_eq!(names(&fuzz().join("fuzz_targets")), files, "left: fuzz/fuzz_targets");
    for (name, path) in fuzzers {
        assert_eq!(path, format!("fuzz_targets/{name}.rs"));
        let source = fs::read_to_string(fuzz().join(&path)).expect("the source of a fuzzer");
        let call = if name == C_BORDER { "c_border::body".into() } else { format!("fuzzed::{name}::body") };
        assert!(source.contains(&call), "{path} does not call {call}");
    }
}

#[test]
fn each_body_has_a_corpus_and_nothing_else_has() {
    assert_eq!(names(&fuzz().join("corpus")), bodies(), "left: fuzz/corpus");
    let strangers: Vec<String> = names(&fuzz().join("regressions")).difference(&bodies()).cloned().collect();
    assert!(strangers.is_empty(), "fuzz/regressions has {strangers:?}, which are no bodies");
    let readme = fs::read_to_string(fuzz().join("README.md")).expect("fuzz/README.md");
    for name in bodies() {
        assert!(readme.contains(&format!("| `{name}` |")), "fuzz/README.md has a row for {name}");
    }
}

const AGAIN: &str = "write it again with: cargo run -p adsdv-tests --bin seeds";

#[test]
fn the_corpus_is_what_the_project_has() {
    let corpus = seeds::corpus();
    assert_eq!(corpus.keys().map(|&name| name.to_owned()).collect::<BTreeSet<_>>(), bodies());
    let mut size = 0;
    for (target, inputs) in &corpus {
        assert!(inputs.len() <= seeds::MOST, "{target} has {} seeds", inputs.len());
        let folder = fuzz().join("corpus").join(target);
        let there =
            names(&folder).into_iter().filter(|name| !replay::is_found(name)).collect::<BTreeSet<_>>();
        assert_eq!(there, inputs.keys().cloned().collect(), "fuzz/corpus/{target}; {AGAIN}");
        for (name, bytes) in inputs {
            size += bytes.len();
            let file = fs::read(folder.join(name)).expect("a seed");
            assert!(file == *bytes, "fuzz/corpus/{target}/{name} is another; {AGAIN}");
        }
    }
    assert!(size < 400_000, "the corpus has {size} bytes");
}

#[test]
fn the_dictionaries_are_what_the_project_has() {
    let dictionaries = seeds::dictionaries();
    let files: BTreeSet<String> = dictionaries.keys().map(|target| format!("{target}.dict")).collect();
    assert_eq!(names(&fuzz().join("dictionaries")), files, "left: fuzz/dictionaries");
    for (target, text) in dictionaries {
        let file =
            fs::read_to_string(fuzz().join(format!("dictionaries/{target}.dict"))).expect("a dictionary");
        assert!(file == text, "fuzz/dictionaries/{target}.dict is another; {AGAIN}");
    }
}

/// Without that no fuzzer would try what happens to a line that is too long.
#[test]
fn inputs_may_be_longer_than_a_line() {
    let options = fs::read_to_string(fuzz().join("libfuzzer.options")).expect("fuzz/libfuzzer.options");
    let max_len = options.lines().find_map(|line| line.strip_prefix("max_len = ")).expect("max_len");
    let max_len: usize = max_len.parse().expect("a number");
    for longest in [adsdv_oracle::candump::MAX_LINE, adsdv_can::scenario::MAX_LINE] {
        assert!(max_len > 2 * longest, "{max_len} bytes, and a line of {longest}");
    }
    for script in ["scripts/fuzz.sh", ".clusterfuzzlite/build.sh"] {
        let text = fs::read_to_string(fuzz().join("..").join(script)).expect("a script");
        assert!(text.contains("fuzz/libfuzzer.options"), "{script}");
    }
}

/// The choices before a seed lead to what it is meant for.
#[test]
fn the_seeds_of_database_are_databases() {
    let corpus = seeds::corpus();
    for (name, bytes) in &corpus["database"] {
        let (_, _, database) = database::read(bytes);
        assert!(database.is_ok_and(|database| database.messages.len() > 4), "{name}");
    }
}

#[test]
fn the_seeds_of_judge_any_are_read_as_logs() {
    let corpus = seeds::corpus();
    let logs = corpus["judge_any"].iter().filter(|(name, _)| !name.starts_with("any-"));
    for (name, seed) in logs {
        let (options, text) = judge_any::text(seed).unwrap_or_else(|| panic!("{name} is a log"));
        assert!(text.starts_with(b"(") || text.starts_with(b"DROPCOUNT"), "{name}");
        assert_eq!(options.judge, adsdv_oracle::judge::JudgeOptions::default(), "{name}");
        assert_eq!(options.interface, None, "{name}");
    }
}

/// What to do where the seeds of a target miss something.
const MORE_TRIES: &str =
    "more tries of its `walks` in tests/src/fuzzed/seeds.rs, then: cargo run -p adsdv-tests --bin seeds";

#[test]
fn the_seeds_of_step_take_every_term_of_every_table() {
    let corpus = seeds::corpus();
    let taken: Vec<_> = corpus["step"].values().flat_map(|seed| step::taken(seed)).collect();
    let mut left = Vec::new();
    for Edition { version, rules, choices, .. } in Edition::ALL {
        for (row, def) in (0..).zip(rules.table.rows()) {
            // A term of an answer that the edition has settled is never there.
            let terms = (0..).zip(def.terms()).filter(|(_, term)| term.readings.is_subset(*choices));
            for (term, _) in terms {
                if !taken.contains(&(*version, Taken { row, term })) {
                    left.push(format!("{version}: {} -> {}: term {term}", def.from, def.to));
                }
            }
        }
    }
    assert!(left.is_empty(), "no seed takes {left:?}; {MORE_TRIES}");
}

#[test]
fn the_seeds_of_belief_take_every_row_of_every_table() {
    let corpus = seeds::corpus();
    let taken: Vec<_> = corpus["belief"].values().flat_map(|seed| belief::taken(seed)).collect();
    for edition in Edition::ALL {
        for (row, def) in (0..).zip(edition.rules.table.rows()) {
            let is_taken =
                taken.iter().any(|&(version, taken)| version == edition.version && taken.row == row);
            let Edition { version, .. } = edition;
            assert!(is_taken, "no seed takes {version}: {} -> {}; {MORE_TRIES}", def.from, def.to);
        }
    }
}

#[test]
fn the_seeds_of_car_come_to_every_state() {
    let corpus = seeds::corpus();
    let reached: BTreeSet<_> = corpus["car"].values().flat_map(|seed| car::reached(seed)).collect();
    let states = |edition: &&'static Edition| AsState::ALL.map(|state| (edition.version, state));
    assert_eq!(reached, Edition::ALL.iter().flat_map(states).collect());
}
