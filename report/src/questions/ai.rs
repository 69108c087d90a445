//! Whether the AI Computer answered in time, what came of its requests, and whether FINISHED was too early.

use adsdv_oracle::judge::{Finding, Measure, Rule, Severity};
use adsdv_spec::messages::{MissionStatus, Node};

use super::answer::{AnswerJson, SHOWN, answer, margin};
use crate::facts::{Facts, first, number};
use crate::mood::Mood;
use crate::requests::{Requests, requests};
use crate::time::Seconds;

pub(super) fn answered(facts: &Facts<'_>) -> AnswerJson {
    const QUESTION: &str = "Did the AI Computer answer in time?";
    let times = &facts.report.responses;
    let late: Vec<&Finding> =
        facts.of_rule(Rule::HandshakeLate).filter(|finding| finding.severity != Severity::Note).collect();
    let slowest = margin(facts, Measure::HandshakeAnswer);
    let (Some(median), Some(max)) = (times.quantile_ms(0.5), times.max_ms()) else {
        let text = "No answer to the handshake is in this recording.".to_owned();
        return answer(QUESTION, "handshake", Mood::Unknown, None, text);
    };
    let limit = facts.rules().timing.handshake_ms;
    let measured = format!(
        "{} answers; the median took {} ms, the slowest {} ms; the limit is {limit} ms",
        times.count(),
        number(median),
        number(max),
    );
    let at = late.first().map(|finding| finding.t_ns).or_else(|| slowest.map(|margin| margin.t_ns));
    if late.is_empty() {
        return answer(QUESTION, "handshake", Mood::Good, at, format!("Yes: {measured}."));
    }
    let texts: Vec<String> = late.iter().map(|finding| format!("{} s", Seconds(finding.t_ns))).collect();
    answer(QUESTION, "handshake", Mood::Bad, at, format!("No, late at {}: {measured}.", first(&texts, SHOWN)))
}

pub(super) fn reached(facts: &Facts<'_>) -> AnswerJson {
    const QUESTION: &str = "Which request never reached the wheels?";
    let Requests { asked, missed, untold } = requests(facts);
    let shown = asked - untold;
    if asked == 0 {
        let text = "The AI Computer asked for nothing: every request was zero, or none came.".to_owned();
        return answer(QUESTION, "torque-front", Mood::Unknown, None, text);
    }
    if shown == 0 {
        let text = format!("Of {asked} requests, no frame of the VCU shows what came of any.");
        return answer(QUESTION, "torque-front", Mood::Unknown, None, text);
    }
    let rest = if untold > 0 {
        format!(" Of {untold} more, no frame shows what came of them.")
    } else {
        String::new()
    };
    if missed.is_empty() {
        let text = format!("None: the vehicle showed something of each of {shown} requests.{rest}");
        return answer(QUESTION, "torque-front", Mood::Good, None, text);
    }
    let texts: Vec<String> = missed.iter().map(|one| one.text.clone()).collect();
    let (at, show) = missed.first().map_or((None, "torque-front"), |one| (Some(one.t_ns), one.plot));
    let text = format!("Of {shown} requests, these: {}.{rest}", first(&texts, SHOWN));
    answer(QUESTION, show, Mood::Care, at, text)
}

pub(super) fn finished(facts: &Facts<'_>) -> AnswerJson {
    const QUESTION: &str = "Was FINISHED too early?";
    let found = facts.signal(Node::Ai, "mission_status");
    let declared = facts.became(found, |raw| raw == MissionStatus::Finished as i32);
    let limit = facts.rules().thresholds.wheel_speed;
    let wheels = ["fl_wheel_speed", "fr_wheel_speed", "rl_wheel_speed", "rr_wheel_speed"]
        .map(|wheel| facts.signal(Node::Vcu, wheel));
    let limit = wheels[0].map_or(0.0, |wheel| wheel.signal.physical(limit.raw()));
    let fastest = |t: i64| {
        let speeds =
            wheels.iter().filter_map(|wheel| Some(wheel.as_ref()?.signal.physical(facts.at(*wheel, t)?)));
        speeds.reduce(f64::max)
    };
    let unit = wheels[0].map_or("", |wheel| wheel.signal.unit);
    let Some(first_time) = declared.first() else {
        let text = "FINISHED was never declared in this recording.".to_owned();
        return answer(QUESTION, "mission-status", Mood::Unknown, None, text);
    };
    let early = facts.of_rule(Rule::FinishedMoving).find(|finding| finding.severity != Severity::Note);
    let texts: Vec<String> = declared
        .iter()
        .map(|t| match fastest(*t) {
            Some(speed) => {
                format!("at {} s the fastest wheel turned at {} {unit}", Seconds(*t), number(speed))
            }
            None => format!("at {} s no wheel speed is known", Seconds(*t)),
        })
        .collect();
    let measured = format!("{}; at rest is below {} {unit}", first(&texts, SHOWN), number(limit));
    match early {
        Some(early) => {
            answer(QUESTION, "mission-status", Mood::Bad, Some(early.t_ns), format!("Yes: {measured}."))
        }
        None if declared.iter().all(|t| fastest(*t).is_some_and(|speed| speed < limit)) => {
            answer(QUESTION, "mission-status", Mood::Good, Some(*first_time), format!("No: {measured}."))
        }
        None => {
            let text = format!("Nothing shows that it was: {measured}.");
            answer(QUESTION, "mission-status", Mood::Unknown, Some(*first_time), text)
        }
    }
}
