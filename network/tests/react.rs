//! The network is `Machine::react`, lane by lane: in every edition, with every answer, and for each mutant of its table.

use std::collections::{BTreeMap, BTreeSet};

use adsdv_network::{Key, LANES, Network, Planes};
use adsdv_spec::{
    Atom, Atoms, Choice, Control, Edition, Faults, Machine, Mutation, Observation, Readings, Timing,
};

/// Timers that end within a walk.
const SHORT_MS: u16 = 30;

/// An edition with these timers, so that walks of a few steps go everywhere.
fn short(edition: &Edition) -> Edition {
    let timing = Timing { ready_dwell_ms: SHORT_MS, ebs_timer_ms: SHORT_MS, ..edition.rules.timing };
    edition.with_timing(timing)
}

/// Every edition with its default answers, with each other answer alone, and with all of them that go together at once.
fn machines() -> impl Iterator<Item = Machine> {
    Edition::ALL.iter().flat_map(|edition| {
        let others: Vec<Choice> = edition.alternatives().iter().collect();
        let all = others.iter().fold(edition.readings, |readings, &choice| readings.with(choice));
        let alone = others.into_iter().map(|choice| edition.readings.with(choice));
        let readings: Vec<_> = alone.chain([edition.readings, all]).collect();
        readings.into_iter().map(|readings| Machine::new(short(edition), readings))
    })
}

/// Each mutant of each edition, with its default answers, with all others at once.
fn mutants() -> impl Iterator<Item = Machine> {
    Edition::ALL.iter().flat_map(|edition| {
        let others = edition.alternatives().iter().fold(edition.readings, Readings::with);
        Mutation::all(edition).flat_map(move |mutation| {
            let mutant = mutation.apply(&short(edition));
            [edition.readings, others].map(|readings| Machine::new(mutant, readings))
        })
    })
}

/// Observations by chance: near to what a mission shows, so that it goes on, or anything.
struct Chance(fastrand::Rng);

impl Chance {
    fn seen(&mut self) -> Observation {
        let random = &mut self.0;
        let any = Atoms::from_bits(random.u32(..) & Atoms::ALL.bits()).expect("only atoms");
        let usual = Atoms::of(&[
            Atom::Asms,
            Atom::Tsms,
            Atom::AmiSelected,
            Atom::MissionSelected,
            Atom::EbsArmed,
            Atom::FrontTorqueZero,
            Atom::RearTorqueZero,
            Atom::BrakeRequestZero,
            Atom::SteerRequestZero,
            Atom::SteerStraight,
            Atom::DirectionNeutral,
        ]);
        let rarely = Atoms::from_bits(random.u32(..) & random.u32(..) & random.u32(..) & Atoms::ALL.bits());
        let atoms = match random.u8(0..8) {
            0 => any,
            1 | 2 => usual.with(Atom::GoOn),
            3 => usual.with(Atom::MissionFinished).with(Atom::AtRest),
            _ => Atoms::from_bits(usual.bits() ^ rarely.expect("only atoms").bits()).expect("only atoms"),
        };
        let faults =
            if random.u8(0..3) == 0 { random.u16(..) & random.u16(..) & Faults::ALL.bits() } else { 0 };
        let answers = if random.bool() { atoms.with(Atom::AiHandshake) } else { atoms };
        Observation::new(answers, Faults::from_bits(faults).expect("only faults"))
    }

    /// A word, now and then one that is not full, and one whose lanes differ in little.
    fn word(&mut self) -> Vec<Observation> {
        let lanes = if self.0.u8(0..8) == 0 { self.0.usize(1..=LANES) } else { LANES };
        (0..lanes).map(|_| self.seen()).collect()
    }
}

