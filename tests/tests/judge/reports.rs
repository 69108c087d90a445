//! Everything that the judge says of the runs of these tests, as they are recorded exactly: `printed.txt` has it to the letter.
//! A change of a text, of a time, or of when it is told shows as a change of that file.
//!
//! `UPDATE_EXPECT=1 cargo test -p adsdv-tests --test judge` writes it anew, from all of them: a filter would leave others out.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::hash::Hasher as _;
use std::path::Path;
use std::sync::{LazyLock, Mutex, PoisonError};
use std::{env, fs};

use adsdv_oracle::judge::{Finding, Judge, JudgeOptions, Report, Severity, Transition};
use adsdv_spec::messages::Frame;
use adsdv_spec::{Knowledge, Term, Truth};
use adsdv_tests::world::Recorded;
use fnv::FnvHasher;

/// What is said of the runs of a name. Tests may give the same name to several.
type Written = BTreeMap<String, BTreeSet<String>>;

/// Between two texts of the file.
const RULE: &str = "================";

static EXPECTED: LazyLock<Written> = LazyLock::new(|| {
    let file = fs::read_to_string(file()).unwrap_or_default();
    let mut printed = Written::new();
    for text in file.split(&format!("{RULE} ")).skip(1) {
        let (name, text) = text.split_once('\n').unwrap_or((text, ""));
        printed.entry(name.to_owned()).or_default().insert(text.trim_end().to_owned());
    }
    printed
});

fn file() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/judge/reports.txt")
}

/// What happens to a judge; times in nanoseconds since the first frame.
pub(crate) enum Event {
    Frame(i64, Frame),
    /// A frame that is not judged.
    Other(i64),
    TimePasses(i64),
    Lost(u64),
}

/// The judge says of this run what the file says.
pub(crate) fn is_as_written(name: &str, log: &[Recorded], options: JudgeOptions) {
    let origin = log.first().map_or(0, |first| first.t);
    let events: Vec<Event> =
        log.iter().map(|recorded| Event::Frame(recorded.t - origin, recorded.frame)).collect();
    what_happens_is_as_written(name, &events, options);
}

/// The same of whatever happens to the judge.
pub(crate) fn what_happens_is_as_written(name: &str, events: &[Event], options: JudgeOptions) {
    let text = printed(events, options);
    if env::var_os("UPDATE_EXPECT").is_some() {
        write(name, &text);
        return;
    }
    let expected = EXPECTED.get(name);
    if expected.is_some_and(|texts| texts.contains(&text)) {
        return;
    }
    let expected: Vec<&String> = expected.into_iter().flatten().collect();
    panic!("{name}: reports.txt has {expected:#?}, and the judge says\n{text}");
}

/// Writes the file from what all tests say, one after the other.
fn write(name: &str, text: &str) {
    static WRITTEN: Mutex<Written> = Mutex::new(Written::new());
    assert!(env::var_os("NEXTEST").is_none(), "cargo test writes it: nextest runs each test by itself");
    let mut written = WRITTEN.lock().unwrap_or_else(PoisonError::into_inner);
    written.entry(name.to_owned()).or_default().insert(text.to_owned());
    let texts = written.iter().flat_map(|(name, texts)| texts.iter().map(move |text| (name, text)));
    let all = texts.fold(String::new(), |mut all, (name, text)| {
        let _ = writeln!(all, "{RULE} {name}\n{text}\n");
        all
    });
    fs::write(file(), all).expect("reports.txt can be written");
}

/// The report, each line with the time at which it was news.
fn printed(events: &[Event], options: JudgeOptions) -> String {
    let mut judge = Judge::new(options);
    let (mut news, mut now) = (Vec::new(), 0);
    for event in events {
        match *event {
            Event::Frame(t, frame) => {
                judge.frame(t, frame.id.into(), frame.data());
                now = t;
            }
            Event::Other(t) => {
                judge.other_frame(t);
                now = t;
            }
            Event::TimePasses(t) => {
                judge.time_passes(t);
                now = t;
            }
            Event::Lost(count) => judge.lost(count),
        }
        let (transitions, findings) = judge.news();
        let lines = transitions.iter().map(transition).chain(findings.iter().map(finding));
        news.extend(lines.map(|line| (line, now)));
    }
    let state = judge.state().map_or("unknown".to_owned(), |state| state.to_string());
    let report = judge.finish();
    let (verdict, violations) = (report.verdict().name(), report.count(Severity::Violation));
    let Report { frames, duration_ns, transitions, findings, responses } = report;
    let mut text = format!(
        "{frames} frames in {} us, then {state}: {verdict}, {violations} violations\n",
        duration_ns / 1000
    );
    if let (Some(min), Some(median), Some(max)) =
        (responses.min_ms(), responses.quantile_ms(0.5), responses.max_ms())
    {
        let _ = writeln!(text, "{} responses: {min} to {max} ms, median {median} ms", responses.count());
    }
    for line in transitions.iter().map(transition).chain(findings.iter().map(finding)) {
        let place = news.iter().position(|(told, _)| *told == line);
        let told = place.map(|place| news.swap_remove(place).1);
        let told = told.map_or("at the end".to_owned(), |t| format!("at {} us", t / 1000));
        let _ = writeln!(text, "{line} [told {told}]");
    }
    for (line, t) in news {
        let _ = writeln!(text, "{line} [told at {} us, and not in the report]", t / 1000);
    }
    shortened(&text)
}

/// Of a long report, the first lines; of the others how many they are, and a sum of them (FNV-1a).
fn shortened(text: &str) -> String {
    const LINES: usize = 12;
    let lines: Vec<&str> = text.lines().collect();
    let (first, others) = lines.split_at(lines.len().min(LINES));
    let mut text = first.join("\n");
    if !others.is_empty() {
        let mut sum = FnvHasher::default();
        for line in others {
            sum.write(line.as_bytes());
        }
        let _ = write!(text, "\nand {} lines more, of the sum {:016X}", others.len(), sum.finish());
    }
    text
}

fn transition(transition: &Transition) -> String {
    let Transition { t_ns, from, to, section, justified, decided, or, .. } = transition;
    let mut line = format!("{} us: {from} -> {to} ({section}), {justified}", t_ns / 1000);
    for (word, (term, known)) in
        decided.iter().map(|one| ("by", one)).chain(or.iter().map(|other| ("or by", other)))
    {
        let _ = write!(line, ", {word} {}", alternative(term, *known));
    }
    line
}

/// The conditions of an alternative with what was known of them; of one that holds, how many there are.
fn alternative(term: &Term, known: Knowledge) -> String {
    if term.truth(known) == Truth::True {
        return format!("all {} of {}", term.literals().count(), term.section);
    }
    let conditions: Vec<String> =
        term.literals().map(|(atom, _)| format!("{atom} {}", known.of(atom))).collect();
    conditions.join(" and ")
}

fn finding(finding: &Finding) -> String {
    let Finding { t_ns, severity, party, section, rule, message } = finding;
    format!(
        "{} us: {} of {} by {}, {section}: {message}",
        t_ns / 1000,
        severity.name(),
        rule.id(),
        party.name()
    )
}
