//! Why the VCU is where the recording ends: what blocks the arrow that the mission goes on by, and "Go" that was pressed in vain.

use std::fmt::{self, Write as _};

use adsdv_oracle::judge::Report;
use adsdv_oracle::why::{Blocked, Condition, Stay, Untaken, next_of_mission};
use adsdv_spec::{AsState, Rules};

use super::style::{self, Styled};
use crate::layout::{Seconds, counted, wrapped};

/// So many times of one arrow tell enough.
const TIMES: usize = 2;
/// What was so for less is how the frames of one cycle come.
const BRIEF_NS: i64 = 50_000_000;
/// So many conditions of one time do.
const CONDITIONS: usize = 3;
/// So many presses of "Go" do.
const PRESSES: usize = 3;
/// Where text stands below its first line.
const INDENT: usize = 2;

pub(super) fn write(out: &mut String, rules: &Rules, report: &Report, width: usize) -> fmt::Result {
    let last = report.stays.last().filter(|last| !is_over(report, last));
    let untaken = last.and_then(|stay| Some((stay, on(stay)?)));
    if untaken.is_none() && report.go_presses.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n{}", Styled(style::HEADING, "WHY NOT"))?;
    for press in report.go_presses.iter().take(PRESSES) {
        let line = format!(
            "\"Go\" at {} s starts nothing: {}, {} s after AS_READY began",
            Seconds(press.t_ns),
            press.why(rules),
            Seconds(press.ready_for_ns),
        );
        wrapped(out, line.split(' '), INDENT, width);
    }
    if let Some(more) = report.go_presses.len().checked_sub(PRESSES).filter(|more| *more > 0) {
        writeln!(out, "  \"Go\" was pressed in vain {more} more times")?;
    }
    let Some((stay, untaken)) = untaken else { return Ok(()) };
    let Some((now, before)) = untaken.blocked.split_last() else { return Ok(()) };
    let mut times: Vec<&Blocked> =
        before.iter().filter(|time| time.until_ns - time.since_ns >= BRIEF_NS).collect();
    // What it is in the end, then the nearest miss; of those that are as near, the last.
    times.sort_by_key(|time| (time.failed.len(), time.unknown.len(), -time.until_ns));
    times.insert(0, now);
    for time in times.iter().take(TIMES) {
        wrapped(out, blocked(rules, stay, untaken, time, report.duration_ns).split(' '), INDENT, width);
    }
    let more = times.len().saturating_sub(TIMES) as u64 + untaken.more;
    if more > 0 {
        writeln!(out, "  and otherwise {} more; --json has them", counted(more, "time"))?;
    }
    if let Some(open) = untaken.blocked.last().filter(|last| last.until_ns < stay.until_ns) {
        let since = Seconds(open.until_ns);
        let line = format!("{} -> {} was open from {since} s on, and was not taken", stay.state, untaken.to);
        wrapped(out, line.split(' '), INDENT, width);
    }
    Ok(())
}

/// What a VCU waits for that is still in this state, in a line, and since when; `None` where nothing blocks.
pub(crate) fn waits(rules: &Rules, stay: &Stay) -> Option<(i64, String)> {
    let untaken = on(stay)?;
    let now = untaken.blocked.last().filter(|last| last.until_ns == i64::MAX)?;
    let text = format!("{} -> {} is blocked: {}", stay.state, untaken.to, conditions(rules, now));
    Some((now.since_ns, text))
}

/// Whether the mission has come to its end in this state: nobody waits for the next one.
fn is_over(report: &Report, last: &Stay) -> bool {
    let before = report.transitions.last().map(|transition| (transition.from, transition.to));
    (before, last.state) == (Some((AsState::Finished, AsState::Off)), AsState::Off)
}

/// The arrow that the mission goes on by.
fn on(stay: &Stay) -> Option<&Untaken> {
    stay.arrows.iter().find(|untaken| untaken.to == next_of_mission(stay.state))
}

fn blocked(rules: &Rules, stay: &Stay, untaken: &Untaken, time: &Blocked, end: i64) -> String {
    let until =
        if time.until_ns >= end { "the end".to_owned() } else { format!("{} s", Seconds(time.until_ns)) };
    let since = Seconds(time.since_ns);
    format!("{} -> {} blocked {since} s to {until}: {}", stay.state, untaken.to, conditions(rules, time))
}

/// What failed, what is not known, and how much held.
fn conditions(rules: &Rules, time: &Blocked) -> String {
    let mut parts = Vec::new();
    let failed = time.failed.iter().take(CONDITIONS).map(|condition| failed(rules, condition));
    parts.extend(failed);
    if let Some(more) = time.failed.len().checked_sub(CONDITIONS).filter(|more| *more > 0) {
        parts.push(format!("and {more} more fail"));
    }
    let hidden: Vec<String> = time.unknown.iter().map(|condition| whose(rules, condition)).collect();
    if !hidden.is_empty() {
        let word = if time.failed.is_empty() { "it waits for" } else { "not known:" };
        parts.push(format!("{word} {}", hidden.join(", ")));
    }
    match time.holding.iter().count() {
        0 => {}
        1 => parts.push("the other condition holds".to_owned()),
        count => parts.push(format!("the other {count} conditions hold")),
    }
    parts.join("; ")
}

fn failed(rules: &Rules, condition: &Condition) -> String {
    let (seen, needs) = (condition.seen(rules), condition.needs(rules));
    format!("{seen} (needs {needs}; {})", by(condition))
}

fn whose(rules: &Rules, condition: &Condition) -> String {
    format!("{} ({})", condition.needs(rules), by(condition))
}

/// Whose move it is, and where it shows.
pub(crate) fn by(condition: &Condition) -> String {
    let whose = condition.mover().name();
    match condition.id {
        Some(id) if condition.is_unheard() => format!("{whose}: no {id:03X}h has come"),
        Some(id) => format!("{whose}, {id:03X}h"),
        None => whose.to_owned(),
    }
}
