//! `adsdv completions` and `adsdv man`.

use crate::run::run;

/// The commands that the overview names.
fn commands() -> Vec<String> {
    let overview = run(&["--help"]).stdout;
    let lines = overview.lines().skip_while(|line| *line != "Commands:").skip(1);
    let named = lines.map_while(|line| line.strip_prefix("  ")).filter(|line| !line.starts_with(' '));
    named.filter_map(|line| line.split_whitespace().next().map(str::to_owned)).collect()
}

#[test]
fn every_command_has_a_page_with_all_that_its_help_has() {
    let commands = commands();
    assert!(commands.len() > 15, "{commands:?}");
    for command in commands.iter().filter(|command| *command != "help") {
        let (page, help) = (run(&["man", command]), run(&[command, "--help"]).stdout);
        assert_eq!((page.status, page.stderr.as_str()), (Some(0), ""), "{command}");
        assert!(page.stdout.contains(&format!("\n.TH ADSDV-{} 1 ", command.to_uppercase())), "{command}");
        for heading in ["NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXAMPLES", "\"EXIT STATUS\""] {
            assert!(page.stdout.contains(&format!("\n.SH {heading}\n")), "{command} lacks {heading}");
        }
        let text = page.stdout.replace('\\', "");
        let options = help.split_whitespace().filter(|word| word.starts_with("--"));
        for option in options.map(|word| word.trim_matches(|c: char| !c.is_ascii_alphanumeric() && c != '-'))
        {
            assert!(text.contains(option), "{command} lacks {option}");
        }
    }
}

#[test]
fn the_page_of_adsdv_itself_names_every_command() {
    let page = run(&["man"]).stdout;
    for command in commands() {
        assert!(page.contains(&format!("adsdv\\-{command}(1)")), "{command} is missing");
    }
}

#[test]
fn a_page_of_no_command_is_refused_with_the_commands_that_there_are() {
    let refused = run(&["man", "judge"]);
    assert_eq!((refused.status, refused.stdout.as_str()), (Some(2), ""));
    assert!(
        refused.stderr.starts_with("adsdv: judge: no such command; expected one of ai, check, "),
        "{refused:?}"
    );
    assert!(refused.stderr.contains("\nhint: adsdv man, without a command"), "{refused:?}");
}

#[test]
fn each_shell_completes_every_command() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = run(&["completions", shell]);
        assert_eq!(script.status, Some(0), "{shell}");
        for command in commands() {
            assert!(script.stdout.contains(&command), "{shell} does not know {command}");
        }
        assert!(script.stdout.contains("excerpt"), "{shell} does not know --excerpt");
    }
}
