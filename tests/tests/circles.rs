//! Which files of a crate depend on each other in a circle: to read one of these is to read all of them.
//!
//! A file depends on another where it imports or names what that defines, through whatever it is exported again. Tests do not count,
//! nor do macros; nor that a file names what the first file of its folder, or of one around that, defines for all of them.
//!
//! And each file belongs to a crate: the compiler says nothing of one that no `mod` names, and no test in it runs.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use syn::visit::{self, Visit};
use syn::{Attribute, Item, ItemMod, ItemUse, UseTree};

/// A module of a crate: the names from its root on.
type Module = Vec<String>;

/// The files of a crate, and what each module in them imports and names.
#[derive(Default)]
struct Sources {
    /// The file that a module stands in.
    files: BTreeMap<Module, String>,
    /// What a module imports: the name that it has there, and the path.
    imports: BTreeMap<Module, Vec<(String, Vec<String>)>>,
    /// The paths that a module names.
    paths: BTreeMap<Module, Vec<Vec<String>>>,
}

impl Sources {
    /// Reads a crate from its root file on; `text` gives what a file has, if there is such a file.
    fn read(root: &str, text: &dyn Fn(&str) -> Option<String>) -> Self {
        let mut sources = Self::default();
        let folder = root.rsplit_once('/').map_or("", |(folder, _)| folder);
        sources.file(root, folder, &Module::new(), text);
        sources
    }

    fn file(&mut self, file: &str, folder: &str, module: &Module, text: &dyn Fn(&str) -> Option<String>) {
        let content = text(file).unwrap_or_else(|| panic!("there is no {file}"));
        let parsed = syn::parse_file(&content).unwrap_or_else(|error| panic!("{file}: {error}"));
        self.items(&parsed.items, file, folder, module, text);
    }

    fn items(
        &mut self,
        items: &[Item],
        file: &str,
        folder: &str,
        module: &Module,
        text: &dyn Fn(&str) -> Option<String>,
    ) {
        self.files.insert(module.clone(), file.to_owned());
        for item in items {
            if let Item::Mod(ItemMod { attrs, ident, content, .. }) = item {
                if is_of_tests(attrs) {
                    continue;
                }
                let inner = [module.as_slice(), &[ident.to_string()]].concat();
                let below = format!("{folder}/{ident}");
                if let Some((_, items)) = content {
                    self.items(items, file, &below, &inner, text);
                    continue;
                }
                let own = [format!("{below}.rs"), format!("{below}/mod.rs")];
                // What is built for another system alone may stand elsewhere.
                if let Some(own) = own.iter().find(|own| text(own).is_some()) {
                    self.file(own, &below, &inner, text);
                }
            } else {
                let mut named = Named::default();
                named.visit_item(item);
                self.imports.entry(module.clone()).or_default().extend(named.imports);
                self.paths.entry(module.clone()).or_default().extend(named.paths);
            }
        }
    }

    /// The module in which stands what a path names, seen from a module; `None` if it is of another crate, or its own.
    fn target(&self, from: &Module, path: &[String], depth: usize) -> Option<Module> {
        let (first, mut rest) = path.split_first()?;
        let mut at = match first.as_str() {
            "crate" => Module::new(),
            "self" => from.clone(),
            "super" => from.split_last()?.1.to_vec(),
            _ => {
                rest = path;
                let inner = [from.as_slice(), std::slice::from_ref(first)].concat();
                self.files.contains_key(&inner).then(|| from.clone())?
            }
        };
        while let Some((name, behind)) = rest.split_first() {
            let inner = [at.as_slice(), std::slice::from_ref(name)].concat();
            if name == "super" {
                at = at.split_last()?.1.to_vec();
            } else if self.files.contains_key(&inner) {
                at = inner;
            } else {
                let again = self.imports.get(&at).into_iter().flatten().find(|(known, _)| known == name);
                return match again {
                    Some((_, path)) if depth > 0 => self.target(&at, path, depth - 1),
                    _ => Some(at),
                };
            }
            rest = behind;
        }
        Some(at)
    }

