//! Times between two bounds, held against the sets of times that they are.

use adsdv_spec::Handshake;
use adsdv_spec::belief::Span;

use super::claimed;

/// Times, and limits that some of them reach.
const MOST: u16 = 5;

/// Every span of them.
fn spans() -> impl Iterator<Item = Span> {
    (0..=MOST).flat_map(|least| (least..=MOST).map(move |most| Span::between(most, least)))
}

/// The times of a span.
fn times(span: Span) -> Vec<u16> {
    let times: Vec<u16> = (0..=MOST + 1).filter(|&ms| span.allows(ms)).collect();
    assert_eq!(times, (span.least_ms()..=span.most_ms()).collect::<Vec<_>>());
    times
}

/// The least span with all of these times in it.
fn hull(times: impl IntoIterator<Item = u16>) -> Option<Span> {
    times.into_iter().map(Span::exact).reduce(Span::or)
}

#[test]
fn a_span_has_the_times_between_its_bounds() {
    assert_eq!(Span::between(1, 2), Span::between(2, 1));
    assert_eq!(Span::exact(3), Span::between(3, 3));
    for one in spans() {
        assert_eq!(hull(times(one)), Some(one));
        for other in spans() {
            assert_eq!(Some(one.or(other)), hull(times(one).into_iter().chain(times(other))));
            let both: Vec<u16> = times(one).into_iter().filter(|&ms| other.allows(ms)).collect();
            assert_eq!(one.and(other), hull(both.iter().copied()), "{one} and {other}");
            let all = times(other).into_iter().all(|ms| one.allows(ms));
            assert_eq!(one.covers(other), all, "{one} covers {other}");
        }
    }
}

#[test]
fn a_span_is_cut_at_a_limit() {
    for span in spans() {
        for limit_ms in 0..=MOST + 1 {
            for reached in [false, true] {
                let left = times(span).into_iter().filter(|&ms| (ms >= limit_ms) == reached);
                assert_eq!(span.given(limit_ms, reached), hull(left), "{span}, {limit_ms} ms: {reached}");
            }
            let ways: Vec<bool> = times(span).into_iter().map(|ms| ms >= limit_ms).collect();
            assert_eq!(span.reaches(limit_ms), claimed(&ways), "{span}, {limit_ms} ms");
        }
    }
    assert_eq!(Span::between(0, u16::MAX).given(u16::MAX, true), Some(Span::exact(u16::MAX)));
}

#[test]
fn a_span_counts_up_as_its_times_do() {
    let count = |timer_ms, dt_ms: u16, limit_ms| {
        let waits = Handshake { active: true, bit: false, unanswered_ms: timer_ms };
        waits.step(true, true, dt_ms.into(), limit_ms).unanswered_ms
    };
    for timer in spans() {
        for dt in spans() {
            for limit_ms in 0..=MOST {
                let all = times(timer).into_iter().flat_map(|timer_ms| {
                    times(dt).into_iter().map(move |dt_ms| count(timer_ms, dt_ms, limit_ms))
                });
                assert_eq!(Some(timer.counted_up(dt, limit_ms)), hull(all), "{timer}, {dt}, {limit_ms} ms");
            }
        }
    }
}

#[test]
fn a_time_that_passes_is_a_range_that_is_not_empty() {
    assert_eq!(Span::of(&(8..=12)), Some(Span::between(8, 12)));
    assert_eq!(Span::of(&(8..=u32::MAX)), Some(Span::between(8, u16::MAX)));
    assert_eq!(Span::of(&(70_000..=80_000)), Some(Span::exact(u16::MAX)));
    let (later, earlier) = (12, 8);
    assert_eq!(Span::of(&(later..=earlier)), None);
}

#[test]
fn a_span_prints_in_words() {
    assert_eq!(Span::exact(40).to_string(), "40 ms");
    assert_eq!(Span::between(40, 50).to_string(), "40 to 50 ms");
}
