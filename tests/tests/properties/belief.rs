//! What may be known of a step, and what it comes to: the fuzzer's body `belief`, on random choices.

use std::cell::RefCell;
use std::collections::BTreeSet;

use adsdv_spec::Edition;
use adsdv_tests::fuzzed::belief::walk;
use proptest::collection::vec;
use proptest::prelude::any;

use crate::holds::{holds, regressions};

/// How many walks are tried.
const CASES: u32 = 10_000;

/// So many bytes are choices enough for some steps.
const BYTES: usize = 2000;

/// A step on what may be allows what the step comes to, is exact where all is known, and knows no more where less is known; for
/// each edition, each arrow out of a state is taken on the way.
#[test]
fn what_a_step_comes_to_is_allowed_by_what_was_known_of_it() {
    let taken = RefCell::new(BTreeSet::new());
    holds(
        CASES,
        regressions!("belief"),
        &vec(any::<u8>(), 1..BYTES),
        |bytes| {
            let arrows = walk(bytes)?;
            taken.borrow_mut().extend(arrows.into_iter().map(|(version, taken)| (version, taken.row)));
            Ok(())
        },
        |bytes| format!("{bytes:?}"),
    );
    let rows = |edition: &&'static Edition| {
        let rows = 0..u8::try_from(edition.rules.table.rows().len()).unwrap();
        rows.map(|row| (edition.version, row)).collect::<Vec<_>>()
    };
    let expected: BTreeSet<_> = Edition::ALL.iter().flat_map(rows).collect();
    assert_eq!(taken.into_inner(), expected, "the rows whose arrow is taken");
}
