//! How fast the AI Computer answers, as the judge measures it on the handshake.

use adsdv_oracle::judge::Options;
use adsdv_tests::world::World;

//= HS-11
#[test]
fn the_response_time_of_the_ai_computer_is_measured() {
    // The simulated AI Computer answers half a cycle after the VCU.
    let mut world = World::reference();
    world.ready();
    world.wait(1000);
    let prompt = world.judge(Options::default()).responses;
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
    let slow = world.judge(Options::default()).responses;
    assert_eq!(
        (slow.min_ms(), slow.quantile_ms(0.5), slow.max_ms()),
        (half_a_cycle, half_a_cycle, Some(25.0))
    );
}
