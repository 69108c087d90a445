//! The AI Computer of the closed model: the reference one, which decides to stop at any time, and wrong ones beside it.

use adsdv_ai::{AiComputer, Decisions, Stage, Wanted};
use adsdv_spec::messages::{AnyMessage, AsState, Frame};
use adsdv_spec::{AiMessages, Bus, VcuMessages};

/// How the AI Computer behaves. All but the first are wrong: they show that a property can fail.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Conduct {
    /// As the document says.
    #[default]
    Reference,
    /// It never answers the handshake (against HS-5).
    Mute,
    /// It says FINISHED and NEUTRAL without waiting until the vehicle has stopped (against FIN-3).
    Hasty,
    /// It says NEUTRAL while it brakes (against IMP-2).
    Coasting,
}

/// The frames that the AI Computer listens to.
pub(super) fn listens_to(messages: &VcuMessages, bus: &Bus) -> [Option<Frame>; 5] {
    let VcuMessages { status, drive_f, drive_r, brake, wheel_speeds, .. } = *messages;
    let all: [AnyMessage; 5] =
        [status.into(), drive_f.into(), drive_r.into(), brake.into(), wheel_speeds.into()];
    all.map(|message| bus.encode(message))
}

/// The frames that it sends, in the order in which they win the bus.
pub(super) fn frames(ai: AiComputer, bus: &Bus) -> [Option<Frame>; 5] {
    messages(ai).all().map(|message| bus.encode(message))
}

/// What it says: where it may move, it asks for all that can be asked for.
pub(super) fn messages(ai: AiComputer) -> AiMessages {
    ai.messages(&Wanted::MOST)
}

/// The AI Computer after one cycle of its program.
pub(super) fn cycle(ai: AiComputer, conduct: Conduct) -> AiComputer {
    let settled = ai.heard.has_stopped() || conduct == Conduct::Hasty;
    let next = ai.cycle(Decisions { settled, stop: false });
    let coasts = conduct == Conduct::Coasting && ai.stage == Stage::Braking;
    AiComputer {
        handshake: if conduct == Conduct::Mute { ai.handshake } else { next.handshake },
        stage: if coasts && ai.heard.as_state == AsState::Driving { Stage::Stopped } else { next.stage },
        ..next
    }
}

/// Whether it may decide that the mission is completed.
pub(super) fn may_decide_to_stop(ai: AiComputer) -> bool {
    ai.stage == Stage::Driving && ai.heard.as_state == AsState::Driving
}

/// It decides that the mission is completed, whenever that is between two cycles.
pub(super) fn decides_to_stop(ai: AiComputer) -> AiComputer {
    let decided = ai.cycle(Decisions { stop: true, settled: false });
    AiComputer { handshake: ai.handshake, ..decided }
}
