//! What is wrong with what Kani has printed, and what only takes long.

use std::collections::BTreeMap;
use std::fmt;

use adsdv_proofs::{readings, theorems};
use adsdv_spec::Edition;

use crate::read::{Case, Harness, Outcome};

/// How long a theorem may take, in seconds, and all that are of one edition. It depends on the machine and on the solver: so only
/// `--limits` makes it a failure.
const LONG: f64 = 30.0;
const LONG_IN_ALL: f64 = 600.0;

/// So many of those that took longest are named.
const SLOWEST: usize = 10;

/// What there is to say of a run of Kani.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Findings {
    verified: usize,
    seconds: f64,
    /// The same of the theorems of each edition.
    of_edition: BTreeMap<&'static str, f64>,
    /// Why the run proves less than it should.
    wrong: Vec<String>,
    /// What takes long.
    slow: Vec<String>,
    /// How long each took, in seconds, with its name.
    times: Vec<(f64, String)>,
}

/// The names of all theorems, as Kani prints them.
pub(crate) fn expected() -> Vec<String> {
    let name = |theorem: &theorems::Theorem| {
        let module = theorem.module.split_once("::").map_or("", |(_, module)| module);
        format!("{module}::{}", theorem.name)
    };
    theorems::all().map(name).collect()
}

/// The edition that a theorem is about: the one in its name, or 3.0.
fn edition_of(name: &str) -> &'static str {
    let theorem = name.rsplit("::").next().unwrap_or(name);
    let choice = readings::CHOICES.iter().find(|(of, ..)| *of == theorem);
    let named = Edition::ALL.iter().find(|edition| {
        let version = edition.version.replace('.', "_");
        edition.version != Edition::V3_0.version && name.contains(&version)
    });
    choice.map(|(_, edition, _)| edition.version).or(named.map(|edition| edition.version)).unwrap_or("3.0")
}

impl Findings {
    /// What there is to say of these harnesses, if all of the expected ones have to be there.
    pub(crate) fn of(harnesses: &[Harness], expected: &[String]) -> Self {
        let mut findings = Self::default();
        if harnesses.is_empty() {
            findings.wrong.push(
                "no harness was checked; expected the regular output of cargo kani, which -j and the terse format do not have"
                    .to_owned(),
            );
            return findings;
        }
        for harness in harnesses {
            findings.look_at(harness);
        }
        let is_there = |name: &String| harnesses.iter().any(|harness| harness.name == *name);
        let missing = expected.iter().filter(|name| !is_there(name));
        findings.wrong.extend(missing.map(|name| format!("{name}: not checked")));
        for (version, seconds) in &findings.of_edition {
            if *seconds > LONG_IN_ALL {
                let all = format!("all of {version} together took {seconds:.0} s, more than {LONG_IN_ALL} s");
                findings.slow.push(all);
            }
        }
        findings
    }

    /// The same, where it is wrong as well to take longer than the limits.
    pub(crate) fn within_limits(mut self) -> Self {
        self.wrong.append(&mut self.slow);
        self
    }

    fn look_at(&mut self, harness: &Harness) {
        let Harness { name, verdict, seconds, cases } = harness;
        match verdict {
            Outcome::Verified => {
                self.verified += 1;
                if cases.is_empty() {
                    self.wrong.push(format!("{name}: has no case to be reached; expected a kani::cover!"));
                }
                let unreached = cases.iter().filter(|&(_, &reached)| !reached);
                self.wrong.extend(unreached.map(|(Case { place, description }, _)| {
                    format!("{name}: never reached: {description}, at {place}")
                }));
            }
            Outcome::Refuted(checks) => self.wrong.push(format!("{name}: refuted: {}", checks.join("; "))),
            Outcome::Undecided => self.wrong.push(format!("{name}: no answer: out of time or of memory")),
            Outcome::Missing => self.wrong.push(format!("{name}: the output ends before the answer")),
        }
        let seconds = seconds.unwrap_or_default();
        self.seconds += seconds;
        *self.of_edition.entry(edition_of(name)).or_default() += seconds;
        self.times.push((seconds, name.clone()));
        if seconds > LONG {
            self.slow.push(format!("{name} took {seconds:.0} s, more than {LONG} s"));
        }
    }

    /// Those that took longest, the slowest first.
    fn slowest(&self) -> impl Iterator<Item = &(f64, String)> {
        let mut times: Vec<_> = self.times.iter().collect();
        times.sort_by(|a, b| b.0.total_cmp(&a.0));
        times.into_iter().take(SLOWEST)
    }

    /// Whether all is verified, and every case reached.
    pub(crate) fn holds(&self) -> bool {
        self.wrong.is_empty()
    }
}

