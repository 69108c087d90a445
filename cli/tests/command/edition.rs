//! `--edition` and `ADSDV_EDITION`: who asks for which edition gets it, and every answer says which it is about.

use adsdv_spec::Edition;
use serde_json::{Value, json};

use crate::run::{FINISHED_WHILE_MOVING, MISSION, Outcome, adsdv, outcome, run};
use crate::schema::validator;

const VARIABLE: &str = "ADSDV_EDITION";

/// Commands that depend on the edition and end by themselves, but for `verify`, which takes its time, and how the first line of each begins.
const TEXT: &[(&[&str], &str)] = &[
    (&["check", MISSION], "edition "),
    (&["check", FINISHED_WHILE_MOVING], "edition "),
    (&["demo"], "edition "),
    (&["dbc"], "VERSION \""),
    (&["diagram"], "%% edition "),
    (&["diagram", "--format", "dot"], "// edition "),
    (&["diagram", "--format", "markdown"], "<!-- edition "),
    (&["export", "--format", "promela"], "/* edition "),
    (&["readings"], "edition "),
    (&["suite", "--prove"], "edition "),
];

/// Those that print JSON, with the name of its schema.
const JSON: &[(&[&str], &str)] = &[
    (&["check", "--json", MISSION], "check"),
    (&["demo", "--json"], "check"),
    (&["readings", "--json"], "readings"),
    (&["suite"], "suite"),
    (&["suite", "--prove", "--json"], "prove"),
];

/// How the line of a recording goes on: both have the lengths of version 4.0.
const RECOGNISED: &str = "4.0 (recognised: ";

fn versions() -> Vec<&'static str> {
    Edition::ALL.iter().map(|edition| edition.version).collect()
}

fn asked(args: &[&str], environment: &str) -> Outcome {
    outcome(adsdv(args).env(VARIABLE, environment))
}

/// How the line goes on where nobody asked for an edition.
fn default_line() -> String {
    let newest = Edition::ALL.last().expect("an edition").version;
    match Edition::DEFAULT.version {
        version if version == newest => format!("{version} (default)"),
        version => format!("{version} (default; --edition {newest} for today's car)"),
    }
}

#[test]
fn the_first_line_says_the_default_or_what_was_recognised() {
    for (args, begins) in TEXT {
        let printed = run(args);
        assert_eq!(printed.stderr, "", "{args:?}");
        let line = printed.stdout.lines().next().unwrap_or_default();
        let said = line.strip_prefix(begins).unwrap_or_else(|| panic!("{args:?}: {line}"));
        let expected = match args[0] {
            "check" => RECOGNISED.to_owned(),
            "dbc" => Edition::DEFAULT.version.to_owned(),
            _ => default_line(),
        };
        assert!(said.starts_with(&expected), "{args:?}: {line}");
    }
}

#[test]
fn the_first_line_says_the_edition_that_was_asked_for() {
    for version in versions() {
        for (args, begins) in TEXT {
            let line = |printed: Outcome| printed.stdout.lines().next().unwrap_or_default().to_owned();
            let by_option = line(run(&[args, &["--edition", version][..]].concat()));
            let said = by_option.strip_prefix(begins).unwrap_or_else(|| panic!("{args:?}: {by_option}"));
            assert!(said.starts_with(version) && !said.contains("default"), "{args:?}: {by_option}");
            assert_eq!(line(asked(args, version)), by_option, "{args:?}: {VARIABLE} asks for the same");
        }
    }
}

#[test]
fn json_begins_with_the_number_of_its_form_and_the_edition() {
    for (args, schema) in JSON {
        for version in versions() {
            let printed = run(&[args, &["--edition", version][..]].concat());
            let line = printed.stdout.lines().next().unwrap_or_default();
            let begins = format!("{{\"schema\":1,\"edition\":\"{version}\",");
            assert!(line.starts_with(&begins), "{args:?}: {}", line.get(..80).unwrap_or(line));
            let object: Value = serde_json::from_str(line).expect("JSON");
            let errors: Vec<_> =
                validator(schema).iter_errors(&object).map(|error| error.to_string()).collect();
            assert!(errors.is_empty(), "{args:?}: {errors:#?}");
        }
        let expected = if args[0] == "check" { "4.0" } else { Edition::DEFAULT.version };
        assert!(run(args).stdout.contains(&format!("\"edition\":\"{expected}\"")), "{args:?}");
    }
}

/// A schema that another form has, or no edition, is refused.
#[test]
fn the_schemas_ask_for_both_keys() {
    for (args, schema) in JSON {
        let printed = run(args).stdout;
        let good: Value = serde_json::from_str(printed.lines().next().expect("a line")).expect("JSON");
        let validator = validator(schema);
        assert!(validator.is_valid(&good));
        for (key, other) in [("schema", json!(2)), ("edition", json!(3.0)), ("edition", json!(""))] {
            let mut bad = good.clone();
            bad[key] = other;
            assert!(!validator.is_valid(&bad), "{schema}: {key}");
            bad.as_object_mut().expect("an object").remove(key);
            assert!(!validator.is_valid(&bad), "{schema}: no {key}");
        }
    }
}

/// Those that need a bus, a browser or a program, or take their time.
const OTHERS: &[&[&str]] = &[
    &["ai", "none0"],
    &["vcu", "none0"],
    &["vcu", "none0", "--plain", "--scenario", "mission"],
    &["watch", "none0"],
    &["watch", "none0", "--json"],
    &["demo", "--screen"],
    &["compare", "none.log", "none.log"],
    &["decode", "none.log"],
    &["explore"],
    &["conform", "--", "none"],
    &["exam", "--stdio", "--", "none"],
    &["verify"],
    &["verify", "--readings"],
];

