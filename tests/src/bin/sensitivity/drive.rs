//! Missions of a VCU, on the simulated bus.

use adsdv_spec::{Choices, Edition, Machine};
use adsdv_tests::world::{Chance, MS, Random, World, any_readings};

/// A run, and when the VCU first did something that the specification does not.
pub(crate) struct Run {
    pub(crate) world: World,
    pub(crate) differs_at: Option<i64>,
    pub(crate) seed: u64,
    /// The readings that the judge allows for.
    pub(crate) readings: Choices,
    /// How much of the recording is missing at its beginning, in hundredths.
    pub(crate) cut: usize,
}

/// Ways through Figure 2.
const ROUTES: [fn(&mut World); 5] = [
    World::finished,
    World::after_emergency,
    |world| {
        world.dwelt();
        world.inputs.asms = false;
        world.wait(500);
    },
    |world| {
        world.finished();
        world.inputs.asms = false;
        world.wait(500);
    },
    World::driving,
];

/// So many runs in which anything is done behind a route.
const RANDOM: u64 = 36;

/// All routes, and runs in which anything is done.
pub(crate) fn missions(edition: &Edition, vcu: &Edition) -> Vec<Run> {
    let world = || World::new(Machine::new(*vcu, edition.readings));
    let routes = ROUTES.iter().map(|route| {
        let mut world = world();
        route(&mut world);
        world
    });
    let random = (0..RANDOM).map(|seed| anything(world(), edition, seed, 600));
    let runs = routes.chain(random).zip(0..);
    let run = |(world, seed)| {
        let differs_at = first_difference(&world, edition);
        Run { differs_at, world, seed, readings: edition.readings.choices(), cut: 0 }
    };
    runs.map(run).collect()
}

/// A run of the specification's VCU under any readings, of which the judge knows in half of all runs. Half of the recordings begin
/// in mid-run.
pub(crate) fn any_run(edition: &Edition, seed: u64) -> Run {
    let mut random = Random(!seed);
    let readings = any_readings(&mut random, edition);
    let pinned = random.one_in(2);
    let cut = if random.one_in(2) { usize::try_from(random.below(50)).unwrap_or(0) } else { 0 };
    let world = anything(World::new(Machine::new(*edition, readings)), edition, seed, 400);
    let readings = if pinned { world.vcu.readings().choices() } else { edition.choices };
    Run { world, differs_at: None, seed, readings, cut }
}

fn anything(mut world: World, edition: &Edition, seed: u64, cycles: u32) -> World {
    let mut random = Random(seed);
    let rate = random.pick(&[3, 20, 60, 150]);
    world.sets_out(&mut random);
    for _ in 0..cycles {
        if random.one_in(rate) {
            world.anything(&mut random);
        }
        if edition.rules.thresholds.missed_ms.is_some() && random.one_in(rate * 2) {
            world.anything_newer(&mut random);
        }
        if random.one_in(rate * 20) {
            world.ebs_changes(&mut random);
        }
        world.cycle();
    }
    world
}

/// When the VCU first did what the specification would not have, from the same memory and the same inputs.
fn first_difference(world: &World, edition: &Edition) -> Option<i64> {
    let specification = Machine::new(*edition, edition.readings);
    let cycle = i64::from(edition.rules.timing.cycle_ms) * MS;
    let mut steps = world.steps.iter().zip(0_i64..);
    steps.find_map(|((control, inputs), step)| {
        let dt_ms = edition.rules.timing.cycle_ms.into();
        let differs =
            specification.step(control, inputs, dt_ms).0 != world.vcu.step(control, inputs, dt_ms).0;
        differs.then_some(step * cycle)
    })
}
