//! Why it stopped, when "Go" was pressed, what it waited for, and whether the wheels were straight.

use adsdv_oracle::judge::Transition;
use adsdv_oracle::remote::Remote;
use adsdv_oracle::why::Stay;
use adsdv_spec::messages::Node;
use adsdv_spec::{AsState, Atom, Row, Term};

use super::answer::{AnswerJson, SHOWN, SOON_NS, answer, cause};
use crate::facts::{Facts, because, blocked, first, number, on};
use crate::mood::Mood;
use crate::time::Seconds;

pub(super) fn stopped(facts: &Facts<'_>) -> AnswerJson {
    const QUESTION: &str = "Why did it stop?";
    let stops = [AsState::EmergencyBrake, AsState::Finished];
    let transitions = &facts.report.transitions;
    let stop = transitions.iter().find(|one| one.to == AsState::EmergencyBrake);
    let stop = stop.or_else(|| transitions.iter().rev().find(|one| stops.contains(&one.to)));
    let Some(stop) = stop else {
        let drove = facts.report.exercised.states.contains(&AsState::Driving);
        let text = match (facts.report.stays.last(), drove) {
            (Some(last), true) => format!("It did not: the recording ends in {}.", last.state),
            (Some(last), false) => format!("It never drove: the recording ends in {}.", last.state),
            (None, _) => "No frame shows a state of the car.".to_owned(),
        };
        return answer(QUESTION, "states", Mood::Unknown, None, text);
    };
    let mood = if stop.to == AsState::EmergencyBrake { Mood::Bad } else { Mood::Good };
    let named = cause(facts, stop.t_ns).filter(|_| stop.to == AsState::EmergencyBrake);
    let named = named.map_or_else(String::new, |cause| format!(" The VCU names as the cause: {cause}."));
    let text = format!(
        "At {} s it went from {} to {} ({}): {}.{named}",
        Seconds(stop.t_ns),
        stop.from,
        stop.to,
        stop.section,
        because(facts.rules(), stop),
    );
    answer(QUESTION, "states", mood, Some(stop.t_ns), text)
}

pub(super) fn went(facts: &Facts<'_>) -> AnswerJson {
    const QUESTION: &str = "When was \"Go\" pressed?";
    let vain = &facts.report.go_presses;
    let why = |t: i64| vain.iter().find(|press| press.t_ns == t).map(|press| press.why(facts.rules()));
    let (pressed, where_, show, hidden) = match remote_go(facts) {
        Some(pressed) => (pressed, "The switch of the remote control", "remote-go", ""),
        None => (
            facts.became(facts.signal(Node::Vcu, "go_signal"), |raw| raw != 0),
            "GO_SIGNAL",
            "go",
            " A press outside of AS_DRIVING may not show.",
        ),
    };
    let mut times: Vec<i64> = pressed.into_iter().chain(vain.iter().map(|press| press.t_ns)).collect();
    times.sort_unstable();
    times.dedup();
    let texts: Vec<String> = times
        .iter()
        .map(|t| {
            let driving =
                |one: &&Transition| one.to == AsState::Driving && (0..SOON_NS).contains(&(one.t_ns - t));
            let began = facts.report.transitions.iter().any(|one| driving(&one));
            let state = match (why(*t), facts.stay_at(*t)) {
                (Some(why), _) => format!(", in vain: {why}"),
                (None, _) if began => ", and AS_DRIVING began".to_owned(),
                (None, Some(stay)) => format!(" in {}", stay.state),
                (None, None) => String::new(),
            };
            format!("at {} s{state}", Seconds(*t))
        })
        .collect();
    if texts.is_empty() && !facts.report.exercised.vcu {
        let text = format!("No frame that has {where_} is in this recording.");
        return answer(QUESTION, show, Mood::Unknown, None, text);
    }
    if texts.is_empty() {
        let never = format!("{where_} never went on in this recording.{hidden}");
        return answer(QUESTION, show, Mood::Unknown, None, never);
    }
    let mood = if vain.is_empty() { Mood::Good } else { Mood::Care };
    let text = format!("{where_} went on {}.{hidden}", first(&texts, SHOWN));
    answer(QUESTION, show, mood, times.first().copied(), text)
}

