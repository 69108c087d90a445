//! The examples that tests run as programs, built if they are not. A file that the tests of `conform` have as well, which would else depend
//! on all that this crate does.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The folder of the examples. Those named are built by `cargo build --examples`, with these arguments, if one of them is not there, or has
/// changed since.
///
/// `cargo test` has built them with the features that its tests have, and what they stand on. By themselves they would be built with
/// others, and some that have the same features otherwise all the same: a minute of compiling.
///
/// # Panics
///
/// If they cannot be built.
pub fn built(examples: &[&str], arguments: &[&str]) -> PathBuf {
    // This test is DIR/debug/deps/command-...
    let test = std::env::current_exe().expect("a path");
    let profile = test.parent().and_then(|deps| deps.parent()).expect("a folder of cargo");
    let folder = profile.with_file_name("debug").join("examples");
    let file = |name: &&str| folder.join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    if examples.iter().all(|name| is_up_to_date(&file(name))) {
        return folder;
    }
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let built = Command::new(cargo)
        .args(["build", "--quiet", "--examples", "--target-dir"])
        .arg(profile.parent().expect("a folder of cargo"))
        .args(arguments)
        .status();
    assert!(built.is_ok_and(|status| status.success()), "the examples can be built");
    folder
}

/// Whether an example is no older than any of its sources, which cargo lists beside it, nor than the versions of what it depends on.
fn is_up_to_date(example: &Path) -> bool {
    let changed = |path: &Path| std::fs::metadata(path).and_then(|file| file.modified()).ok();
    let built = changed(example);
    let Ok(listed) = std::fs::read_to_string(example.with_extension("d")) else { return false };
    let Some((_, sources)) = listed.split_once(": ") else { return false };
    let lock = Path::new(env!("CARGO_MANIFEST_DIR")).join("../Cargo.lock");
    let mut sources = sources.split_whitespace().map(PathBuf::from).chain([lock]);
    // One that cannot be looked at counts as changed.
    sources.all(|source| changed(&source).is_some_and(|changed| built.is_some_and(|built| changed <= built)))
}
