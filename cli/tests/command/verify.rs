//! `adsdv verify`: what it tells of each property, and counterexamples that `adsdv check` judges the same way.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use adsdv_model::{goals, properties};
use adsdv_spec::Edition;
use serde_json::Value;

use crate::run::{Outcome, adsdv, outcome, run};
use crate::schema::validator;

/// Explored once for the tests that only look at it. The inputs that can matter are enough here: that the others do not
/// matter is tested with the model.
static DEFAULT: LazyLock<Outcome> = LazyLock::new(|| verify(Path::new("."), &[]));

/// With a reading under which two properties of the open model fail, printed as text. Their logs are in [`EDGE_LOGS`].
static EDGE: LazyLock<Outcome> = LazyLock::new(|| {
    folder(EDGE_LOGS);
    verify(temporary(), &["--model", "open", "--reading", "fault-trigger=edge", "--logs", EDGE_LOGS])
});

/// A folder in [`temporary`].
const EDGE_LOGS: &str = "verify-fault-edge";

/// The models, as the text and as the JSON name them.
const MODELS: [&str; 3] = ["open model", "closed model, well-behaved operator", "closed model, any operator"];

/// Explores in a folder, where counterexamples are written by default.
fn verify(folder: &Path, options: &[&str]) -> Outcome {
    let args = [&["verify", "--vectors", "read"], options].concat();
    outcome(adsdv(&args).current_dir(folder))
}

fn temporary() -> &'static Path {
    Path::new(env!("CARGO_TARGET_TMPDIR"))
}

/// An empty folder for one test. The name has to be the test's own.
fn folder(name: &str) -> PathBuf {
    let path = temporary().join(name);
    if path.exists() {
        fs::remove_dir_all(&path).expect("it is ours");
    }
    fs::create_dir(&path).expect("the folder for tests can be written");
    path
}

/// The names of the files in a folder.
fn files(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<_> =
        entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("text")).collect();
    names.sort();
    names
}

/// The lines of a model's part of the text.
fn section<'a>(text: &'a str, model: &str) -> Vec<&'a str> {
    let heading = model.to_uppercase();
    let lines = text.lines().skip_while(|line| *line != heading).skip(1);
    let next = |line: &&str| !line.is_empty() && !line.starts_with(' ');
    lines.take_while(|line| !next(line)).collect()
}

/// What is printed of a property: its name, its result, its states and its time.
fn rows<'a>(text: &'a str, model: &str) -> Vec<[&'a str; 4]> {
    let lines = section(text, model);
    let table = lines.iter().skip_while(|line| !line.trim_start().starts_with("PROPERTY "));
    let cells = |line: &&'a str| {
        // Requirements that do not fit into their line go on in lines of their own.
        let (name, rest) = line.strip_prefix("  ").filter(|rest| !rest.starts_with(' '))?.split_once(' ')?;
        let (before, _) = rest.split_once(" s  ").unwrap_or_else(|| panic!("no time in {line:?}"));
        let (before, time) = before.trim_end().rsplit_once(' ').expect("a time");
        let (result, states) = before.trim_end().rsplit_once(' ').expect("a number of states");
        Some([name, result.trim(), states, time])
    };
    table.skip(1).filter_map(cells).collect()
}

#[test]
fn everything_holds_with_the_default_readings() {
    let Outcome { status, stdout, stderr } = &*DEFAULT;
    assert_eq!((*status, stderr.as_str()), (Some(0), ""), "{stdout}");
    let mut count = 0;
    for model in MODELS {
        let lines = section(stdout, model);
        assert!(lines.iter().any(|line| line.ends_with(": complete")), "{model}: {stdout}");
        for heading in ["PROPERTY", "RESULT", "STATES", "TIME", "REQUIREMENTS"] {
            assert!(
                lines.iter().any(|line| line.split_whitespace().any(|word| word == heading)),
                "{heading}"
            );
        }
        for [name, result, states, time] in rows(stdout, model) {
            assert!(
                ["holds", "reached"].contains(&result) || result.starts_with("reached in "),
                "{name}: {result}"
            );
            assert!(states.parse::<u64>().is_ok_and(|states| states > 100_000), "{name}: {states}");
            assert!(time.parse::<f64>().is_ok(), "{name}: {time}");
            count += 1;
        }
    }
    assert_eq!(stdout.lines().last(), Some(format!("all hold: {count} properties").as_str()));
}