/// When "Go" went on at the remote control, where that is on the bus.
fn remote_go(facts: &Facts<'_>) -> Option<Vec<i64>> {
    let remote = Remote::of(&facts.edition.bus)?;
    let frames = facts.recording.frames.iter().filter(|frame| frame.id == remote.message().id);
    let (mut before, mut times, mut heard) = (true, Vec::new(), false);
    for frame in frames {
        let Some(switches) = remote.read(frame.data()) else { continue };
        heard = true;
        if switches.go && !before {
            times.push(frame.t_ns);
        }
        before = switches.go;
    }
    heard.then_some(times)
}

pub(super) fn waited(facts: &Facts<'_>) -> AnswerJson {
    const QUESTION: &str = "What did it wait for?";
    let waits = |stay: &&Stay| [AsState::Off, AsState::Ready].contains(&stay.state);
    let drove = facts.report.transitions.iter().position(|one| one.to == AsState::Driving);
    let until = drove.and_then(|place| facts.report.transitions.get(place)).map_or(i64::MAX, |one| one.t_ns);
    let stays = facts.report.stays.iter().filter(waits).filter(|stay| stay.since_ns < until);
    // What blocked it for longest before it drove.
    let times = stays.flat_map(|stay| {
        let all = on(stay).map_or(&[][..], |untaken| &untaken.blocked);
        all.iter().map(move |time| (stay, time))
    });
    let mut times: Vec<_> = times.collect();
    times.sort_by_key(|(_, time)| time.since_ns - time.until_ns);
    times.truncate(3);
    times.sort_by_key(|(_, time)| time.since_ns);
    let texts: Vec<String> = times
        .iter()
        .map(|(stay, time)| {
            let (since, until) = (Seconds(time.since_ns), Seconds(time.until_ns));
            format!("{} from {since} to {until} s: {}", stay.state, blocked(facts.rules(), time))
        })
        .collect();
    if texts.is_empty() {
        let text = "Nothing is known to have held it before it drove.".to_owned();
        return answer(QUESTION, "arrows", Mood::Unknown, None, text);
    }
    let mood = if drove.is_some() { Mood::Good } else { Mood::Care };
    let at =
        times.iter().max_by_key(|(_, time)| time.until_ns - time.since_ns).map(|(_, time)| time.since_ns);
    answer(QUESTION, "arrows", mood, at, format!("{}.", texts.join(". ")))
}

pub(super) fn straight(facts: &Facts<'_>) -> AnswerJson {
    const QUESTION: &str = "Was the steering at zero?";
    let found = facts.signal(Node::Vcu, "steer_angle");
    let limit = facts.rules().text(Atom::SteerStraight, true).to_string();
    let angle = |t: i64| {
        facts.at(found, t).zip(found).map(|(raw, found)| (found.signal.physical(raw), found.signal.unit))
    };
    let driven = facts.report.transitions.iter().filter(|one| one.to == AsState::Driving);
    let driven: Vec<i64> = driven.map(|one| one.t_ns).collect();
    let at = driven.first().copied().or_else(|| {
        let ready = facts.report.stays.iter().rev().find(|stay| stay.state == AsState::Ready);
        ready.map(|stay| stay.until_ns.min(facts.recording.end_ns))
    });
    let Some((t, (degrees, unit))) = at.and_then(|t| Some((t, angle(t)?))) else {
        let text =
            "It never mattered: the car was neither in AS_READY nor in AS_DRIVING, or no steer angle came.";
        return answer(QUESTION, "steering", Mood::Unknown, at, text.to_owned());
    };
    let when = if driven.is_empty() { "at the end of AS_READY" } else { "when AS_DRIVING began" };
    let asks_for_it = |term: &Term| term.on.has(Atom::SteerStraight);
    if !facts.rules().table.rows().iter().flat_map(Row::terms).any(asks_for_it) {
        let text = format!("It may be anywhere: {} {unit} {when}, at {} s.", number(degrees), Seconds(t));
        return answer(QUESTION, "steering", Mood::Good, Some(t), text);
    }
    let straight = facts.rules().thresholds.straight;
    let is = found.is_some_and(|found| degrees.abs() < found.signal.physical(straight.raw()));
    let yes = if is { "Yes" } else { "No" };
    let mood = if is { Mood::Good } else { Mood::Bad };
    let text =
        format!("{yes}: {} {unit} {when}, at {} s; it has to be {limit}.", number(degrees), Seconds(t));
    answer(QUESTION, "steering", mood, Some(t), text)
}
