//! Escapes are for terminals, or for those who ask.

use crate::run::{FINISHED_WHILE_MOVING, MISSION, adsdv, outcome, run};

const ESCAPE: char = '\x1b';

#[test]
fn a_pipe_gets_no_escapes() {
    for args in [
        &["check", FINISHED_WHILE_MOVING][..],
        &["compare", MISSION, FINISHED_WHILE_MOVING],
        &["readings"],
        &["--help"],
        &["check", "no-such.log"],
    ] {
        let outcome = run(args);
        assert!(!outcome.stdout.contains(ESCAPE) && !outcome.stderr.contains(ESCAPE), "{args:?}");
    }
    let forced = outcome(adsdv(&["check", FINISHED_WHILE_MOVING]).env("CLICOLOR_FORCE", "1"));
    assert!(!forced.stdout.contains(ESCAPE));
}

#[test]
fn always_means_always_and_the_words_stay_the_same() {
    let plain = run(&["check", FINISHED_WHILE_MOVING]).stdout;
    let mut command = adsdv(&["check", "--color", "always", FINISHED_WHILE_MOVING]);
    let colored = outcome(command.env("NO_COLOR", "1")).stdout;
    assert!(colored.contains("\x1b[1m\x1b[31mviolation\x1b[0m"), "{colored}");
    let mut stripped = String::new();
    for (index, part) in colored.split(ESCAPE).enumerate() {
        // Every escape of the report ends with its first m.
        stripped.push_str(if index == 0 { part } else { part.split_once('m').expect("an end").1 });
    }
    assert_eq!(stripped, plain);
}

#[test]
fn never_means_never() {
    let report = run(&["check", "--color", "never", FINISHED_WHILE_MOVING]).stdout;
    assert!(report.contains("violation") && !report.contains(ESCAPE));
}

#[test]
fn json_is_never_colored() {
    let json = run(&["check", "--json", "--color", "always", FINISHED_WHILE_MOVING]).stdout;
    assert!(json.starts_with('{') && !json.contains(ESCAPE));
}

/// With `script` of util-linux the command writes to a terminal.
#[cfg(target_os = "linux")]
#[test]
fn a_terminal_gets_escapes_unless_no_color_is_set() {
    use std::process::{Command, Stdio};

    let on_terminal = |no_color: &str| {
        let line = format!("{} check {FINISHED_WHILE_MOVING}", env!("CARGO_BIN_EXE_adsdv"));
        let mut script = Command::new("script");
        script.args(["-qec", &line, "/dev/null"]).current_dir(crate::run::workspace());
        script.env("TERM", "xterm").env_remove("CLICOLOR").env("NO_COLOR", no_color);
        script
            .stdin(Stdio::null())
            .output()
            .ok()
            .map(|output| String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let Some(colored) = on_terminal("") else { return }; // There is no script on this machine.
    assert!(colored.contains("TIMELINE") && colored.contains(ESCAPE), "{colored}");
    let plain = on_terminal("1").expect("script ran before");
    assert!(plain.contains("TIMELINE") && !plain.contains(ESCAPE), "{plain}");
}
