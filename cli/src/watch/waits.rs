//! What the car waits for now: printed when it has been so for a while, and again when it is something else.

use adsdv_oracle::why::Stay;
use adsdv_spec::Rules;

use crate::report;

/// What has been so for less may be over before anybody has read it.
const SETTLED_NS: i64 = 1_000_000_000;

/// What was printed last.
#[derive(Debug, Default)]
pub(super) struct Waits {
    printed: Option<String>,
}

impl Waits {
    /// What is to be printed at `now_ns`, of a VCU that is in this state; `None` if that has been said.
    pub(super) fn news(&mut self, rules: &Rules, now_ns: i64, stay: &Stay) -> Option<String> {
        let (since_ns, text) = report::waits(rules, stay)?;
        if now_ns - since_ns < SETTLED_NS || self.printed.as_ref() == Some(&text) {
            return None;
        }
        self.printed = Some(text.clone());
        Some(text)
    }
}

#[cfg(test)]
mod tests {
    use adsdv_oracle::judge::{Judge, JudgeOptions};
    use adsdv_spec::{Control, Edition, Inputs, Machine};

    use super::*;

    #[test]
    fn what_lasts_is_printed_once() {
        let (vcu, mut judge, mut waits) =
            (Machine::REFERENCE, Judge::new(JudgeOptions::default()), Waits::default());
        let mut control = Control::INITIAL;
        let mut printed = Vec::new();
        for cycle in 0..400 {
            // The operator switches on after two seconds.
            let inputs = Inputs { asms: cycle >= 200, tsms: cycle >= 200, ..Inputs::default() };
            let (next, outputs) = vcu.step(&control, &inputs, 10);
            control = next;
            for frame in outputs.messages(&inputs).frames(&vcu.edition().bus) {
                judge.frame(cycle * 10_000_000, frame.id.into(), frame.data());
            }
            let now = judge.waits().and_then(|(t, stay)| waits.news(&Edition::DEFAULT.rules, t, stay));
            printed.extend(now.map(|text| (cycle / 100, text)));
        }
        let seconds: Vec<_> = printed.iter().map(|(second, _)| *second).collect();
        assert_eq!(seconds, [1, 3], "{printed:?}");
        assert!(printed[0].1.contains("AS_SWITCH_STATUS is OFF"), "{printed:?}");
        assert!(!printed[1].1.contains("AS_SWITCH_STATUS"), "{printed:?}");
    }
}
