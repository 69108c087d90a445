//! Holding what the judge says against what it should say, on the exact recording and on disturbed ones.

use std::sync::OnceLock;

use adsdv_oracle::judge::{Finding, JudgeOptions, Party, Report, Rule, Section, Severity};
use adsdv_spec::{Choice, Choices, Edition};
use adsdv_tests::world::{MS, Recorded, World, judge, violations};

/// A violation, as far as it is the same in every recording of the same run.
pub(crate) type Blame = (Rule, &'static str);

/// Frames lost: one in this many.
const LOSS: u64 = 20;
/// How many recordings there are of each kind, unless [`RECORDINGS`] says otherwise.
pub(crate) const USUAL: u64 = 20;
/// The variable of the environment that sets it: fewer are faster, more find more.
const RECORDINGS: &str = "ADSDV_RECORDINGS";

/// How many recordings there are of each kind.
pub(crate) fn recordings_of_a_kind() -> u64 {
    static SET: OnceLock<u64> = OnceLock::new();
    *SET.get_or_init(|| match std::env::var(RECORDINGS) {
        Ok(number) => {
            number.parse().unwrap_or_else(|_| panic!("{RECORDINGS} is {number:?}; expected a number"))
        }
        Err(_) => USUAL,
    })
}

/// The judge of a VCU that follows this choice.
pub(crate) fn pinned(choice: Choice) -> JudgeOptions {
    all_pinned(Choices::NONE.with(choice))
}

/// The judge of a VCU that follows these choices.
pub(crate) fn all_pinned(choices: Choices) -> JudgeOptions {
    JudgeOptions { readings: choices.iter().fold(Choices::ALL, Choices::pin), ..JudgeOptions::default() }
}

/// The judge of a VCU of an edition that follows these choices.
pub(crate) fn pinned_in(edition: &'static Edition, choices: &[Choice]) -> JudgeOptions {
    let open = JudgeOptions::of(edition);
    JudgeOptions { readings: choices.iter().copied().fold(open.readings, Choices::pin), ..open }
}

/// The violations of one party.
pub(crate) fn by(report: &Report, party: Party) -> Vec<&Finding> {
    report.findings.iter().filter(|f| f.severity == Severity::Violation && f.party == party).collect()
}

/// What one party is blamed for.
pub(crate) fn blames(report: &Report, party: Party) -> Vec<Blame> {
    by(report, party).iter().map(|finding| (finding.rule, section_of(finding))).collect()
}

/// The one violation of the VCU that there is.
pub(crate) fn only(report: &Report) -> Finding {
    match by(report, Party::Vcu)[..] {
        [finding] => finding.clone(),
        _ => panic!("expected one violation of the VCU: {:#?}", violations(report)),
    }
}

/// Nothing is said against the VCU, however the recorder works.
pub(crate) fn is_silent(world: &World, options: JudgeOptions, name: &str) {
    for (how, log) in recordings(world) {
        let report = judge(&log, options);
        assert!(by(&report, Party::Vcu).is_empty(), "{name}, {how}: {:#?}", violations(&report));
    }
}

/// Exactly these violations are reported, also under jitter; where frames are lost, no other, and mostly these.
pub(crate) fn is_reported(
    world: &World,
    options: JudgeOptions,
    party: Party,
    expected: &[Blame],
    name: &str,
) {
    let missed = missed_in(world, options, party, expected, name);
    // Of a few recordings, each may have lost the very frame.
    let seeds = recordings_of_a_kind();
    assert!(
        missed <= seeds / 2 || seeds < USUAL,
        "{name}: missed in {missed} of {seeds} recordings that lose frames"
    );
}

/// The same for what shows for a moment only, so that a recording that loses frames may not show it.
pub(crate) fn is_reported_if_seen(
    world: &World,
    options: JudgeOptions,
    party: Party,
    expected: &[Blame],
    name: &str,
) {
    missed_in(world, options, party, expected, name);
}

/// In how many recordings that lose frames it is not reported. In all others it must be, and nothing else in any.
fn missed_in(world: &World, options: JudgeOptions, party: Party, expected: &[Blame], name: &str) -> u64 {
    let mut missed = 0;
    for (how, log) in recordings(world) {
        let report = judge(&log, options);
        let found = blames(&report, party);
        if how.loses_frames() {
            missed += u64::from(found != expected);
            let other = found.iter().any(|blame| !expected.contains(blame)) || found.len() > expected.len();
            assert!(!other, "{name}, {how}: {:#?}", violations(&report));
        } else {
            assert_eq!(found, expected, "{name}, {how}: {:#?}", violations(&report));
        }
    }
    missed
}

/// A finding is where it should be, give or take.
pub(crate) fn is_at(finding: &Finding, t: i64, tolerance_ms: i64) {
    assert!(
        (finding.t_ns - t).abs() <= tolerance_ms * MS,
        "{} ms, expected {} ms: {finding:?}",
        finding.t_ns / MS,
        t / MS
    );
}

/// How a run was recorded.
#[derive(Clone, Copy, Debug)]
pub(crate) enum How {
    Exactly,
    Jittered(u64),
    Thinned(u64),
}

impl How {
    fn loses_frames(self) -> bool {
        matches!(self, Self::Thinned(_))
    }
}

impl std::fmt::Display for How {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Exactly => f.write_str("recorded exactly"),
            Self::Jittered(seed) => write!(f, "with 5 ms of jitter (seed {seed})"),
            Self::Thinned(seed) => write!(f, "with 1 in {LOSS} frames lost (seed {seed})"),
        }
    }
}

fn recordings(world: &World) -> impl Iterator<Item = (How, Vec<Recorded>)> + '_ {
    let seeds = recordings_of_a_kind();
    let jittered = (0..seeds).map(|seed| (How::Jittered(seed), world.disturbed(seed, 5 * MS, 0)));
    let thinned = (0..seeds).map(|seed| (How::Thinned(seed), world.disturbed(seed, 0, LOSS)));
    std::iter::once((How::Exactly, world.log.clone())).chain(jittered).chain(thinned)
}

/// The section of the document that a finding is about.
pub(crate) fn section_of(finding: &Finding) -> &'static str {
    match finding.section {
        Section::Document(section) => section,
        Section::Line(line) => panic!("no rules of the user's own are given, and line {line} is one"),
    }
}
