//! `adsdv exam`: what it tells of AI Computers, for people and for programs.

use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;

use adsdv_spec::Edition;
use serde_json::Value;

use crate::run::{Outcome, example, run, workspace};
use crate::schema::validator;

/// The file of the example with the mistakes.
fn mutant() -> &'static str {
    static FILE: OnceLock<String> = OnceLock::new();
    FILE.get_or_init(|| example("ai_mutant"))
}

/// Examines an AI Computer with this mistake, or without one.
/// Without a search for shorter scenarios, which takes longer than the exam, unless it is asked for.
fn examined(options: &[&str], mistake: &[&str]) -> Outcome {
    let shrink: &[&str] = if options.contains(&"--shrink") { &[] } else { &["--shrink", "0"] };
    run(&[&["exam", "--stdio"], options, shrink, &["--", mutant()], mistake].concat())
}

/// The JSON, which has to keep to its schema and to say what the exit status does.
fn report(options: &[&str], mistake: &[&str]) -> Value {
    let outcome = examined(&[options, &["--json"]].concat(), mistake);
    assert_eq!((outcome.stdout.lines().count(), outcome.stderr.as_str()), (1, ""));
    let report: Value = serde_json::from_str(&outcome.stdout).expect("JSON");
    let errors: Vec<_> = validator("exam").iter_errors(&report).map(|error| error.to_string()).collect();
    assert!(errors.is_empty(), "{errors:#?}");
    assert_eq!(report["passes"], outcome.status == Some(0), "{:?}", outcome.status);
    report
}

#[test]
fn the_reference_passes_through_standard_input_as_well() {
    for edition in Edition::ALL.iter().map(|edition| edition.version) {
        let report = report(&["--edition", edition], &[]);
        assert_eq!((&report["passes"], &report["edition"]), (&Value::from(true), &Value::from(edition)));
        assert_eq!(report["scenarios"].as_array().map(Vec::len), Some(43));
    }
}

/// What is wrong stands in the first screen.
#[test]
fn each_mistake_is_printed_first() {
    for (edition, mistake, expected) in [
        ("4.0", "silent", "MSG-5   sends AI2VCU_Status (510h)"),
        ("4.0", "never-selects", "RDY-7   confirms the mission that is selected"),
        ("4.0", "floods", "MSG-98  sends 510h to 514h every 10 ms"),
        ("3.0", "answers-late", "HS-5    answers the HANDSHAKE bit of the VCU"),
        ("4.0", "answers-late", "HS-5    answers the HANDSHAKE bit of the VCU"),
        ("4.0", "sends-a-reserved-identifier", "ID-8    does not send 301h"),
        ("4.0", "brakes-and-drives", "IMP-8   does not drive and brake at once"),
    ] {
        let outcome = examined(&["--edition", edition, "--only", "mission-skidpad"], &[mistake]);
        assert_eq!((outcome.status, outcome.stderr.as_str()), (Some(1), ""), "{mistake}");
        let screen: Vec<&str> = outcome.stdout.lines().take(24).collect();
        assert!(screen[0].starts_with(&format!("edition {edition}")), "{}", screen[0]);
        assert!(screen.iter().any(|line| line.contains(expected)), "{mistake}: {screen:#?}");
    }
}

/// A finding of the judge has the words and the rule that `adsdv check` has for the log.
#[test]
fn the_log_of_a_scenario_is_judged_with_the_same_words() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("exam-logs");
    // It may be there from an earlier run.
    let _ = std::fs::remove_dir_all(&folder);
    let folder = folder.to_str().expect("text");
    for (mistake, rule) in [
        ("finishes-at-speed", "finished-while-moving"),
        ("sends-a-reserved-identifier", "reserved-identifier"),
        ("brakes-too-much-behind", "value-out-of-range"),
    ] {
        let options = ["--edition", "4.0", "--only", "mission-skidpad", "--logs", folder];
        let exam = report(&options, &[mistake]);
        let checked = run(&["check", "--edition", "4.0", "--json", &format!("{folder}/mission-skidpad.log")]);
        let check: Value = serde_json::from_str(&checked.stdout).expect("JSON");
        let words = |report: &Value, rule: &str| -> Vec<String> {
            let all = report["findings"].as_array().expect("a list").iter();
            let of_rule = all.filter(|one| one["rule"] == rule);
            of_rule.map(|one| format!("{}; expected {}", one["seen"], one["expected"])).collect()
        };
        let found = words(&exam, rule);
        assert!(!found.is_empty() && words(&check, rule).contains(&found[0]), "{mistake}: {found:?}");
    }
}