    /// The files that each file depends on.
    fn depends(&self) -> BTreeMap<&str, BTreeSet<&str>> {
        let mut all = BTreeMap::<_, BTreeSet<_>>::new();
        for (module, file) in &self.files {
            let imports = self.imports.get(module).into_iter().flatten().map(|(_, path)| path);
            let paths = imports.chain(self.paths.get(module).into_iter().flatten());
            let targets = paths.filter_map(|path| self.target(module, path, 8));
            let targets = targets.filter(|target| !module.starts_with(target));
            let files = targets.filter_map(|module| self.files.get(&module)).map(String::as_str);
            all.entry(file.as_str()).or_default().extend(files.filter(|other| other != file));
        }
        all
    }
}

/// What an item imports, and which paths it names.
#[derive(Default)]
struct Named {
    imports: Vec<(String, Vec<String>)>,
    paths: Vec<Vec<String>>,
}

impl Named {
    fn tree(&mut self, tree: &UseTree, before: &[String]) {
        let with = |name: &dyn ToString| [before, &[name.to_string()]].concat();
        match tree {
            UseTree::Path(path) => self.tree(&path.tree, &with(&path.ident)),
            UseTree::Name(name) if name.ident == "self" => {
                self.imports.push((before.last().cloned().unwrap_or_default(), before.to_vec()));
            }
            UseTree::Name(name) => self.imports.push((name.ident.to_string(), with(&name.ident))),
            UseTree::Rename(name) => self.imports.push((name.rename.to_string(), with(&name.ident))),
            UseTree::Glob(_) => self.paths.push(before.to_vec()),
            UseTree::Group(group) => group.items.iter().for_each(|tree| self.tree(tree, before)),
        }
    }
}

impl Visit<'_> for Named {
    fn visit_item_use(&mut self, item: &ItemUse) {
        if !is_of_tests(&item.attrs) {
            self.tree(&item.tree, &[]);
        }
    }

    fn visit_path(&mut self, path: &syn::Path) {
        let names: Vec<_> = path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        if names.len() > 1 {
            self.paths.push(names);
        }
        visit::visit_path(self, path);
    }

    fn visit_item_mod(&mut self, item: &ItemMod) {
        if !is_of_tests(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }
}

fn is_of_tests(attributes: &[Attribute]) -> bool {
    let is_test = |attribute: &&Attribute| {
        let test = |list: &syn::MetaList| list.tokens.to_string() == "test";
        attribute.path().is_ident("cfg") && attribute.meta.require_list().is_ok_and(test)
    };
    attributes.iter().any(|attribute| is_test(&attribute))
}

/// The circles: each file with those that it depends on and that depend on it, if there are any.
fn circles<'a>(depends: &BTreeMap<&'a str, BTreeSet<&'a str>>) -> BTreeSet<BTreeSet<&'a str>> {
    let reaches = |from: &'a str| {
        let mut seen = BTreeSet::new();
        let mut open = vec![from];
        while let Some(file) = open.pop() {
            for &next in depends.get(file).into_iter().flatten() {
                if seen.insert(next) {
                    open.push(next);
                }
            }
        }
        seen
    };
    let all: BTreeMap<_, _> = depends.keys().map(|&file| (file, reaches(file))).collect();
    let circle = |(file, reached): (&&'a str, &BTreeSet<&'a str>)| {
        let back = |other: &&&str| all.get(**other).is_some_and(|reached| reached.contains(file));
        reached.iter().filter(back).copied().collect::<BTreeSet<_>>()
    };
    all.iter().map(circle).filter(|circle| circle.len() > 1).collect()
}

/// The root files of the workspace's libraries and programs.
fn roots(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for member in fs::read_dir(folder).expect("the workspace").filter_map(Result::ok) {
        let source = member.path().join("src");
        found.extend(
            ["lib.rs", "main.rs"].map(|name| source.join(name)).into_iter().filter(|root| root.is_file()),
        );
    }
    found.sort();
    found
}

