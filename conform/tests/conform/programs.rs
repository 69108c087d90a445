//! The programs that the tests judge: machines in this process, and the examples as child processes.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use std::time::Duration;

use adsdv_conform::suite::{self, Test};
use adsdv_conform::{ConformOptions, ConformReport, InProcess, Program, ProgramError, conform};
use adsdv_spec::{Edition, Machine};

/// Long enough for any program that answers at all, on a machine that has other things to do.
pub(crate) const TIMEOUT: Duration = Duration::from_secs(20);

pub(crate) fn tests() -> &'static [Test] {
    tests_of(Edition::DEFAULT)
}

/// The suite of the edition that is asked for; that of the default one for the editions that tests make up.
pub(crate) fn tests_of(edition: &Edition) -> &'static [Test] {
    static TESTS: [OnceLock<Vec<Test>>; Edition::ALL.len()] = [const { OnceLock::new() }; Edition::ALL.len()];
    let known = Edition::find(edition.version).unwrap_or(Edition::DEFAULT);
    let (_, tests) = Edition::ALL.iter().zip(&TESTS).find(|(one, _)| **one == known).expect("one of them");
    tests.get_or_init(|| suite::generate(known))
}

/// Only the suite; what we decided counts.
pub(crate) fn suite_only() -> ConformOptions {
    ConformOptions { runs: 0, strict: true, ..ConformOptions::default() }
}

/// A machine in this process, judged.
pub(crate) fn machine(machine: &Machine, options: &ConformOptions) -> ConformReport {
    conform(&mut InProcess(*machine), tests_of(&options.edition), options, &mut |_| {})
        .expect("a machine is never in trouble")
}

/// An example with arguments, judged.
pub(crate) fn example(
    name: &str,
    args: &[&str],
    options: &ConformOptions,
    timeout: Duration,
) -> Result<ConformReport, ProgramError> {
    let args: Vec<OsString> = args.iter().map(OsString::from).collect();
    let mut program = Program::start(&path(name).into_os_string(), &args, timeout, options.latency > 0)?;
    conform(&mut program, tests_of(&options.edition), options, &mut |_| {})
}

/// The examples that are programs under test.
const EXAMPLES: [&str; 2] = ["adapter", "mutant"];

/// The file of an example, which is built if it is not, or has changed since. `cargo test` has built it with the features that its
/// tests have: for itself it would be built with others, and what it depends on a second time.
pub(crate) fn path(example: &str) -> PathBuf {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    let folder = FOLDER.get_or_init(|| {
        // This test is DIR/debug/deps/conform-...
        let test = std::env::current_exe().expect("a path");
        let profile = test.parent().and_then(|deps| deps.parent()).expect("a folder of cargo");
        let folder = profile.with_file_name("debug").join("examples");
        if EXAMPLES.iter().all(|example| is_up_to_date(&folder.join(example))) {
            return folder;
        }
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let built = Command::new(cargo)
            .args(["build", "--quiet", "--examples", "--target-dir"])
            .arg(profile.parent().expect("a folder of cargo"))
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .status();
        assert!(built.is_ok_and(|status| status.success()), "the examples can be built");
        folder
    });
    assert!(EXAMPLES.contains(&example), "{example}: not in the list");
    folder.join(format!("{example}{}", std::env::consts::EXE_SUFFIX))
}

/// Whether an example is no older than any of its sources, which cargo lists beside it, nor than the versions of what it depends on.
fn is_up_to_date(example: &Path) -> bool {
    let changed = |path: &Path| std::fs::metadata(path).and_then(|file| file.modified()).ok();
    let built = changed(&example.with_extension(std::env::consts::EXE_EXTENSION));
    let Ok(listed) = std::fs::read_to_string(example.with_extension("d")) else { return false };
    let Some((_, sources)) = listed.split_once(": ") else { return false };
    let lock = Path::new(env!("CARGO_MANIFEST_DIR")).join("../Cargo.lock");
    let mut sources = sources.split_whitespace().map(PathBuf::from).chain([lock]);
    // One that cannot be looked at counts as changed.
    sources.all(|source| changed(&source).is_some_and(|changed| built.is_some_and(|built| changed <= built)))
}
