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

use adsdv_conform::protocol::{Protocol, Request, Shown, UNSAID};
use adsdv_conform::suite::Step;
use adsdv_conform::{ConformOptions, Program, conform};
use adsdv_oracle::candump::{Entry, Reader};
use adsdv_oracle::judge::JudgeOptions;
use adsdv_oracle::log::{LogOptions, judge_log};
use adsdv_oracle::recognise::Recogniser;
use adsdv_spec::messages::Node;
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

/// And what it says of the editions is what their example prints.
#[test]
fn the_editions_are_those_of_the_readme() {
    let Some(cc) = compiler(C) else { return };
    let program = built(&cc, C, &folder().join("examples/editions.c"), Linked::Statically);
    let Output { status, stdout, stderr } = Command::new(&program).output().unwrap();
    assert!(status.success() && stderr.is_empty(), "{}", String::from_utf8_lossy(&stderr));
    let printed = String::from_utf8(stdout).unwrap();
    for &edition in Edition::ALL {
        let lost = edition.rules.timing.handshake_ms + 10;
        let drive = edition.bus.message(0x511).unwrap().len;
        let sent = edition.bus.messages.iter().filter(|def| def.sender == Node::Vcu).count();
        let line = format!(
            "{}: {sent} frames a cycle, 511h has {drive} bytes, communication lost after {lost} ms\n",
            edition.version
        );
        assert!(printed.contains(&line), "{line}{printed}");
    }
    assert!(
        printed.contains("\nerror 9: there is no edition \"2.9\"; expected one of 3.0, 4.0"),
        "{printed}"
    );
    let readme = std::fs::read_to_string(folder().join("README.md")).unwrap();
    let (_, shown) = readme.split_once("$ ./editions\n").unwrap();
    let (shown, _) = shown.split_once("```").unwrap();
    assert!(printed.starts_with(shown), "the README does not have what it prints: {printed}");
}

/// What it says of many steps is what their example prints, which is C++ as well.
#[test]
fn the_steps_are_those_of_the_readme() {
    let readme = std::fs::read_to_string(folder().join("README.md")).unwrap();
    let (_, shown) = readme.split_once("$ ./steps\n").unwrap();
    let (shown, _) = shown.split_once("```").unwrap();
    for language in [C, CPP] {
        let Some(compiler) = compiler(language) else { continue };
        let program = built(&compiler, language, &folder().join("examples/steps.c"), Linked::Statically);
        let Output { status, stdout, stderr } = Command::new(&program).output().unwrap();
        assert!(status.success() && stderr.is_empty(), "{}", String::from_utf8_lossy(&stderr));
        assert_eq!(String::from_utf8(stdout).unwrap(), shown);
    }
}

#[test]
fn the_adapters_are_short() {
    for adapter in [adapter(), adapter_in_cpp()] {
        let lines = std::fs::read_to_string(&adapter).unwrap().lines().count();
        assert!(lines < 140, "{}: {lines} lines", adapter.display());
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
    for &edition in Edition::ALL {
        agrees_in(edition, program, shows_everything);
    }
    // Without a hello all is about 3.0.
    let mut script = script(UNSAID, 7, 300);
    script.remove(0);
    let mut running = Running::start(program);
    running.shows_everything = shows_everything;
    for (request, expected) in &script {
        running.ask(&format!("{request}\n"));
        running.answers(expected);
    }
    running.ends();
}

fn agrees_in(edition: &'static Edition, program: &Path, shows_everything: bool) {
    let script = script(edition, 5, 3000);
    let mut running = Running::start(program);
    running.shows_everything = shows_everything;
    for (request, expected) in &script {
        running.ask(&format!("{request}\n"));
        running.answers(expected);
    }
    running.ends();

    let mut script = self::script(edition, 6, 20_000);
    script.extend(suite(edition));
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
            running.answers(expected);
        }
    });
    println!("{} steps through the pipe in {:?}, answers read and checked", script.len(), start.elapsed());
    running.ends();
}