#[test]
fn every_property_and_goal_of_the_open_model_is_listed_once() {
    let listed: Vec<_> = rows(&DEFAULT.stdout, "open model").iter().map(|[name, ..]| *name).collect();
    let properties = properties(Edition::DEFAULT).map(|property| property.name);
    let expected: Vec<_> = properties.chain(goals(Edition::DEFAULT).iter().map(|goal| goal.name)).collect();
    assert_eq!(listed, expected);
    for model in MODELS {
        let rows = rows(&DEFAULT.stdout, model);
        let names: BTreeSet<_> = rows.iter().map(|[name, ..]| name).collect();
        assert!(!names.is_empty() && names.len() == rows.len(), "{model}: {rows:?}");
    }
}

#[test]
fn the_first_line_is_the_edition() {
    assert!(DEFAULT.stdout.starts_with("edition 3.0"), "{}", DEFAULT.stdout);
}

#[test]
fn lines_fit_into_100_columns() {
    for line in DEFAULT.stdout.lines() {
        assert!(line.chars().count() <= 100, "{line}");
    }
}

/// What is printed for each failure: the arguments behind `$ adsdv`, and what is said to come of them.
fn failures(text: &str) -> Vec<(Vec<&str>, &str)> {
    let shown = text.split("\n$ adsdv ").skip(1).map(|shown| {
        let (line, report) = shown.split_once('\n').expect("a command and its report");
        // Behind the report there is an empty line, and then the next failure or the verdict.
        let next = report.find("\n\nFAILS ").or_else(|| report.find("\n\nfail: ")).expect("an end");
        let report = report.get(..=next).expect("a line ends there");
        (line.split_whitespace().collect(), report)
    });
    shown.collect()
}

/// What verify prints for each failure is what its command line prints when it is run. The reports.
fn judged_the_same(text: &str, folder: &Path) -> Vec<String> {
    let judged = failures(text).into_iter().map(|(args, shown)| {
        assert!(args.first() == Some(&"check"), "{args:?}");
        let check = outcome(adsdv(&args).current_dir(folder));
        assert!(matches!(check.status, Some(0 | 1)), "{args:?}: {}", check.stderr);
        let (report, why) = shown.split_once("\n  The property fails all the same: ").unwrap_or((shown, ""));
        assert_eq!(check.stdout, report, "adsdv {args:?}");
        assert_eq!(why.is_empty(), check.status == Some(1), "a log that conforms is explained: {shown}");
        check.stdout
    });
    judged.collect()
}

#[test]
fn counterexamples_are_logs_that_check_judges_the_same_way() {
    let verified = &*EDGE;
    assert_eq!((verified.status, verified.stderr.as_str()), (Some(1), ""), "{}", verified.stdout);
    assert!(verified.stdout.contains("\nreading fault-trigger=edge: the change counts\n"));
    let expected = ["counterexample-driving-finished.log", "counterexample-driving-neutral.log"];
    assert_eq!(files(&temporary().join(EDGE_LOGS)), expected);

    let reports = judged_the_same(&verified.stdout, temporary());
    assert_eq!(reports.len(), expected.len());
    for (report, log) in reports.iter().zip(expected) {
        let (edition, report) = report.split_once('\n').expect("more than one line");
        assert!(edition.starts_with("edition 3.0"), "{edition}");
        assert!(report.starts_with(&format!("{EDGE_LOGS}/{log}: ")), "{report}");
        let blames = |line: &str| line.contains("  violation  VCU  3.7  ");
        assert!(report.lines().any(blames), "{report}");
        assert!(report.lines().last().is_some_and(|line| line.contains(": violates (")), "{report}");
    }
    assert_eq!(verified.stdout.lines().last().map(|line| line.starts_with("fail: 2 properties")), Some(true));
}

