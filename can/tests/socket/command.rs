//! The command itself, named by `ADSDV`, on a bus of the kernel's: a signal stops it, and it ends in order.

use std::env;
use std::fs;
use std::io::{BufRead as _, BufReader, Read as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use libtest_mimic::Completion;

use super::vcan::{Outcome, PATIENCE, Test, Tried, Vcan, ensure, undisturbed, wait_until};

pub(crate) const TESTS: &[Test] = &[
    ("command::a_mission_is_watched_and_recorded_and_the_logs_conform", mission),
    ("command::stopped_by_a_signal_each_ends_in_order", stops),
    ("command::what_cannot_be_opened_is_reported", refused),
    ("command::a_full_disk_is_reported_and_watching_goes_on", full_disk),
    ("command::a_full_disk_for_what_is_printed_is_reported", full_disk_for_output),
    ("command::a_log_that_cannot_be_made_is_reported", no_log),
    ("command::an_interface_that_vanishes_is_reported_and_waited_for", vanishes),
    ("command::a_closed_pipe_ends_each_in_order", closed_pipe),
];

/// A program that is ended with the test.
pub(crate) struct Program(Child);

impl Program {
    pub(crate) fn start(program: &Path, words: &[&str]) -> Tried<Self> {
        Self::start_into(program, words, Stdio::piped())
    }

    fn start_into(program: &Path, words: &[&str], out: Stdio) -> Tried<Self> {
        let child = Command::new(program)
            .args(words)
            .stdin(Stdio::null())
            .stdout(out)
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| format!("{}: {error}", program.display()))?;
        Ok(Self(child))
    }

    pub(crate) fn signal(&self, signal: &str) -> Tried {
        let id = self.0.id().to_string();
        ensure!(Command::new("kill").args(["-s", signal, &id]).status()?.success(), "kill {id}");
        Ok(())
    }

    /// Waits for its end: its exit status and what it printed.
    pub(crate) fn end(mut self) -> Tried<(Option<i32>, String, String)> {
        let begun = Instant::now();
        while self.0.try_wait()?.is_none() {
            ensure!(begun.elapsed() < Duration::from_secs(100), "it does not end");
            thread::sleep(Duration::from_millis(10));
        }
        let (mut out, mut error) = (String::new(), String::new());
        if let Some(mut stdout) = self.0.stdout.take() {
            stdout.read_to_string(&mut out)?;
        }
        self.0.stderr.take().ok_or("no errors")?.read_to_string(&mut error)?;
        Ok((self.0.wait()?.code(), out, error))
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

pub(crate) fn adsdv() -> Option<PathBuf> {
    env::var_os("ADSDV").map(PathBuf::from)
}

pub(crate) fn without() -> Completion {
    Completion::ignored_with("ADSDV does not name the command")
}

pub(crate) fn log(name: &str) -> PathBuf {
    env::temp_dir().join(format!("adsdv-{name}-{}.log", std::process::id()))
}

pub(crate) fn text(path: &Path) -> Tried<&str> {
    path.to_str().ok_or_else(|| "an odd name of a file".into())
}

pub(crate) fn lines(path: &Path) -> usize {
    fs::read_to_string(path).map_or(0, |text| text.lines().count())
}

fn mission() -> Outcome {
    let Some(adsdv) = adsdv() else { return Ok(without()) };
    undisturbed("command::mission", || watched_mission(&adsdv))
}

/// Tells whether the mission was driven: not if the machine kept an answer waiting for longer than the VCU does.
fn watched_mission(adsdv: &Path) -> Tried<bool> {
    let vcan = Vcan::new()?;
    let (ours, theirs, scenario) = (log("watch"), log("candump"), log("scenario"));
    fs::write(&scenario, adsdv_can::scenario::Scenario::SAMPLES[0].1)?;
    let recorded = fs::File::create(&theirs)?;
    let candump = Program::start_into(Path::new("candump"), &["-L", &vcan.0], recorded.into()).ok();
    let watch = Program::start(adsdv, &["watch", &vcan.0, "--log", text(&ours)?])?;
    thread::sleep(Duration::from_secs(1));
    let ai = Program::start(adsdv, &["ai", &vcan.0])?;
    let mut vcu = Program::start(adsdv, &["vcu", &vcan.0, "--plain", "--scenario", text(&scenario)?])?;
    let begun = Instant::now();
    while vcu.0.try_wait()?.is_none() && begun.elapsed() < 2 * PATIENCE {
        thread::sleep(Duration::from_millis(50));
    }
    if vcu.0.try_wait()?.is_none() {
        vcu.signal("INT")?;
    }
    let (code, out, error) = vcu.end()?;
    ensure!(code == Some(0) && error.is_empty(), "vcu: {code:?} {error}");
    if out.contains("-> EMERGENCY_BRAKE") && out.contains("AI_COMMS_LOST") {
        return Ok(false);
    }
    for expected in
        ["AS_OFF -> AS_READY", "AS_DRIVING -> AS_FINISHED", "operator: go on", "AI handshake: ", "cycles: "]
    {
        ensure!(out.contains(expected), "vcu does not say {expected:?}:\n{out}");
    }
    ai.signal("TERM")?;
    let (code, out, error) = ai.end()?;
    ensure!(code == Some(0) && out.contains("AS_READY -> AS_DRIVING"), "ai: {code:?} {error}\n{out}");
    watch.signal("INT")?;
    let (code, out, error) = watch.end()?;
    ensure!(code == Some(0) && error.is_empty(), "watch: {code:?} {error}\n{out}");
    let sent = vcan.sent()?;
    for expected in [
        "is watched",
        "TIMELINE",
        &format!("{}: conforms", vcan.0),
        &format!(": {sent} frames"),
        "0 frames dropped",
    ] {
        ensure!(out.contains(expected), "watch does not say {expected:?}:\n{out}");
    }
    // The command prints each transition as it happens, and in the report.
    ensure!(out.matches("AS_READY        -> AS_DRIVING").count() == 2, "{out}");
    ensure!(lines(&ours) == usize::try_from(sent)?, "{} lines for {sent} frames", lines(&ours));
    let mut logs = vec![ours.clone()];
    if let Some(candump) = candump {
        candump.signal("INT")?;
        let (code, _, error) = candump.end()?;
        ensure!(lines(&theirs) == lines(&ours), "candump: {} lines, {code:?} {error}", lines(&theirs));
        logs.push(theirs.clone());
    }
    for log in logs {
        let (code, out, error) = Program::start(adsdv, &["check", text(&log)?])?.end()?;
        ensure!(code == Some(0), "check {}: {code:?} {error}\n{out}", log.display());
    }
    for file in [ours, theirs, scenario] {
        let _ = fs::remove_file(file);
    }
    Ok(true)
}

fn stops() -> Outcome {
    let Some(adsdv) = adsdv() else { return Ok(without()) };
    for signal in ["INT", "TERM"] {
        let vcan = Vcan::new()?;
        let file = log("stops");
        let watch = Program::start(&adsdv, &["watch", &vcan.0, "--json", "--log", text(&file)?])?;
        thread::sleep(Duration::from_secs(1));
        let vcu = Program::start(&adsdv, &["vcu", &vcan.0, "--plain"])?;
        // The log is there while it is recorded.
        wait_until("the log has frames", || lines(&file) > 500)?;
        vcu.signal(signal)?;
        let (code, out, error) = vcu.end()?;
        ensure!(
            code == Some(0) && error.is_empty() && out.contains(" sent, "),
            "vcu: {code:?} {error}\n{out}"
        );
        watch.signal(signal)?;
        let (code, out, error) = watch.end()?;
        ensure!(code == Some(0) && error.is_empty(), "watch: {code:?} {error}\n{out}");
        let sent = vcan.sent()?;
        ensure!(
            out.starts_with("{\"schema\":1,\"edition\":\"3.0\",\"recognised\":{\"certain\":true,")
                && out.contains(&format!("\"frames\":{sent},"))
                && out.ends_with("}\n"),
            "{sent} frames: {out}"
        );
        let text = fs::read_to_string(&file)?;
        ensure!(text.lines().count() == usize::try_from(sent)? && text.ends_with('\n'), "the log is cut off");
        let _ = fs::remove_file(file);
    }
    Ok(Completion::Completed)
}

fn refused() -> Outcome {
    let Some(adsdv) = adsdv() else { return Ok(without()) };
    let vcan = Vcan::new()?;
    for command in ["vcu", "ai", "watch"] {
        let (code, out, error) = Program::start(&adsdv, &[command, "lo"])?.end()?;
        let expected =
            format!("adsdv: lo: is not a CAN interface\nhint: the only CAN interface here is {}\n", vcan.0);
        ensure!(code == Some(2) && out.is_empty() && error == expected, "{command}: {code:?} {out} {error}");
        let (code, out, error) = Program::start(&adsdv, &[command, "adsdv-none"])?.end()?;
        let expected = format!(
            "adsdv: adsdv-none: there is no such interface\nhint: the only CAN interface here is {}\n",
            vcan.0
        );
        ensure!(code == Some(2) && out.is_empty() && error == expected, "{command}: {code:?} {out} {error}");
    }
    let watch = Program::start(&adsdv, &["watch", &vcan.0])?;
    thread::sleep(Duration::from_secs(1));
    watch.signal("INT")?;
    let (code, _, error) = watch.end()?;
    ensure!(code == Some(2) && error.contains("no frame came"), "{code:?} {error}");
    Ok(Completion::Completed)
}

/// A disk without any room, and a file of 4 KiB, which cuts a line: the system refuses to write more.
fn full_disk() -> Outcome {
    let Some(adsdv) = adsdv() else { return Ok(without()) };
    watched_with_a_full_disk(&adsdv, "", Path::new("/dev/full"))?;
    let file = log("full");
    watched_with_a_full_disk(&adsdv, "trap '' XFSZ; ulimit -f 8; ", &file)?;
    let written = fs::read_to_string(&file)?;
    ensure!(written.len() == 8 * 512 && !written.ends_with('\n'), "{} bytes", written.len());
    let whole = written.matches('\n').count();
    let (code, out, error) = Program::start(&adsdv, &["check", text(&file)?])?.end()?;
    ensure!(out.contains(&format!(": {whole} frames")), "{code:?} {out} {error}");
    let _ = fs::remove_file(file);
    Ok(Completion::Completed)
}

/// The command says so when it happens and at the end, and watching goes on.
fn watched_with_a_full_disk(adsdv: &Path, limit: &str, log: &Path) -> Tried {
    let vcan = Vcan::new()?;
    let command = format!("{limit}exec \"$0\" \"$@\"");
    let words = ["-c", &command, text(adsdv)?, "watch", &vcan.0, "--log", text(log)?];
    let watch = Program::start(Path::new("sh"), &words)?;
    thread::sleep(Duration::from_secs(1));
    let other = vcan.other()?;
    for number in 0..200_u8 {
        other.send_standard(0x520, &[0, 0, 1, 0, 0, 0, 0, number])?;
        thread::sleep(Duration::from_millis(10));
    }
    watch.signal("INT")?;
    let (code, out, error) = watch.end()?;
    ensure!(code == Some(2) && out.contains(": 200 frames"), "{code:?} {out}");
    let expected = format!("{}: cannot record the log: ", log.display());
    ensure!(error.matches(&expected).count() == 2 && error.contains("hint: "), "{error}");
    Ok(())
}

fn full_disk_for_output() -> Outcome {
    let Some(adsdv) = adsdv() else { return Ok(without()) };
    let vcan = Vcan::new()?;
    for command in [&["vcu", "--plain"][..], &["ai"], &["watch"]] {
        let full = fs::OpenOptions::new().write(true).open("/dev/full")?;
        let words = [command, &[vcan.0.as_str()]].concat();
        let (code, _, error) = Program::start_into(&adsdv, &words, full.into())?.end()?;
        ensure!(
            code == Some(2) && error.contains("adsdv: standard output: cannot write the answer: "),
            "{command:?}: {code:?} {error}"
        );
        ensure!(error.contains("\nhint: free some space"), "{command:?}: {error}");
    }
    Ok(Completion::Completed)
}

fn no_log() -> Outcome {
    let Some(adsdv) = adsdv() else { return Ok(without()) };
    let vcan = Vcan::new()?;
    let folder = env::temp_dir();
    for (log, hint) in
        [("no-such-folder/run.log", "make the directory first"), (text(&folder)?, "name a file")]
    {
        let (code, out, error) = Program::start(&adsdv, &["watch", &vcan.0, "--log", log])?.end()?;
        let expected = format!("adsdv: {log}: cannot record the log: ");
        ensure!(code == Some(2) && out.is_empty() && error.starts_with(&expected), "{code:?} {out} {error}");
        ensure!(error.contains(&format!("\nhint: {hint}")), "{error}");
    }
    Ok(Completion::Completed)
}

/// All three are there when it goes; they say so, wait, and go on when it is back. What was recorded is whole, and nobody is
/// blamed for what could not be heard.
fn vanishes() -> Outcome {
    let Some(adsdv) = adsdv() else { return Ok(without()) };
    undisturbed("command::vanishes", || watched_while_it_vanishes(&adsdv))
}

/// Tells whether the AI Computer was in time throughout: not if the machine kept an answer waiting for longer than the VCU does.
fn watched_while_it_vanishes(adsdv: &Path) -> Tried<bool> {
    let vcan = Vcan::new()?;
    let file = log("vanishes");
    let watch = Program::start(adsdv, &["watch", &vcan.0, "--log", text(&file)?])?;
    thread::sleep(Duration::from_secs(1));
    let ai = Program::start(adsdv, &["ai", &vcan.0])?;
    let vcu = Program::start(adsdv, &["vcu", &vcan.0, "--plain"])?;
    wait_until("the log has frames", || lines(&file) > 500)?;
    vcan.delete()?;
    thread::sleep(Duration::from_secs(1));
    let before = lines(&file);
    vcan.add()?;
    vcan.set("up")?;
    wait_until("the log has frames again", || lines(&file) > before + 500)?;
    let mut missed = false;
    for (name, program) in [("vcu", vcu), ("ai", ai), ("watch", watch)] {
        program.signal("INT")?;
        let (code, out, error) = program.end()?;
        ensure!(error.is_empty() && matches!(code, Some(0 | 1)), "{name}: {code:?} {error}\n{out}");
        for expected in ["the interface is ", "the bus is there again"] {
            ensure!(out.contains(expected), "{name} does not say {expected:?}:\n{out}");
        }
        if name == "watch" {
            let frames = lines(&file);
            ensure!(out.contains(&format!(": {frames} frames in ")), "{frames} lines:\n{out}");
            missed = code != Some(0);
            ensure!(!missed || out.contains("handshake-late"), "{code:?}\n{out}");
        } else {
            ensure!(code == Some(0), "{name}: {code:?}\n{out}");
        }
    }
    let (code, out, error) = Program::start(adsdv, &["check", text(&file)?])?.end()?;
    ensure!(missed || code == Some(0), "check: {code:?} {error}\n{out}");
    let _ = fs::remove_file(file);
    Ok(!missed)
}

/// The reader leaves after the first two lines; each command notices with the next that it has to tell.
fn closed_pipe() -> Outcome {
    let Some(adsdv) = adsdv() else { return Ok(without()) };
    let file = log("closed");
    for command in [&["vcu", "--plain"][..], &["ai"], &["watch", "--log", text(&file)?]] {
        let vcan = Vcan::new()?;
        let mut program = Program::start(&adsdv, &[command, &[vcan.0.as_str()]].concat())?;
        let (mut edition, mut line) = (String::new(), String::new());
        let mut out = BufReader::new(program.0.stdout.take().ok_or("no output")?);
        out.read_line(&mut edition)?;
        ensure!(edition.starts_with("edition "), "{edition:?}");
        out.read_line(&mut line)?;
        drop(out);
        ensure!(line.contains(&vcan.0), "{line:?}");
        let other = vcan.other()?;
        for _ in 0..100 {
            other.send_standard(0x520, &[0, 0, 1, 0, 0, 0, 0, 0])?;
        }
        vcan.set("down")?;
        let (code, _, error) = program.end()?;
        ensure!(code == Some(0) && error.is_empty(), "{command:?}: {code:?} {error}");
    }
    let recorded = fs::read_to_string(&file)?;
    ensure!(recorded.lines().count() == 100 && recorded.ends_with('\n'), "{recorded}");
    let _ = fs::remove_file(file);
    Ok(Completion::Completed)
}
