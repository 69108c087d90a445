//! What the faults and the cause may be, held against the sets that they are.

use adsdv_spec::belief::{Causes, KnownFaults};
use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{Fault, Faults, Truth};

use super::claimed;

/// Some faults, in the order of their numbers: of the others none is ever present.
const SOME: [Fault; 3] = [Fault::AiComputerRequest, Fault::EbsFault, Fault::BmsFault];

/// Every set of them.
fn sets() -> impl Iterator<Item = Faults> + Clone {
    (0..1 << SOME.len()).map(|set: u32| {
        (0..)
            .zip(SOME)
            .fold(Faults::NONE, |faults, (bit, fault)| faults.union(Faults::when(fault, set >> bit & 1 == 1)))
    })
}

/// Everything that can be known of them.
fn known() -> impl Iterator<Item = KnownFaults> {
    let others = Faults::ALL.difference(Faults::of(&SOME));
    let pairs = sets().flat_map(|present| sets().map(move |absent| (present, absent)));
    let pairs = pairs.filter(|(present, absent)| present.intersection(*absent).is_empty());
    pairs.map(move |(present, absent)| KnownFaults::new(present, absent.union(others)))
}

/// The sets that are allowed.
fn allowed(known: KnownFaults) -> Vec<Faults> {
    sets().filter(|&faults| known.allows(faults)).collect()
}

/// The least that allows all of these.
fn hull(some: impl IntoIterator<Item = Faults>) -> Option<KnownFaults> {
    some.into_iter().map(KnownFaults::exact).reduce(KnownFaults::or)
}

#[test]
fn faults_are_known_as_far_as_is_said() {
    assert_eq!(KnownFaults::NOTHING.possible(), Faults::ALL);
    let ebs = Faults::NONE.with(Fault::EbsFault);
    let both = KnownFaults::new(ebs, ebs);
    assert_eq!((both.present(), both.absent()), (ebs, Faults::NONE), "what is said to be both is present");
    for one in known() {
        assert_eq!(hull(allowed(one)), Some(one));
        assert_eq!(one.possible(), Faults::ALL.difference(one.absent()));
        for fault in SOME {
            let ways: Vec<bool> = allowed(one).iter().map(|faults| faults.has(fault)).collect();
            assert_eq!(one.of(fault), claimed(&ways));
        }
        for some in sets() {
            let ways: Vec<bool> = allowed(one).iter().map(|all| !all.intersection(some).is_empty()).collect();
            assert_eq!(one.any_of(some), claimed(&ways), "{one:?}, {some}");
            let those = allowed(one).into_iter().map(|all| all.intersection(some));
            assert_eq!(Some(one.of_these(some)), hull(those), "{one:?}, {some}");
        }
    }
}

#[test]
fn what_is_known_of_faults_is_joined() {
    for one in known() {
        for other in known() {
            let either = allowed(one).into_iter().chain(allowed(other));
            assert_eq!(Some(one.or(other)), hull(either));
            let unions =
                allowed(one).into_iter().flat_map(|a| allowed(other).into_iter().map(move |b| a.union(b)));
            assert_eq!(Some(one.together(other)), hull(unions), "{one:?} together with {other:?}");
            let all = allowed(other).into_iter().all(|faults| one.allows(faults));
            assert_eq!(one.covers(other), all, "{one:?} covers {other:?}");
        }
    }
}

/// What the cause may be, with these faults.
fn all_causes() -> impl Iterator<Item = Causes> {
    sets().flat_map(|faults| [false, true].map(|none| Causes { none, faults }))
}

fn causes(causes: Causes) -> Vec<ShutdownCause> {
    ShutdownCause::ALL.into_iter().filter(|&cause| causes.allows(cause)).collect()
}

/// The least that allows all of these.
fn hull_of_causes(some: impl IntoIterator<Item = ShutdownCause>) -> Causes {
    let empty = Causes { none: false, faults: Faults::NONE };
    some.into_iter().map(Causes::exact).fold(empty, Causes::or)
}

#[test]
fn causes_are_those_that_are_allowed() {
    assert_eq!(causes(Causes::ANY), ShutdownCause::ALL);
    for cause in ShutdownCause::ALL {
        assert_eq!(causes(Causes::exact(cause)), [cause]);
    }
    for one in all_causes() {
        assert_eq!(hull_of_causes(causes(one)), one);
        assert_eq!(one.is_empty(), causes(one).is_empty());
        for other in all_causes() {
            let all = causes(other).into_iter().all(|cause| one.allows(cause));
            assert_eq!(one.covers(other), all, "{one:?} covers {other:?}");
            if !other.is_empty() {
                let then = causes(one).into_iter().flat_map(|before| {
                    let stays = before != ShutdownCause::NoShutdown;
                    if stays { vec![before] } else { causes(other) }
                });
                assert_eq!(one.then(other), hull_of_causes(then), "{one:?}, then {other:?}");
            }
        }
    }
}

#[test]
fn the_first_cause_is_that_of_the_lowest_number() {
    for known in known() {
        for some in [false, true] {
            let those = allowed(known).into_iter().filter(|faults| !some || !faults.is_empty());
            let expected = hull_of_causes(those.map(Faults::cause));
            if !expected.is_empty() {
                assert_eq!(Causes::first_of(known, some), expected, "{known:?}, {some}");
            }
        }
    }
}

#[test]
fn the_flag_of_a_cause_is_shown() {
    for one in all_causes().filter(|causes| !causes.is_empty()) {
        let shown = causes(one).into_iter().map(Faults::of_cause);
        assert_eq!(Some(one.shown()), hull(shown), "{one:?}");
    }
    let only = Causes::exact(ShutdownCause::EbsFault).shown();
    assert_eq!((only.of(Fault::EbsFault), only.of(Fault::BmsFault)), (Truth::True, Truth::False));
}

#[test]
fn faults_up_to_one_are_those_with_no_higher_number() {
    for faults in [Faults::NONE, Faults::ALL, Faults::OPENING] {
        for &last in Fault::ALL {
            let expected: Vec<Fault> = faults.iter().filter(|&fault| fault <= last).collect();
            assert_eq!(faults.up_to(last).iter().collect::<Vec<_>>(), expected, "{faults} up to {last}");
        }
    }
}
