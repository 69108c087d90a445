//! The header, the examples and the protocol's adapter, compiled by a C and a C++ compiler and run.
//!
//! Without compilers (`cc`, `c++`) these tests say so and pass, unless `ADSDV_REQUIRE_CC` is set.

#[path = "../common/mod.rs"]
mod common;
mod compile;

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Output, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use adsdv_oracle::log::{LogOptions, judge_log};
use adsdv_oracle::protocol::{Answer, Request, Shown};
use adsdv_oracle::suite::Step;
use adsdv_spec::{Control, Edition, Machine};
use common::Run;
use compile::{C, CPP, Linked, built, compiler, folder, syntax};

/// Nothing here takes so long.
const LIMIT: Duration = Duration::from_mins(1);

#[test]
fn the_header_compiles_alone_in_every_standard() {
    for (language, standards) in [(C, ["-std=c99", "-std=c11"]), (CPP, ["-std=c++11", "-std=c++17"])] {
        let Some(compiler) = compiler(language) else { continue };
        for standard in standards {
            syntax(&compiler, language, standard, "#include \"adsdv.h\"\n");
        }
    }
}

/// What the README shows is what the example prints, linked either way.
#[test]
fn the_first_example_is_that_of_the_readme() {
    let Some(cc) = compiler(C) else { return };
    let readme = std::fs::read_to_string(folder().join("README.md")).unwrap();
    let source = std::fs::read_to_string(folder().join("examples/step.c")).unwrap();
    let (_, body) = source.split_once("int main").unwrap();
    assert!(readme.contains(body), "the README does not have examples/step.c");
    for linked in [Linked::Statically, Linked::Dynamically] {
        let program = built(&cc, C, &folder().join("examples/step.c"), linked);
        let Output { status, stdout, stderr } = Command::new(&program).output().unwrap();
        assert!(status.success() && stderr.is_empty(), "{}", String::from_utf8_lossy(&stderr));
        let printed = String::from_utf8(stdout).unwrap();
        assert!(printed.contains("AS_READY by section 3.1"), "{printed}");
        for line in printed.lines() {
            assert!(readme.contains(line), "the README does not have {line:?}");
        }
    }
}

#[test]
fn the_adapters_are_short() {
    for adapter in [adapter(), adapter_in_cpp()] {
        let lines = std::fs::read_to_string(&adapter).unwrap().lines().count();
        assert!(lines < 100, "{}: {lines} lines", adapter.display());
    }
}

/// The C adapter answers as the specification does, step for step, in random runs and in the whole suite: asked for one
/// step after the other, and for many at once.
#[test]
fn the_adapter_agrees_with_the_specification() {
    let Some(cc) = compiler(C) else { return };
    agrees(&built(&cc, C, &adapter(), Linked::Statically), true);
}

/// So does the one in C++, which shows less.
#[test]
fn the_adapter_in_cpp_agrees_with_the_specification() {
    let Some(cpp) = compiler(CPP) else { return };
    agrees(&built(&cpp, CPP, &adapter_in_cpp(), Linked::Statically), false);
}

fn agrees(program: &Path, shows_everything: bool) {
    let script = script(5, 3000);
    let mut running = Running::start(program);
    running.shows_everything = shows_everything;
    for (request, expected) in &script {
        running.ask(&format!("{request}\n"));
        running.answers(expected.as_ref());
    }
    running.ends();

    let mut script = self::script(6, 30_000);
    script.extend(suite());
    let mut running = Running::start(program);
    running.shows_everything = shows_everything;
    let start = Instant::now();
    let mut questions = running.questions.take().unwrap();
    std::thread::scope(|scope| {
        let script = &script;
        scope.spawn(move || {
            for (request, _) in script {
                writeln!(questions, "{request}").unwrap();
            }
        });
        for (_, expected) in script {
            running.answers(expected.as_ref());
        }
    });
    println!("{} steps through the pipe in {:?}, answers read and checked", script.len(), start.elapsed());
    running.ends();
}

/// A line may come in pieces, and an answer comes as soon as the line is there.
#[test]
fn the_adapter_waits_for_the_rest_of_a_line() {
    let Some(cc) = compiler(C) else { return };
    let mut running = Running::start(&built(&cc, C, &adapter(), Linked::Statically));
    running.ask("{\"op\":\"reset\"}\n{\"op\":\"re");
    running.answers(None);
    std::thread::sleep(Duration::from_millis(20));
    running.ask("set\"}\n");
    running.answers(None);
    running.ends();
}

/// What is wrong with a request is said, and is no answer.
#[test]
fn the_adapter_reports_what_is_wrong() {
    let Some(cc) = compiler(C) else { return };
    let program = built(&cc, C, &adapter(), Linked::Statically);
    for (line, expected) in [
        (
            r#"{"op":"step","dt_ms":10,"ami":"LUNCH"}"#,
            "adapter: \"LUNCH\" is no name of a value; expected 0 = NOT_SELECTED",
        ),
        (
            r#"{"op":"step","dt_ms":10,"steer_angle":241}"#,
            "adapter: inputs.steer_angle is 241; expected -240 to 240",
        ),
    ] {
        let mut running = Running::start(&program);
        running.ask(&format!("{line}\n"));
        drop(running.questions.take());
        let Output { status, stdout, stderr } = running.child.wait_with_output().unwrap();
        let said = String::from_utf8(stderr).unwrap();
        assert!(!status.success() && stdout.is_empty(), "{line}");
        assert!(said.starts_with(expected), "{said}");
    }
}

