//! The help texts, which stand for a manual page.

use crate::run::{run, temporary};

const COMMANDS: [&str; 21] = [
    "ai",
    "check",
    "compare",
    "completions",
    "conform",
    "dbc",
    "decode",
    "demo",
    "diagram",
    "diff",
    "exam",
    "explore",
    "export",
    "man",
    "readings",
    "schema",
    "suite",
    "vcu",
    "verify",
    "watch",
    "web",
];

#[test]
fn every_help_text_has_examples_and_exit_status() {
    let pages = COMMANDS.map(|command| vec![command, "--help"]).into_iter().chain([vec!["--help"]]);
    for args in pages {
        let help = run(&args);
        assert_eq!(help.status, Some(0), "{args:?}");
        for heading in ["\nEXAMPLES\n", "\nEXIT STATUS\n", "Usage: adsdv"] {
            assert!(help.stdout.contains(heading), "{args:?} lacks {heading:?}");
        }
        assert_eq!(help.stderr, "", "{args:?}");
        for line in help.stdout.lines() {
            assert!(line.chars().count() <= 100, "{args:?} has a long line: {line}");
        }
    }
}

#[test]
fn the_overview_names_every_command() {
    let help = run(&["--help"]).stdout;
    let commands = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let named: Vec<_> = commands
        .map_while(|line| line.strip_prefix("  "))
        .filter(|line| !line.starts_with(' '))
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    let mut expected = COMMANDS.to_vec();
    expected.push("help");
    for command in &expected {
        assert!(named.contains(command), "{command} is missing: {named:?}");
    }
    assert_eq!(named.len(), expected.len(), "{named:?}");
}

#[test]
fn the_examples_of_check_are_valid_arguments() {
    let help = run(&["check", "--help"]).stdout;
    let rules = temporary("help-team.rules", b"calm: always ASMS off");
    let rules = rules.to_str().expect("a path of text");
    let mut tried = 0;
    for example in help.lines().filter_map(|line| line.trim().strip_prefix("adsdv check ")) {
        let arguments = example.split(['|', '>']).next().unwrap_or_default().replace("team.rules", rules);
        let args: Vec<&str> = ["check"].into_iter().chain(arguments.split_whitespace()).collect();
        let outcome = run(&args);
        // There is no such log; a pattern matches none.
        let missing = ["cannot open the log: ", "nothing matches"];
        assert!(missing.iter().any(|words| outcome.stderr.contains(words)), "{example}: {outcome:?}");
        tried += 1;
    }
    assert!(tried >= 4, "{help}");
}

#[test]
fn defaults_are_shown() {
    let help = run(&["check", "--help"]).stdout;
    assert!(help.contains("[default: 30]") && help.contains("[default: 50]"), "{help}");
}

#[test]
fn the_default_of_the_edition_is_what_the_command_does() {
    let words = |command| {
        let help = run(&[command, "--help"]).stdout;
        help.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    for recognises in ["check", "compare", "decode", "watch"] {
        let help = words(recognises);
        assert!(
            help.contains("ADSDV_EDITION says, or the one that the frames tell]"),
            "{recognises}: {help}"
        );
    }
    for command in ["ai", "conform", "demo", "exam", "vcu"] {
        assert!(words(command).contains("[default: what ADSDV_EDITION says, or 3.0]"), "{command}");
    }
}

#[test]
fn version_and_no_arguments() {
    let version = run(&["--version"]);
    assert_eq!((version.status, version.stdout.as_str()), (Some(0), "adsdv 0.1.0\n"));
    let nothing = run(&[]);
    assert_eq!((nothing.status, nothing.stdout.as_str()), (Some(2), ""));
    assert!(nothing.stderr.contains("Usage: adsdv <COMMAND>"), "{}", nothing.stderr);
}
