//! The generators of random values make every value that there is, and none that there is not.

use adsdv_spec::Edition;
use adsdv_spec::messages::{Frame, Node};
use adsdv_spec::{
    Actuation, AsState, Assi, Atom, Atoms, Choice, Choices, Control, Fault, Faults, Handshake, Inputs,
    Knowledge, Observation, Outputs, Reading, Readings, Taken, Truth, VcuMessages,
};
use std::collections::HashSet;
use std::fmt::Debug;
use std::hash::Hash;

/// How many values are made of each type.
const TIMES: usize = 2_000;

/// Whether as many different values came as there are.
fn assert_all<T: Eq + Hash + Debug>(values: &[T], count: usize) {
    let different: HashSet<_> = values.iter().collect();
    assert_eq!(different.len(), count, "{different:?}");
}

/// Both states of each element come up, so that no set is left out by half.
macro_rules! assert_elements {
    ($sets:expr, $element:ident) => {{
        let sets = $sets;
        for &element in $element::ALL {
            assert!(sets.iter().any(|set| set.has(element)), "never {element}");
            assert!(sets.iter().any(|set| !set.has(element)), "always {element}");
        }
    }};
}

fn check_frames(frames: &[Frame]) {
    assert!(frames.iter().all(Frame::is_valid));
    for len in 0..=8 {
        assert!(frames.iter().any(|frame| frame.len == len && frame.data().iter().all(|&byte| byte != 0)));
    }
}

fn check_knowledge(all: &[Knowledge]) {
    assert!(all.iter().all(|known| known.on().intersection(known.off()).is_empty()));
    for &atom in Atom::ALL {
        for truth in [Truth::False, Truth::Unknown, Truth::True] {
            assert!(all.iter().any(|known| known.of(atom) == truth), "{atom} is never {truth}");
        }
    }
}

fn check_observations(all: &[Observation]) {
    assert!(all.iter().all(|seen| Observation::new(seen.atoms(), seen.faults()) == *seen));
    for atom in Observation::SCOPE.iter() {
        assert!(all.iter().any(|seen| seen.atoms().has(atom)), "never {atom}");
        assert!(all.iter().any(|seen| !seen.atoms().has(atom)), "always {atom}");
    }
}

fn check_readings(all: &[Readings]) {
    for readings in all {
        assert_eq!(readings.choices().iter().count(), Reading::ALL.len(), "{readings:?}");
        for &reading in Reading::ALL {
            assert_eq!(readings.choices().of_reading(reading).count(), 1, "{readings:?}");
        }
    }
    assert_elements!(all.iter().map(|readings| readings.choices()).collect::<Vec<_>>(), Choice);
}

fn check_controls(all: &[Control]) {
    for state in AsState::ALL {
        assert!(all.iter().any(|control| control.state == state), "never {state}");
    }
    assert!(all.iter().any(|control| control.handshake.bit && control.power_cycle_needed));
}

/// Checks what `$make`, a function from a type to many values of it, makes of each type.
macro_rules! check {
    ($make:ident) => {
        assert_all(&$make::<Atom>(), Atom::ALL.len());
        assert_all(&$make::<Fault>(), Fault::ALL.len());
        assert_all(&$make::<Reading>(), Reading::ALL.len());
        assert_all(&$make::<Choice>(), Choice::ALL.len());
        assert_all(&$make::<Truth>(), 3);
        assert_all(&$make::<Assi>(), AsState::ALL.len());
        assert_all(&$make::<Node>(), 2);
        assert_elements!($make::<Atoms>(), Atom);
        assert_elements!($make::<Faults>(), Fault);
        assert_elements!($make::<Choices>(), Choice);
        check_readings(&$make());
        check_knowledge(&$make());
        check_observations(&$make());
        check_controls(&$make());
        check_frames(&$make());
        assert!($make::<Handshake>().iter().any(|handshake| handshake.unanswered_ms > 0));
        assert!($make::<Inputs>().iter().any(|inputs| inputs.ai.status.handshake));
        assert!($make::<Taken>().iter().any(|taken| taken.row != taken.term));
        assert!($make::<Outputs>().iter().any(|outputs| outputs.taken.is_some()));
        assert!($make::<Actuation>().iter().any(|actuation| actuation.steer.is_some()));
        for messages in $make::<VcuMessages>() {
            for frame in messages.frames(&Edition::V3_0.bus) {
                assert!(Edition::V3_0.bus.decode(frame.id, frame.data()).is_ok(), "{frame}");
            }
        }
    };
}

#[cfg(feature = "arbitrary")]
#[test]
fn arbitrary_values_are_all_there_are() {
    fn make<T: for<'a> arbitrary::Arbitrary<'a>>() -> Vec<T> {
        let mut random = fastrand::Rng::with_seed(0x5EED_0005);
        let bytes: Vec<Vec<u8>> = (0..TIMES).map(|_| (0..256).map(|_| random.u8(..)).collect()).collect();
        bytes
            .iter()
            .map(|bytes| arbitrary::Unstructured::new(bytes).arbitrary().expect("enough bytes"))
            .collect()
    }
    check!(make);
}

#[cfg(feature = "proptest")]
#[test]
fn proptest_values_are_all_there_are() {
    use proptest::prelude::{Strategy, any};
    use proptest::strategy::ValueTree;

    fn make<T: proptest::arbitrary::Arbitrary>() -> Vec<T> {
        let mut runner = proptest::test_runner::TestRunner::deterministic();
        let strategy = any::<T>();
        (0..TIMES).map(|_| strategy.new_tree(&mut runner).expect("nothing is filtered").current()).collect()
    }
    check!(make);
}