/// Every command that depends on the edition, once at least.
fn asked_for_an_edition() -> impl Iterator<Item = &'static [&'static str]> {
    let printing = TEXT.iter().map(|(args, _)| *args).chain(JSON.iter().map(|(args, _)| *args));
    printing.chain(OTHERS.iter().copied())
}

#[test]
fn no_command_that_depends_on_the_edition_is_left_out_here() {
    let overview = run(&["--help"]).stdout;
    let commands = overview.lines().skip_while(|line| *line != "Commands:").skip(1);
    let names = commands.map_while(|line| line.strip_prefix("  "));
    let names = names.filter(|line| !line.starts_with(' ')).filter_map(|line| line.split_whitespace().next());
    let mut depending = 0;
    for name in names.filter(|name| *name != "help") {
        let depends = run(&[name, "--help"]).stdout.contains("--edition <VERSION>");
        assert_eq!(asked_for_an_edition().any(|args| args[0] == name), depends, "{name}");
        depending += u32::from(depends);
    }
    assert!(depending > 10, "{overview}");
}

/// A file that is there is not lost for an edition that is not.
#[test]
fn a_log_is_not_touched_where_the_edition_is_unknown() {
    let log = std::env::temp_dir().join(format!("adsdv-edition-{}.log", std::process::id()));
    std::fs::write(&log, "of before").expect("it is written");
    let refused = asked(&["demo", "--log", log.to_str().expect("a name")], "9.9");
    let left = std::fs::read_to_string(&log).expect("it is there");
    std::fs::remove_file(&log).expect("it is there");
    assert_eq!((refused.status, left.as_str()), (Some(2), "of before"));
}

#[test]
fn an_unknown_edition_is_refused_with_those_that_there_are() {
    for args in asked_for_an_edition() {
        for given in ["9.9", "4", "", "v3.0", "3.0 "] {
            let (command, rest) = args.split_first().expect("a command");
            let refused = run(&[&[*command, "--edition", given], rest].concat());
            assert_eq!((refused.status, refused.stdout.as_str()), (Some(2), ""), "{args:?}");
            assert!(refused.stderr.contains("--edition <VERSION>"), "{}", refused.stderr);
            for version in versions() {
                assert!(refused.stderr.contains(version), "{args:?}: {}", refused.stderr);
            }
        }
        let refused = asked(args, "9.9\x1b[2J");
        assert_eq!((refused.status, refused.stdout.as_str()), (Some(2), ""), "{args:?}");
        let said = format!(
            "adsdv: ADSDV_EDITION: there is no edition \"9.9\\u{{1b}}[2J\"; expected one of {}\nhint: set ADSDV_EDITION",
            versions().join(", ")
        );
        assert!(refused.stderr.starts_with(&said), "{args:?}: {}", refused.stderr);
    }
}

/// The option counts before the environment, even where that has no edition at all.
#[test]
fn the_option_counts_before_the_environment_and_that_before_the_default() {
    for version in versions() {
        let line = |printed: Outcome| printed.stdout.lines().next().unwrap_or_default().to_owned();
        let both = asked(&["readings", "--edition", version], "9.9");
        assert_eq!((both.status, both.stderr.as_str()), (Some(0), ""));
        assert_eq!(line(both), format!("edition {version}"));
        for other in versions() {
            let both = asked(&["readings", "--edition", version], other);
            assert_eq!(line(both), format!("edition {version}"));
        }
        assert_eq!(line(asked(&["readings"], version)), format!("edition {version}"));
    }
    let unset = asked(&["readings"], "");
    assert_eq!((unset.status, unset.stdout), (Some(0), run(&["readings"]).stdout));
}

/// What is the same in every edition asks nobody for one.
#[test]
fn a_schema_needs_no_edition() {
    assert_eq!(asked(&["schema"], "9.9").stdout, run(&["schema"]).stdout);
    assert_eq!(run(&["schema", "--edition", Edition::DEFAULT.version]).status, Some(2));
}

#[test]
fn the_help_of_every_command_that_depends_on_it_has_the_option_and_its_values() {
    for command in [
        "ai", "check", "compare", "conform", "dbc", "demo", "diagram", "exam", "explore", "export",
        "readings", "suite", "vcu", "verify", "watch",
    ] {
        let help = run(&[command, "--help"]).stdout;
        let values = format!("[possible values: {}]", versions().join(", "));
        let words = help.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains("--edition <VERSION>") && words.contains(&values), "{command}: {help}");
        assert!(help.contains("\n  ADSDV_EDITION  "), "{command}: {help}");
    }
}

/// The database of 2026 dropped 120h, and nothing that is judged needs it.
#[test]
fn a_message_that_is_absent_is_one_note_however_the_edition_was_chosen() {
    for (options, notes) in [(&[][..], 1), (&["--edition", "4.0"], 1), (&["--edition", "2026"], 0)] {
        let report = run(&[&["check", "--json", MISSION], options].concat()).stdout;
        let report: Value = serde_json::from_str(&report).expect("JSON");
        let findings = report["findings"].as_array().expect("an array");
        let text = |one: &&Value| one["seen"].as_str().is_some_and(|seen| seen.contains("120h"));
        assert_eq!(findings.iter().filter(text).count(), notes, "{options:?}: {findings:#?}");
    }
}