impl fmt::Display for Findings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.slow.iter().try_for_each(|slow| writeln!(f, "slow: {slow}"))?;
        self.wrong.iter().try_for_each(|wrong| writeln!(f, "wrong: {wrong}"))?;
        if self.times.len() > 1 {
            writeln!(f, "the slowest, in seconds:")?;
            self.slowest().try_for_each(|(seconds, name)| writeln!(f, "{seconds:6.0} {name}"))?;
        }
        let theorems = if self.verified == 1 { "theorem" } else { "theorems" };
        write!(f, "{} {theorems} verified in {:.0} s", self.verified, self.seconds)?;
        if self.holds() {
            writeln!(f, ", every case reached")
        } else {
            writeln!(f, "; {} wrong", self.wrong.len())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Findings, expected};
    use crate::read::harnesses;
    use crate::read::tests::{INLINED, NO_ANSWER, REFUTED, TERSE, UNREACHED, VERIFIED};

    fn printed(text: &str, expected: &[&str]) -> (bool, String) {
        let expected: Vec<String> = expected.iter().map(|&name| name.to_owned()).collect();
        let findings = Findings::of(&harnesses(text), &expected);
        (findings.holds(), findings.to_string())
    }

    #[test]
    fn what_is_verified_with_every_case_reached_is_right() {
        let all = [VERIFIED, INLINED].concat();
        let expected =
            ["codec::ai::ai2vcu_brake_514h", "codec::any::a_frame_is_read_as_the_message_of_its_identifier"];
        let slow =
            "slow: codec::any::a_frame_is_read_as_the_message_of_its_identifier took 242 s, more than 30 s\n";
        let sum = "2 theorems verified in 245 s, every case reached\n";
        let slowest = "the slowest, in seconds:
   242 codec::any::a_frame_is_read_as_the_message_of_its_identifier
     3 codec::ai::ai2vcu_brake_514h
";
        let text = format!("{slow}{slowest}{sum}");
        assert_eq!(printed(&all, &expected), (true, text), "what is slow is no failure");
    }

    #[test]
    fn all_together_may_be_slow_and_that_is_no_failure() {
        let (holds, printed) = printed(&INLINED.repeat(3), &[]);
        assert!(holds);
        assert!(printed.contains("slow: all of 3.0 together took 726 s, more than 600 s\n"), "{printed}");
    }

    #[test]
    fn with_limits_what_is_slow_is_wrong() {
        let findings = Findings::of(&harnesses(INLINED), &[]).within_limits();
        assert!(!findings.holds());
        let wrong = "wrong: codec::any::a_frame_is_read_as_the_message_of_its_identifier took 242 s";
        assert!(findings.to_string().contains(wrong), "{findings}");
        let quick = Findings::of(&harnesses(VERIFIED), &[]).within_limits();
        assert!(quick.holds(), "{quick}");
    }

    #[test]
    fn a_theorem_counts_for_the_edition_that_it_names() {
        let of = ["readings::read_as_watch_always", "safety::v4_0::silence", "codec::v2026::x", "time::x"];
        assert_eq!(of.map(super::edition_of), ["4.0", "4.0", "2026", "3.0"]);
    }

    #[test]
    fn ten_are_named_that_took_longest_and_no_more() {
        let harness = |at| {
            format!(
                "Checking harness time::h{at}...\nVERIFICATION:- SUCCESSFUL\nVerification Time: {at}.4s\n\n"
            )
        };
        let all = (0..12).map(harness).collect::<Vec<_>>().concat();
        let (_, printed) = printed(&all, &[]);
        let (_, lines) = printed.split_once("the slowest, in seconds:\n").expect("they are named");
        let names: Vec<&str> = lines
            .lines()
            .take(11)
            .filter_map(|line| line.trim().split_once(' '))
            .map(|(_, name)| name)
            .collect();
        assert_eq!(names[..2], ["time::h11", "time::h10"]);
        assert_eq!(names[9], "time::h2", "{printed}");
        assert!(!names[10].starts_with("time::"), "{printed}");
    }

    #[test]
    fn what_is_not_verified_or_not_reached_is_wrong() {
        for (text, expected, wrong) in [
            (REFUTED, &[][..], &["figure2::driving_asms: refuted: \"the condition leads there\""][..]),
            (NO_ANSWER, &[], &["totality::what_is_taken_is_possible: no answer: out of time or of memory"]),
            (
                UNREACHED,
                &[],
                &[
                    "handshake::lost: never reached: lost, at proofs/src/handshake.rs:31:5 in function handshake::lost",
                    "handshake::lost: never reached: never looked at, at proofs/src/handshake.rs:32:5 in function handshake::lost",
                ],
            ),
            (
                VERIFIED,
                &["time::two_steps_in_ready_are_one"],
                &["time::two_steps_in_ready_are_one: not checked"],
            ),
            (
                "Checking harness time::empty...\nVERIFICATION:- SUCCESSFUL\n",
                &[],
                &["time::empty: has no case to be reached; expected a kani::cover!"],
            ),
            ("Checking harness time::cut...\n", &[], &["time::cut: the output ends before the answer"]),
        ] {
            let (holds, printed) = printed(text, expected);
            assert!(!holds, "{printed}");
            let lines: Vec<&str> = printed.lines().filter_map(|line| line.strip_prefix("wrong: ")).collect();
            assert_eq!(lines, wrong);
        }
    }

    #[test]
    fn output_without_a_harness_is_wrong() {
        for text in [TERSE, "", "error: no such command: `kani`\n"] {
            let (holds, printed) = printed(text, &[]);
            assert!(!holds && printed.contains("no harness was checked"), "{printed}");
        }
    }

    #[test]
    fn theorems_have_the_names_that_kani_prints() {
        let expected = expected();
        assert!(expected.iter().any(|name| name == "codec::ai::ai2vcu_brake_514h"), "{expected:?}");
        assert!(expected.iter().any(|name| name == "time::two_steps_in_ready_are_one"), "{expected:?}");
    }
}
