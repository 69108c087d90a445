//! A node on a bus follows the edition that it is given, and its status says which that is.

use adsdv_can::ai::{Ai, Plan};
use adsdv_can::live::{AiComputer, Vcu};
use adsdv_can::status::HappeningKind;
use adsdv_spec::{Edition, Machine, Rules, Timing};

use super::{Bench, count, ms};

/// An edition with a slower cycle, in which an answer to the handshake may take longer.
const SLOW: Edition = Edition {
    version: "test",
    rules: Rules {
        timing: Timing { cycle_ms: 20, handshake_ms: 200, ..Edition::V3_0.rules.timing },
        ..Edition::V3_0.rules
    },
    ..Edition::V3_0
};

fn vcu(bench: &Bench, edition: &Edition) -> Vcu<Bench> {
    Vcu::new(bench.clone(), Machine::new(*edition, edition.readings), None)
}

#[test]
fn the_status_says_the_edition_and_its_limit_for_answers() {
    for (edition, limit) in [(&Edition::V3_0, 50), (&SLOW, 200)] {
        let vcu = vcu(&Bench::new(), edition);
        let ai = AiComputer::new(Bench::new(), Ai::new(edition, Plan::DEFAULT));
        for status in [vcu.status(), ai.status()] {
            assert_eq!((status.edition, status.answer_limit_ms), (edition.version, limit));
        }
    }
}

#[test]
fn the_cycle_is_that_of_the_edition() {
    for (edition, cycles) in [(&Edition::V3_0, 100), (&SLOW, 50)] {
        let (of_vcu, of_ai) = (Bench::new(), Bench::new());
        let mut vcu = vcu(&of_vcu, edition);
        let mut ai = AiComputer::new(of_ai.clone(), Ai::new(edition, Plan::DEFAULT));
        while of_vcu.time() < ms(1000) {
            vcu.turn();
        }
        while of_ai.time() < ms(1000) {
            ai.turn();
        }
        for status in [vcu.status(), ai.status()] {
            assert!(
                status.cycles.count.abs_diff(cycles) <= 1,
                "{}: {}",
                edition.version,
                status.cycles.count
            );
            assert_eq!(count(status, |what| matches!(what, HappeningKind::Late(_))), 0);
        }
    }
}
