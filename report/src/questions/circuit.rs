//! Who opened the shutdown circuit, whether frames got lost, and what is to be fixed first.

use adsdv_oracle::judge::{Finding, Measure, Party, Rule, Severity};
use adsdv_spec::messages::Node;
use adsdv_spec::{AsState, Atom, Fault, Faults};

use super::answer::{AnswerJson, SHOWN, SOON_NS, answer, cause, margin};
use crate::facts::{Facts, because, first, number};
use crate::lanes::gaps as silences;
use crate::mood::Mood;
use crate::recording::Found;
use crate::time::Seconds;

pub(super) fn opened(facts: &Facts<'_>) -> AnswerJson {
    const QUESTION: &str = "Who opened the shutdown circuit, as far as can be known?";
    let stop = facts.report.transitions.iter().find(|one| one.to == AsState::EmergencyBrake);
    if !facts.report.exercised.vcu {
        let text = "No frame of the VCU is in this recording.".to_owned();
        return answer(QUESTION, "sdc", Mood::Unknown, None, text);
    }
    let Some(stop) = stop else {
        let text =
            "No emergency stop is in this recording, and no message shows the circuit itself.".to_owned();
        return answer(QUESTION, "sdc", Mood::Good, None, text);
    };
    let at = Some(stop.t_ns);
    if stop.remote_estop {
        let text = format!("The E-stop of the remote control: pressed by {} s.", Seconds(stop.t_ns));
        return answer(QUESTION, "sdc", Mood::Bad, at, text);
    }
    let circuit =
        stop.decided.is_some_and(|(term, _)| term.literals().any(|(atom, _)| atom == Atom::SdcOpen));
    let raised = opening(facts, stop.t_ns);
    let when = Seconds(stop.t_ns);
    let named = cause(facts, stop.t_ns).map_or_else(String::new, |cause| format!(" The VCU names {cause}."));
    let is_told = |raised: &&(Fault, &str)| raised.0 != Fault::HvilOpenFault;
    let causes: Vec<&str> = raised.iter().filter(is_told).map(|(_, name)| *name).collect();
    let (mood, text) = if !causes.is_empty() {
        (
            Mood::Bad,
            format!("With the stop at {when} s the VCU shows {}, which opens it.{named}", causes.join(", ")),
        )
    } else if circuit || !raised.is_empty() {
        let who = "no message shows whether it was a button, a switch or a fault of the vehicle";
        (Mood::Unknown, format!("It was open at {when} s, and {who}.{named}"))
    } else {
        let text = format!(
            "The VCU itself: at {when} s it had reason for an emergency stop: {}.{named}",
            because(facts.rules(), stop),
        );
        (Mood::Care, text)
    };
    answer(QUESTION, "sdc", mood, at, text)
}

/// The faults that open the circuit by themselves and are shown soon after a time.
fn opening(facts: &Facts<'_>, t_ns: i64) -> Vec<(Fault, &'static str)> {
    let status = facts.signal(Node::Vcu, "as_state").and_then(|found| facts.edition.bus.message(found.id));
    let Some(status) = status else { return Vec::new() };
    let flags = Fault::ALL.iter().filter(|fault| Faults::OPENING.has(**fault));
    let raised = flags.filter_map(|fault| {
        let signal = status.signal(fault.flag())?;
        let raw = facts.at(Some(Found { id: status.id, signal }), t_ns + SOON_NS)?;
        (raw != 0).then_some((*fault, signal.name))
    });
    raised.collect()
}

pub(super) fn lost(facts: &Facts<'_>) -> AnswerJson {
    const QUESTION: &str = "Did frames get lost?";
    let drops = &facts.recording.drops;
    let gaps: Vec<&Finding> = facts.of_rule(Rule::Gap).collect();
    let told: Vec<String> =
        gaps.iter().map(|one| format!("at {} s, {}", Seconds(one.t_ns), one.seen)).collect();
    let mut texts = Vec::new();
    let dropped: u64 = drops.iter().map(|lost| lost.count).sum();
    if !told.is_empty() {
        texts.push(first(&told, SHOWN));
    } else if dropped > 0 {
        texts.push(format!("the recorder says that it lost {dropped} frames"));
    }
    let silent = silences(facts.recording, &facts.edition.bus);
    if let Some((from, until)) = silent.iter().max_by_key(|(from, until)| until - from) {
        let longest = format!("{} s from {} s on", Seconds((until - from) * 1000), Seconds(from * 1000));
        let times = if silent.len() == 1 {
            "once, for".to_owned()
        } else {
            format!("{} times, once for", silent.len())
        };
        texts.push(format!("the bus was silent {times} {longest}"));
    }
    let broken = facts.of_rule(Rule::BrokenLine).count();
    if broken > 0 {
        texts.push("lines of the log could not be read".to_owned());
    }
    let missed: Vec<String> =
        facts.of_rule(Rule::MessageMissed).map(|one| format!("{} s", Seconds(one.t_ns))).collect();
    if !missed.is_empty() {
        texts.push(format!("a message was missed at {}", first(&missed, SHOWN)));
    }
    let at = drops.first().map(|lost| lost.t_ns);
    let at = at.or_else(|| silent.first().map(|(from, _)| from * 1000));
    let at = at.or_else(|| gaps.first().map(|one| one.t_ns));
    if texts.is_empty() {
        let gap = margin(facts, Measure::MessageGap);
        let longest = gap.map_or_else(String::new, |gap| {
            let id = gap.message.map_or_else(String::new, |id| format!(" of {id:03X}h"));
            format!(" The longest time between two frames{id} was {} {}.", number(gap.value), gap.unit)
        });
        let text = format!("Nothing shows that any did.{longest}");
        return answer(QUESTION, "periods", Mood::Good, gap.map(|gap| gap.t_ns), text);
    }
    answer(QUESTION, "gaps", Mood::Care, at, format!("It looks so: {}.", texts.join("; ")))
}

pub(super) fn mend(facts: &Facts<'_>) -> AnswerJson {
    const QUESTION: &str = "What is to be fixed first?";
    let first = facts.of_severity(Severity::Violation).next();
    let (first, mood) = match first {
        Some(first) => (Some(first), Mood::Bad),
        None => (facts.of_severity(Severity::Warning).next(), Mood::Care),
    };
    let Some(first) = first else {
        if let Some(lack) = facts.report.exercised.lacks().first() {
            let text = format!("Nothing that this recording shows; but in it is {}.", lack.text());
            return answer(QUESTION, "findings", Mood::Unknown, None, text);
        }
        let text = "Nothing: there is no violation and no warning.".to_owned();
        return answer(QUESTION, "findings", Mood::Good, None, text);
    };
    let whose = match first.party {
        Party::Ai => "In the AI Computer",
        Party::Vcu => "In the VCU",
        Party::Log => "In the recording",
        Party::Own => "By your own rule",
    };
    let text = format!("{whose}: {}, at {} s ({}).", first.message(), Seconds(first.t_ns), first.section);
    answer(QUESTION, "findings", mood, Some(first.t_ns), text)
}
