//! Runs the command, and finds the logs.

use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::process::{ChildStdin, Command, Output, Stdio};
use std::sync::OnceLock;
use std::{fs, thread};

use adsdv_tests::examples;

pub(crate) const MISSION: &str = "tests/logs/mission.log";
pub(crate) const FINISHED_WHILE_MOVING: &str = "tests/logs/finished-while-moving.log";

/// What a run came to.
#[derive(Debug)]
pub(crate) struct Outcome {
    pub(crate) status: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

/// The command, in the folder of the workspace, so that reports name logs as a user there does, and without the variables
/// that change colors or the edition.
pub(crate) fn adsdv(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_adsdv"));
    command.args(args).current_dir(workspace()).stdin(Stdio::null());
    for variable in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE", "ADSDV_EDITION"] {
        command.env_remove(variable);
    }
    command
}

/// The examples that are programs under test.
const EXAMPLES: [&str; 4] = ["adapter", "mutant", "deviating", "ai_mutant"];

/// The file of an example of any crate, which is built if it is not, or has changed since.
pub(crate) fn example(name: &str) -> String {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.toml");
    let folder =
        FOLDER.get_or_init(|| examples::built(&EXAMPLES, &["--workspace", "--manifest-path", manifest]));
    assert!(EXAMPLES.contains(&name), "{name}: not in the list");
    let file = folder.join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    file.to_str().expect("a path of text").to_owned()
}

/// Runs the command to its end.
pub(crate) fn run(args: &[&str]) -> Outcome {
    outcome(&mut adsdv(args))
}

/// Runs a command to its end.
pub(crate) fn outcome(command: &mut Command) -> Outcome {
    of(command.output().expect("the command starts"))
}

/// Runs `adsdv check` on a log that is given as standard input.
pub(crate) fn check_input(args: &[&str], log: &[u8]) -> Outcome {
    fed(adsdv(&["check", "-"]).args(args), |stdin| stdin.write_all(log))
}

/// Runs a command, and writes its standard input as it reads. One that refuses its arguments, or has seen enough, does not read on.
pub(crate) fn fed(
    command: &mut Command,
    write: impl FnOnce(&mut ChildStdin) -> io::Result<()> + Send,
) -> Outcome {
    let mut child = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    let output = thread::scope(|scope| {
        scope.spawn(move || match write(&mut stdin).and_then(|()| stdin.flush()) {
            Err(error) if error.kind() != io::ErrorKind::BrokenPipe => panic!("standard input: {error}"),
            _ => drop(stdin),
        });
        child.wait_with_output().expect("the command ends")
    });
    of(output)
}

fn of(output: Output) -> Outcome {
    Outcome {
        status: output.status.code(),
        stdout: String::from_utf8(output.stdout).expect("text"),
        stderr: String::from_utf8(output.stderr).expect("text"),
    }
}

pub(crate) fn workspace() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the crate is in a workspace")
}

/// The bytes of a file of the workspace.
pub(crate) fn file(path: &str) -> Vec<u8> {
    fs::read(workspace().join(path)).unwrap_or_else(|error| panic!("cannot read {path}: {error}"))
}

/// A file of this content for one test. The name has to be the test's own.
pub(crate) fn temporary(name: &str, content: &[u8]) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&path, content).expect("the folder for tests can be written");
    path
}
