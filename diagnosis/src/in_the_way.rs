//! The outputs whose answers no deviation explains: without them, the others may be explained.

use std::collections::BTreeMap;

use crate::model::{Memory, Model};
use crate::record::Record;

/// Without these nothing can be explained.
const NEEDED: [&str; 2] = ["as_state", "handshake"];

/// The outputs that are shown otherwise than a model shows them where the state is as it has it, in any of these records.
pub(crate) fn outputs(records: &[Record], model: &Model) -> Vec<&'static str> {
    let mut all = BTreeMap::<&'static str, usize>::new();
    for Record { steps, replies } in records {
        let mut memory = Memory::INITIAL;
        for (step, reply) in steps.iter().zip(replies) {
            let (outputs, after) = model.follow(&memory, &step.inputs, step.dt_ms, reply);
            if outputs.state == after.control.state {
                let shown = model.shown(&outputs, &step.inputs);
                for difference in reply.differences(&shown) {
                    *all.entry(difference.key).or_default() += 1;
                }
            }
            memory = after;
        }
    }
    all.into_keys().filter(|key| !NEEDED.contains(key)).collect()
}