/// What `adsdv check` says of the log, the exam says as well, and it names every requirement that check names.
#[test]
fn the_exam_has_the_findings_and_the_requirements_of_check() {
    let folder = new_file("check-logs");
    for (mistake, id) in [
        ("finishes-at-speed", Some("FIN-3")),
        ("answers-late", Some("HS-5")),
        ("loses-514h-for-a-while", None),
        ("neutral-at-speed", None),
        ("reverses", None),
    ] {
        let options = ["--edition", "4.0", "--only", "mission-skidpad", "--shrink", "0", "--logs", &folder];
        let exam = report(&options, &[mistake]);
        let checked = run(&["check", "--edition", "4.0", "--json", &format!("{folder}/mission-skidpad.log")]);
        let check: Value = serde_json::from_str(&checked.stdout).expect("JSON");
        let list = |value: &Value| value.as_array().expect("a list").clone();
        let of_the_ai = list(&check["findings"])
            .into_iter()
            .filter(|one| one["party"] == "AI" && one["severity"] == "violation");
        let mut named = Vec::new();
        for finding in of_the_ai {
            let is_it = |one: &Value| one["rule"] == finding["rule"] && one["seen"] == finding["seen"];
            let examined = list(&exam["findings"]).into_iter().find(is_it);
            let examined = examined.unwrap_or_else(|| panic!("{mistake}: only check says {finding}"));
            for requirement in list(&finding["requirements"]) {
                let ids = list(&examined["requirements"]);
                assert!(ids.contains(&requirement), "{mistake}: {requirement}, but {ids:?}");
                named.push(requirement);
            }
        }
        if let Some(id) = id {
            assert!(named.contains(&Value::from(id)), "{mistake}: {named:?}");
        }
    }
}

#[test]
fn the_scenarios_are_listed_and_chosen() {
    let list = run(&["exam", "--list"]);
    assert_eq!((list.status, list.stderr.as_str()), (Some(0), ""));
    assert_eq!(list.stdout.lines().count(), 43 + 2);
    assert!(
        list.stdout.contains("\nready                          5 s  a mission is selected"),
        "{}",
        list.stdout
    );
    let some = run(&["exam", "--list", "--only", "go-", "--only", "ready"]);
    let mut scenarios = some.stdout.lines().take_while(|line| !line.is_empty());
    assert!(scenarios.all(|line| line.starts_with("go-") || line.starts_with("ready ")));
    let quick = run(&["exam", "--list", "--quick"]);
    assert!(quick.stdout.ends_with("\n5 scenarios: 1 min 7 s in real time\n"), "{}", quick.stdout);
    let none = run(&["exam", "--stdio", "--only", "nothing", "--", "cat"]);
    assert_eq!((none.status, none.stdout.as_str()), (Some(2), ""));
    assert!(none.stderr.contains("--only nothing: no scenario begins so; expected one of no-mission, "));
}

