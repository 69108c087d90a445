//! The list of theorems and the harnesses in the sources are the same, and every place to be covered is covered.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use adsdv_proofs::{readings, seed, theorems};
use adsdv_spec::{Choice, Edition};

/// Every source file of the crate, but for the stand-in.
fn sources() -> Vec<(PathBuf, String)> {
    fn add(folder: &Path, files: &mut Vec<(PathBuf, String)>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                if path.file_name() != Some("kani".as_ref()) {
                    add(&path, files);
                }
            } else {
                let text = fs::read_to_string(&path).unwrap();
                files.push((path, text));
            }
        }
    }
    let mut files = Vec::new();
    add(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut files);
    files
}

/// The names of the functions that Kani proves: written down, or made by the macro of `readings.rs`.
fn harnesses() -> Vec<String> {
    let mut names = Vec::new();
    for (_, text) in sources() {
        let mut lines = text.lines();
        while let Some(line) = lines.next() {
            if line.trim_start().starts_with("#[cfg_attr(kani, kani::proof") {
                let function = lines.find(|line| line.contains("pub fn ")).unwrap();
                let name = function.trim().trim_start_matches("pub fn ").split('(').next().unwrap();
                if !name.starts_with('$') {
                    names.push(name.to_owned());
                }
            }
        }
    }
    names.extend(readings::CHOICES.iter().map(|&(name, ..)| name.to_owned()));
    names
}

#[test]
fn every_harness_is_listed_once_and_nothing_else_is() {
    let mut listed: Vec<String> = theorems::all().map(|theorem| theorem.name.to_owned()).collect();
    let mut found = harnesses();
    listed.sort();
    found.sort();
    assert_eq!(listed, found);
    let names: BTreeSet<&String> = listed.iter().collect();
    assert_eq!(names.len(), listed.len(), "a name is there twice");
}

#[test]
fn every_choice_but_the_defaults_has_its_theorem() {
    // Those of 3.0 under 3.0; and under 4.0 those that 3.0 does not have, or has as defaults. 2026 has those of 4.0, and its
    // state machine: a theorem says so.
    let (old, new) = (Edition::V3_0.alternatives(), Edition::V4_0.alternatives());
    let of_old = old.iter().map(|choice| ("3.0", choice));
    let of_new = new.difference(old).iter().map(|choice| ("4.0", choice));
    let expected: Vec<(&str, Choice)> = of_old.chain(of_new).collect();
    let choices: Vec<(&str, Choice)> =
        readings::CHOICES.iter().map(|&(_, edition, choice)| (edition.version, choice)).collect();
    assert_eq!(choices, expected);
}

/// The name of a source file within `src`.
fn in_src(path: &str) -> String {
    path.rsplit("src/").next().unwrap_or(path).to_owned()
}

/// A place that no run comes by does not show up in any outcome: so the sources are searched for them.
#[test]
fn every_place_to_be_covered_is_covered() {
    let mut written = BTreeSet::new();
    for (path, text) in sources() {
        let name = in_src(&path.to_string_lossy());
        for (number, line) in (1u32..).zip(text.lines()) {
            let code = line.split("//").next().unwrap_or_default();
            if code.contains("kani::cover!(") {
                written.insert((name.clone(), number));
            }
        }
    }
    assert!(!written.is_empty());
    let mut covered: BTreeMap<(String, u32), bool> = BTreeMap::new();
    for theorem in theorems::all() {
        for (cover, reached) in theorem.check(seed::USUAL).covers {
            *covered.entry((in_src(cover.file), cover.line)).or_default() |= reached;
        }
    }
    let missed: Vec<_> = written.iter().filter(|place| covered.get(place) != Some(&true)).collect();
    assert!(missed.is_empty(), "no run comes by {missed:?}");
}
