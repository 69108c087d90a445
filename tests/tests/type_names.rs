//! A type's name stands once in its crate: who reads it needs no path to know which one is meant.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The same type for one system and for another, of which each build has one.
const TWINS: [(&str, &str); 3] = [("can/src", "CanBus"), ("can/src", "Listener"), ("cli/src", "Keyboard")];

/// What a type is defined by.
const KINDS: [&str; 5] = ["enum ", "struct ", "trait ", "type ", "union "];

/// How far in what a block has is.
const INDENT: usize = 4;

/// Where the types of each name stand, crate by crate.
type Places = BTreeMap<(String, String), Vec<String>>;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the crate is in a workspace")
}

/// The Rust files in a folder and those below, without what builds leave.
fn sources(folder: &Path, files: &mut Vec<PathBuf>) {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    for entry in entries {
        let path = entry.unwrap_or_else(|error| panic!("{}: {error}", folder.display())).path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() && name != "target" && !name.starts_with('.') {
            sources(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}

/// The crate that a file is part of: a package has its `src`, and one for each of its programs, tests, examples and
/// benches.
fn crate_of(file: &str) -> String {
    let parts: Vec<&str> = file.split('/').collect();
    let depth = match parts[..] {
        [_, "src", "bin", ..] => 4,
        [_, "src", ..] => 2,
        _ => 3,
    };
    let name = parts[..depth.min(parts.len())].join("/");
    name.strip_suffix(".rs").unwrap_or(&name).to_owned()
}

/// The types that a file defines, those of inline modules and those that a macro such as `data!` takes as well; what a function
/// defines for itself is its own. The file is as rustfmt leaves it: what stands in a module is four columns further in than the
/// module.
fn types(text: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let mut depth = 0;
    for line in text.lines() {
        let code = line.trim_start();
        let indent = line.len() - code.len();
        if matches!(code, "}" | ");") && indent + INDENT == depth {
            depth = indent;
        }
        if indent != depth {
            continue;
        }
        let code = without_visibility(code);
        if code.starts_with("mod ") && code.ends_with('{') || code.ends_with("!(") {
            depth += INDENT;
        } else if let Some(rest) = KINDS.iter().find_map(|kind| code.strip_prefix(kind)) {
            let name = rest.split(|c: char| !c.is_alphanumeric() && c != '_').next();
            found.extend(name.filter(|name| name.starts_with(char::is_uppercase)));
        }
    }
    found
}

/// An item without the words that say who sees it.
fn without_visibility(code: &str) -> &str {
    let Some(rest) = code.strip_prefix("pub") else { return code };
    let rest = if rest.starts_with('(') { rest.split_once(')').map_or(rest, |(_, rest)| rest) } else { rest };
    rest.trim_start()
}

fn collect(file: &str, text: &str, places: &mut Places) {
    for name in types(text) {
        places.entry((crate_of(file), name.to_owned())).or_default().push(file.to_owned());
    }
}

/// Each name that several types of a crate have, and where they stand.
fn repeated(places: &Places) -> Vec<((&str, &str), &[String])> {
    let several = places.iter().filter(|(_, files)| files.len() > 1);
    several.map(|((of, name), files)| ((of.as_str(), name.as_str()), files.as_slice())).collect()
}

#[test]
fn no_two_types_of_a_crate_have_one_name() {
    let mut files = Vec::new();
    sources(root(), &mut files);
    let mut places = Places::new();
    for path in files {
        let file = path.strip_prefix(root()).expect("it is below").to_string_lossy().replace('\\', "/");
        let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{file}: {error}"));
        collect(&file, &text, &mut places);
    }
    let repeated = repeated(&places);
    let (twins, others): (Vec<_>, Vec<_>) = repeated.into_iter().partition(|(what, _)| TWINS.contains(what));
    assert!(others.is_empty(), "rename all but one of each: {others:#?}");
    let twins: BTreeSet<_> = twins.into_iter().map(|(what, _)| what).collect();
    assert_eq!(twins, BTreeSet::from(TWINS), "the twins that there are, and those that are excused");
}

#[test]
fn a_second_type_of_a_name_is_found_in_its_crate_alone() {
    let mut places = Places::new();
    for (file, text) in [
        ("one/src/lib.rs", "pub struct Line;\nfn f() {\n    struct Word;\n}"),
        ("one/src/deep/word.rs", "enum Word {}\nmod tests {\n    trait Line {}\n}"),
        ("one/tests/word.rs", "type Word = u8;"),
        ("one/src/part.rs", "data!(\n    pub struct Part {\n        a: u8,\n    }\n);\nstruct Whole;"),
        ("one/src/parts.rs", "fn f() {}\nstruct Part;\nenum Whole {}"),
        ("two/src/lib.rs", "union Line { a: u8 }"),
        (
            "two/src/bin/line/main.rs",
            "impl Iterator for Line {\n    type Item = u8;\n}\nstruct Item;\nstruct Line;",
        ),
        (
            "two/src/bin/line/twice.rs",
            "mod one {\n    mod two {\n        fn f() {}\n    }\n}\npub(super) struct Twice<T>(T);",
        ),
        ("two/src/bin/line/once.rs", "mod tests {\n    pub(in crate::one) enum Twice {}\n}"),
    ] {
        collect(file, text, &mut places);
    }
    let files = |files: [&str; 2]| files.map(str::to_owned).to_vec();
    let expected = [
        (("one/src", "Line"), files(["one/src/lib.rs", "one/src/deep/word.rs"])),
        (("one/src", "Part"), files(["one/src/part.rs", "one/src/parts.rs"])),
        (("one/src", "Whole"), files(["one/src/part.rs", "one/src/parts.rs"])),
        (("two/src/bin/line", "Twice"), files(["two/src/bin/line/twice.rs", "two/src/bin/line/once.rs"])),
    ];
    let found: Vec<_> = repeated(&places).into_iter().map(|(what, files)| (what, files.to_vec())).collect();
    assert_eq!(found, expected);
}
