//! The steps of a test as a person writes them: a step that is repeated, and an AI Computer that answers the handshake.

use std::fmt::{self, Write as _};

use adsdv_spec::{Control, Machine};
use serde::Deserialize;
use serde_json::value::RawValue;

use super::{Scenario, Step};
use crate::protocol::{BadLine, InputsAsJson, Protocol, Shown};

/// A step as a line has it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawStep<'a> {
    pub(super) dt_ms: u32,
    /// How often it is made.
    #[serde(default)]
    pub(super) times: Option<u32>,
    /// Whether the AI Computer answers the handshake; where that is not said, `inputs` say its bit.
    #[serde(default)]
    pub(super) answers: Option<bool>,
    #[serde(borrow, default)]
    pub(super) inputs: Option<&'a RawValue>,
    #[serde(borrow, default)]
    pub(super) expected: Option<&'a RawValue>,
}

/// No test has more steps than these where some are repeated: 200 s at 10 ms.
const MOST: usize = 20_000;

/// Reads steps. What `answers` says of the handshake is what the AI Computer does that sees this machine.
pub(super) fn read(steps: &[RawStep<'_>], machine: &Machine) -> Result<Scenario, String> {
    let mut scenario = Scenario::default();
    let protocol = Protocol::of(machine.edition());
    let mut control = Control::INITIAL;
    for (number, step) in (1..).zip(steps) {
        let at = |error: BadLine| format!("step {number}: {error}");
        let given = step.inputs.map_or("{}", |inputs| inputs.get());
        let InputsAsJson(mut inputs) = protocol.inputs_as_json(given).map_err(at)?;
        if step.answers.is_some() && inputs.ai.status.handshake {
            return Err(format!(
                "step {number}: \"answers\" says what \"handshake\" is; expected one of them"
            ));
        }
        let expected =
            step.expected.map(|expected| protocol.answer(expected.get()).map_err(at)).transpose()?;
        let times = step.times.unwrap_or(1);
        let room = MOST.saturating_sub(scenario.steps.len());
        if times == 0 || times > 1 && usize::try_from(times).unwrap_or(usize::MAX) > room {
            return Err(format!(
                "step {number}: \"times\" is {times}; expected 1 to {room}, for a test of repeated steps has at most {MOST}"
            ));
        }
        for _ in 0..times {
            if let Some(answers) = step.answers {
                inputs.ai.status.handshake = control.handshake.bit == answers;
            }
            let step = Step { dt_ms: step.dt_ms, inputs };
            let (after, outputs) = machine.step(&control, &inputs, step.dt_ms);
            control = after;
            scenario.steps.push(step);
            let shown = Shown::of(machine.edition(), &outputs, &inputs);
            if let Some(difference) =
                expected.as_ref().and_then(|expected| expected.differences(&shown).next())
            {
                return Err(format!("step {number}: {difference}, which is what the specification shows"));
            }
        }
    }
    Ok(scenario)
}

impl Scenario {
    /// Of each step whether the AI Computer answers the handshake in it: whether its bit is that which this machine showed last.
    pub(crate) fn answers<'a>(&'a self, machine: &'a Machine) -> impl Iterator<Item = bool> + 'a {
        let bits = self.run(machine).map(|(control, _)| control.handshake.bit);
        let seen = std::iter::once(Control::INITIAL.handshake.bit).chain(bits);
        self.steps.iter().zip(seen).map(|(step, bit)| step.inputs.ai.status.handshake == bit)
    }

    /// The scenario as a test that a person can read and change: a line of a suite, without what is expected.
    pub fn to_line<'a>(&'a self, name: &'a str, machine: &'a Machine) -> impl fmt::Display + 'a {
        fmt::from_fn(move |f| {
            let text = |text: &str| serde_json::Value::from(text).to_string();
            let version = machine.edition().version;
            write!(f, "{{\"edition\":{},\"name\":{},\"steps\":[", text(version), text(name))?;
            let protocol = Protocol::of(machine.edition());
            let mut all = self.steps.iter().zip(self.answers(machine)).map(|(step, answers)| {
                let mut inputs = step.inputs;
                inputs.ai.status.handshake = false;
                (Step { inputs, ..*step }, answers)
            });
            let mut next = all.next();
            let mut comma = "";
            while let Some((step, answers)) = next {
                let mut times = 1;
                next = all.next();
                while next == Some((step, answers)) {
                    times += 1;
                    next = all.next();
                }
                write!(f, "{comma}{{\"dt_ms\":{}", step.dt_ms)?;
                if times > 1 {
                    write!(f, ",\"times\":{times}")?;
                }
                let inputs = InputsAsJson(step.inputs);
                write!(f, ",\"answers\":{answers},\"inputs\":{}}}", protocol.object(&inputs))?;
                comma = ",";
            }
            f.write_char(']')?;
            f.write_char('}')
        })
    }
}
