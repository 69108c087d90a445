//! `adsdv exam` on buses of the kernel's: an interface that is there, and those that it makes in namespaces of its own.
//!
//! `ADSDV_SOCKETCAN_C` names the stack of `exam/examples/socketcan.c`, which has nothing of ours in it.

use std::env;
use std::fs;
use std::os::unix::process::CommandExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use libtest_mimic::Completion;

use super::command::{Program, adsdv, lines, log, text, without};
use super::vcan::{Outcome, Test, Tried, Vcan, ensure, wait_until};

pub(crate) const TESTS: &[Test] = &[
    ("exam::a_stack_of_sockets_passes_on_a_bus_that_is_made_for_it", socketcan_c),
    ("exam::who_is_not_root_has_a_bus_as_well", not_root),
    ("exam::the_reference_passes_started_and_running", reference),
    ("exam::a_program_that_is_silent_floods_or_crashes_fails", misbehaves),
    ("exam::what_a_program_started_is_gone_with_it", forks),
    ("exam::an_interface_that_goes_down_ends_it_with_what_was_seen", goes_down),
    ("exam::told_to_stop_it_ends_in_order", stops),
    ("exam::what_cannot_be_examined_is_reported", refused),
];

/// What a run came to: its exit status, what it printed, and its errors.
type Ended = (Option<i32>, String, String);

fn examined(adsdv: &Path, words: &[&str], program: &[&str]) -> Tried<Ended> {
    Program::start(adsdv, &[&["exam", "--edition", "4.0"], words, &["--"], program].concat())?.end()
}

fn socketcan() -> Option<PathBuf> {
    env::var_os("ADSDV_SOCKETCAN_C").map(PathBuf::from)
}

fn socketcan_c() -> Outcome {
    let (Some(adsdv), Some(stack)) = (adsdv(), socketcan()) else { return Ok(without()) };
    let begun = Instant::now();
    let words = ["--namespace", "--quick", "--jobs", "2", "--all"];
    let (code, out, error) = examined(&adsdv, &words, &[text(&stack)?, "vcan0"])?;
    println!("exam --quick --jobs 2: {:.0} s\n{out}", begun.elapsed().as_secs_f64());
    ensure!(code == Some(0) && error.is_empty(), "{code:?} {error}\n{out}");
    for told in ["5 scenarios", "of real time", "MSG-5   sends", ": passes"] {
        ensure!(out.contains(told), "{told:?} is not in:\n{out}");
    }
    // A machine that had not the time for it has shown that nobody is blamed.
    ensure!(out.contains("FIN-3   tells") || out.contains("this machine was late by"), "{out}");
    Ok(Completion::Completed)
}

/// Nobody, who may do nothing but have a user namespace.
fn not_root() -> Outcome {
    const NOBODY: u32 = 65534;
    let (Some(adsdv), Some(stack)) = (adsdv(), socketcan()) else { return Ok(without()) };
    let output = Command::new(adsdv)
        .args(["exam", "--edition", "4.0", "--namespace", "--only", "ready", "--"])
        .args([text(&stack)?, "vcan0"])
        .uid(NOBODY)
        .gid(NOBODY)
        .stdin(Stdio::null())
        .output()?;
    let (out, error) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    ensure!(output.status.code() == Some(0) && error.is_empty(), "{:?} {error}\n{out}", output.status);
    ensure!(out.contains("1 scenario, 4.") && out.contains(": passes"), "{out}");
    Ok(Completion::Completed)
}

fn reference() -> Outcome {
    let Some(adsdv) = adsdv() else { return Ok(without()) };
    let vcan = Vcan::new()?;
    let ours = text(&adsdv)?;
    let folder = log("exam");
    let words = [&vcan.0, "--only", "estop-in-ready", "--logs", text(&folder)?];
    let (code, out, error) = examined(&adsdv, &words, &[ours, "ai", &vcan.0, "--edition", "4.0"])?;
    ensure!(code == Some(0) && error.is_empty(), "{code:?} {error}\n{out}");
    ensure!(lines(&folder.join("estop-in-ready.log")) > 1000, "the log is short");
    let running = Program::start(&adsdv, &["ai", &vcan.0, "--edition", "4.0"])?;
    let attached =
        ["exam", "--edition", "4.0", &vcan.0, "--attach", "--only", "ready", "--only", "vcu-first"];
    let (code, out, error) = Program::start(&adsdv, &attached)?.end()?;
    ensure!(code == Some(0) && error.is_empty(), "{code:?} {error}\n{out}");
    ensure!(out.contains("vcu-first: not run, since it needs a program that is started afresh"), "{out}");
    let (code, out, error) =
        Program::start(&adsdv, &["exam", &vcan.0, "--attach", "--only", "vcu-first"])?.end()?;
    ensure!(code == Some(2) && out.is_empty() && error.contains("nothing was exercised"), "{code:?} {error}");
    running.signal("INT")?;
    running.end()?;
    let _ = fs::remove_dir_all(folder);
    Ok(Completion::Completed)
}

