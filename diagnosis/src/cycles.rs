//! What a program of a fixed cycle is asked in place of longer steps; `Record::joined` is the way back.

use adsdv_conform::suite::Step;

use crate::model::{Memory, Model};

/// The steps one by one, with the handshake answered or not in each as in all of them, by the bit that a model shows.
pub(crate) fn each(steps: &[Step], model: &Model, cycle_ms: u32) -> Vec<Step> {
    let (mut memory, mut bit) = (Memory::INITIAL, false);
    let mut all = Vec::new();
    for step in steps {
        let answers = step.inputs.ai.status.handshake == bit;
        for _ in 0..step.dt_ms.div_ceil(cycle_ms).max(1) {
            let mut inputs = step.inputs;
            inputs.ai.status.handshake = bit == answers;
            let (after, outputs) = model.step(&memory, &inputs, cycle_ms);
            (memory, bit) = (after, outputs.handshake);
            all.push(Step { dt_ms: cycle_ms, inputs });
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use adsdv_spec::{Atom, Edition, Inputs};

    use super::*;
    use crate::record::Record;
    use crate::subject::Subject as _;

    /// Power-on, the handshake for so many steps, and an AI Computer that is silent for as many.
    fn asked(count: usize) -> Record {
        let mut program = Model::new(&Edition::V3_0, &[]).running();
        let mut record = Record::default();
        let mut bit = false;
        for place in 0..2 * count {
            let mut inputs = Inputs { tsms: true, ..Inputs::default() };
            inputs.ai.status.handshake = bit == (place < count);
            let reply = program.step(10, &inputs).expect("a model answers everything");
            bit = reply.get("handshake").and_then(|value| value.raw) == Some(1);
            record.steps.push(Step { dt_ms: 10, inputs });
            record.replies.push(reply);
        }
        record
    }

    #[test]
    fn like_steps_become_one_that_takes_as_long_and_is_explained_as_they_are() {
        let model = Model::new(&Edition::V3_0, &[]);
        for count in [1, 2, 5, 6, 7, 8, 9, 10, 11, 12, 99, 100] {
            let each = asked(count);
            let joined = each.joined();
            let lasts = |record: &Record| record.steps.iter().map(|step| step.dt_ms).sum::<u32>();
            assert_eq!(lasts(&each), lasts(&joined), "{count}");
            assert!(joined.is_explained(&model), "{count}");
            assert!(joined.steps.len() <= 28, "{count}: {}", joined.steps.len());
            let late = crate::Deviation::find(&Edition::V3_0, "handshake:+10ms").expect("there is one");
            let late = Model::new(&Edition::V3_0, &[late]);
            assert_eq!(each.is_explained(&late), joined.is_explained(&late), "{count}");
        }
    }

    /// An arrow that stays open for a second is not late: joined steps say so as well.
    #[test]
    fn joined_steps_do_not_make_an_arrow_late_that_is_missing() {
        let find = |id: &str| crate::Deviation::find(&Edition::V3_0, id).expect("there is one");
        let mut inputs = Inputs { asms: true, tsms: true, ..Inputs::default() };
        for atom in [Atom::AmiSelected, Atom::MissionSelected, Atom::EbsArmed] {
            inputs.show(atom, true, &Edition::V3_0.rules.thresholds);
        }
        let missing = Model::new(&Edition::V3_0, &[find("ready-off:missing")]);
        let ready =
            [Step { dt_ms: 10, inputs }, Step { dt_ms: 1000, inputs: Inputs { asms: false, ..inputs } }];
        let steps = each(&ready, &missing, 10);
        let record = Record::of(&mut missing.clone().running(), &steps).expect("a model answers everything");
        let joined = record.joined();
        assert!(joined.steps.len() < steps.len() && joined.is_explained(&missing));
        for late in 1..=crate::deviation::LATEST {
            let late = Model::new(&Edition::V3_0, &[find(&format!("ready-off:late:{late}"))]);
            assert!(!record.is_explained(&late) && !joined.is_explained(&late));
        }
    }
}
