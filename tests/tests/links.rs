//! Every link within the project's documents leads to something that is there.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn documents(directory: &Path, all: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(directory).expect("a directory").map(|entry| entry.expect("an entry").path()) {
        let name = entry.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        if entry.is_dir() && !["target", "node_modules", ".git"].contains(&name) {
            documents(&entry, all);
        } else if entry.extension().is_some_and(|extension| extension == "md") {
            all.push(entry);
        }
    }
}

/// The anchor of a heading, as the usual sites make it.
fn anchor(heading: &str) -> String {
    let text = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = text.chars().filter(|c| c.is_alphanumeric() || [' ', '-', '_'].contains(c));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// What a document links to, without what stands in its code.
fn targets(text: &str) -> Vec<String> {
    let mut in_code = false;
    let mut all = Vec::new();
    for line in text.lines() {
        in_code ^= line.trim_start().starts_with("```");
        let links = line.split("](").skip(1).filter(|_| !in_code);
        all.extend(links.filter_map(|rest| Some(rest.split_once(')')?.0.to_owned())));
    }
    all
}

fn anchors(text: &str) -> BTreeSet<String> {
    text.lines().filter(|line| line.starts_with('#')).map(anchor).collect()
}

#[test]
fn every_link_of_a_document_leads_to_a_file_and_a_heading_that_are_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the project");
    let mut all = Vec::new();
    documents(root, &mut all);
    let (mut seen, mut broken) = (0, Vec::new());
    for document in &all {
        let text = fs::read_to_string(document).expect("a document");
        for target in targets(&text).iter().filter(|target| !target.contains("://") && !target.contains("::"))
        {
            seen += 1;
            let (path, heading) = target.split_once('#').unwrap_or((target, ""));
            let folder = document.parent().expect("a folder");
            let file = if path.is_empty() { document.clone() } else { folder.join(path) };
            let has = |text: String| anchors(&text).contains(heading);
            let leads =
                if heading.is_empty() { file.exists() } else { fs::read_to_string(&file).is_ok_and(has) };
            if !leads {
                broken
                    .push(format!("{}: {target}", document.strip_prefix(root).unwrap_or(document).display()));
            }
        }
    }
    assert!(broken.is_empty(), "{broken:#?}");
    assert!(seen > 100, "{seen}");
}
