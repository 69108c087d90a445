//! How fast a program is judged: by the test suite, through the pipe and in this process.
//!
//! ```text
//! cargo bench -p adsdv-oracle --bench conform
//! ```
//!
//! The throughput shown is in steps ("item/s"). The program behind the pipe is `examples/adapter.rs`; in this process
//! the specification steps itself.

use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;
use std::time::Duration;

use adsdv_conform::protocol::{Shown, UNSAID};
use adsdv_conform::suite::{self, Scenario, Test};
use adsdv_conform::{ConformOptions, InProcess, Program, Reply, Vcu, conform};
use adsdv_spec::{Control, Edition, Machine, Outputs};
use divan::Bencher;
use divan::counter::ItemsCount;

/// The suite is asked for so many times in a row, so that starting the program does not count for much.
const TIMES: usize = 20;

fn main() {
    divan::main();
}

/// Asked and answered through the pipe, every answer read.
#[divan::bench(sample_count = 20)]
fn through_the_pipe(bencher: Bencher) {
    let tests = suite::generate(Edition::DEFAULT);
    let named = repeated(&tests);
    drop(program()); // It is built by now.
    bencher.counter(steps(&named)).bench(|| {
        let mut program = program();
        ask(&mut program, &named)
    });
}

/// The whole of `adsdv conform` without random scenarios, through the pipe.
#[divan::bench(sample_count = 20)]
fn judged_through_the_pipe(bencher: Bencher) {
    let tests = suite::generate(Edition::DEFAULT);
    drop(program()); // It is built by now.
    bencher.counter(steps(&once(&tests))).bench(|| judge(&mut program(), &tests));
}

/// The whole of `adsdv conform` without random scenarios, in this process.
#[divan::bench(sample_count = 20)]
fn judged_in_process(bencher: Bencher) {
    let tests = suite::generate(Edition::DEFAULT);
    bencher.counter(steps(&once(&tests))).bench(|| judge(&mut InProcess(Machine::REFERENCE), &tests));
}

/// Each step made in this process, and its outcome compared with what is expected.
#[divan::bench]
fn in_process(bencher: Bencher) {
    let tests = suite::generate(Edition::DEFAULT);
    let expected: Vec<Vec<(Control, Outputs)>> =
        tests.iter().map(|test| test.scenario.run(&Machine::REFERENCE).collect()).collect();
    bencher.counter(steps(&once(&tests))).bench(|| {
        let right = |(test, expected): (&Test, &Vec<(Control, Outputs)>)| {
            test.scenario.run(&Machine::REFERENCE).eq(expected.iter().copied())
        };
        assert!(tests.iter().zip(&expected).all(right));
    });
}

/// Each step made in this process, and every field of the protocol made and compared.
#[divan::bench]
fn in_process_by_field(bencher: Bencher) {
    let tests = suite::generate(Edition::DEFAULT);
    let expected: Vec<Vec<Shown>> =
        tests.iter().map(|test| test.scenario.shown(&Machine::REFERENCE).collect()).collect();
    bencher.counter(steps(&once(&tests))).bench(|| {
        let right = |(test, expected): (&Test, &Vec<Shown>)| {
            test.scenario.shown(&Machine::REFERENCE).eq(expected.iter().copied())
        };
        assert!(tests.iter().zip(&expected).all(right));
    });
}

fn judge(vcu: &mut dyn Vcu, tests: &[Test]) {
    let options = ConformOptions { runs: 0, ..ConformOptions::default() };
    let report = conform(vcu, tests, &options, &mut |_| {});
    assert!(report.is_ok_and(|report| report.conforms()));
}

fn ask(vcu: &mut dyn Vcu, named: &[(&str, &Scenario)]) -> usize {
    let mut answers = 0;
    vcu.ask(named, &mut |_, replies: &[Reply]| answers += replies.len()).expect("it answers");
    answers
}

fn once(tests: &[Test]) -> Vec<(&str, &Scenario)> {
    tests.iter().map(|test| (test.name.as_str(), &test.scenario)).collect()
}

fn repeated(tests: &[Test]) -> Vec<(&str, &Scenario)> {
    once(tests).repeat(TIMES)
}

fn steps(named: &[(&str, &Scenario)]) -> ItemsCount {
    ItemsCount::new(named.iter().map(|(_, scenario)| scenario.steps.len()).sum::<usize>())
}

/// The adapter, built once as benchmarks are.
fn program() -> Program {
    static ADAPTER: OnceLock<PathBuf> = OnceLock::new();
    let path = ADAPTER.get_or_init(|| {
        // This benchmark is DIR/release/deps/conform-...
        let bench = std::env::current_exe().expect("a path");
        let profile = bench.parent().and_then(|deps| deps.parent()).expect("a folder of cargo");
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let built = Command::new(cargo)
            .args(["build", "--quiet", "--release", "--example", "adapter", "--target-dir"])
            .arg(profile.parent().expect("a folder of cargo"))
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .status();
        assert!(built.is_ok_and(|status| status.success()), "the adapter can be built");
        profile.join("examples/adapter")
    });
    let program = Program::start(&path.clone().into_os_string(), &[], Duration::from_secs(5), false);
    let mut program = program.expect("it starts");
    program.hello(UNSAID).expect("it says something of itself, and is reset");
    program
}
