//! How fast a program in C is judged through the pipe: the adapter of `adsdv conform`, with the whole test suite.
//!
//! ```text
//! cargo bench -p adsdv-ffi --bench pipe
//! ```
//!
//! "item/s" are steps. Without a C compiler there is nothing to measure.

// What compiles the examples for the tests, some of which is not needed here.
#[allow(dead_code)]
#[path = "../tests/c/compile.rs"]
mod compile;

use std::path::PathBuf;
use std::sync::OnceLock;
use std::time::Duration;

use adsdv_conform::protocol::UNSAID;
use adsdv_conform::suite::{self, Scenario, Test};
use adsdv_conform::{ConformOptions, Program, Vcu, conform};
use adsdv_spec::Edition;
use divan::Bencher;
use divan::counter::ItemsCount;

use compile::{C, Linked, built, compiler, folder};

/// The suite is asked for so many times in a row, so that starting the program does not count for much.
const TIMES: usize = 20;

fn main() {
    if compiler(C).is_some() {
        divan::main();
    }
}

/// Asked and answered, every answer read.
#[divan::bench(sample_count = 20)]
fn asked(bencher: Bencher) {
    let tests = suite::generate(Edition::DEFAULT);
    let once: Vec<(&str, &Scenario)> =
        tests.iter().map(|test| (test.name.as_str(), &test.scenario)).collect();
    let named = once.repeat(TIMES);
    drop(adapter()); // It is built by now.
    bencher.counter(ItemsCount::new(TIMES * steps(&tests))).bench(|| {
        let mut answers = 0;
        adapter().ask(&named, &mut |_, replies| answers += replies.len()).expect("it answers");
        answers
    });
}

/// The whole of `adsdv conform` without random scenarios: started, asked once, and judged under every reading.
#[divan::bench(sample_count = 20)]
fn judged(bencher: Bencher) {
    let tests = suite::generate(Edition::DEFAULT);
    drop(adapter()); // It is built by now.
    bencher.counter(ItemsCount::new(steps(&tests))).bench(|| {
        let options = ConformOptions { runs: 0, ..ConformOptions::default() };
        let report = conform(&mut adapter(), &tests, &options, &mut |_| {}).expect("it answers");
        assert!(report.conforms());
    });
}

fn steps(tests: &[Test]) -> usize {
    tests.iter().map(|test| test.scenario.steps.len()).sum()
}

/// The adapter in C, built once.
fn adapter() -> Program {
    static ADAPTER: OnceLock<PathBuf> = OnceLock::new();
    let path = ADAPTER.get_or_init(|| {
        let cc = compiler(C).expect("a C compiler");
        built(&cc, C, &folder().join("../conform/examples/adapter.c"), Linked::Statically)
    });
    let program = Program::start(&path.clone().into_os_string(), &[], Duration::from_secs(5), false);
    let mut program = program.expect("it starts");
    program.hello(UNSAID).expect("it says something of itself, and is reset");
    program
}