/// What is asked for on a bus cannot all be asked for at once.
#[test]
fn a_bus_and_what_is_on_it_are_asked_for() {
    for (args, told) in [
        (&["exam", "--", "true"][..], "<INTERFACE>"),
        (&["exam", "vcan0"], "<PROGRAM>..."),
        (&["exam", "vcan0", "--stdio", "--", "true"], "cannot be used with"),
        (&["exam", "--attach"], "<INTERFACE>"),
        (&["exam", "vcan0", "--attach", "--", "true"], "cannot be used with"),
        (&["exam", "vcan0", "--jobs", "2", "--", "true"], "--namespace"),
        (&["exam", "vcan0", "--shrink", "2", "--", "true"], "cannot be used with '--shrink"),
        (&["exam", "--namespace", "--jobs", "0", "--", "true"], "0 is not in 1..=64"),
        (&["exam", "vcan0", "--quick", "--only", "ready", "--", "true"], "cannot be used with"),
    ] {
        let refused = run(args);
        assert_eq!((refused.status, refused.stdout.as_str()), (Some(2), ""), "{args:?}");
        assert!(refused.stderr.contains(told), "{args:?}: {}", refused.stderr);
    }
}

#[test]
fn an_interface_that_is_not_there_is_reported() {
    let refused = run(&["exam", "adsdv-none", "--only", "ready", "--", "true"]);
    assert_eq!((refused.status, refused.stdout.as_str()), (Some(2), ""));
    assert!(refused.stderr.starts_with("adsdv: adsdv-none: "), "{}", refused.stderr);
    assert!(refused.stderr.contains("\nhint: "), "{}", refused.stderr);
}

#[test]
fn what_passed_is_listed_if_somebody_asks() {
    let outcome = examined(&["--edition", "4.0", "--only", "mission-skidpad", "--all"], &[]);
    assert!(
        outcome.stdout.contains("\n  RDY-7   confirms the mission that is selected\n"),
        "{}",
        outcome.stdout
    );
    assert_eq!(outcome.status, Some(0));
}

#[test]
fn a_verdict_without_a_vehicle_that_moved_says_so() {
    let open = "passes, as far as it goes: the vehicle never moved in AS_DRIVING\n";
    let ready = examined(&["--only", "ready"], &[]);
    assert!(ready.status == Some(0) && ready.stdout.ends_with(open), "{}", ready.stdout);
    let mission = examined(&["--only", "mission-skidpad"], &[]);
    assert!(mission.status == Some(0) && mission.stdout.ends_with(": passes\n"), "{}", mission.stdout);
    // What is wrong counts more.
    let wrong = examined(&["--only", "ready"], &["never-selects"]);
    assert!(wrong.status == Some(1) && wrong.stdout.ends_with(": fails\n"), "{}", wrong.stdout);
}

/// The examples that teams begin with.
#[test]
fn the_examples_pass() {
    let python =
        Command::new("python3").arg("--version").output().is_ok_and(|output| output.status.success());
    if python {
        for example in [&["exam/examples/stack.py"][..], &["exam/examples/ros2_bridge.py", "--without-ros"]] {
            let outcome = run(&[&["exam", "--stdio", "--edition", "4.0", "--", "python3"], example].concat());
            assert_eq!(outcome.status, Some(0), "{}{}", outcome.stdout, outcome.stderr);
        }
    }
    let program = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("exam-minimal");
    let built = Command::new("cc")
        .args(["-O1", "-Wall", "-Wextra", "-Werror", "-std=c99", "-o"])
        .arg(&program)
        .arg("exam/examples/minimal.c")
        .current_dir(workspace())
        .status();
    if built.is_ok_and(|status| status.success()) {
        let program = program.to_str().expect("text");
        let outcome = run(&["exam", "--stdio", "--edition", "2026", "--", program]);
        assert_eq!(outcome.status, Some(0), "{}{}", outcome.stdout, outcome.stderr);
    }
}

/// The attributes and the text of a test case, or of a tag in it.
fn cases(xml: &str) -> Vec<&str> {
    xml.split("<testcase ")
        .skip(1)
        .map(|case| case.split("</testsuite>").next().unwrap_or_default())
        .collect()
}

/// A file of a folder of this test, which is new.
fn new_file(name: &str) -> String {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("exam-files");
    std::fs::create_dir_all(&folder).expect("it can be made");
    let file = folder.join(name);
    // It may be there from an earlier run.
    let _ = std::fs::remove_file(&file);
    file.to_str().expect("text").to_owned()
}

