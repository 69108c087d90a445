//! `adsdv demo --screen` on a terminal, which `script` of util-linux makes.

use std::io::{Read as _, Write as _};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::thread;
use std::time::{Duration, Instant};

/// The command.
pub(crate) const SCREEN: &str = concat!(env!("CARGO_BIN_EXE_adsdv"), " demo --screen");

/// Longer than the screen takes to show anything.
pub(crate) const PATIENCE: Duration = Duration::from_secs(30);

/// What a terminal receives when a screen begins, and when it is given back.
const BEGIN: &str = "\x1b[?1049h";
const END: &str = "\x1b[?1049l";

/// Ctrl-L.
const REDRAW: &str = "\x0c";

/// The command on its terminal. It is stopped when this is dropped, so also when a test fails.
pub(crate) struct Terminal {
    child: Child,
    keyboard: ChildStdin,
    news: Receiver<Vec<u8>>,
    shown: String,
}

impl Terminal {
    /// Runs this line of a shell; `None`: there is no `script` on this machine.
    pub(crate) fn new(line: &str) -> Option<Self> {
        let line = format!("stty rows 40 cols 100; {line}");
        let mut script = Command::new("script");
        script.args(["-qec", &line, "/dev/null"]).env("TERM", "xterm").env_remove("NO_COLOR");
        let mut child = script.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().ok()?;
        let (keyboard, mut stdout) = child.stdin.take().zip(child.stdout.take()).expect("two pipes");
        let (sender, news) = mpsc::channel();
        thread::spawn(move || {
            let mut bytes = [0; 4096];
            while let Ok(count @ 1..) = stdout.read(&mut bytes) {
                if sender.send(bytes[..count].to_vec()).is_err() {
                    return;
                }
            }
        });
        Some(Self { child, keyboard, news, shown: String::new() })
    }

    fn press(&mut self, keys: &str) {
        self.keyboard.write_all(keys.as_bytes()).expect("it reads");
        self.keyboard.flush().expect("it reads");
    }

    /// Waits until this is shown, and takes all that was shown until then.
    pub(crate) fn shows(&mut self, text: &str) -> String {
        let late = Instant::now() + PATIENCE;
        loop {
            if let Some(at) = self.shown.find(text) {
                let rest = self.shown.split_off(at + text.len());
                return std::mem::replace(&mut self.shown, rest);
            }
            let patience = late.saturating_duration_since(Instant::now());
            let news = self.news.recv_timeout(patience);
            let news = news.unwrap_or_else(|end| panic!("{text:?} is not shown ({end}): {:?}", self.shown));
            self.shown += &String::from_utf8_lossy(&news);
        }
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn a_screen_follows_the_keys_and_gives_the_terminal_back() {
    let Some(mut terminal) = Terminal::new(&format!("exec {SCREEN}")) else { return };
    terminal.shows(BEGIN);
    // Words without spaces: what is blank already is not drawn.
    terminal.shows("happened");
    // Drawn anew, all of it.
    terminal.press(REDRAW);
    terminal.shows("happened");
    // Mission, ASMS, TSMS and EBS.
    terminal.press("mate");
    terminal.shows("(3.1):");
    terminal.press("?");
    terminal.shows("PgUp");
    terminal.press("q");
    let last = terminal.shows(END);
    assert!(!last.contains("panicked"), "{last}");
    assert_eq!(terminal.child.wait().expect("it ends").code(), Some(0));
}
