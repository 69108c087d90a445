//! `conform`, by any edition, against a VCU that answers whatever it likes; and against one that is right under some readings.

use std::sync::LazyLock;
use std::time::Duration;

use adsdv_conform::protocol::{About, Answer, Protocol, SHOWN, Shown};
use adsdv_conform::suite::{self, Scenario, Test};
use adsdv_conform::{
    ConformOptions, ConformReport, InProcess, Outcome, ProgramError, ProgramErrorKind, Reply, Vcu, conform,
};
use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{Control, Edition, Fault, Machine, Mutation};

use super::Bytes;
use crate::world::Chance;

/// An edition, and what is asked of its VCUs.
struct Asked {
    edition: &'static Edition,
    tests: Vec<Test>,
    mutations: Vec<Mutation>,
}

static ASKED: LazyLock<Vec<Asked>> = LazyLock::new(|| {
    let of = |&edition| Asked {
        edition,
        tests: suite::generate(edition),
        mutations: Mutation::all(edition).collect(),
    };
    Edition::ALL.iter().map(of).collect()
});

/// A run has at most so many tests.
const TESTS_OF_A_RUN: u64 = 4;

/// After so many steps the VCU has gone: what is asked of it does not grow without end.
const STEPS: u64 = 2_000_000;

/// The body.
pub fn body(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let of = bytes.edition().version;
    let Asked { edition, tests: all, mutations } =
        ASKED.iter().find(|asked| asked.edition.version == of).expect("every edition is asked");
    let readings = bytes.readings(edition);
    let honest = bytes.one_in(3);
    let tests: Vec<Test> = {
        let count = 1 + bytes.below(TESTS_OF_A_RUN);
        let mut places: Vec<u64> = (0..count).map(|_| bytes.below(all.len() as u64)).collect();
        places.sort_unstable();
        places.dedup();
        places.iter().filter_map(|&place| all.get(usize::try_from(place).ok()?)).cloned().collect()
    };
    let mut options = ConformOptions {
        latency: usize::try_from(bytes.pick(&[0, 0, 0, 1])).unwrap_or(0),
        cycle_ms: bytes.pick(&[None, None, None, Some(10)]),
        seed: bytes.any(),
        runs: bytes.pick(&[0, 0, 0, 1]),
        // As a rule nothing is made shorter: how far that goes depends on the clock.
        shrinking: Duration::from_millis(if bytes.one_in(8) { 50 } else { 0 }),
        possible: if bytes.one_in(4) { readings.choices() } else { edition.choices },
        ..ConformOptions::of(edition)
    };
    options.strict = options.seed % 2 == 1;
    if honest {
        right(&Machine::new(**edition, readings), &tests, &options);
    } else {
        let machine = match bytes.below(3) {
            0 => Machine::new(**edition, readings),
            1 => Machine::new(bytes.pick(mutations).apply(edition), readings),
            _ => Machine::new(**edition, edition.readings),
        };
        let late = usize::try_from(bytes.pick(&[0, 0, 1, 2])).unwrap_or(0);
        let mut liar = Liar { machine, late, bytes, steps: 0 };
        match conform(&mut liar, &tests, &options, &mut |_| {}) {
            Ok(report) => sound(&report, &tests, &options),
            Err(trouble) => readable(&trouble),
        }
    }
}

/// The reference under any readings conforms, whatever it is asked, and the judge finds out nothing else of it.
fn right(machine: &Machine, tests: &[Test], options: &ConformOptions) {
    let report = conform(&mut InProcess(*machine), tests, options, &mut |_| {}).expect("it answers");
    let (of, readings) = (machine.edition().version, machine.readings());
    assert!(report.conforms(), "{of}, {readings}: {:#?}", report.failures);
    assert_eq!((report.failed_tests, report.failed_runs, report.late), (0, 0, 0));
    assert!(
        report
            .requirements
            .iter()
            .all(|requirement| !matches!(requirement.outcome, Outcome::Fail | Outcome::Differs))
    );
    sound(&report, tests, options);
}

/// What holds of each report.
fn sound(report: &ConformReport, tests: &[Test], options: &ConformOptions) {
    assert_eq!(report.tests + report.not_run.len(), tests.len());
    assert!(report.failed_tests <= report.tests && report.failed_runs <= report.runs);
    assert_eq!(report.runs, options.runs);
    assert!(report.late <= options.latency);
    let fails = report.failed_tests > 0 || report.failed_runs > 0;
    assert_eq!(report.conforms(), !fails, "{} tests, {} runs", report.failed_tests, report.failed_runs);
    for failure in &report.failures {
        let timeline = failure.timeline();
        assert!(timeline.is_sorted_by_key(|moment| moment.first));
        // A VCU that is right when it is asked again leaves nothing to show.
        if let Some(found) = &failure.found {
            assert_eq!(failure.scenario.steps.len(), failure.replies.len());
            assert!(!timeline.is_empty());
            assert!(found.about <= found.step && found.step < failure.replies.len());
            assert!(!format!("{found:?}").is_empty());
        }
    }
    for requirement in &report.requirements {
        assert!(requirement.checked <= requirement.tests);
        let broken = matches!(requirement.outcome, Outcome::Fail | Outcome::Differs);
        assert!(broken || requirement.failed.is_empty(), "{requirement:?}");
        assert!(requirement.outcome != Outcome::Differs || !options.strict, "{requirement:?}");
    }
    assert!(report.not_shown.iter().all(|key| SHOWN.iter().any(|field| field.key == *key)));
}