/// The choices that are no default, as `--reading` takes them.
fn other_choices() -> Vec<String> {
    let readings: Value = serde_json::from_str(&run(&["readings", "--json"]).stdout).expect("JSON");
    let of = |reading: &Value| {
        let id = reading["id"].as_str().expect("text").to_owned();
        let choices = reading["choices"].as_array().expect("an array").clone();
        let others = choices.into_iter().filter(|choice| choice["default"] == false);
        others.map(move |choice| format!("{id}={}", choice["id"].as_str().expect("text"))).collect::<Vec<_>>()
    };
    readings["readings"].as_array().expect("an array").iter().flat_map(of).collect()
}

#[test]
fn what_a_reading_breaks_is_judged_the_same_way() {
    let folder = folder("verify-readings");
    let choices = other_choices();
    assert!(choices.len() >= 12, "{choices:?}");
    // Each takes seconds. That all of them cost what is written down is tested with the model.
    for choice in choices.iter().step_by(4) {
        // What fails in the closed models is written and judged by the same code, and takes ten times as long.
        let verified = verify(&folder, &["--model", "open", "--reading", choice]);
        assert_eq!((verified.status, verified.stderr.as_str()), (Some(1), ""), "{choice}");
        let failing: BTreeSet<_> = rows(&verified.stdout, MODELS[0])
            .into_iter()
            .filter(|[_, result, ..]| result.starts_with("FAILS"))
            .map(|[name, ..]| format!("counterexample-{name}.log"))
            .collect();
        assert_eq!(files(&folder), failing.into_iter().collect::<Vec<_>>(), "{choice}");
        let reports = judged_the_same(&verified.stdout, &folder);
        assert_eq!(reports.len(), files(&folder).len(), "{choice}");
        for log in files(&folder) {
            fs::remove_file(folder.join(log)).expect("it is ours");
        }
    }
}

#[test]
fn a_folder_for_logs_that_does_not_exist() {
    let options = ["--reading", "fault-trigger=edge", "--logs", "no-such-folder"];
    let verified = verify(&folder("verify-no-folder"), &options);
    assert_eq!((verified.status, verified.stdout.as_str()), (Some(2), ""));
    let mut lines = verified.stderr.lines();
    let error = lines.next().unwrap_or_default();
    assert!(error.starts_with("adsdv: no-such-folder"), "{error}");
    let hint = lines.next().unwrap_or_default();
    assert!(hint.starts_with("hint: ") && hint.contains("--logs"), "{hint}");
    assert_eq!(lines.next(), None);
}

#[test]
fn colors_change_no_word() {
    let args = ["verify", "--vectors", "read", "--model", "open", "--threads", "1", "--color", "always"];
    let colored = outcome(adsdv(&args).env("NO_COLOR", "1"));
    assert_eq!(colored.status, Some(0), "{}", colored.stderr);
    for escaped in ["\x1b[1mOPEN MODEL\x1b[0m", "\x1b[32mholds", "\x1b[32mall hold\x1b[0m"] {
        assert!(colored.stdout.contains(escaped), "{escaped:?} is missing: {}", colored.stdout);
    }
    assert!(!DEFAULT.stdout.contains('\x1b'));
    // Only the times differ, from run to run.
    let untimed = |lines: Vec<&str>| lines.concat().replace(|c: char| c.is_ascii_digit() || c == ' ', "");
    let stripped = stripped(&colored.stdout);
    for part in [MODELS[0], "table of figure 2"] {
        let plain = section(&DEFAULT.stdout, part);
        assert!(plain.len() > 3, "{part}: {plain:?}");
        assert_eq!(untimed(section(&stripped, part)), untimed(plain), "{part}");
    }
}

/// Text without its escapes.
fn stripped(colored: &str) -> String {
    let mut parts = colored.split('\x1b');
    let first = parts.next().into_iter();
    // Every escape of the text ends with its first m.
    first.chain(parts.map(|part| part.split_once('m').expect("an end").1)).collect()
}

