//! `adsdv diff`: what one edition changes of another, for people and for programs.

use adsdv_spec::{AsState, Edition};
use serde_json::{Value, json};

use crate::golden::compare_text;
use crate::run::{Outcome, adsdv, outcome, run};
use crate::schema::{Spoil, validator};

/// The pairs of editions, each with itself as well.
fn pairs() -> impl Iterator<Item = [&'static str; 2]> {
    Edition::ALL.iter().flat_map(|from| Edition::ALL.iter().map(move |to| [from.version, to.version]))
}

fn printed(options: &[&str]) -> String {
    let Outcome { status, stdout, stderr } = run(&[&["diff"], options].concat());
    assert_eq!((status, stderr.as_str()), (Some(0), ""), "{options:?}");
    stdout
}

#[test]
fn as_text() {
    compare_text("diff-3.0-4.0.txt", &printed(&["3.0", "4.0"]));
    compare_text("diff-4.0-2026.txt", &printed(&["4.0", "2026"]));
}

#[test]
fn as_markdown() {
    compare_text("diff-3.0-4.0.md", &printed(&["3.0", "4.0", "--markdown"]));
}

#[test]
fn the_first_line_names_both_editions() {
    for [from, to] in pairs() {
        let first = |text: String| text.lines().next().unwrap_or_default().to_owned();
        assert_eq!(first(printed(&[from, to])), format!("edition {from} -> edition {to}"));
        assert_eq!(first(printed(&[from, to, "--markdown"])), format!("# Edition {from} to edition {to}"));
    }
}

#[test]
fn an_edition_and_itself_do_not_differ() {
    for edition in Edition::ALL {
        let version = edition.version;
        let text = printed(&[version, version]);
        assert_eq!(text, format!("edition {version} -> edition {version}\n\nnothing differs\n"));
    }
}

#[test]
fn json_keeps_to_its_schema() {
    let validator = validator("diff");
    for [from, to] in pairs() {
        let line = printed(&[from, to, "--json"]);
        assert_eq!(line.lines().count(), 1, "one object on one line");
        assert!(line.starts_with(&format!("{{\"schema\":1,\"from\":\"{from}\",\"to\":\"{to}\",")), "{line}");
        let difference: Value = serde_json::from_str(&line).expect("JSON");
        let errors: Vec<_> = validator.iter_errors(&difference).map(|error| error.to_string()).collect();
        assert!(errors.is_empty(), "{from} and {to}: {errors:#?}");
        assert_eq!(difference["differs"], from != to);
    }
}

#[test]
fn the_schema_refuses_what_is_not_a_difference() {
    let good: Value = serde_json::from_str(&printed(&["3.0", "4.0", "--json"])).expect("JSON");
    let validator = validator("diff");
    assert!(validator.is_valid(&good));
    let spoil: [Spoil; 10] = [
        ("another key", |d| d["extra"] = json!(1)),
        ("another number of the form", |d| d["schema"] = json!(2)),
        ("no edition", |d| d["from"] = json!("")),
        ("a missing part", |d| _ = d.as_object_mut().map(|d| d.remove("causes"))),
        ("a message without signals", |d| {
            _ = d["messages"]["new"][0].as_object_mut().map(|message| message.remove("signals"));
        }),
        ("another property", |d| {
            d["messages"]["changed"][0]["signals"]["changed"][0]["changes"][0]["property"] = json!("color");
        }),
        ("a name that is none", |d| {
            d["messages"]["changed"][0]["signals"]["changed"][0]["changes"][0]["from"] = json!(7);
        }),
        ("a time that is none", |d| d["timing"][0]["to"] = json!("100 ms")),
        ("a state that is none", |d| d["arrows"]["changed"][0]["state"] = json!("AS_PARKED")),
        ("an identifier that is none", |d| d["reserved"]["new"][0]["first"] = json!(4096)),
    ];
    for (what, spoil) in spoil {
        let mut difference = good.clone();
        spoil(&mut difference);
        assert_ne!(difference, good, "{what}");
        assert!(!validator.is_valid(&difference), "{what} is accepted");
    }
}

#[test]
fn the_schema_names_every_state() {
    let schema: Value = serde_json::from_str(&run(&["schema", "diff"]).stdout).expect("JSON");
    let states: Vec<_> = AsState::ALL.iter().map(|state| state.name()).collect();
    assert_eq!(schema["$defs"]["state"]["enum"], json!(states));
}

#[test]
fn an_unknown_edition_is_refused_with_those_that_there_are() {
    for args in [["9.9", "4.0"], ["3.0", "9.9"], ["", "4.0"], ["3.0", "v4.0"]] {
        let refused = run(&["diff", args[0], args[1]]);
        assert_eq!((refused.status, refused.stdout.as_str()), (Some(2), ""), "{args:?}");
        for edition in Edition::ALL {
            assert!(refused.stderr.contains(edition.version), "{args:?}: {}", refused.stderr);
        }
    }
    for args in [&["diff"][..], &["diff", "3.0"], &["diff", "3.0", "4.0", "3.0"]] {
        assert_eq!(run(args).status, Some(2), "{args:?}");
    }
    let both = run(&["diff", "3.0", "4.0", "--json", "--markdown"]);
    assert!(both.status == Some(2) && both.stderr.contains("cannot be used with"), "{}", both.stderr);
}

/// Where both editions are named the environment is not asked.
#[test]
fn the_environment_does_not_count() {
    let asked = outcome(adsdv(&["diff", "3.0", "4.0"]).env("ADSDV_EDITION", "9.9"));
    assert_eq!((asked.status, asked.stdout), (Some(0), printed(&["3.0", "4.0"])));
}

#[test]
fn color_is_for_the_text_and_only_if_it_is_asked_for() {
    let always = ["--color", "always", "3.0", "4.0"];
    let colored = printed(&always);
    assert!(colored.contains("\x1b[1mMESSAGES\x1b[0m"), "{colored}");
    assert!(colored.contains("\x1b[1m\x1b[32mnew:\x1b[0m bit 50"), "{colored}");
    assert!(!printed(&["3.0", "4.0"]).contains('\x1b'));
    for form in ["--json", "--markdown"] {
        assert!(!printed(&[&always[..], &[form]].concat()).contains('\x1b'), "{form}");
    }
}

#[test]
fn the_examples_of_the_help_are_valid_arguments() {
    let help = run(&["diff", "--help"]).stdout;
    let examples = help.lines().filter_map(|line| line.trim().strip_prefix("adsdv diff "));
    let mut tried = 0;
    for example in examples {
        let arguments = example.split(['|', '>']).next().unwrap_or_default();
        printed(&arguments.split_whitespace().collect::<Vec<_>>());
        tried += 1;
    }
    assert_eq!(tried, 3, "{help}");
}