fn readable(trouble: &ProgramError) {
    let text = trouble.to_string();
    assert!(!text.is_empty() && !trouble.hint().is_empty());
    assert!(text.lines().all(|line| !line.contains(|c: char| c.is_control())), "{text:?}");
}

/// A VCU that lies now and then.
struct Liar<'a> {
    machine: Machine,
    late: usize,
    bytes: Bytes<'a>,
    steps: u64,
}

impl Liar<'_> {
    fn reply(&mut self, right: &Shown) -> Result<Reply, ProgramError> {
        self.steps += 1;
        let gone = |what| Err(ProgramError { place: None, what, stderr: vec!["gone".to_owned()] });
        if self.steps > STEPS {
            return gone(ProgramErrorKind::Closed);
        }
        if !self.bytes.are_left() || !self.bytes.one_in(16) {
            return Ok((*right).into());
        }
        match self.bytes.below(8) {
            0 => Ok(Reply::Nothing),
            1 => gone(ProgramErrorKind::Ended("exit status 3".to_owned())),
            2 | 3 => Ok(Reply::Answer(self.partly(right))),
            _ => Ok(Reply::Answer(self.lie(right))),
        }
    }

    /// A field shows something else.
    fn lie(&mut self, right: &Shown) -> Answer {
        let mut line: serde_json::Map<String, serde_json::Value> =
            serde_json::from_str(&right.to_string()).expect("what is shown is an object");
        let field = self.bytes.pick(&SHOWN);
        let edition = self.machine.edition();
        let mut control = self.bytes.0.arbitrary().unwrap_or(Control::INITIAL);
        // What this edition has no fault for was never the cause.
        if Fault::of_cause(control.shutdown_cause).is_some_and(|fault| !edition.faults.has(fault)) {
            control.shutdown_cause = ShutdownCause::NoShutdown;
        }
        let (_, outputs) = self.machine.step(&control, &self.bytes.any(), self.bytes.any());
        let other = Shown::of(edition, &outputs, &self.bytes.any());
        let other: serde_json::Map<String, serde_json::Value> =
            serde_json::from_str(&other.to_string()).expect("what is shown is an object");
        if let Some(value) = other.get(field.key) {
            line.insert(field.key.to_owned(), value.clone());
        }
        answer(&Protocol::of(self.machine.edition()), &line)
    }

    /// Some fields are left out.
    fn partly(&mut self, right: &Shown) -> Answer {
        let mut line: serde_json::Map<String, serde_json::Value> =
            serde_json::from_str(&right.to_string()).expect("what is shown is an object");
        let kept: u64 = self.bytes.any();
        for (place, field) in SHOWN.iter().enumerate() {
            if field.key != "as_state" && kept >> (place % 64) & 1 == 0 {
                line.remove(field.key);
            }
        }
        answer(&Protocol::of(self.machine.edition()), &line)
    }
}

fn answer(protocol: &Protocol, line: &serde_json::Map<String, serde_json::Value>) -> Answer {
    let line = serde_json::Value::from(line.clone()).to_string();
    protocol.answer(&line).expect("each value is one of its field's")
}

impl Vcu for Liar<'_> {
    fn hello(&mut self, edition: &Edition) -> Result<About, ProgramError> {
        InProcess(self.machine).hello(edition)
    }

    fn ask(
        &mut self,
        scenarios: &[(&str, &Scenario)],
        answered: &mut dyn FnMut(usize, &[Reply]),
    ) -> Result<(), ProgramError> {
        for (place, (_, scenario)) in scenarios.iter().enumerate() {
            let machine = self.machine;
            let shown: Vec<Shown> = scenario.shown(&machine).collect();
            let mut replies = Vec::with_capacity(shown.len());
            for step in 0..shown.len() {
                let reply = match step.checked_sub(self.late).and_then(|step| shown.get(step)) {
                    Some(right) => self.reply(right)?,
                    None => Reply::Nothing,
                };
                replies.push(reply);
            }
            answered(place, &replies);
        }
        Ok(())
    }

    fn end(&mut self) -> Result<Vec<String>, ProgramError> {
        if self.bytes.one_in(16) {
            return Err(ProgramError {
                place: None,
                what: ProgramErrorKind::TooMany("{}".to_owned()),
                stderr: Vec::new(),
            });
        }
        Ok(Vec::new())
    }
}