#[test]
fn junit_has_a_test_case_for_each_requirement() {
    for (edition, mistake, others) in
        [("4.0", "looks-at-one-wheel", false), ("3.0", "sends-for-the-vcu", true), ("2026", "", false)]
    {
        let file = new_file(&format!("junit-{edition}.xml"));
        let options = ["--edition", edition, "--only", "wheel-spins", "--only", "ready", "--junit", &file];
        let report = report(&options, &[mistake]);
        let xml = std::fs::read_to_string(&file).expect("it is written");
        let cases = cases(&xml);
        let requirements = report["requirements"].as_array().expect("a list");
        assert_eq!(cases.len(), requirements.len() + 1);
        for (case, one) in cases.iter().zip(requirements) {
            let [id, section, why] =
                ["id", "section", "why"].map(|key| one[key].as_str().unwrap_or_default());
            assert!(case.starts_with(&format!("name=\"{id} ")), "{case}");
            let section = section.replace(['.', ' '], "_");
            let edition = edition.replace('.', "_");
            assert!(
                case.contains(&format!("classname=\"adsdv.edition_{edition}.section_{section}\"")),
                "{case}"
            );
            let outcome = one["outcome"].as_str().expect("a name");
            assert_eq!(case.contains("<failure "), outcome == "fail", "{case}");
            assert_eq!(
                case.contains("<skipped message=\"not exercised: "),
                outcome == "not exercised",
                "{case}"
            );
            assert!(case.contains(why), "{case}");
        }
        let last = cases.last().expect("one more");
        assert!(last.starts_with("name=\"nothing else is wrong\""), "{last}");
        assert_eq!(last.contains("<failure "), others, "{last}");
        if mistake == "looks-at-one-wheel" {
            for words in [
                "type=\"finished-while-moving\"",
                "scenario  wheel-spins: ",
                "operator  0.000 s ebs ARMED",
                "frames    ",
            ] {
                assert!(xml.contains(words), "{words} is not in {xml}");
            }
        }
    }
}

#[test]
fn the_summary_begins_with_the_verdict_and_what_failed() {
    let file = new_file("summary.md");
    let options = ["--edition", "4.0", "--only", "wheel-spins", "--summary", &file];
    examined(&options, &["looks-at-one-wheel"]);
    let text = std::fs::read_to_string(&file).expect("it is written");
    for words in [
        "## adsdv exam: fails\n",
        "edition 4.0, 1 scenario; requirements: 1 failed, ",
        "\n| FIN-3 | 3.3 | tells FINISHED once the vehicle has stopped | 1 | no |\n",
        "<summary>FIN-3: MISSION_STATUS == FINISHED and a wheel speed > 10 rpm",
        "- scenario wheel-spins: ",
    ] {
        assert!(text.contains(words), "{words} is not in {text}");
    }
    examined(&options, &[]);
    let text = std::fs::read_to_string(&file).expect("it is written");
    assert!(text.starts_with("## adsdv exam: passes\n") && !text.contains("| failed |"), "{text}");
}

/// The verdict is printed all the same.
#[test]
fn a_file_that_cannot_be_written_is_named() {
    for option in ["--junit", "--summary", "--write-accept"] {
        for (file, hint) in
            [("/dev/full", "free some space"), ("no-such-folder/file", "a directory that is there")]
        {
            let outcome = examined(&["--only", "ready", option, file], &[]);
            assert_eq!(outcome.status, Some(2));
            assert!(outcome.stdout.contains(": passes, as far as it goes: "), "{}", outcome.stdout);
            if option == "--write-accept" {
                assert!(outcome.stderr.contains(file), "{}", outcome.stderr);
                continue;
            }
            let why = format!("{file}: cannot write what {option} asks for: ");
            assert!(outcome.stderr.contains(&why) && outcome.stderr.contains(hint), "{}", outcome.stderr);
        }
    }
}

