//! The runs of a harness, and what is learnt from them.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt;
use std::panic::{self, AssertUnwindSafe, Location};
use std::sync::Once;

use super::source::Source;

/// How a harness is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Runs {
    /// So many times, on random values. The same values for the same seed: a failure can be looked at again.
    Random(u32),
    /// Once for every combination of values.
    Every,
}

/// A place in a harness that some run has to reach.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Cover {
    /// The source file.
    pub file: &'static str,
    /// The line in it.
    pub line: u32,
    /// What is to be seen there.
    pub what: &'static str,
}

/// What the runs of a harness have shown.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// How many there were.
    pub runs: u64,
    /// How many of them no assumption rejected.
    pub accepted: u64,
    /// Each place that was to be covered and was come by, and whether its condition held there in some run. An assumption
    /// that comes later does not matter, as it does not to Kani.
    pub covers: BTreeMap<Cover, bool>,
    /// The first run that failed; none came after it.
    pub failure: Option<Failure>,
}

/// A run that failed.
#[derive(Clone, Debug)]
pub struct Failure {
    /// What the assertion said.
    pub message: String,
    /// The values that the harness drew, in order.
    pub drawn: Vec<String>,
}

/// Why the runs of a harness show nothing, or show that it does not hold.
#[derive(Clone, Debug)]
pub enum Complaint {
    /// A run failed.
    Failed(Failure),
    /// Nearly all runs were rejected.
    Rejected {
        /// How many there were.
        runs: u64,
        /// How many counted.
        accepted: u64,
    },
    /// These were never reached; or there was nothing to reach, and so no sign that the harness looks at anything.
    Uncovered(Vec<Cover>),
}

impl Outcome {
    /// One in so many random runs has to count.
    const LEAST: u64 = 20;

    /// What is wrong, if anything is.
    pub fn complaint(&self, runs: Runs) -> Option<Complaint> {
        let missing: Vec<Cover> =
            self.covers.iter().filter(|&(_, &reached)| !reached).map(|(&cover, _)| cover).collect();
        let Self { runs: made, accepted, .. } = *self;
        if let Some(failure) = &self.failure {
            Some(Complaint::Failed(failure.clone()))
        } else if accepted == 0 || runs != Runs::Every && accepted < made / Self::LEAST {
            Some(Complaint::Rejected { runs: made, accepted })
        } else if !missing.is_empty() || self.covers.is_empty() {
            Some(Complaint::Uncovered(missing))
        } else {
            None
        }
    }
}

impl fmt::Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Failed(Failure { message, drawn }) => {
                write!(f, "{message}\nwith the values\n  {}", drawn.join("\n  "))
            }
            Self::Rejected { runs, accepted } => write!(
                f,
                "only {accepted} of {runs} runs met the assumptions; expected at least one in {}: draw values that fit",
                Outcome::LEAST
            ),
            Self::Uncovered(missing) if missing.is_empty() => {
                f.write_str("came by no kani::cover!; expected one for the interesting case")
            }
            Self::Uncovered(missing) => {
                f.write_str("never reached:")?;
                missing
                    .iter()
                    .try_for_each(|Cover { file, line, what }| write!(f, "\n  {file}:{line}: {what}"))
            }
        }
    }
}

/// What is going on in a run.
struct Run {
    source: Source,
    /// What has been drawn, if somebody wants to know.
    drawn: Option<Vec<String>>,
    covers: BTreeMap<Cover, bool>,
    /// Where and why an assertion failed.
    failed: Option<String>,
}

thread_local! {
    static RUN: RefCell<Option<Run>> = const { RefCell::new(None) };
}

/// The payload with which a run ends that does not count.
struct Rejected;

fn with<T>(act: impl FnOnce(&mut Run) -> T) -> T {
    RUN.with_borrow_mut(|run| match run {
        Some(run) => act(run),
        None => panic!("a value was drawn outside of a run; run the harness with check or replay"),
    })
}

/// Draws a value.
pub(super) fn draw<T: fmt::Debug>(any: impl FnOnce(&mut Source) -> T) -> T {
    with(|run| {
        let value = any(&mut run.source);
        if let Some(drawn) = &mut run.drawn {
            drawn.push(format!("{value:?}"));
        }
        value
    })
}