/// One that is asked about an edition that there is not says which one it is of.
#[test]
fn the_adapters_say_which_edition_they_are_of() {
    for (language, source) in [(C, adapter()), (CPP, adapter_in_cpp())] {
        let Some(compiler) = compiler(language) else { continue };
        let mut running = Running::start(&built(&compiler, language, &source, Linked::Statically));
        for (request, version) in [
            (r#"{"op":"hello","edition":"2.9"}"#, UNSAID.version),
            (r#"{"op":"hello","edition":"4.0"}"#, "4.0"),
            (r#"{"op":"hello","edition":"an edition with a name that is far too long"}"#, "4.0"),
        ] {
            running.ask(&format!("{request}\n"));
            running.answers(&Expected::Edition(version));
        }
        running.ends();
    }
}

/// What `adsdv conform` does with each of them, in each edition.
#[test]
fn the_adapters_conform_to_every_edition() {
    for (language, source) in [(C, adapter()), (CPP, adapter_in_cpp())] {
        let Some(compiler) = compiler(language) else { continue };
        let program = built(&compiler, language, &source, Linked::Dynamically).into_os_string();
        for &edition in Edition::ALL {
            let options = ConformOptions { runs: 20, ..ConformOptions::of(edition) };
            let mut program = Program::start(&program, &[], LIMIT, false).unwrap();
            let report =
                conform(&mut program, &adsdv_conform::suite::generate(edition), &options, &mut |_| {});
            assert!(report.unwrap().conforms(), "{} in edition {}", source.display(), edition.version);
        }
    }
}

/// A line may come in pieces, and an answer comes as soon as the line is there.
#[test]
fn the_adapter_waits_for_the_rest_of_a_line() {
    let Some(cc) = compiler(C) else { return };
    let mut running = Running::start(&built(&cc, C, &adapter(), Linked::Statically));
    running.ask("{\"op\":\"reset\"}\n{\"op\":\"re");
    running.answers(&Expected::Nothing);
    std::thread::sleep(Duration::from_millis(20));
    running.ask("set\"}\n");
    running.answers(&Expected::Nothing);
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
        let answers = String::from_utf8(stdout).unwrap();
        assert!(!status.success() && answers.starts_with(ABOUT) && answers.lines().count() == 1, "{line}");
        assert!(said.starts_with(expected), "{said}");
    }
}

/// The judge in C++ finds in a log what the judge in Rust finds.
#[test]
fn the_online_judge_agrees_with_the_judge() {
    let Some(cpp) = compiler(CPP) else { return };
    let program = built(&cpp, CPP, &folder().join("examples/online_judge.cpp"), Linked::Statically);
    let default = Edition::DEFAULT.version;
    for (log, edition, args, code) in [
        ("finished-while-moving.log", default, vec![], 1),
        ("mission.log", default, vec![], 0),
        ("finished-while-moving.log", "4.0", vec!["4.0"], 1),
        ("mission.log", "4.0", vec!["4.0"], 0),
    ] {
        let path = folder().join("../tests/logs").join(log);
        let Output { status, stdout, stderr } =
            Command::new(&program).args(args).stdin(std::fs::File::open(&path).unwrap()).output().unwrap();
        assert_eq!((status.code(), String::from_utf8_lossy(&stderr).as_ref()), (Some(code), ""), "{log}");
        let printed = String::from_utf8(stdout).unwrap();

        let judge = JudgeOptions::of(Edition::find(edition).unwrap());
        let options = LogOptions { judge, ..LogOptions::default() };
        let report = judge_log(std::fs::File::open(&path).unwrap(), &options, |_| {}).unwrap();
        let mut expected = count(report.findings.iter().map(|finding| {
            format!(
                "{}.{:06} s  {}  {}  section {}  {}  {}",
                finding.t_ns / 1_000_000_000,
                finding.t_ns / 1000 % 1_000_000,
                finding.severity.name(),
                finding.party.name(),
                finding.section,
                finding.rule.id(),
                finding.message(),
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
    let Output { status, stderr, .. } =
        Command::new(&program).arg("2.9").stdin(Stdio::null()).output().unwrap();
    let said = String::from_utf8(stderr).unwrap();
    assert_eq!(status.code(), Some(2));
    assert!(
        said.starts_with("online_judge: there is no edition \"2.9\"; expected one of 3.0, 4.0"),
        "{said}"
    );
}

/// The recogniser in C tells of a log what the recogniser in Rust tells.
#[test]
fn the_edition_of_a_log_is_recognised_in_c() {
    let Some(cc) = compiler(C) else { return };
    let program = built(&cc, C, &folder().join("examples/recognise.c"), Linked::Statically);
    for log in ["finished-while-moving.log", "mission.log"] {
        let path = folder().join("../tests/logs").join(log);
        let Output { status, stdout, stderr } =
            Command::new(&program).stdin(std::fs::File::open(&path).unwrap()).output().unwrap();
        assert!(status.success() && stderr.is_empty(), "{log}: {}", String::from_utf8_lossy(&stderr));
        let mut recogniser = Recogniser::new(Edition::DEFAULT);
        let mut reader = Reader::new(BufReader::new(std::fs::File::open(&path).unwrap()));
        while let Some(entry) = reader.next_record().unwrap() {
            if let Entry::Frame(record) = entry {
                recogniser.frame(record.time_ns, record.id, record.data);
            }
        }
        let expected = recogniser.recognise();
        assert_eq!(expected.edition.version, "4.0");
        assert_eq!(String::from_utf8(stdout).unwrap(), format!("{expected}\n"));
    }
}

fn adapter() -> std::path::PathBuf {
    folder().join("../conform/examples/adapter.c")
}

fn adapter_in_cpp() -> std::path::PathBuf {
    folder().join("../conform/examples/adapter.cpp")
}

/// How often each line comes; the order is not compared, for a live judge says a thing once it knows it.
fn count(lines: impl Iterator<Item = String>) -> BTreeMap<String, u32> {
    lines.fold(BTreeMap::new(), |mut counts, line| {
        *counts.entry(line).or_default() += 1;
        counts
    })
}

/// What is expected of an answer.
#[derive(Clone, Debug)]
enum Expected {
    /// Nothing: to a reset.
    Nothing,
    /// The edition: to a hello.
    Edition(&'static str),
    Shown(Box<Shown>),
}

/// Requests, and what the specification shows, in an edition that is greeted.
fn script(edition: &'static Edition, seed: u64, steps: u32) -> Vec<(String, Expected)> {
    let (mut run, mut control) = (Run::of(edition, seed), Control::INITIAL);
    let (vcu, protocol) = (Machine::new(*edition, edition.readings), Protocol::of(edition));
    let hello = Request::Hello { edition: edition.version.to_owned() };
    let mut script = vec![
        (hello.to_string(), Expected::Edition(edition.version)),
        (Request::Reset.to_string(), Expected::Nothing),
    ];
    for _ in 0..steps {
        if Run::is_over(&control) {
            control = Control::INITIAL;
            script.push((Request::Reset.to_string(), Expected::Nothing));
        }
        let (dt_ms, inputs) = run.next(&control);
        let (next, outputs) = vcu.step(&control, &inputs, dt_ms);
        let shown = Expected::Shown(Box::new(Shown::of(edition, &outputs, &inputs)));
        script.push((protocol.line(&Request::Step { dt_ms, inputs }).to_string(), shown));
        control = next;
    }
    script
}

/// The whole test suite of an edition.
fn suite(edition: &'static Edition) -> impl Iterator<Item = (String, Expected)> {
    let (vcu, protocol) = (Machine::new(*edition, edition.readings), Protocol::of(edition));
    adsdv_conform::suite::generate(edition).into_iter().flat_map(move |test| {
        let steps = test.scenario.steps.iter().zip(test.scenario.shown(&vcu));
        let steps = steps.map(|(&Step { dt_ms, inputs }, shown)| {
            (protocol.line(&Request::Step { dt_ms, inputs }).to_string(), Expected::Shown(Box::new(shown)))
        });
        let reset = (Request::Reset.to_string(), Expected::Nothing);
        std::iter::once(reset).chain(steps).collect::<Vec<_>>()
    })
}

/// What an adapter says of itself begins so.
const ABOUT: &str = r#"{"outputs":["as_state","handshake","#;

/// The outputs that an adapter says it has, in a line of its own or beside its edition.
fn announced(line: &str) -> Vec<String> {
    let outputs = line.split_once(r#""outputs":["#).and_then(|(_, rest)| rest.split_once(']'));
    let (keys, _) = outputs.unwrap_or_else(|| panic!("no outputs: {line}"));
    keys.split(',').map(|key| key.trim_matches('"').to_owned()).collect()
}

/// A program that is asked and answers.
struct Running {
    child: Child,
    questions: Option<ChildStdin>,
    lines: Option<Receiver<String>>,
    /// Whether every answer has to show all that there is.
    shows_everything: bool,
    /// What its answers may say.
    protocol: Protocol,
    /// The outputs that it says it has.
    outputs: Vec<String>,
}

impl Running {
    fn start(program: &Path) -> Self {
        let mut child = Command::new(program)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        Self {
            questions: child.stdin.take(),
            lines: None,
            shows_everything: true,
            protocol: Protocol::of(UNSAID),
            outputs: Vec::new(),
            child,
        }
    }

    fn ask(&mut self, text: &str) {
        let questions = self.questions.as_mut().unwrap();
        questions.write_all(text.as_bytes()).unwrap();
        questions.flush().unwrap();
    }

    /// The next answer is what was expected.
    fn answers(&mut self, expected: &Expected) {
        let lines = self.lines.get_or_insert_with(|| {
            let (sender, receiver) = channel();
            let answers = BufReader::new(self.child.stdout.take().unwrap());
            std::thread::spawn(move || {
                answers.lines().map_while(Result::ok).try_for_each(|line| sender.send(line))
            });
            receiver
        });
        let mut line: String = lines.recv_timeout(LIMIT).expect("an answer in time");
        // Before its first answer it speaks of itself, once.
        if self.outputs.is_empty() && line.starts_with(ABOUT) {
            self.outputs = announced(&line);
            line = lines.recv_timeout(LIMIT).expect("an answer behind what it says of itself");
        }
        let shown = match expected {
            Expected::Nothing => return assert_eq!(line, "{}"),
            Expected::Edition(version) => {
                self.protocol = Protocol::of(Edition::find(version).unwrap());
                assert!(line.starts_with(&format!("{{\"edition\":\"{version}\"")), "{line}");
                if line.contains("outputs") {
                    self.outputs = announced(&line);
                }
                return;
            }
            Expected::Shown(shown) => shown,
        };
        let answer = self.protocol.answer(&line).unwrap_or_else(|error| panic!("{error}: {line}"));
        let differences: Vec<String> = answer.differences(shown).map(|one| one.to_string()).collect();
        assert!(differences.is_empty(), "{differences:?}: {line}");
        let has = |key: &str| self.outputs.iter().any(|output| output == key);
        let as_announced = shown.iter().all(|(field, _)| answer.has(field.key) == has(field.key));
        assert!(as_announced, "it says that it has {:?}, and shows {line}", self.outputs);
        let missing: Vec<&str> =
            shown.iter().filter(|(field, _)| !answer.has(field.key)).map(|(field, _)| field.key).collect();
        assert!(missing.is_empty() || !self.shows_everything, "it does not show {missing:?}: {line}");
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
