//! The open model in numbers: how large it is under each reading and with parts of the table changed, which steps break a
//! property, and the run to each goal.

use std::fmt::Write as _;

use adsdv_model::{
    Action, Exploration, Options, Report, Run, SHORT_TIMERS, Step, Vectors, explore, goals, properties,
    reachable, story_of,
};
use adsdv_spec::messages::AsState;
use adsdv_spec::{Atoms, Control, Edition, Faults, Machine, Mutation, Observation, Readings};
use expect_test::expect_file;

use crate::chance::Random;
use crate::{SHORT, SHORTENED, lines, verified};

/// The machine under every other reading, and with every so many-th mutation.
fn machines(every: usize) -> impl Iterator<Item = (String, Machine)> {
    let others = Edition::DEFAULT.alternatives();
    let readings = others
        .iter()
        .map(|choice| (choice.to_string(), Machine::new(SHORTENED, Readings::DEFAULT.with(choice))));
    let mutants = Mutation::all(&SHORTENED)
        .step_by(every)
        .map(|mutation| (mutation.to_string(), Machine::new(mutation.apply(&SHORTENED), Readings::DEFAULT)));
    std::iter::once(("the reference".to_owned(), SHORT)).chain(readings).chain(mutants)
}

#[test]
fn the_whole_of_it() {
    let mut text = String::new();
    for (name, machine) in machines(17) {
        let options =
            Options { vectors: Vectors::Few, threads: 1, document: SHORT_TIMERS, ..Options::default() };
        let found = explore(machine, options, |_| {});
        let holds = if found.holds() { "everything holds" } else { "something fails" };
        let Exploration { states, transitions, depth, broken, missed, parts, .. } = found;
        let _ = writeln!(text, "{name}: {states} states, {transitions} transitions, depth {depth}, {holds}");
        for property in broken {
            let _ = writeln!(text, "  breaks {}", property.name);
        }
        for goal in missed {
            let _ = writeln!(text, "  misses {}", goal.name);
        }
        for (part, _) in parts.iter().filter(|(_, decides)| !decides) {
            let _ = writeln!(text, "  never needs {part}");
        }
    }
    expect_file!["open.txt"].assert_eq(&text);
}

const STEPS: u64 = 100_000;

/// Steps of the reference, of those that err, and of VCUs that do anything at all: which properties each breaks.
#[test]
fn the_steps_that_break_a_property() {
    let mut random = Random::with_seed(3);
    let machines: Vec<Machine> = machines(1).map(|(_, machine)| machine).collect();
    let all = reachable(&SHORT, SHORT_TIMERS, Vectors::Few);
    let controls = AsState::ALL.map(|state| {
        let mut of: Vec<Control> = all.iter().copied().filter(|control| control.state == state).collect();
        of.sort_by_cached_key(|control| format!("{control:?}"));
        of
    });
    let one_of = |random: &mut Random| {
        let of = random.one(&controls);
        random.one(of)
    };
    let mut broken: Vec<u32> = properties(Edition::DEFAULT).map(|_| 0).collect();
    for number in 0..STEPS {
        let before = *one_of(&mut random);
        let machine = random.one(&machines);
        let bits = random.bits();
        let atoms = Observation::SCOPE.iter().filter(|atom| bits >> (*atom as u32) & 1 == 1);
        let faults = Edition::DEFAULT.faults.iter().filter(|_| random.one_in(24));
        let faults = faults.fold(Faults::NONE, Faults::with);
        let seen = Observation::new(atoms.fold(Atoms::NONE, Atoms::with), faults);
        let step = Step::of(machine, &SHORT_TIMERS, before, seen);
        let other = *one_of(&mut random);
        let mut after = *step.after();
        match number % 6 {
            0 => after = other,
            1 => after.state = other.state,
            2 => after.handshake = other.handshake,
            3 => after.shutdown_cause = other.shutdown_cause,
            _ => {}
        }
        let step = step.leading_to(after);
        for (count, property) in broken.iter_mut().zip(properties(Edition::DEFAULT)) {
            *count += u32::from(!property.holds(machine, &step));
        }
    }
    let mut text = String::new();
    for (count, property) in broken.iter().zip(properties(Edition::DEFAULT)) {
        let _ = writeln!(text, "{}: {count} of {STEPS}", property.name);
    }
    expect_file!["steps.txt"].assert_eq(&text);
}

/// The run to each goal and, after a power cycle, to the next one.
#[test]
fn the_runs() {
    let Report { runs, .. } = verified(&SHORT);
    let names: Vec<&str> = goals(Edition::DEFAULT).iter().map(|goal| goal.name).collect();
    let mut text = String::new();
    for pair in names.windows(2) {
        let (one, other) = (runs[pair[0]].iter().copied(), runs[pair[1]].iter().copied());
        let run = Run::new(&SHORT, one.chain([Action::PowerCycle]).chain(other)).persisting(100);
        let _ = writeln!(
            text,
            "{}, {}: {} cycles, {} frames",
            pair[0],
            pair[1],
            run.cycles().len(),
            run.frames().count(),
        );
        text += &lines(story_of(&run));
    }
    expect_file!["runs.txt"].assert_eq(&text);
}
