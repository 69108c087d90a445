//! The exports against the files in `golden/`, byte for byte: a change of a table shows as a change of a file that
//! other tools read. The files are also there to be used as they are. So with the mutations, each with what it changes.

use std::collections::HashSet;
use std::fmt::Write as _;
use std::{env, fs, path::Path};

use adsdv_spec::export::{Dbc, Dot, Figure2, Mermaid};
use adsdv_spec::table::{Row, Term};
use adsdv_spec::{Interface, Machine, Mutation};

/// Set to 1, it makes these tests write the files instead of comparing them.
const BLESS: &str = "ADSDV_BLESS";

fn compare(file: &str, export: &impl std::fmt::Display) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(file);
    let export = export.to_string();
    if env::var_os(BLESS).is_some_and(|value| value == "1") {
        fs::write(&path, &export).unwrap_or_else(|error| panic!("cannot write golden/{file}: {error}"));
        return;
    }
    let renew = format!("to renew it: {BLESS}=1 cargo test -p adsdv-spec --test golden");
    let golden = fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("cannot read golden/{file}: {error}; {renew}"));
    if golden == export {
        return;
    }
    let lines = golden.lines().map(Some).chain(std::iter::repeat(None));
    let first =
        export.lines().map(Some).chain([None]).zip(lines).zip(1..).find(|((ours, file), _)| ours != file);
    panic!("the export is not golden/{file}; first difference (export, file), line: {first:#?}\n{renew}");
}

#[test]
fn dbc() {
    compare("adsdv.dbc", &Dbc(&Interface::V3_0));
}

#[test]
fn mermaid() {
    compare("figure2.mmd", &Mermaid(&Machine::REFERENCE));
}

#[test]
fn dot() {
    compare("figure2.dot", &Dot(&Machine::REFERENCE));
}

#[test]
fn markdown() {
    compare("figure2.md", &Figure2(&Machine::REFERENCE));
}

/// Each mutation, and below it what of the interface goes (-) and comes (+).
#[test]
fn mutations() {
    let document = lines(&Interface::V3_0);
    let mut all = String::new();
    for mutation in Mutation::all(&Interface::V3_0) {
        let mutant = lines(&mutation.apply(&Interface::V3_0));
        writeln!(all, "{mutation}").expect("a string can be written");
        // What stands before and behind the change is left out; a row that moved shows both ways.
        let same = document.iter().zip(&mutant).take_while(|(ours, theirs)| ours == theirs).count();
        let (ours, theirs) = (document[same..].iter().rev(), mutant[same..].iter().rev());
        let same_end = ours.zip(theirs).take_while(|(ours, theirs)| ours == theirs).count();
        for (sign, lines) in [('-', &document), ('+', &mutant)] {
            for line in &lines[same..lines.len() - same_end] {
                writeln!(all, "  {sign} {line}").expect("a string can be written");
            }
        }
    }
    compare("mutations.txt", &all.trim_end());
}

#[test]
fn mutations_have_names_of_their_own() {
    let mut names = HashSet::new();
    for mutation in Mutation::all(&Interface::V3_0) {
        assert!(names.insert(mutation.to_string()), "{mutation} is there twice");
    }
}

/// What mutations change, in lines: the rows with their terms, the times and the thresholds.
fn lines(interface: &Interface) -> Vec<String> {
    let Interface { table, timing, thresholds, .. } = interface;
    let rows = table.rows().iter().flat_map(|row| {
        let Row { from, to, clause, .. } = row;
        let head = format!("{clause} {from} -> {to}");
        let terms: Vec<_> = row.terms().iter().map(|term| format!("{head}: {}", of(term))).collect();
        std::iter::once(head).chain(terms)
    });
    rows.chain([format!("{timing:?}"), format!("{thresholds:?}")]).collect()
}

fn of(term: &Term) -> String {
    let Term { readings, fault, clause, .. } = term;
    let conditions =
        term.conditions().map(|(atom, on)| if on { atom.to_string() } else { format!("not {atom}") });
    let mut words = conditions.collect::<Vec<_>>().join(", ");
    for reading in readings.iter() {
        write!(words, ", if {reading}").expect("a string can be written");
    }
    if let Some(fault) = fault {
        write!(words, ", told as {fault:?}").expect("a string can be written");
    }
    format!("{words} ({clause})")
}
