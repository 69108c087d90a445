//! The programs that the tests judge: machines in this process, and the examples as child processes.

use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::OnceLock;
use std::time::Duration;

use adsdv_conform::suite::{self, Test};
use adsdv_conform::{ConformOptions, ConformReport, InProcess, Program, ProgramError, conform};
use adsdv_spec::{Edition, Machine};

use super::examples;

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

/// The file of an example, which is built if it is not, or has changed since.
pub(crate) fn path(example: &str) -> PathBuf {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml");
    let folder = FOLDER.get_or_init(|| examples::built(&EXAMPLES, &["--manifest-path", manifest]));
    assert!(EXAMPLES.contains(&example), "{example}: not in the list");
    folder.join(format!("{example}{}", std::env::consts::EXE_SUFFIX))
}
