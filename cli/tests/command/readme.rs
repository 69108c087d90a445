//! The README is true: what it shows as printed is what is printed.

use std::path::Path;
use std::process::Command;

/// Stands for lines that the README leaves out.
const LEFT_OUT: &str = "[...]";

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// The commands that the README shows with their output, as arguments of `adsdv`.
fn shown(readme: &str) -> Vec<(Vec<&str>, &str)> {
    readme
        .split("```console\n")
        .skip(1)
        .filter_map(|block| block.split_once("\n```"))
        .filter_map(|(block, _)| block.strip_prefix("$ cargo run --release -- ")?.split_once('\n'))
        .map(|(command, output)| (command.split_whitespace().collect(), output))
        .collect()
}

fn matches(printed: &str, shown: &str) -> bool {
    let mut rest = printed.trim_end();
    let mut parts = shown.split(LEFT_OUT);
    let Some(first) = parts.next() else { return false };
    let Some(after) = rest.strip_prefix(first.trim_end()) else { return false };
    rest = after;
    parts.all(|part| match rest.find(part.trim()) {
        Some(at) => {
            rest = &rest[at + part.trim().len()..];
            true
        }
        None => false,
    }) && rest.trim().is_empty()
}

#[test]
fn what_the_readme_shows_is_what_is_printed() {
    let readme = std::fs::read_to_string(root().join("README.md")).expect("the README is there");
    let commands = shown(&readme);
    assert!(commands.len() >= 2, "the README shows at least two commands with their output");
    for (arguments, shown) in commands {
        let run = Command::new(env!("CARGO_BIN_EXE_adsdv")).args(&arguments).current_dir(root()).output();
        let printed = String::from_utf8(run.expect("adsdv runs").stdout).expect("it prints text");
        assert!(
            matches(&printed, shown),
            "README shows for adsdv {arguments:?}:\n{shown}\nbut it prints:\n{printed}"
        );
    }
}

#[test]
fn the_table_in_the_readme_is_the_table_that_is_printed() {
    let readme = std::fs::read_to_string(root().join("README.md")).expect("the README is there");
    let run = Command::new(env!("CARGO_BIN_EXE_adsdv")).args(["diagram", "--format", "markdown"]).output();
    let table = String::from_utf8(run.expect("adsdv runs").stdout).expect("it prints text");
    // Behind the line that says the edition, which a reader of the README does not see.
    let table = table.split_once('\n').map_or("", |(_, table)| table);
    assert!(
        !table.is_empty() && readme.contains(table.trim()),
        "the README's table is not that of `adsdv diagram --format markdown`"
    );
}

#[test]
fn the_comparison_can_fail() {
    assert!(matches("a\nb\nc\n", "a\n[...]\nc"));
    assert!(!matches("a\nb\nc\n", "a\n[...]\nd"));
    assert!(!matches("a\nb\nc\nd\n", "a\n[...]\nc"));
    assert!(!matches("x\nb\nc\n", "a\n[...]\nc"));
}
