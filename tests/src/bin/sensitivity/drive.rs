//! Missions of a VCU, on the simulated bus.

use adsdv_spec::{Choices, Edition, Machine};
use adsdv_tests::world::{Chance, Random, World, any_readings};

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

/// Ways on which it shows what is remembered, for VCUs that remember something otherwise.
const TO_REMEMBER: [fn(&mut World); 3] = [
    // Twice in AS_READY, each time for less than the time that counts.
    |world| {
        world.ready();
        world.wait(3000);
        world.inputs.asms = false;
        world.wait(500);
        world.inputs.asms = true;
        world.wait(3000);
        world.inputs.go = true;
        world.wait(500);
    },
    // "Go" is on before it counts.
    |world| {
        world.ready();
        world.inputs.go = true;
        world.wait(7000);
    },
    // The AI Computer is gone for a while, and comes back.
    |world| {
        world.stopped();
        world.ai_answers = false;
        world.wait(500);
        world.ai_answers = true;
        world.wait(500);
    },
];

/// So many runs in which anything is done behind a route.
const RANDOM: u64 = 36;

/// All routes, and runs in which anything is done, in a world with this VCU; `remembers`: those on which that shows as well.
pub(crate) fn missions(edition: &Edition, vcu: &World, remembers: bool) -> Vec<Run> {
    let besides = if remembers { &TO_REMEMBER[..] } else { &[] };
    let routes = ROUTES.iter().chain(besides).map(|route| {
        let mut world = vcu.clone();
        route(&mut world);
        world
    });
    let random = (0..RANDOM).map(|seed| anything(vcu.clone(), edition, seed, 600));
    let runs = routes.chain(random).zip(0..);
    let specification = Machine::new(*edition, edition.readings);
    let run = |(world, seed): (World, u64)| {
        let differs_at = world.differs_at(&specification);
        Run { differs_at, world, seed, readings: edition.readings.choices(), cut: 0 }
    };
    runs.map(run).collect()
}

/// A run of the specification's VCU under any readings, of which the judge knows in half of all runs. Half of the recordings begin
/// in mid-run.
pub(crate) fn any_run(edition: &Edition, seed: u64) -> Run {
    let mut random = Random::with_seed(!seed);
    let readings = any_readings(&mut random, edition);
    let pinned = random.one_in(2);
    let cut = if random.one_in(2) { usize::try_from(random.below(50)).unwrap_or(0) } else { 0 };
    let world = anything(World::new(Machine::new(*edition, readings)), edition, seed, 400);
    let readings = if pinned { world.vcu.readings().choices() } else { edition.choices };
    Run { world, differs_at: None, seed, readings, cut }
}

fn anything(mut world: World, edition: &Edition, seed: u64, cycles: u32) -> World {
    let mut random = Random::with_seed(seed);
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
