//! What the handshake may be, held against the sets of handshakes that it is.

use adsdv_spec::Handshake;
use adsdv_spec::belief::{Handshakes, Span};

use super::{TRUTHS, claimed};

/// Times up to this limit.
const LIMIT_MS: u16 = 2;

/// Every handshake that there can be.
fn all() -> Vec<Handshake> {
    let waits = |bit| (0..=LIMIT_MS).map(move |unanswered_ms| Handshake { active: true, bit, unanswered_ms });
    [Handshake::IDLE].into_iter().chain(waits(false)).chain(waits(true)).collect()
}

fn spans() -> impl Iterator<Item = Span> + Clone {
    (0..=LIMIT_MS).flat_map(|least| (least..=LIMIT_MS).map(move |most| Span::between(least, most)))
}

/// Everything that the handshake may be.
fn handshakes() -> impl Iterator<Item = Handshakes> {
    let some = || spans().map(Some).chain([None]);
    [false, true].into_iter().flat_map(move |idle| {
        some().flat_map(move |low| some().map(move |high| Handshakes { idle, low, high }))
    })
}

/// Those that are allowed.
fn allowed(handshakes: &Handshakes) -> Vec<Handshake> {
    all().into_iter().filter(|&handshake| handshakes.allows(handshake)).collect()
}

/// The least that allows all of these.
fn hull(some: impl IntoIterator<Item = Handshake>) -> Handshakes {
    some.into_iter().map(Handshakes::exact).fold(Handshakes::NONE, Handshakes::or)
}

#[test]
fn handshakes_are_those_that_are_allowed() {
    assert_eq!(hull(all()), Handshakes::any(LIMIT_MS));
    // One that rests sends 0, and waits for nothing.
    assert!(!Handshakes::any(LIMIT_MS).allows(Handshake { bit: true, ..Handshake::IDLE }));
    assert!(!Handshakes::any(LIMIT_MS).allows(Handshake { unanswered_ms: 1, ..Handshake::IDLE }));
    for one in handshakes() {
        assert_eq!(hull(allowed(&one)), one);
        assert_eq!(one.is_empty(), allowed(&one).is_empty());
        assert_eq!((one.waits(false), one.waits(true)), (one.low, one.high));
    }
    for handshake in all() {
        assert_eq!(allowed(&Handshakes::exact(handshake)), [handshake]);
    }
}

#[test]
fn handshakes_are_joined() {
    let some: Vec<Handshakes> = handshakes().step_by(7).collect();
    for one in &some {
        for other in &some {
            assert_eq!(one.or(*other), hull(allowed(one).into_iter().chain(allowed(other))));
            let all = allowed(other).into_iter().all(|handshake| one.allows(handshake));
            assert_eq!(one.covers(other), all, "{one:?} covers {other:?}");
        }
    }
}

#[test]
fn handshakes_step_as_each_of_them_does() {
    for before in handshakes() {
        for (active, answer) in TRUTHS.into_iter().flat_map(|active| TRUTHS.map(|answer| (active, answer))) {
            for dt in spans() {
                let mut after = Vec::new();
                for handshake in allowed(&before) {
                    for (a, b) in [(false, false), (false, true), (true, false), (true, true)] {
                        if active.allows(a) && answer.allows(b) {
                            let times = dt.least_ms()..=dt.most_ms();
                            after.extend(times.map(|dt| handshake.step(a, b, dt.into(), LIMIT_MS)));
                        }
                    }
                }
                let mut expected = hull(after);
                if before.is_empty() {
                    // Nobody asks what becomes of none: it may rest.
                    expected.idle = active.allows(false);
                }
                assert_eq!(
                    before.step(active, answer, dt, LIMIT_MS),
                    expected,
                    "{before:?}, {active}, {answer}, {dt}"
                );
            }
        }
    }
}

#[test]
fn handshakes_are_cut_where_one_is_lost_or_seen() {
    for handshakes in handshakes() {
        for limit_ms in 0..=LIMIT_MS + 1 {
            let lost = |handshake: &Handshake| handshake.is_lost(limit_ms);
            for so in [false, true] {
                let left = allowed(&handshakes).into_iter().filter(|handshake| lost(handshake) == so);
                assert_eq!(handshakes.given_lost(limit_ms, so), hull(left), "{handshakes:?}, {limit_ms} ms");
            }
            let ways: Vec<bool> = allowed(&handshakes).iter().map(lost).collect();
            if !handshakes.is_empty() {
                assert_eq!(handshakes.is_lost(limit_ms), claimed(&ways), "{handshakes:?}, {limit_ms} ms");
            }
        }
        for bit in [false, true] {
            let left = allowed(&handshakes).into_iter().filter(|handshake| handshake.bit == bit);
            assert_eq!(handshakes.given_bit(bit), hull(left), "{handshakes:?}, {bit}");
        }
    }
}
