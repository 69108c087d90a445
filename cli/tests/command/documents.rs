//! The documents are true: what they show as printed is what is printed.

use std::collections::BTreeSet;
use std::fs;

use crate::run::{example, run, workspace};

/// Stands for lines that a document leaves out.
const LEFT_OUT: &str = "[...]";

/// How a document begins a command; the second is for who has installed it.
const PROMPTS: [&str; 2] = ["$ cargo run --release -- ", "$ adsdv "];

/// Commands that no test runs, and why.
const NOT_RUN: [(&str, &str); 3] = [
    ("verify", "it takes minutes, and how long each property took stands in it"),
    ("web", "it serves until it is stopped"),
    ("verify --reading fault-trigger=edge", "so does this, and the next command reads what it writes"),
];

/// Programs under test that documents name, where `cargo build` puts them.
const EXAMPLES: [(&str, &str); 2] =
    [("target/release/examples/deviating", "deviating"), ("target/debug/examples/ai_mutant", "ai_mutant")];

/// A command with what a document shows of its output.
#[derive(Debug, PartialEq, Eq)]
struct Shown<'a> {
    arguments: &'a str,
    output: &'a str,
}

/// The README and the pages of the book, each with its name.
fn documents() -> Vec<(String, String)> {
    let pages =
        fs::read_dir(workspace().join("docs")).expect("the book").map(|page| page.expect("a page").path());
    let pages = pages.filter(|page| page.extension().is_some_and(|extension| extension == "md"));
    let mut all: Vec<_> = pages.chain([workspace().join("README.md")]).collect();
    all.sort();
    let name = |page: &std::path::Path| page.file_name().expect("a name").to_string_lossy().into_owned();
    all.iter().map(|page| (name(page), fs::read_to_string(page).expect("text"))).collect()
}

/// The commands that a document shows with their output.
fn shown(document: &str) -> Vec<Shown<'_>> {
    let blocks = document.split("```console\n").skip(1).filter_map(|block| block.split_once("\n```"));
    let commands = blocks.filter_map(|(block, _)| {
        let command = PROMPTS.iter().find_map(|prompt| block.strip_prefix(prompt))?;
        let (arguments, output) = command.split_once('\n')?;
        // Several commands in a row are something to do, and show nothing.
        (!output.starts_with("$ ")).then_some(Shown { arguments, output })
    });
    commands.collect()
}

fn matches(printed: &str, shown: &str) -> bool {
    let mut rest = printed.trim_end();
    let mut parts = shown.split(LEFT_OUT);
    let Some(first) = parts.next() else { return false };
    let Some(after) = rest.strip_prefix(first.trim_end()) else { return false };
    rest = after;
    let mut last = first;
    parts.all(|part| {
        last = part;
        match rest.find(part.trim()) {
            Some(at) => {
                rest = &rest[at + part.trim().len()..];
                true
            }
            None => false,
        }
    }) && (rest.trim().is_empty() || last.trim().is_empty())
}

/// What a command prints, with the names of programs as a document has them.
fn printed(arguments: &str) -> String {
    let mut arguments: Vec<String> = arguments.split_whitespace().map(str::to_owned).collect();
    let mut named = Vec::new();
    for argument in &mut arguments {
        if let Some(&(shown, name)) = EXAMPLES.iter().find(|(shown, _)| shown == argument) {
            *argument = example(name);
            named.push((argument.clone(), shown));
        }
    }
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let output = run(&arguments).stdout;
    named.iter().fold(output, |output, (file, shown)| output.replace(file.as_str(), shown))
}

#[test]
fn what_a_document_shows_is_what_is_printed() {
    let documents = documents();
    let all =
        documents.iter().flat_map(|(name, text)| shown(text).into_iter().map(move |shown| (name, shown)));
    let (not_run, run): (Vec<_>, Vec<_>) =
        all.partition(|(_, shown)| NOT_RUN.iter().any(|(arguments, _)| *arguments == shown.arguments));
    assert_eq!(not_run.len(), NOT_RUN.len(), "each of those is shown once: {not_run:?}");
    assert!(run.len() >= 10, "they show at least ten: {run:?}");
    let mut wrong = Vec::new();
    let mut printed_already: Vec<(&str, String)> = Vec::new();
    for (name, Shown { arguments, output }) in run {
        let known = printed_already.iter().position(|(known, _)| *known == arguments);
        let at = known.unwrap_or_else(|| {
            printed_already.push((arguments, printed(arguments)));
            printed_already.len() - 1
        });
        let printed = &printed_already[at].1;
        if !matches(printed, output) {
            wrong.push(format!("{name} shows for adsdv {arguments}:\n{output}\nbut it prints:\n{printed}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn the_table_of_figure_2_in_the_book_is_the_table_that_is_printed() {
    let page = fs::read_to_string(workspace().join("docs/figure-2.md")).expect("the page is there");
    let table = run(&["diagram", "--format", "markdown"]).stdout;
    // Behind the line that says the edition, which a reader of the page does not see.
    let table = table.split_once('\n').map_or("", |(_, table)| table);
    assert!(
        !table.is_empty() && page.contains(table.trim()),
        "the table of docs/figure-2.md is not that of `adsdv diagram --format markdown`"
    );
}

/// The pages of the book, and others that it takes in, stand in its contents, once each.
#[test]
fn every_page_of_the_book_stands_in_its_contents() {
    let contents = fs::read_to_string(workspace().join("docs/SUMMARY.md")).expect("the contents are there");
    let targets: Vec<&str> =
        contents.split("](").skip(1).filter_map(|rest| Some(rest.split_once(')')?.0)).collect();
    let once: BTreeSet<&str> = targets.iter().copied().collect();
    assert_eq!(once.len(), targets.len(), "a page stands in it twice");
    for (name, _) in documents().iter().filter(|(name, _)| name != "README.md" && name != "SUMMARY.md") {
        assert!(once.contains(name.as_str()), "docs/SUMMARY.md does not have {name}");
    }
}

#[test]
fn the_comparison_can_fail() {
    assert!(matches("a\nb\nc\n", "a\n[...]\nc"));
    assert!(matches("a\nb\nc\n", "a\n[...]"));
    assert!(!matches("a\nb\nc\n", "a\n[...]\nd"));
    assert!(!matches("a\nb\nc\nd\n", "a\n[...]\nc"));
    assert!(!matches("x\nb\nc\n", "a\n[...]\nc"));
    let block = "```console\n$ adsdv check log\nbad\n```\n```console\n$ adsdv vcu\n$ adsdv ai\n```\n";
    assert_eq!(shown(block), [Shown { arguments: "check log", output: "bad" }]);
}
