//! How long scenarios are, by the reference AI Computer, and which of them are the quick ones.

use std::time::Duration;

use crate::exam::ExamOptions;
use crate::scenario::ExamScenario;
use crate::session::run;
use crate::stack::{Reference, Stack as _};

/// Some scenarios that together ask for every requirement that all of them ask for, and that end within two minutes of real time.
const QUICK: [&str; 5] =
    ["mission-skidpad", "go-withdrawn-at-once", "estop-in-ready", "frames-late", "vcu-first"];

/// What a scenario takes in real time beside its length, at most: the bus is to be quiet before it, and the program is to start.
pub const BESIDE: Duration = Duration::from_millis(1200);

impl ExamScenario {
    /// Whether it is one of the few that show most.
    pub fn is_quick(&self) -> bool {
        QUICK.contains(&self.name.as_str())
    }

    /// How long it is where the reference AI Computer is examined: a mission is longer or shorter with another one.
    ///
    /// ```
    /// use adsdv_exam::{ExamOptions, scenarios};
    /// use adsdv_spec::Edition;
    ///
    /// let ready = scenarios().into_iter().find(|one| one.name == "ready").expect("it is there");
    /// assert_eq!(ready.length(&ExamOptions::of(Edition::DEFAULT)).as_secs(), 4);
    /// ```
    pub fn length(&self, options: &ExamOptions) -> Duration {
        let mut reference = Reference::default();
        let ran = reference
            .hello(options.edition)
            .ok()
            .and_then(|()| run(self, options.edition, options.mission_ms, &mut reference).ok());
        Duration::from_millis(ran.map_or(0, |ran| ran.duration_ms))
    }
}

/// How long scenarios of these lengths take in real time, so many at once; each needs `more` beside its length.
pub fn estimate(lengths: &[Duration], more: Duration, at_once: usize) -> Duration {
    let each = lengths.iter().map(|length| *length + more);
    let longest = each.clone().max().unwrap_or_default();
    let all: Duration = each.sum();
    longest.max(all / u32::try_from(at_once.max(1)).unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use adsdv_spec::Edition;

    use super::*;
    use crate::scenarios::scenarios;

    fn whole(of: impl Fn(&ExamScenario) -> bool, edition: &'static Edition) -> Duration {
        let options = ExamOptions::of(edition);
        let chosen = scenarios().into_iter().filter(of);
        let lengths: Vec<Duration> = chosen.map(|one| one.length(&options)).collect();
        estimate(&lengths, BESIDE, 1)
    }

    #[test]
    fn the_quick_ones_end_in_two_minutes_and_all_in_fifteen() {
        for name in QUICK {
            assert!(scenarios().iter().any(|one| one.name == name), "{name}");
        }
        for edition in Edition::ALL {
            let (quick, all) = (whole(ExamScenario::is_quick, edition), whole(|_| true, edition));
            println!("{}: {quick:?}, {all:?}", edition.version);
            assert!(quick <= Duration::from_mins(2), "{}: {quick:?}", edition.version);
            assert!(all <= Duration::from_mins(15), "{}: {all:?}", edition.version);
        }
    }

    #[test]
    fn the_quick_ones_exercise_what_all_of_them_do() {
        for edition in Edition::ALL {
            let options = ExamOptions::of(edition);
            let names = |of: &dyn Fn(&ExamScenario) -> bool| -> Vec<&'static str> {
                let chosen: Vec<_> = scenarios().into_iter().filter(|one| of(one)).collect();
                let report = crate::exam::exam(&mut Reference::default(), &chosen, &options, &mut |_| {});
                let requirements = report.expect("it answers").requirements;
                requirements.iter().filter(|one| one.outcome.name() == "pass").map(|one| one.id).collect()
            };
            assert_eq!(names(&ExamScenario::is_quick), names(&|_| true), "{}", edition.version);
        }
    }

    #[test]
    fn an_estimate_is_never_shorter_than_the_longest() {
        let lengths = [10, 20, 30].map(Duration::from_secs);
        let estimated = |at_once| estimate(&lengths, Duration::from_secs(1), at_once).as_secs();
        assert_eq!([1, 2, 3, 0].map(estimated), [63, 31, 31, 63]);
    }
}