/// The judge in C++ finds in a log what the judge in Rust finds.
#[test]
fn the_online_judge_agrees_with_the_judge() {
    let Some(cpp) = compiler(CPP) else { return };
    let program = built(&cpp, CPP, &folder().join("examples/online_judge.cpp"), Linked::Statically);
    for (log, code) in [("finished-while-moving.log", 1), ("mission.log", 0)] {
        let path = folder().join("../tests/logs").join(log);
        let Output { status, stdout, stderr } =
            Command::new(&program).stdin(std::fs::File::open(&path).unwrap()).output().unwrap();
        assert_eq!((status.code(), String::from_utf8_lossy(&stderr).as_ref()), (Some(code), ""), "{log}");
        let printed = String::from_utf8(stdout).unwrap();

        let report = judge_log(std::fs::File::open(&path).unwrap(), &LogOptions::default(), |_| {}).unwrap();
        let mut expected = count(report.findings.iter().map(|finding| {
            format!(
                "{}.{:06} s  {}  {}  section {}  {}  {}",
                finding.t_ns / 1_000_000_000,
                finding.t_ns / 1000 % 1_000_000,
                finding.severity.name(),
                finding.party.name(),
                finding.section,
                finding.rule.id(),
                finding.message,
            )
        }));
        *expected
            .entry(format!(
                "{} frames, {} violations, {} warnings",
                report.frames,
                report.count(adsdv_oracle::judge::Severity::Violation),
                report.count(adsdv_oracle::judge::Severity::Warning),
            ))
            .or_default() += 1;
        assert_eq!(count(printed.lines().map(str::to_owned)), expected, "{log}");
    }
}

fn adapter() -> std::path::PathBuf {
    folder().join("../oracle/examples/adapter.c")
}

fn adapter_in_cpp() -> std::path::PathBuf {
    folder().join("../oracle/examples/adapter.cpp")
}

/// How often each line comes; the order is not compared, for a live judge says a thing once it knows it.
fn count(lines: impl Iterator<Item = String>) -> BTreeMap<String, u32> {
    lines.fold(BTreeMap::new(), |mut counts, line| {
        *counts.entry(line).or_default() += 1;
        counts
    })
}

/// Requests, and what the specification shows; `None` for a reset.
fn script(seed: u64, steps: u32) -> Vec<(String, Option<Shown>)> {
    let (mut run, mut control) = (Run::new(seed), Control::INITIAL);
    let mut script = vec![(Request::Reset.to_string(), None)];
    for _ in 0..steps {
        if Run::is_over(&control) {
            control = Control::INITIAL;
            script.push((Request::Reset.to_string(), None));
        }
        let (dt_ms, inputs) = run.next(&control);
        let (next, outputs) = Machine::REFERENCE.step(&control, &inputs, dt_ms);
        let shown = Shown::of(Machine::REFERENCE.edition(), &outputs, &inputs);
        script.push((Request::Step { dt_ms, inputs }.to_string(), Some(shown)));
        control = next;
    }
    script
}

/// The whole test suite.
fn suite() -> impl Iterator<Item = (String, Option<Shown>)> {
    adsdv_oracle::suite::generate(Edition::DEFAULT).into_iter().flat_map(|test| {
        let steps = test.scenario.steps.iter().zip(test.scenario.shown(&Machine::REFERENCE));
        let steps = steps.map(|(&Step { dt_ms, inputs }, shown)| {
            (Request::Step { dt_ms, inputs }.to_string(), Some(shown))
        });
        let reset = (Request::Reset.to_string(), None);
        std::iter::once(reset).chain(steps).collect::<Vec<_>>()
    })
}

/// A program that is asked and answers.
struct Running {
    child: Child,
    questions: Option<ChildStdin>,
    lines: Option<Receiver<String>>,
    /// Whether every answer has to show all that there is.
    shows_everything: bool,
}

impl Running {
    fn start(program: &Path) -> Self {
        let mut child = Command::new(program)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        Self { questions: child.stdin.take(), lines: None, shows_everything: true, child }
    }

    fn ask(&mut self, text: &str) {
        let questions = self.questions.as_mut().unwrap();
        questions.write_all(text.as_bytes()).unwrap();
        questions.flush().unwrap();
    }

    /// The next answer is what was expected.
    fn answers(&mut self, expected: Option<&Shown>) {
        let lines = self.lines.get_or_insert_with(|| {
            let (sender, receiver) = channel();
            let answers = BufReader::new(self.child.stdout.take().unwrap());
            std::thread::spawn(move || {
                answers.lines().map_while(Result::ok).try_for_each(|line| sender.send(line))
            });
            receiver
        });
        let line = lines.recv_timeout(LIMIT).expect("an answer in time");
        let Some(shown) = expected else { return assert_eq!(line, "{}") };
        let answer: Answer = line.parse().unwrap_or_else(|error| panic!("{error}: {line}"));
        let differences: Vec<String> = answer.differences(shown).map(|one| one.to_string()).collect();
        assert!(differences.is_empty(), "{differences:?}: {line}");
        let everything = shown.iter().all(|(field, _)| answer.has(field.key));
        assert!(everything || !self.shows_everything, "it does not show everything: {line}");
    }

    /// It ends as soon as there are no more questions, and has said nothing else.
    fn ends(mut self) {
        drop(self.questions.take());
        if let Some(lines) = self.lines.take() {
            assert!(lines.recv_timeout(LIMIT).is_err(), "more answers than questions");
        }
        let Output { status, stderr, .. } = self.child.wait_with_output().unwrap();
        assert!(status.success() && stderr.is_empty(), "{}", String::from_utf8_lossy(&stderr));
    }
}
