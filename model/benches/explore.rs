//! How fast the models are explored: each line gives steps per second.
//!
//! `scripts/compare-spin.sh` states the same beside Spin, in the same run. `plain` is what a program without a model checker
//! needs that makes the same steps: a search that keeps no paths, asks for no properties and has one thread.

use adsdv_model::closed::{Closed, Operator};
use adsdv_model::{Options, Vectors, explore, reachable};
use adsdv_spec::{Edition, Machine};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};

fn main() {
    divan::main();
}

fn steps(vectors: Vectors) -> u64 {
    explore(Machine::REFERENCE, Options { vectors, ..Options::default() }, |_| {}).transitions
}

/// The open model with the real times, on one thread and on two.
#[divan::bench(args = [(Vectors::Read, 1), (Vectors::Read, 2), (Vectors::Few, 1), (Vectors::Few, 2)], sample_count = 5)]
fn open(bencher: Bencher<'_, '_>, (vectors, threads): (Vectors, usize)) {
    let options = Options { vectors, threads, ..Options::default() };
    bencher
        .counter(ItemsCount::new(steps(vectors)))
        .bench(|| explore(black_box(Machine::REFERENCE), options, |_| {}));
}

/// Every input vector: this one takes long.
#[divan::bench(args = [1, 2], sample_count = 1, sample_size = 1)]
fn open_every_vector(bencher: Bencher<'_, '_>, threads: usize) {
    let options = Options { threads, ..Options::default() };
    bencher
        .counter(ItemsCount::new(steps(Vectors::Every)))
        .bench(|| explore(black_box(Machine::REFERENCE), options, |_| {}));
}

/// The same control states by a plain search.
#[divan::bench(sample_count = 5)]
fn plain(bencher: Bencher<'_, '_>) {
    bencher
        .counter(ItemsCount::new(steps(Vectors::Read)))
        .bench(|| reachable(black_box(&Machine::REFERENCE), Edition::DEFAULT.rules.timing, Vectors::Read));
}

/// The closed model with the real times and a well-behaved operator.
#[divan::bench(sample_count = 5)]
fn closed_well_behaved(bencher: Bencher<'_, '_>) {
    let model = || Closed::new(Machine::REFERENCE, Operator::WellBehaved);
    let steps = model().explore(1).transitions;
    bencher.counter(ItemsCount::new(steps)).bench(|| black_box(model()).explore(1));
}