/// What the workflow for teams asks for, there is.
#[test]
fn the_workflow_has_options_that_there_are() {
    let workflow =
        std::fs::read_to_string(workspace().join("exam/examples/workflow.yml")).expect("it is there");
    let (_, command) = workflow.split_once("adsdv exam ").expect("the command");
    let (options, _) = command.split_once(" -- ").expect("the program");
    let help = run(&["exam", "--help"]).stdout;
    let options: Vec<&str> = options.split_whitespace().filter(|word| word.starts_with("--")).collect();
    assert!(options.len() > 3, "{options:?}");
    for option in options {
        assert!(help.contains(&format!(" {option}")), "{option} is not in {help}");
    }
}

#[test]
fn what_is_accepted_is_no_failure() {
    let (known, junit, summary) = (new_file("known.txt"), new_file("accepted.xml"), new_file("accepted.md"));
    let options = ["--edition", "3.0", "--only", "mission-skidpad"];
    let accept =
        |file| [&options[..], &["--accept", file, "--junit", &junit, "--summary", &summary]].concat();
    for (mistake, id) in [("never-selects", "RDY-7"), ("sends-for-the-vcu", "identifier-of-others")] {
        let outcome = examined(&[&options[..], &["--write-accept", &known]].concat(), &[mistake]);
        assert_eq!(outcome.status, Some(1));
        let text = std::fs::read_to_string(&known).expect("it is written");
        assert!(text.starts_with("# Failures that are known: "), "{text}");
        let ids: Vec<&str> =
            text.lines().filter_map(|line| line.strip_suffix("  no reason given yet")).collect();
        let id = if ids.contains(&id) { id } else { ids[0] };
        std::fs::write(&known, text.replace("no reason given yet", "until <June>"))
            .expect("it can be written");

        let report = report(&accept(&known), &[mistake]);
        assert_eq!((&report["passes"], &report["unused"]), (&Value::from(true), &Value::Array(Vec::new())));
        let findings = report["findings"].as_array().expect("a list");
        assert!(!findings.is_empty() && findings.iter().all(|one| one["accepted"] == true));
        let xml = std::fs::read_to_string(&junit).expect("it is written");
        assert!(!xml.contains("<failure") && xml.contains("<skipped message=\"accepted: "), "{xml}");
        let text = std::fs::read_to_string(&summary).expect("it is written");
        assert!(text.starts_with("## adsdv exam: passes but for what is accepted\n"), "{text}");
        let outcome = examined(&accept(&known), &[mistake]);
        assert!(outcome.stdout.contains("          accepted: until <June>\n"), "{id}: {}", outcome.stdout);
        assert!(outcome.stdout.ends_with(": passes but for what is accepted\n"), "{}", outcome.stdout);
    }
}

#[test]
fn what_is_accepted_and_not_wrong_is_a_warning() {
    let known = new_file("unused.txt");
    std::fs::write(&known, "RDY-7 because\nMSG-7 because\nMSG-98 because\n").expect("it can be written");
    let options = ["--edition", "3.0", "--only", "mission-skidpad", "--accept", &known];
    let outcome = examined(&options, &[]);
    for (id, why) in
        [("RDY-7", "passes"), ("MSG-7", "is not exercised"), ("MSG-98", "is no requirement of the exam")]
    {
        assert!(
            outcome.stdout.contains(&format!("warning: {id} is accepted, and {why}")),
            "{}",
            outcome.stdout
        );
    }
    assert_eq!(outcome.status, Some(0));
    assert_eq!(report(&options, &[])["unused"], serde_json::json!(["RDY-7", "MSG-7", "MSG-98"]));
    // What fails beside it fails.
    assert_eq!(examined(&options, &["never-forward"]).status, Some(1));
}