pub(super) fn enumerates() -> bool {
    with(|run| run.source.enumerates())
}

pub(super) fn reject() {
    panic::resume_unwind(Box::new(Rejected));
}

pub(super) fn cover(cover: Cover, condition: bool) {
    with(|run| *run.covers.entry(cover).or_default() |= condition);
}

/// What became of one run.
enum End {
    Accepted,
    Rejected,
    Failed,
}

/// Runs a harness once.
fn once(harness: fn(), source: Source, listen: bool) -> (End, Run) {
    let run = Run { source, drawn: listen.then(Vec::new), covers: BTreeMap::new(), failed: None };
    RUN.set(Some(run));
    let end = match panic::catch_unwind(AssertUnwindSafe(harness)) {
        Ok(()) => End::Accepted,
        Err(payload) if payload.is::<Rejected>() => End::Rejected,
        Err(_) => End::Failed,
    };
    match RUN.take() {
        Some(run) => (end, run),
        None => panic!("a harness ran another one"),
    }
}

/// Runs a harness many times, until one run fails. Random values are drawn from the seed.
///
/// A panic inside of a run is not printed: it stands in the outcome.
pub fn check(harness: fn(), runs: Runs, seed: u64) -> Outcome {
    listen_to_panics();
    let mut outcome = Outcome::default();
    let mut random = fastrand::Rng::with_seed(seed);
    let mut source = next_source(runs, &mut random, None);
    while let Some(values) = source {
        let (end, run) = once(harness, values.clone(), false);
        outcome.runs += 1;
        for (cover, reached) in run.covers {
            *outcome.covers.entry(cover).or_default() |= reached;
        }
        match end {
            End::Accepted => outcome.accepted += 1,
            End::Rejected => {}
            End::Failed => {
                outcome.failure = Some(failure(harness, values));
                break;
            }
        }
        let more = !matches!(runs, Runs::Random(count) if outcome.runs >= u64::from(count));
        source = if more { next_source(runs, &mut random, Some(run.source)) } else { None };
    }
    outcome
}

/// The values of the next run.
fn next_source(runs: Runs, random: &mut fastrand::Rng, last: Option<Source>) -> Option<Source> {
    /// More bytes than any harness uses.
    const BYTES: usize = 1024;
    match (runs, last) {
        (Runs::Random(_), _) => {
            let mut data = vec![0; BYTES];
            random.fill(&mut data);
            Some(Source::bytes(data))
        }
        (Runs::Every, None) => Some(Source::first()),
        (Runs::Every, Some(last)) => last.next(),
    }
}

/// The run that failed, once more, for what it drew.
fn failure(harness: fn(), values: Source) -> Failure {
    let (_, run) = once(harness, values, true);
    Failure { message: run.failed.unwrap_or_default(), drawn: run.drawn.unwrap_or_default() }
}

/// Runs a harness once, on bytes that were chosen elsewhere. Whether an assumption rejects them does not matter; an
/// assertion that fails panics as it does anywhere.
pub fn replay(harness: fn(), bytes: &[u8]) {
    let run =
        Run { source: Source::bytes(bytes.to_vec()), drawn: None, covers: BTreeMap::new(), failed: None };
    RUN.set(Some(run));
    let end = panic::catch_unwind(AssertUnwindSafe(harness));
    RUN.set(None);
    if let Err(payload) = end {
        if !payload.is::<Rejected>() {
            panic::resume_unwind(payload);
        }
    }
}

/// Lets a panic of a run be noted in the run, instead of printed.
fn listen_to_panics() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let usual = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            let place = info.location().map(Location::to_string).unwrap_or_default();
            let payload = info.payload();
            let text = payload.downcast_ref::<&str>().copied();
            let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
            let noted = RUN.try_with(|run| match run.try_borrow_mut().as_deref_mut() {
                Ok(Some(run)) => {
                    run.failed = Some(format!("{}, at {place}", text.unwrap_or("a panic")));
                    true
                }
                // Nothing runs, or what runs was about to draw: the stand-in itself is wrong.
                Ok(None) | Err(_) => false,
            });
            if noted != Ok(true) {
                usual(info);
            }
        }));
    });
}
