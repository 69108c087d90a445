//! Every crate that the project stands on has its reason in `docs/dependencies.md`, and nothing else stands there; the Rust that it takes is
//! the one that its documents name; and what is given away is optimised.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The crates that a manifest names in its tables of dependencies, without those of the project.
fn of_manifest(manifest: &str) -> impl Iterator<Item = String> + '_ {
    let mut of_dependencies = false;
    manifest.lines().filter_map(move |line| {
        if let Some(table) = line.strip_prefix('[') {
            of_dependencies =
                table.trim_end_matches(']').ends_with("dependencies") && !table.starts_with("workspace");
            return None;
        }
        let (name, _) = line.split_once('=').filter(|_| of_dependencies)?;
        let name = name.split('.').next().unwrap_or_default().trim();
        let is_name = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_');
        (is_name && !name.starts_with("adsdv")).then(|| name.to_owned())
    })
}

#[test]
fn each_crate_that_is_used_has_its_reason() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the project");
    let folders = fs::read_dir(root).expect("the project").map(|entry| entry.expect("an entry").path());
    let manifests = folders.filter_map(|folder| fs::read_to_string(folder.join("Cargo.toml")).ok());
    let used: BTreeSet<String> = manifests.flat_map(|text| of_manifest(&text).collect::<Vec<_>>()).collect();
    let page = fs::read_to_string(root.join("docs/dependencies.md")).expect("the page");
    let rows = page.lines().filter_map(|line| line.strip_prefix("| ")).skip(1);
    let named: BTreeSet<String> = rows
        .flat_map(|row| {
            row.split(" | ").next().unwrap_or_default().split(", ").map(|name| name.trim().to_owned())
        })
        .collect();
    assert!(used.len() > 30, "{used:?}");
    let without_reason: Vec<_> = used.difference(&named).collect();
    let without_use: Vec<_> = named.difference(&used).collect();
    assert!(without_reason.is_empty() && without_use.is_empty(), "{without_reason:?} {without_use:?}");
}

/// The Rust that a manifest says it takes.
fn rust_of(manifest: &str) -> Option<&str> {
    manifest.lines().find_map(|line| line.strip_prefix("rust-version = \"")?.strip_suffix('"'))
}

#[test]
fn the_documents_name_the_rust_that_the_manifests_take() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the project");
    let read = |name: &str| fs::read_to_string(root.join(name)).expect("a file of the project");
    let (all, spec) = (read("Cargo.toml"), read("spec/Cargo.toml"));
    let [all, spec] = [&all, &spec].map(|manifest| rust_of(manifest).expect("a version"));
    let readme = read("README.md").replace('\n', " ");
    assert!(readme.contains(&format!("With a Rust toolchain ({all} or later)")), "{all}");
    assert!(readme.contains(&format!("(Rust {spec} or later, `no_std`")), "{spec}");
    for document in ["CONTRIBUTING.md", "docs/packaging.md"] {
        assert!(
            read(document).contains(&format!("Rust {all} or later")),
            "{document} does not say Rust {all} or later"
        );
    }
    let contributing = read("CONTRIBUTING.md");
    assert!(
        contributing.contains(&format!("stays on Rust {spec}")),
        "CONTRIBUTING.md does not say that spec stays on Rust {spec}"
    );
}

/// The crates that a profile of a manifest has a level of optimisation for, with it.
fn levels<'a>(manifest: &'a str, profile: &str) -> Vec<(&'a str, &'a str)> {
    let heading = format!("[profile.{profile}.package]");
    let lines = manifest.lines().skip_while(move |line| **line != heading).skip(1);
    lines
        .take_while(|line| !line.starts_with('['))
        .filter_map(|line| line.split_once(".opt-level = "))
        .collect()
}

#[test]
fn what_is_given_away_is_optimised_also_where_a_build_from_source_is_not() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the project");
    let manifest = fs::read_to_string(root.join("Cargo.toml")).expect("the workspace");
    let most = "3";
    let [release, dist] = ["release", "dist"].map(|profile| levels(&manifest, profile));
    let lowered: Vec<_> = release.iter().filter(|(_, level)| *level != most).map(|(name, _)| *name).collect();
    assert!(!lowered.is_empty(), "{release:?}");
    let undone: Vec<_> = dist.iter().filter(|(_, level)| *level == most).map(|(name, _)| *name).collect();
    assert_eq!(lowered, undone, "lowered by the profile `release`, and raised again by `dist`");
}
