//! The state and what happens, in words.

use std::fmt;

use adsdv_spec::messages::{AmiState, Frame, ShutdownCause};
use adsdv_spec::{Atom, Edition, Rules};

use super::action::on_off;
use super::meaning::meaning;
use super::{Closed, ClosedAction, ClosedState, WaitingFrames, Wheels, ai};

/// A frame as `candump` writes it, and what it says.
fn frame(frame: &Frame, edition: &Edition) -> String {
    format!("{frame} ({})", meaning(frame, edition))
}

/// The names of the lines that describe a state.
const WIDTH: usize = 13;

impl ClosedState {
    /// The state, a line for each party: its name, and how it is.
    fn lines(&self, rules: Option<&Rules>) -> [(&'static str, String); 8] {
        [
            ("VCU", self.vcu(rules)),
            ("handshake", self.handshake()),
            ("AI Computer", self.ai_computer()),
            ("  has heard", self.heard()),
            ("bus to AI", self.waiting(&self.bus.to_ai)),
            ("bus to VCU", self.waiting(&self.bus.to_vcu)),
            ("operator", self.operator()),
            ("vehicle", self.vehicle()),
        ]
    }

    fn vcu(&self, rules: Option<&Rules>) -> String {
        let control = &self.control;
        let lasted = control.in_state_ms;
        let mut words = vec![control.state.to_string()];
        if let Some(atom) = Atom::of_timer(control.state) {
            words.push(match rules {
                Some(rules) => {
                    let elapsed = lasted >= rules.timing.in_state_limit(control.state);
                    format!("{} ({lasted} ms)", rules.text(atom, elapsed))
                }
                None => format!("{lasted} ms counted"),
            });
        }
        if control.go_seen_low {
            words.push("\"Go\" seen off".to_owned());
        }
        if control.shutdown_cause != ShutdownCause::NoShutdown {
            words.push(format!("SHUTDOWN_CAUSE {}", control.shutdown_cause));
        }
        if control.power_cycle_needed {
            words.push("power cycle needed".to_owned());
        }
        words.join(", ")
    }

    fn handshake(&self) -> String {
        let handshake = self.control.handshake;
        if !handshake.active {
            return "rests".to_owned();
        }
        let (bit, answer) = (u8::from(handshake.bit), u8::from(self.received.status.handshake));
        format!("VCU asks for {bit}, has {answer}, unanswered for {} ms", handshake.unanswered_ms)
    }

    fn ai_computer(&self) -> String {
        let messages = ai::messages(self.ai);
        format!(
            "{}, {}, HANDSHAKE {}, torque {}, brakes {}",
            messages.status.mission_status,
            messages.status.direction_request,
            u8::from(messages.status.handshake),
            messages.drive_f.front_axle_trq_request,
            messages.brake.hyd_press_f_req,
        )
    }

    fn heard(&self) -> String {
        let heard = &self.ai.heard;
        let wheels = if heard.turning { "wheels turning" } else { "wheels at rest" };
        format!("HANDSHAKE {}, {}, {}, {wheels}", u8::from(heard.handshake), heard.as_state, heard.ami)
    }

    fn operator(&self) -> String {
        let switches = &self.switches;
        let mission = match switches.ami {
            AmiState::NotSelected => "no mission".to_owned(),
            mission => format!("mission {mission}"),
        };
        format!(
            "{mission}, TSMS {}, ASMS {}, EBS {}, \"Go\" {}, remote E-stop {}",
            on_off(switches.tsms),
            on_off(switches.asms),
            if switches.ebs_armed { "armed" } else { "unavailable" },
            on_off(switches.go),
            if self.remote_estop { "pressed" } else { "released" },
        )
    }

    fn vehicle(&self) -> String {
        let motion = self.motion;
        let force = match (motion.driven, motion.braked) {
            (_, true) => "braked",
            (true, false) => "driven",
            (false, false) => "neither driven nor braked",
        };
        format!("{}, {force}", self.wheels())
    }

    /// How fast the wheels turn.
    pub(super) fn wheels(&self) -> String {
        let limit = self.document.edition.rules.thresholds.wheel_speed;
        match self.motion.wheels {
            Wheels::AtRest => "wheels at rest".to_owned(),
            Wheels::AtThreshold => format!("wheels at exactly {limit}"),
            Wheels::Moving => format!("wheels faster than {limit}"),
        }
    }

    fn waiting(&self, line: &WaitingFrames) -> String {
        let frames: Vec<String> = line.frames().map(|waits| frame(waits, self.document.edition)).collect();
        if frames.is_empty() { "nothing new".to_owned() } else { frames.join("; ") }
    }
}

impl fmt::Debug for ClosedState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, (name, words)) in self.lines(None).iter().enumerate() {
            let end = if i == 0 { "" } else { "\n" };
            write!(f, "{end}{name:WIDTH$}{words}")?;
        }
        Ok(())
    }
}

/// What a step did: what happened, and then the state, with a mark at each line that is new.
pub(super) fn step(
    model: &Closed,
    before: &ClosedState,
    action: ClosedAction,
    after: &ClosedState,
) -> String {
    let rules = Some(&model.machine.edition().rules);
    let mut lines =
        vec![super::sequence::event(model, before, action, after).words.join(", "), String::new()];
    for ((name, now), (_, was)) in after.lines(rules).into_iter().zip(before.lines(rules)) {
        let mark = if now == was { ' ' } else { '>' };
        lines.push(format!("{mark} {name:WIDTH$}{now}"));
    }
    lines.join("\n")
}

/// Milliseconds as seconds, for the time axis.
pub(super) fn seconds(ms: u32) -> String {
    format!("{}.{:02} s", ms / 1000, ms % 1000 / 10)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_is_a_line_for_each_thing() {
        let state = ClosedState::default();
        let text = format!("{state:?}");
        let expected = state.lines(None);
        assert!(expected.len() > 3);
        assert_eq!(text.lines().count(), expected.len());
        for (line, (name, words)) in text.lines().zip(&expected) {
            assert!(line.starts_with(*name) && line.ends_with(words.as_str()), "{line:?}: {name}, {words}");
        }
    }
}