#[test]
fn no_files_depend_on_each_other_in_a_circle() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the crate is in a workspace");
    let roots = roots(folder);
    assert!(roots.len() > 10, "{roots:?}");
    let text = |file: &str| fs::read_to_string(folder.join(file)).ok();
    let mut found = BTreeMap::new();
    for root in roots {
        let root = root.strip_prefix(folder).expect("it is below").to_string_lossy().replace('\\', "/");
        let sources = Sources::read(&root, &text);
        let depends = sources.depends();
        for circle in circles(&depends) {
            for file in &circle {
                let within: Vec<_> =
                    depends[file].intersection(&circle).map(|other| (*other).to_owned()).collect();
                found.insert((*file).to_owned(), within);
            }
        }
    }
    assert!(found.is_empty(), "in a circle, each with those of it that it depends on: {found:#?}");
}

/// Every file of Rust in a folder and below it, by folder.
fn by_folder(folder: &Path, all: &mut BTreeMap<PathBuf, BTreeSet<String>>) {
    for entry in fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry")) {
        let name = entry.file_name().to_string_lossy().into_owned();
        if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            if !["target", "node_modules", ".git"].contains(&name.as_str()) {
                by_folder(&entry.path(), all);
            }
        } else if let Some(stem) = name.strip_suffix(".rs") {
            all.entry(folder.to_owned()).or_default().insert(stem.to_owned());
        }
    }
}

#[test]
fn each_file_beside_the_first_of_its_folder_is_a_module_of_it() {
    const FIRST: [&str; 3] = ["main", "lib", "mod"];
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the crate is in a workspace");
    let mut all = BTreeMap::new();
    by_folder(root, &mut all);
    let (mut seen, mut alone) = (0, Vec::new());
    for (folder, stems) in &all {
        let first = FIRST.map(|name| folder.join(name)).into_iter().chain([folder.clone()]);
        let first: Vec<_> =
            first.filter_map(|path| fs::read_to_string(path.with_extension("rs")).ok()).collect();
        // Where there is none, each file is a program: a test, an example, a benchmark.
        for stem in stems.iter().filter(|stem| !first.is_empty() && !FIRST.contains(&stem.as_str())) {
            seen += 1;
            let names = [format!("mod {stem};"), format!("#[path = \"{stem}.rs\"]")];
            if !first.iter().any(|text| names.iter().any(|name| text.contains(name))) {
                alone.push(folder.join(stem).with_extension("rs"));
            }
        }
    }
    assert!(seen > 500, "{seen}");
    assert!(alone.is_empty(), "no `mod` names them, so that they are not compiled: {alone:#?}");
}

#[test]
fn a_circle_is_found_through_what_is_exported_again() {
    let files = BTreeMap::from([
        (
            "one/lib.rs",
            "mod a; mod b; mod c; pub use a::A; pub struct All; #[cfg(test)] mod tests { use crate::c::C; }",
        ),
        ("one/a.rs", "use crate::b::B; pub struct A(B); #[cfg(test)] use crate::c::C;"),
        ("one/b/mod.rs", "mod inner; pub use inner::{Inner as B};"),
        ("one/b/inner.rs", "pub struct Inner; impl Inner { fn f(_: &crate::A) {} }"),
        ("one/c.rs", "use super::{A, All, b::B}; use std::fmt::Write; pub struct C;"),
    ]);
    let text = |file: &str| files.get(file).map(|text| (*text).to_owned());
    let sources = Sources::read("one/lib.rs", &text);
    let depends = sources.depends();
    assert_eq!(depends["one/c.rs"], BTreeSet::from(["one/a.rs", "one/b/inner.rs"]));
    assert_eq!(circles(&depends), BTreeSet::from([BTreeSet::from(["one/a.rs", "one/b/inner.rs"])]));
}
