//! What the AI Computer asked of the wheels, and what the vehicle showed of it.

use adsdv_spec::messages::Node;

use crate::facts::{Facts, number};
use crate::time::Seconds;

/// What is asked, what shows that it came, what it is called, and the plot that has both.
const PAIRS: &[(&str, &str, &str, &str)] = &[
    ("front_axle_trq_request", "front_axle_trq", "torque on the front axle", "torque-front"),
    ("rear_axle_trq_request", "rear_axle_trq", "torque on the rear axle", "torque-rear"),
    ("steer_request", "steer_angle", "a steer angle", "steering"),
    ("hyd_press_f_req", "hyd_press_f", "brake pressure in front", "brake"),
    ("hyd_press_r_req", "hyd_press_r", "brake pressure behind", "brake"),
];

/// So much later the first frame that shows something may come.
const LATER_NS: i64 = 50_000_000;
/// What is asked for less long may be over before anything moves.
const BRIEF_NS: i64 = 50_000_000;

/// A request of which the vehicle showed nothing.
#[derive(Debug)]
pub(crate) struct Missed {
    pub(crate) t_ns: i64,
    pub(crate) text: String,
    pub(crate) plot: &'static str,
}

/// A time in which something other than zero was asked for.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    since: i64,
    until: i64,
    most: i32,
}

/// What became of the requests.
#[derive(Debug, Default)]
pub(crate) struct Requests {
    /// How many there were.
    pub(crate) asked: usize,
    /// Those of which nothing came: what was measured stayed zero all the time.
    pub(crate) missed: Vec<Missed>,
    /// Of how many no frame shows anything.
    pub(crate) untold: usize,
}

/// Follows every request that lasted.
pub(crate) fn requests(facts: &Facts<'_>) -> Requests {
    let mut all = Requests::default();
    for &(request, actual, what, plot) in PAIRS {
        let Some(request) = facts.signal(Node::Ai, request) else { continue };
        let mut measured = facts.recording.series(facts.signal(Node::Vcu, actual)).peekable();
        for Stretch { since, until, most } in stretches(facts.recording.series(Some(request))) {
            if until - since < BRIEF_NS {
                continue;
            }
            all.asked += 1;
            while measured.next_if(|(t, _)| *t < since).is_some() {}
            let (mut told, mut came) = (false, false);
            while let Some((_, raw)) = measured.next_if(|(t, _)| *t <= until) {
                (told, came) = (true, came || raw != 0);
            }
            // The frame after it may be the first that shows something.
            came = came || measured.peek().is_some_and(|(t, raw)| *t <= until + LATER_NS && *raw != 0);
            if !told {
                all.untold += 1;
            } else if !came {
                let state =
                    facts.stay_at(since).map_or_else(String::new, |stay| format!(", in {}", stay.state));
                let unit = request.signal.unit;
                let most = number(request.signal.physical(most));
                let (from, to) = (Seconds(since), Seconds(until));
                let text =
                    format!("{what} from {from} to {to} s, up to {most} {unit}{state}: the vehicle showed 0");
                all.missed.push(Missed { t_ns: since, text, plot });
            }
        }
    }
    all.missed.sort_by_key(|one| one.t_ns);
    all
}

fn stretches(series: impl Iterator<Item = (i64, i32)>) -> Vec<Stretch> {
    let (mut all, mut open): (Vec<Stretch>, Option<Stretch>) = (Vec::new(), None);
    for (t, raw) in series {
        if raw == 0 {
            all.extend(open.take().map(|stretch| Stretch { until: t, ..stretch }));
            continue;
        }
        let stretch = open.get_or_insert(Stretch { since: t, until: t, most: raw });
        stretch.until = t;
        if raw.unsigned_abs() > stretch.most.unsigned_abs() {
            stretch.most = raw;
        }
    }
    all.extend(open);
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stretch_lasts_until_zero_is_asked_for() {
        let series = [(0, 0), (10, 5), (20, -9), (30, 0), (40, 0), (50, 1)];
        let found: Vec<_> =
            stretches(series.into_iter()).iter().map(|one| (one.since, one.until, one.most)).collect();
        assert_eq!(found, [(10, 30, -9), (50, 50, 1)]);
    }
}
