//! A version is named in several places: a release takes its notes from one of them, and each says the same.

use std::fs;
use std::path::Path;

const VERSION: &str = env!("CARGO_PKG_VERSION");

fn text(file: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the project");
    fs::read_to_string(root.join(file)).unwrap_or_else(|error| panic!("{file}: {error}"))
}

/// What `.github/workflows/release.yml` takes for the notes of a release.
#[test]
fn the_changelog_has_a_dated_section_of_the_version() {
    let changelog = text("CHANGELOG.md");
    let mut sections = changelog.split("\n## ").skip(1);
    assert!(
        sections.next().is_some_and(|first| first.starts_with("[Unreleased]\n")),
        "what comes next is first"
    );
    let heading = format!("[{VERSION}] - ");
    let section = sections.find_map(|section| section.strip_prefix(heading.as_str()));
    let (date, notes) = section.and_then(|section| section.split_once('\n')).unwrap_or_else(|| {
        panic!("CHANGELOG.md has no section \"## {heading}YYYY-MM-DD\": write it before the tag")
    });
    let parts: Vec<usize> =
        date.split('-').map(|part| part.parse::<u16>().map_or(0, |_| part.len())).collect();
    assert_eq!(parts, [4, 2, 2], "{date} is no date");
    assert!(notes.lines().filter(|line| line.starts_with("- ")).count() > 3, "{notes}");
}

#[test]
fn what_is_no_member_of_the_workspace_has_its_version_as_well() {
    for (file, line) in [
        ("python/Cargo.toml", format!("version = \"{VERSION}\"")),
        ("embedded/Cargo.toml", format!("version = \"{VERSION}\"")),
        ("CITATION.cff", format!("version: {VERSION}")),
    ] {
        assert!(text(file).lines().any(|own| own == line), "{file}: expected a line {line}");
    }
}