/// Some control states that a machine reaches, the first among them.
fn reached(machine: &Machine, chance: &mut Chance, walks: usize) -> BTreeSet<Control> {
    let mut all = BTreeSet::from([Control::INITIAL]);
    for _ in 0..walks {
        let mut control = Control::INITIAL;
        for _ in 0..24 {
            control = machine.react(&control, chance.seen(), 10).control;
            all.insert(control);
        }
    }
    all
}

/// Holds one word against a reaction for each lane; what comes to the same is remembered by its key.
fn check(
    network: &Network,
    control: &Control,
    dt_ms: u32,
    word: &[Observation],
    by_key: &mut BTreeMap<Key, Control>,
) {
    let (machine, planes, wired) = (network.machine(), Planes::of(word), network.at(control, dt_ms));
    let guarded = wired.guarded(&planes);
    let mut keys = [None; LANES];
    wired.groups(&planes, |key, lanes| {
        assert!(lanes & !planes.lanes() == 0 && lanes != 0, "only lanes that are there");
        for (lane, of) in keys.iter_mut().enumerate().filter(|(lane, _)| lanes >> lane & 1 == 1) {
            assert_eq!(of.replace(key), None, "lane {lane} is in two groups");
        }
    });
    for (lane, &seen) in word.iter().enumerate() {
        let has = |plane: u64| plane >> lane & 1 == 1;
        let reaction = machine.react(control, seen, dt_ms);
        let atoms = Atom::ALL.iter().filter(|&&atom| has(guarded.atom(atom)));
        let about = || format!("{control:?} {seen:?} {reaction:?}");
        assert_eq!(planes.seen(lane), seen);
        assert_eq!(atoms.fold(Atoms::NONE, |all, &atom| all.with(atom)), reaction.atoms, "{}", about());
        let taken = wired.arrows(&guarded).find(|(_, lanes)| has(*lanes)).map(|(gate, _)| gate.taken);
        assert_eq!(taken, reaction.taken, "{}", about());
        let handshake =
            wired.handshakes(&guarded).find(|(_, lanes)| has(*lanes)).map(|(handshake, _)| handshake);
        assert_eq!(handshake, Some(reaction.control.handshake), "{}", about());
        let key = keys[lane].expect("each lane is in a group");
        assert_eq!(key.to(), reaction.control.state, "{}", about());
        let same = *by_key.entry(key).or_insert(reaction.control);
        assert_eq!(same, reaction.control, "the same key, {}", about());
    }
}

/// Holds the network of a machine against it; how many control states that took.
fn hold(machine: &Machine, walks: usize, words: usize) -> usize {
    let (network, mut chance) = (Network::new(machine), Chance(fastrand::Rng::with_seed(1)));
    let states = reached(machine, &mut chance, walks);
    for control in &states {
        let mut by_key = BTreeMap::new();
        for _ in 0..words {
            check(&network, control, 10, &chance.word(), &mut by_key);
        }
    }
    states.len()
}

#[test]
fn each_lane_is_a_reaction_in_every_edition_with_every_answer() {
    let states: usize = machines().map(|machine| hold(&machine, 200, 4)).sum();
    assert!(states > 10_000, "{states}");
}

#[test]
fn each_lane_is_a_reaction_of_each_mutant() {
    let states: usize = mutants().map(|machine| hold(&machine, 20, 2)).sum();
    assert!(states > 10_000, "{states}");
}

/// Also after any time, and from control states that no run comes to.
#[test]
fn each_lane_is_a_reaction_from_any_control_state() {
    let mut chance = Chance(fastrand::Rng::with_seed(2));
    let all: Vec<Control> = machines().flat_map(|machine| reached(&machine, &mut chance, 5)).collect();
    for machine in machines() {
        let network = Network::new(&machine);
        for control in all.iter().step_by(97) {
            let dt_ms = *chance.0.choice(&[0, 1, 10, 49, 50, 100, 5_000, u32::MAX]).expect("one of them");
            check(&network, control, dt_ms, &chance.word(), &mut BTreeMap::new());
        }
    }
}