fn misbehaves() -> Outcome {
    let Some(adsdv) = adsdv() else { return Ok(without()) };
    let vcan = Vcan::new()?;
    let words = [&vcan.0, "--only", "no-mission", "--startup", "0.2"];
    let flood = ["cangen", &vcan.0, "-g", "0", "-I", "510", "-L", "8", "-i"];
    for (program, told) in [
        (&["sleep", "600"][..], &["MSG-5   sends AI2VCU_Status (510h)"][..]),
        (
            &["sh", "-c", "sleep 1; echo no map >&2; kill -SEGV $$"],
            &["the program ended by itself: signal 11; its last words: no map"],
        ),
        (&flood, &["the bus cannot carry what the AI Computer sends", "MSG-98"]),
    ] {
        let (code, out, error) = examined(&adsdv, &words, program)?;
        ensure!(code == Some(1) && error.is_empty(), "{program:?}: {code:?} {error}\n{out}");
        let flat = out.split_whitespace().collect::<Vec<_>>().join(" ");
        for told in told {
            let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
            ensure!(flat.contains(&told), "{program:?}: {told:?} is not in:\n{out}");
        }
    }
    Ok(Completion::Completed)
}

/// The processes with this word among theirs, such as the seconds that they sleep.
fn processes(word: &str) -> usize {
    let folders = fs::read_dir("/proc").into_iter().flatten().flatten();
    let commands = folders.filter_map(|folder| fs::read(folder.path().join("cmdline")).ok());
    commands.filter(|command| command.split(|byte| *byte == 0).any(|one| one == word.as_bytes())).count()
}

/// A daemon in a session of its own, and a program that does not heed SIGTERM.
const FORKS: &str = "setsid sleep 617 & trap '' TERM; while :; do sleep 617; done";

fn forks() -> Outcome {
    let Some(adsdv) = adsdv() else { return Ok(without()) };
    let vcan = Vcan::new()?;
    let words = [&vcan.0, "--only", "no-mission", "--startup", "0.2"];
    let (code, out, error) = examined(&adsdv, &words, &["sh", "-c", FORKS])?;
    ensure!(code == Some(1) && error.is_empty(), "{code:?} {error}\n{out}");
    wait_until("nothing is left", || processes("617") == 0)?;
    Ok(Completion::Completed)
}

fn goes_down() -> Outcome {
    let Some(adsdv) = adsdv() else { return Ok(without()) };
    for gone in [false, true] {
        let vcan = Vcan::new()?;
        let words = ["exam", &vcan.0, "--startup", "0.2", "--only", "go-late", "--", "sh", "-c", FORKS];
        let exam = Program::start(&adsdv, &words)?;
        wait_until("it runs", || processes("617") > 0)?;
        thread::sleep(Duration::from_secs(2));
        if gone {
            vcan.delete()?;
        } else {
            vcan.set("down")?;
        }
        let (code, out, error) = exam.end()?;
        // One that is removed goes down first, and that may be seen.
        let down = format!("{}: the interface is ", vcan.0);
        ensure!(
            code == Some(2) && error.contains(&down) && error.contains(", in go-late at "),
            "{code:?} {error}"
        );
        ensure!(out.contains("no verdict, since the exam ended early"), "{out}");
        wait_until("nothing is left", || processes("617") == 0)?;
        if gone {
            // It is removed in the end.
            vcan.add()?;
        }
    }
    Ok(Completion::Completed)
}

fn stops() -> Outcome {
    let Some(adsdv) = adsdv() else { return Ok(without()) };
    let vcan = Vcan::new()?;
    let folder = log("exam-stops");
    let logs = text(&folder)?;
    let words =
        ["exam", &vcan.0, "--startup", "0.2", "--only", "go-late", "--logs", logs, "--", "sh", "-c", FORKS];
    let exam = Program::start(&adsdv, &words)?;
    wait_until("it runs", || processes("617") > 0)?;
    thread::sleep(Duration::from_secs(2));
    exam.signal("INT")?;
    let (code, out, error) = exam.end()?;
    ensure!(code == Some(2) && error.contains("it was stopped, in go-late after "), "{code:?} {error}");
    ensure!(out.contains("no verdict, since the exam ended early"), "{out}");
    ensure!(lines(&folder.join("go-late.log")) > 100, "the log is short");
    wait_until("nothing is left", || processes("617") == 0)?;
    let _ = fs::remove_dir_all(folder);
    Ok(Completion::Completed)
}

fn refused() -> Outcome {
    let Some(adsdv) = adsdv() else { return Ok(without()) };
    let vcan = Vcan::new()?;
    let (code, out, error) = examined(&adsdv, &["adsdv-none", "--only", "ready"], &["true"])?;
    ensure!(
        code == Some(2) && out.is_empty() && error.contains("adsdv-none: there is no such interface"),
        "{error}"
    );
    let (code, out, error) = examined(&adsdv, &[&vcan.0, "--only", "ready"], &["no/such/stack"])?;
    ensure!(
        code == Some(2) && error.contains("no/such/stack: ") && error.contains("check the path"),
        "{out}{error}"
    );
    let vcu = Program::start(&adsdv, &["vcu", &vcan.0, "--plain"])?;
    thread::sleep(Duration::from_secs(1));
    let (code, _, error) = examined(&adsdv, &[&vcan.0, "--only", "ready"], &["true"])?;
    ensure!(code == Some(2) && error.contains("comes before the program runs"), "{error}");
    vcu.signal("INT")?;
    vcu.end()?;
    Ok(Completion::Completed)
}
