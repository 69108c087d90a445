//! A run as a sequence of events between the parties: what a sequence diagram shows.

use adsdv_spec::messages::{AsState, Frame};

use super::meaning::meaning;
use super::{Closed, ClosedAction, ClosedState, ai};

/// Who takes part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Party {
    Operator,
    Ai,
    Vcu,
    Vehicle,
}

/// One action: from whom to whom, and what it says, in short lines. An event of one party with itself is its own doing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Event {
    pub(super) from: Party,
    pub(super) to: Party,
    pub(super) words: Vec<String>,
    /// The AS state that the last of these lines names, where it changes.
    pub(super) enters: Option<AsState>,
    /// How long it takes: a cycle of the VCU is what makes time go by.
    pub(super) ms: u32,
}

/// A run: the AS state at its beginning, and the events.
#[derive(Clone, Debug)]
pub(super) struct Sequence {
    pub(super) first: AsState,
    pub(super) events: Vec<Event>,
}

/// The events of a run.
pub(super) fn of(model: &Closed, run: &[(ClosedState, Option<ClosedAction>)]) -> Sequence {
    let first = run.first().map_or(AsState::default(), |(state, _)| state.control.state);
    let mut events = Vec::new();
    for pair in run.windows(2) {
        if let [(before, Some(action)), (after, _)] = pair {
            events.push(event(model, before, *action, after));
        }
    }
    Sequence { first, events }
}

/// What an action is.
pub(super) fn event(
    model: &Closed,
    before: &ClosedState,
    action: ClosedAction,
    after: &ClosedState,
) -> Event {
    let one = |from, to, words: String| Event { from, to, words: vec![words], enters: None, ms: 0 };
    match action {
        ClosedAction::VcuCycle => vcu_cycle(model, before, after),
        ClosedAction::AiCycle => ai_cycle(before, after),
        ClosedAction::FrameToAi => arrival(Party::Vcu, Party::Ai, before, before.bus.to_ai.frames().next()),
        ClosedAction::FrameToVcu => arrival(Party::Ai, Party::Vcu, before, before.bus.to_vcu.frames().next()),
        ClosedAction::AiDecidesToStop => {
            let Event { mut words, .. } = ai_cycle(before, after);
            words.insert(0, "mission completed".to_owned());
            Event { from: Party::Ai, to: Party::Ai, words, enters: None, ms: 0 }
        }
        ClosedAction::Operator(act) => one(Party::Operator, Party::Vcu, act.to_string()),
        ClosedAction::RemoteEstop(pressed) => {
            let words = if pressed { "remote E-stop pressed" } else { "remote E-stop released" };
            one(Party::Operator, Party::Vcu, words.to_owned())
        }
        ClosedAction::Faster | ClosedAction::Slower => one(Party::Vehicle, Party::Vcu, after.wheels()),
        ClosedAction::TimePasses => {
            let (_, cycles) = model.time_passes(before);
            let ms = cycles * u32::from(model.timing.cycle_ms);
            let mut words = vec![format!("{ms} ms pass")];
            if after.ai.stage != before.ai.stage {
                words.push(format!("AI: {}", in_words(after)));
            }
            let enters = enters(before, after);
            if enters.is_some() {
                words.push(change(before, after, None));
            }
            Event { from: Party::Vcu, to: Party::Vcu, words, enters, ms }
        }
    }
}

fn vcu_cycle(model: &Closed, before: &ClosedState, after: &ClosedState) -> Event {
    let (_, outputs, _) = model.step(before);
    let ms = u32::from(model.timing.cycle_ms);
    let mut words = vec![format!("cycle of {ms} ms")];
    let enters = enters(before, after);
    if enters.is_some() {
        words.push(change(before, after, outputs.row(&model.machine).map(|row| row.section)));
    }
    Event { from: Party::Vcu, to: Party::Vcu, words, enters, ms }
}

fn enters(before: &ClosedState, after: &ClosedState) -> Option<AsState> {
    Some(after.control.state).filter(|&state| state != before.control.state)
}

/// What the AI Computer asks for.
fn in_words(state: &ClosedState) -> String {
    let messages = ai::messages(state.ai);
    let mut words = format!("{}, {}", messages.status.mission_status, messages.status.direction_request);
    if messages.drive_f.front_axle_trq_request.raw() > 0 {
        words += ", torque";
    }
    if messages.brake.hyd_press_f_req.raw() > 0 {
        words += ", brakes";
    }
    words
}

fn change(before: &ClosedState, after: &ClosedState, section: Option<&str>) -> String {
    let arrow = format!("{} to {}", before.control.state, after.control.state);
    section.map_or(arrow.clone(), |section| format!("{arrow} ({section})"))
}

fn ai_cycle(before: &ClosedState, after: &ClosedState) -> Event {
    let ids: Vec<String> = after.bus.to_vcu.frames().map(|frame| format!("{:03X}h", frame.id)).collect();
    let mut words =
        vec![if ids.is_empty() { "cycle".to_owned() } else { format!("sends {}", ids.join(", ")) }];
    if before.ai.stage != after.ai.stage {
        words.push(in_words(after));
    }
    Event { from: Party::Ai, to: Party::Ai, words, enters: None, ms: 0 }
}

fn arrival(from: Party, to: Party, before: &ClosedState, arrived: Option<&Frame>) -> Event {
    let edition = before.document.edition;
    let words = arrived.map_or(Vec::new(), |frame| vec![frame.to_string(), meaning(frame, edition)]);
    Event { from, to, words, enters: None, ms: 0 }
}
