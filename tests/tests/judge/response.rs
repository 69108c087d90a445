//! How fast the AI Computer answers, as the judge measures it on the handshake.

use adsdv_oracle::judge::{JudgeOptions, ResponseTimes};
use adsdv_tests::world::{MS, World};

//= HS-11
#[test]
fn the_response_time_of_the_ai_computer_is_measured() {
    // The simulated AI Computer answers half a cycle after the VCU.
    let mut world = World::reference();
    world.ready();
    world.wait(1000);
    let prompt = world.judge(JudgeOptions::default()).responses;
    assert!(prompt.count() > 50, "{}", prompt.count());
    let half_a_cycle = Some(5.0);
    assert_eq!(
        (prompt.min_ms(), prompt.quantile_ms(0.99), prompt.max_ms()),
        (half_a_cycle, half_a_cycle, half_a_cycle)
    );

    // Once it takes 20 ms longer.
    world.ai_answers = false;
    world.wait(20);
    world.ai_answers = true;
    world.wait(1000);
    let slow = world.judge(JudgeOptions::default()).responses;
    assert_eq!(
        (slow.min_ms(), slow.quantile_ms(0.5), slow.max_ms()),
        (half_a_cycle, half_a_cycle, Some(25.0))
    );
}

#[test]
fn without_any_answer_there_is_no_time() {
    let none = ResponseTimes::default();
    assert_eq!((none.count(), none.min_ms(), none.quantile_ms(0.5), none.max_ms()), (0, None, None, None));
}

/// Quantiles are steps of a hundredth of a millisecond, and never beyond what was measured.
#[test]
fn quantiles_are_those_of_what_was_counted() {
    let mut times = ResponseTimes::default();
    for ms in 1..=100 {
        times.add(ms * MS);
    }
    assert_eq!((times.count(), times.min_ms(), times.max_ms()), (100, Some(1.0), Some(100.0)));
    let quantiles = [0.0, 0.01, 0.5, 0.99, 1.0].map(|share| times.quantile_ms(share));
    assert_eq!(quantiles, [1.0, 1.0, 50.0, 99.0, 100.0].map(Some));

    let mut times = ResponseTimes::default();
    for ns in [4_000_000, 4_007_000, 199_999_000, 700 * MS] {
        times.add(ns);
    }
    let quantiles = [0.25, 0.5, 0.75, 1.0].map(|share| times.quantile_ms(share));
    assert_eq!(quantiles, [4.0, 4.0, 199.99, 700.0].map(Some), "what takes 200 ms and more is one group");
    assert_eq!(times.max_ms(), Some(700.0));
}