#[test]
fn json_keeps_to_its_schema_and_agrees_with_the_text() {
    let logs = folder("verify-json");
    // The same code prints a closed model, and has a test of its own.
    let options = ["--model", "open", "--reading", "fault-trigger=edge", "--logs", "verify-json", "--json"];
    let printed = verify(temporary(), &[&options[..], &["--color", "always"]].concat());
    assert_eq!((printed.status, printed.stderr.as_str()), (Some(1), ""), "{}", printed.stdout);
    assert_eq!(printed.stdout.lines().count(), 1, "one object on one line");
    assert!(printed.stdout.starts_with("{\"schema\":1,\"edition\":\"3.0\","), "{}", printed.stdout);
    let json: Value = serde_json::from_str(&printed.stdout).expect("JSON");
    let errors: Vec<_> = validator("verify").iter_errors(&json).map(|error| error.to_string()).collect();
    assert!(errors.is_empty(), "{errors:#?}");

    assert_eq!(
        (&json["readings"]["fault-trigger"], &json["readings"]["go-edge"]),
        (&"edge".into(), &"seen-low".into())
    );
    assert_eq!((&json["holds"], &json["dead_parts"]), (&false.into(), &Value::Array(vec![])));
    let models = json["models"].as_array().expect("an array");
    let names: Vec<_> = models.iter().map(|model| model["name"].as_str().expect("text")).collect();
    assert_eq!(names, MODELS[..1]);
    let mut written = Vec::new();
    for (model, name) in models.iter().zip(MODELS) {
        assert_eq!(model["complete"], true, "{name}");
        let properties = model["properties"].as_array().expect("an array");
        let rows = rows(&EDGE.stdout, name);
        assert_eq!(properties.len(), rows.len(), "{name}");
        for (property, [name, result, states, _]) in properties.iter().zip(rows) {
            assert_eq!((&property["name"], model["states"].to_string().as_str()), (&name.into(), states));
            assert_eq!(result_in_words(property), result, "{name}");
            let log = property["log"].as_str();
            assert_eq!(log.is_some(), result.starts_with("FAILS"), "{name}");
            written.extend(log.map(str::to_owned));
        }
    }
    written.sort();
    let files: Vec<_> = files(&logs).iter().map(|file| format!("verify-json/{file}")).collect();
    assert_eq!((written.len(), written), (2, files));
}

/// The result of a property in the words of the text.
fn result_in_words(property: &Value) -> String {
    let steps = match &property["steps"] {
        Value::Null => String::new(),
        steps if *steps == 1 => " in 1 step".to_owned(),
        steps => format!(" in {steps} steps"),
    };
    match (property["claim"].as_str(), property["holds"].as_bool()) {
        (Some("sometimes"), Some(true)) => format!("reached{steps}"),
        (Some("sometimes"), Some(false)) => "NOT REACHED".to_owned(),
        (Some("always" | "eventually"), Some(true)) => "holds".to_owned(),
        (Some("always" | "eventually"), Some(false)) => format!("FAILS{steps}"),
        _ => panic!("no claim: {property}"),
    }
}

#[test]
fn the_schema_refuses_what_is_not_an_answer() {
    let good = serde_json::json!({
        "schema": 1, "edition": "3.0", "readings": {}, "dead_parts": [], "moot_parts": [], "holds": true,
        "models": [{
            "name": "one", "states": 1, "transitions": 0, "depth": 0, "seconds": 0.0, "complete": true,
            "properties": [{
                "name": "one", "statement": "", "requirements": [], "claim": "always", "holds": true,
                "steps": null, "log": null,
            }],
        }],
    });
    let validator = validator("verify");
    assert!(validator.is_valid(&good));
    for (place, bad) in [
        ("/holds", Value::Null),
        ("/models/0/states", 0.into()),
        ("/models/0/seconds", Value::Null),
        ("/models/0/properties/0/claim", "never".into()),
        ("/models/0/properties/0/steps", (-1).into()),
        ("/models/0/properties/0/log", true.into()),
    ] {
        let mut spoiled = good.clone();
        *spoiled.pointer_mut(place).expect("it is there") = bad;
        assert!(!validator.is_valid(&spoiled), "{place}");
    }
}
