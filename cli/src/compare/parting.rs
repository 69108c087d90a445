//! Where two recordings part, in words.

use std::fmt::{self, Write as _};

use adsdv_oracle::compare::{Parting, Recording, Way, Which};
use adsdv_oracle::judge::Transition;
use adsdv_oracle::why::{Blocked, Condition, Mover, Untaken, place_of};
use adsdv_spec::{AsState, Atom, Edition, Truth};

use super::section::heading;
use crate::layout::{Seconds, wrapped};
use crate::report::by;

/// So many conditions tell enough.
const CONDITIONS: usize = 4;
/// So many presses of "Go" do.
const PRESSES: usize = 2;
/// Where text stands below its first line.
const INDENT: usize = 4;

pub(super) fn write(
    out: &mut String,
    recordings: [&Recording; 2],
    begin: Option<[AsState; 2]>,
    parting: Option<&Parting<'_>>,
    width: usize,
) -> fmt::Result {
    heading(out, "WHERE THEY PART", begin.is_none() && parting.is_none())?;
    if let Some([good, bad]) = begin {
        writeln!(out, "  GOOD begins in {good}, BAD in {bad}")?;
    }
    let Some(parting) = parting else { return Ok(()) };
    for (which, recording) in [Which::Good, Which::Bad].into_iter().zip(recordings) {
        let line = way(parting, parting.way(which), recording);
        let mut text = String::new();
        wrapped(&mut text, line.split(' '), 2 + "GOOD  ".len(), width);
        writeln!(out, "  {:4}  {}", which.name(), text.trim())?;
    }
    for (which, recording) in [Which::Good, Which::Bad].into_iter().zip(recordings) {
        presses(out, which, parting.way(which), recording, width);
    }
    let Some((missed, to)) = parting.missed() else { return Ok(()) };
    let (recording, other) = match missed {
        Which::Good => (recordings[0], Which::Bad),
        Which::Bad => (recordings[1], Which::Good),
    };
    let way = parting.way(missed);
    let Some(untaken) = way.untaken(to) else { return Ok(()) };
    let arrow = format!("{} -> {to}", parting.state);
    let Some(last) = untaken.blocked.last() else {
        return writeln!(out, "  in {} nothing that shows blocked {arrow}", missed.name());
    };
    // Of what no message shows, nothing can be said.
    let shown = last.failed.iter().chain(&last.unknown).filter(|condition| condition.id.is_some());
    let conditions: Vec<&Condition> =
        last.failed.iter().filter(|one| one.id.is_none()).chain(shown).collect();
    if conditions.is_empty() {
        return Ok(());
    }
    let (since, until) = (Seconds(last.since_ns), until(last.until_ns, recording.report.duration_ns));
    writeln!(out, "  in {} {arrow} was blocked from {since} s to {until}:", missed.name())?;
    let reference = parting.way(other).untaken(to);
    for condition in conditions.iter().take(CONDITIONS) {
        let line = blocked(recording.edition, last, condition, other, reference);
        wrapped(out, line.split(' '), INDENT, width);
    }
    if let Some(more) = conditions.len().checked_sub(CONDITIONS).filter(|more| *more > 0) {
        writeln!(out, "    and {more} more")?;
    }
    if last.until_ns < way.until_ns {
        writeln!(out, "  then it was open until {} s, and was not taken", Seconds(way.until_ns))?;
    }
    Ok(())
}

/// "Go" that was pressed in vain while the state lasted.
fn presses(out: &mut String, which: Which, way: &Way<'_>, recording: &Recording, width: usize) {
    let meanwhile = |t_ns| (way.since_ns..=way.until_ns).contains(&t_ns);
    let presses = recording.report.go_presses.iter().filter(|press| meanwhile(press.t_ns));
    for press in presses.take(PRESSES) {
        let (t, why) = (Seconds(press.t_ns), press.why(&recording.edition.rules));
        let line = format!("in {} \"Go\" at {t} s starts nothing: {why}", which.name());
        wrapped(out, line.split(' '), 2, width);
    }
}

fn until(t_ns: i64, end: i64) -> String {
    if t_ns >= end { "the end".to_owned() } else { format!("{} s", Seconds(t_ns)) }
}

/// How a recording goes on.
fn way(parting: &Parting<'_>, way: &Way<'_>, recording: &Recording) -> String {
    let (state, since) = (parting.state, Seconds(way.since_ns));
    let lasted = Seconds(way.until_ns - way.since_ns);
    let Some(to) = way.to else {
        return format!("{state} from {since} s to the end, {lasted} s");
    };
    let Some(transition) = way.transition else {
        return format!("{state} from {since} s for {lasted} s, then {to} after a silence");
    };
    let decided = decided(recording.edition, transition);
    let section = transition.section;
    format!("{state} from {since} s for {lasted} s, then {to} ({section}){decided}")
}

/// What decided, whose move each condition was, and which message shows it.
fn decided(edition: &Edition, transition: &Transition) -> String {
    let Some((term, known)) = transition.decided else {
        return if transition.justified == Truth::False { ", a violation".to_owned() } else { String::new() };
    };
    let condition = |(atom, needed)| {
        let whose = Mover::of(atom).name();
        if atom == Atom::SdcOpen && transition.remote_estop {
            return format!("remote E-stop pressed ({whose})");
        }
        let seen = known.of(atom);
        let text = match seen {
            Truth::Unknown => format!("{} (not certain)", edition.rules.text(atom, needed)),
            _ => edition.rules.text(atom, seen == Truth::True).to_string(),
        };
        match place_of(&edition.bus, atom) {
            Some(place) => format!("{text} ({whose}, {:03X}h)", place.message.id),
            None => format!("{text} ({whose})"),
        }
    };
    let conditions: Vec<String> = term.literals().map(condition).collect();
    let word = if transition.justified == Truth::False { "a violation" } else { "because" };
    format!(", {word}: {}", conditions.join(", "))
}

/// What blocked, and how that was in the other recording.
fn blocked(
    edition: &Edition,
    last: &Blocked,
    condition: &Condition,
    other: Which,
    reference: Option<&Untaken>,
) -> String {
    let (needs, by) = (condition.needs(&edition.rules), by(condition));
    let seen = if last.unknown.contains(condition) {
        format!("{needs} is not known ({by})")
    } else {
        format!("{} (needs {needs}; {by})", condition.seen(&edition.rules))
    };
    let held = |untaken| format!("; {} {}", other.name(), held(untaken, condition));
    format!("{seen}{}", reference.map_or_else(String::new, held))
}

/// Since when a condition held where the arrow was taken.
fn held(untaken: &Untaken, condition: &Condition) -> String {
    let names = |blocked: &&Blocked| {
        blocked.failed.iter().chain(&blocked.unknown).any(|other| other.atom == condition.atom)
    };
    match untaken.blocked.iter().rfind(names) {
        Some(last) => format!("had it from {} s on", Seconds(last.until_ns)),
        None => "had it all along".to_owned(),
    }
}
