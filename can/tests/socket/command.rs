//! The command itself, named by `ADSDV`, on a bus of the kernel's: told to stop, it ends in order.

use std::env;
use std::fs;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use libtest_mimic::Completion;

use super::vcan::{Outcome, PATIENCE, Test, Tried, Vcan, ensure, undisturbed, wait_until};

pub(crate) const TESTS: &[Test] = &[
    ("command::a_mission_is_watched_and_recorded_and_the_logs_conform", mission),
    ("command::told_to_stop_each_ends_in_order", stops),
    ("command::what_cannot_be_opened_is_told", refused),
    ("command::a_full_disk_is_told_and_watching_goes_on", full_disk),
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
    for told in
        ["AS_OFF -> AS_READY", "AS_DRIVING -> AS_FINISHED", "operator: go on", "AI handshake: ", "cycles: "]
    {
        ensure!(out.contains(told), "vcu does not say {told:?}:\n{out}");
    }
    ai.signal("TERM")?;
    let (code, out, error) = ai.end()?;
    ensure!(code == Some(0) && out.contains("AS_READY -> AS_DRIVING"), "ai: {code:?} {error}\n{out}");
    watch.signal("INT")?;
    let (code, out, error) = watch.end()?;
    ensure!(code == Some(0) && error.is_empty(), "watch: {code:?} {error}\n{out}");
    let sent = vcan.sent()?;
    for told in [
        "is watched",
        "TIMELINE",
        &format!("{}: conforms", vcan.0),
        &format!(": {sent} frames"),
        "0 frames dropped",
    ] {
        ensure!(out.contains(told), "watch does not say {told:?}:\n{out}");
    }
    // Each transition is told as it happens, and in the report.
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
            out.starts_with(&format!("{{\"frames\":{sent},")) && out.ends_with("}\n"),
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
        let told =
            format!("adsdv: lo: is not a CAN interface\nhint: the only CAN interface here is {}\n", vcan.0);
        ensure!(code == Some(2) && out.is_empty() && error == told, "{command}: {code:?} {out} {error}");
    }
    let watch = Program::start(&adsdv, &["watch", &vcan.0])?;
    thread::sleep(Duration::from_secs(1));
    watch.signal("INT")?;
    let (code, _, error) = watch.end()?;
    ensure!(code == Some(2) && error.contains("no frame came"), "{code:?} {error}");
    Ok(Completion::Completed)
}

fn full_disk() -> Outcome {
    let Some(adsdv) = adsdv() else { return Ok(without()) };
    let vcan = Vcan::new()?;
    let watch = Program::start(&adsdv, &["watch", &vcan.0, "--log", "/dev/full"])?;
    thread::sleep(Duration::from_secs(1));
    let other = vcan.other()?;
    for number in 0..100_u8 {
        other.send_standard(0x520, &[0, 0, 1, 0, 0, 0, 0, number])?;
        thread::sleep(Duration::from_millis(10));
    }
    watch.signal("INT")?;
    let (code, out, error) = watch.end()?;
    ensure!(code == Some(2) && out.contains(": 100 frames"), "{code:?} {out}");
    ensure!(error.contains("/dev/full: cannot record the log: ") && error.contains("hint: free"), "{error}");
    Ok(Completion::Completed)
}
