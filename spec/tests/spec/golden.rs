//! The exports against the files in `golden/`, byte for byte: a change of a table shows as a change of a file that
//! other tools read. The files are also there to be used as they are. So with the mutations, each with what it changes.
//!
//! `UPDATE_EXPECT=1 cargo test -p adsdv-spec golden` writes them anew.

use std::collections::HashSet;
use std::fmt::Write as _;

use adsdv_spec::export::{Dbc, Dot, Figure2, Mermaid};
use adsdv_spec::table::{Row, Table, Term};
use adsdv_spec::{Edition, Machine, Mutation, Readings, Rules};
use expect_test::expect_file;

fn compare(file: &str, export: &impl std::fmt::Display) {
    expect_file![format!("golden/{file}")].assert_eq(&export.to_string());
}

#[test]
fn dbc_of_each_edition() {
    for edition in Edition::ALL {
        let name = if *edition == Edition::DEFAULT { String::new() } else { format!("-{}", edition.version) };
        compare(&format!("adsdv{name}.dbc"), &Dbc(edition));
    }
}

#[test]
fn mermaid() {
    compare("figure2.mmd", &Mermaid(&Machine::REFERENCE));
}

#[test]
fn mermaid_of_version_4_0() {
    compare("figure2-4.0.mmd", &Mermaid(&Machine::new(Edition::V4_0, Edition::V4_0.readings)));
}

#[test]
fn dot() {
    compare("figure2.dot", &Dot(&Machine::REFERENCE));
}

#[test]
fn markdown() {
    compare("figure2.md", &Figure2(&Machine::REFERENCE));
}

/// The text of a table of one's own may have what means something else in a format.
#[test]
fn nothing_in_a_text_ends_it() {
    let first = &Edition::V3_0.rules.table.rows()[0];
    let section = "a \"b\" \\c &d <e> |f| *g* `h` #i: j;\nk";
    let table = Table::new(&[Row::new(first.from, first.to, section, first.terms())]);
    let name = "\"4\" \\5";
    let edition = Edition { version: name, document: name, ..Edition::V3_0 }.with_table(table);
    let machine = Machine::new(edition, Readings::DEFAULT);
    for (export, expected) in [
        (Dbc(&edition).to_string(), &[r#"VERSION "\"4\" \\5""#, r#"CM_ "\"4\" \\5";"#][..]),
        (Dot(&machine).to_string(), &[r#"section a \"b\" \\c &amp;d <e> |f| *g* `h` #i: j;\lk\l"#]),
        (
            Mermaid(&machine).to_string(),
            &["section a #quot;b#quot; \\c #amp;d #lt;e#gt; |f| *g* `h` #35;i#58; j#59;<br/>k<br/>"],
        ),
        (Figure2(&machine).to_string(), &[r#"| a "b" \\c &amp;d &lt;e> \|f\| \*g\* \`h\` #i: j;<br>k |"#]),
    ] {
        for expected in expected {
            assert!(export.contains(expected), "{expected} in {export}");
        }
    }
}

/// Each mutation, and below it what of the interface goes (-) and comes (+).
#[test]
fn mutations() {
    let document = lines(&Edition::V3_0);
    let mut all = String::new();
    for mutation in Mutation::all(&Edition::V3_0) {
        let mutant = lines(&mutation.apply(&Edition::V3_0));
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
    for mutation in Mutation::all(&Edition::V3_0) {
        assert!(names.insert(mutation.to_string()), "{mutation} is there twice");
    }
}

//= HS-18
#[test]
fn the_limit_of_missed_messages_is_one_unit_more_and_less() {
    let edition = Edition::V4_0;
    let limits: Vec<_> = Mutation::all(&edition)
        .filter(|mutation| mutation.to_string().contains("missed message"))
        .map(|mutation| mutation.apply(&edition).rules.thresholds.missed_ms)
        .collect();
    assert_eq!(limits.len(), 2, "{limits:?}");
    assert!(limits.contains(&Some(99)) && limits.contains(&Some(101)), "{limits:?}");
    assert!(Mutation::all(&Edition::V3_0).all(|mutation| !mutation.to_string().contains("missed")));
}

/// What mutations change, in lines: the rows with their terms, the times and the thresholds.
fn lines(edition: &Edition) -> Vec<String> {
    let Rules { table, timing, thresholds, .. } = edition.rules;
    let rows = table.rows().iter().flat_map(|row| {
        let Row { from, to, section, .. } = row;
        let head = format!("{section} {from} -> {to}");
        let terms: Vec<_> = row.terms().iter().map(|term| format!("{head}: {}", of(term))).collect();
        std::iter::once(head).chain(terms)
    });
    rows.chain([format!("{timing:?}"), format!("{thresholds:?}")]).collect()
}

fn of(term: &Term) -> String {
    let Term { readings, fault, section, .. } = term;
    let conditions =
        term.literals().map(|(atom, on)| if on { atom.to_string() } else { format!("not {atom}") });
    let mut words = conditions.collect::<Vec<_>>().join(", ");
    for reading in readings.iter() {
        write!(words, ", if {reading}").expect("a string can be written");
    }
    if let Some(fault) = fault {
        write!(words, ", shown as {fault:?}").expect("a string can be written");
    }
    format!("{words} ({section})")
}