#[test]
fn a_file_that_accepts_nothing_readable_is_refused() {
    let known = new_file("no-reason.txt");
    std::fs::write(&known, "RDY-7\n").expect("it can be written");
    for (file, why) in [
        (known.as_str(), ", line 1: \"RDY-7\" has no reason"),
        ("no-such-file", "cannot read the accepted failures"),
    ] {
        let outcome = run(&["exam", "--stdio", "--accept", file, "--", "no-such-program"]);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""));
        assert!(
            outcome.stderr.contains(why) && outcome.stderr.contains("RDY-7  the mission"),
            "{}",
            outcome.stderr
        );
    }
}

#[test]
fn scenarios_by_chance_are_the_same_for_the_same_seed() {
    let list = |seed| run(&["exam", "--list", "--runs", "3", "--seed", seed, "--only", "random-"]).stdout;
    let (seven, again) = (list("7"), list("7"));
    assert_eq!(seven, again);
    for (place, line) in seven.lines().take(3).enumerate() {
        assert!(line.starts_with(&format!("random-{place} ")), "{line}");
        assert!(line.ends_with(&format!(" s  scenario {place} of seed 7")), "{line}");
    }
    assert!(seven.contains("\n3 scenarios: "), "{seven}");
    let report = report(&["--edition", "4.0", "--runs", "5", "--only", "random-"], &[]);
    assert_eq!(
        (report["scenarios"].as_array().map(Vec::len), &report["passes"]),
        (Some(5), &Value::from(true))
    );
}

/// What is printed and written of a finding can be held again, and fails again.
#[test]
fn the_shortest_scenario_of_a_finding_can_be_held_again() {
    let folder = PathBuf::from(new_file("finding-logs"));
    // It may be there from an earlier run.
    let _ = std::fs::remove_dir_all(&folder);
    let logs = folder.to_str().expect("text");
    let options = ["--edition", "4.0", "--only", "wheel-spins", "--shrink", "40", "--logs", logs];
    let report = report(&options, &["looks-at-one-wheel"]);
    let shortest = report["findings"][0]["shortest"].as_str().expect("a scenario");
    assert!(shortest.lines().count() <= 6 && shortest.starts_with("disturb braking "), "{shortest}");
    let file = folder.join("finding-1.txt");
    assert_eq!(std::fs::read_to_string(&file).expect("it is written"), shortest);
    let file = file.to_str().expect("text");
    let again =
        examined(&["--edition", "4.0", "--scenario", file, "--shrink", "40"], &["looks-at-one-wheel"]);
    assert_eq!(again.status, Some(1));
    assert!(
        again.stdout.contains("  FIN-3   tells FINISHED once the vehicle has stopped"),
        "{}",
        again.stdout
    );
    let first = shortest.lines().next().expect("a line");
    assert!(again.stdout.contains(&format!("\n      shortest  {first}\n")), "{}", again.stdout);
    let log = folder.join("finding-1.log");
    let checked = run(&["check", "--edition", "4.0", log.to_str().expect("text")]);
    assert!(checked.stdout.contains("finished-while-moving"), "{}", checked.stdout);
    assert_eq!(examined(&["--edition", "4.0", "--scenario", file], &[]).status, Some(0));
    let none = examined(&["--edition", "4.0", "--only", "wheel-spins"], &["looks-at-one-wheel"]);
    assert!(!none.stdout.contains("shortest"), "{}", none.stdout);
}

#[test]
fn a_file_that_is_no_scenario_is_refused() {
    let file = new_file("wrong.txt");
    std::fs::write(&file, "disturb AS_GONE +1 for 1 silences\n0 asms up\n").expect("it can be written");
    for (file, why) in [
        (file.as_str(), "line 1, column 9: found \"AS_GONE\", expected one of start, braking, "),
        (file.as_str(), "line 2, column 8: found \"up\""),
        ("no-such-file", "cannot read the scenario: "),
        ("tests", "is a directory; expected a scenario"),
    ] {
        let outcome = run(&["exam", "--stdio", "--scenario", file, "--", "no-such-program"]);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""));
        assert!(outcome.stderr.contains(why) && outcome.stderr.contains("\nhint: "), "{}", outcome.stderr);
    }
}
