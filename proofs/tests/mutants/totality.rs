//! What the theorems of `totality.rs` catch: functions that panic, overflow or index out of bounds somewhere, and answers
//! that there are not.

use adsdv_proofs::subject::Subject;
use adsdv_spec::messages::{Frame, SignalDef};
use adsdv_spec::{
    Actuation, AsState, Atom, Atoms, Control, Edition, Inputs, Machine, Observation, Outputs, Reaction,
    Reads, Row, Table, Taken, VcuMessages,
};

use crate::otherwise::Otherwise;
use crate::{Changed, Mutant};

pub(crate) fn mutants() -> Vec<Mutant> {
    vec![
        Mutant::new("a_step_is_total", "the time in the state overflows", Overflows),
        Mutant::table("a_step_is_total", "ready dwell +1"),
        Mutant::new("a_reaction_is_total", "the time in the state overflows", Overflows),
        Mutant::new("a_reaction_is_total", "it tells of no arrow", Silent),
        Mutant::new("an_observation_is_total", "it divides by the steer angle", Divides),
        Mutant::new("an_observation_is_total", "a vehicle at 10 rpm moves and is at rest", MovesAtRest),
        Mutant::new("what_is_read_in_off_is_total", "the time in the state overflows", Overflows),
        Mutant::new("what_is_read_in_off_is_total", "it reads what is remembered", ReadsMemory),
        Mutant::new("what_is_read_in_ready_is_total", "the time in the state overflows", Overflows),
        Mutant::new("what_is_read_in_ready_is_total", "it reads what is remembered", ReadsMemory),
        Mutant::new("what_is_read_in_driving_is_total", "the time in the state overflows", Overflows),
        Mutant::new("what_is_read_in_driving_is_total", "it reads what is remembered", ReadsMemory),
        Mutant::new("what_is_read_in_finished_is_total", "the time in the state overflows", Overflows),
        Mutant::new("what_is_read_in_finished_is_total", "it reads what is remembered", ReadsMemory),
        Mutant::new("what_is_read_in_emergency_brake_is_total", "the time in the state overflows", Overflows),
        Mutant::new("what_is_read_in_emergency_brake_is_total", "it reads what is remembered", ReadsMemory),
        elsewhere("what_is_taken_in_off_is_possible", AsState::Off),
        elsewhere("what_is_taken_in_ready_is_possible", AsState::Ready),
        elsewhere("what_is_taken_in_driving_is_possible", AsState::Driving),
        elsewhere("what_is_taken_in_finished_is_possible", AsState::Finished),
        elsewhere("what_is_taken_in_emergency_brake_is_possible", AsState::EmergencyBrake),
        Mutant::new(
            "what_is_taken_in_off_is_possible",
            "AS_OFF is left before a power cycle",
            Otherwise(|before, _, after, outputs| {
                if before.state == AsState::Off && before.power_cycle_needed {
                    after.state = AsState::Ready;
                    outputs.taken = Some(Taken { row: 0, term: 0 });
                }
            }),
        ),
        Mutant::new("what_was_taken_is_looked_up", "there is an arrow more", Changed::of(&one_row_more())),
        Mutant::new("an_actuation_is_total", "twice the torque is too much", TwiceTheTorque),
        Mutant::new("an_actuation_is_total", "the EBS brakes in AS_OFF as well", EbsInOff),
        Mutant::new("messages_are_total", "the sum of two pressures overflows a byte", PressuresInAByte),
        Mutant::new("messages_are_total", "AS_STATE is the state before", Late),
        Mutant::new("frames_are_total", "the first byte is taken for an index", LooksUp),
        Mutant::new("frames_are_total", "a frame of nine bytes", NineBytes),
        Mutant::new(
            "a_row_of_any_shape_is_total",
            "a row out of the frame is written into its end",
            PutsAtTheEnd,
        ),
        Mutant::new("a_frame_is_total", "an identifier is cut to 11 bits", CutsTheIdentifier),
    ]
}

/// Whatever leaves a state leads to AS_DRIVING, or out of AS_READY to AS_FINISHED, where no arrow leads.
fn elsewhere(theorem: &'static str, state: AsState) -> Mutant {
    let lead: fn(&Control, &Inputs, &mut Control, &mut Outputs) = |before, _, after, _| {
        if after.state != before.state {
            let ready = before.state == AsState::Ready;
            after.state = if ready { AsState::Finished } else { AsState::Driving };
        }
    };
    Mutant::new(theorem, &format!("{state} leads where no arrow does"), Otherwise(lead))
}

/// Time is added in 16 bits.
#[derive(Clone)]
struct Overflows;

impl Overflows {
    fn add(before: &Control, dt_ms: u32) {
        let dt_ms = u16::try_from(dt_ms).expect("as short as that");
        assert!(before.in_state_ms.checked_add(dt_ms).is_some(), "overflow");
    }
}

impl Subject for Overflows {
    fn step_of(
        &self,
        machine: &Machine,
        before: &Control,
        inputs: &Inputs,
        dt_ms: u32,
    ) -> (Control, Outputs) {
        Self::add(before, dt_ms);
        machine.step(before, inputs, dt_ms)
    }

    fn react(&self, before: &Control, seen: Observation, dt_ms: u32) -> Reaction {
        Self::add(before, dt_ms);
        self.machine().react(before, seen, dt_ms)
    }

    fn reads(&self, before: &Control, dt_ms: u32) -> Reads {
        Self::add(before, dt_ms);
        self.machine().reads(before, dt_ms)
    }
}

/// A reaction does not tell which arrow it takes.
#[derive(Clone)]
struct Silent;

impl Subject for Silent {
    fn react(&self, before: &Control, seen: Observation, dt_ms: u32) -> Reaction {
        Reaction { taken: None, ..self.machine().react(before, seen, dt_ms) }
    }
}

/// Whether the wheels are straight is found by a division.
#[derive(Clone)]
struct Divides;

impl Subject for Divides {
    fn observe(&self, inputs: &Inputs) -> Observation {
        assert!(50_i32.checked_div(inputs.vehicle.steer_angle.raw()).is_some(), "a division by zero");
        inputs.observe(&self.machine().edition().rules.thresholds)
    }
}

/// A wheel exactly at the limit is moving and at rest at once.
#[derive(Clone)]
struct MovesAtRest;

impl Subject for MovesAtRest {
    fn observe(&self, inputs: &Inputs) -> Observation {
        let seen = inputs.observe(&self.machine().edition().rules.thresholds);
        let both = Atoms::of(&[Atom::Moving, Atom::AtRest]);
        if seen.atoms().intersection(both).is_empty() {
            return Observation::new(seen.atoms().union(both), seen.faults());
        }
        seen
    }
}

/// What is remembered counts as what is seen.
#[derive(Clone)]
struct ReadsMemory;

impl Subject for ReadsMemory {
    fn reads(&self, before: &Control, dt_ms: u32) -> Reads {
        let reads = self.machine().reads(before, dt_ms);
        Reads { atoms: reads.atoms.with(Atom::PowerCycleNeeded), ..reads }
    }
}

/// Figure 2 with its last arrow twice.
fn one_row_more() -> Edition {
    let rows = Edition::DEFAULT.rules.table.rows();
    let twice: Vec<Row> = rows.iter().chain(rows.last()).copied().collect();
    Edition::DEFAULT.with_table(Table::new(&twice))
}

/// The torque is doubled on its way, in as many bits as one axle needs.
#[derive(Clone)]
struct TwiceTheTorque;

impl Subject for TwiceTheTorque {
    fn actuation(&self, outputs: &Outputs, inputs: &Inputs) -> Actuation {
        let actuation = outputs.actuation(inputs);
        assert!(actuation.front_axle_trq.raw() * 2 < 2048, "overflow");
        actuation
    }
}

/// The Emergency Braking System brakes in AS_OFF.
#[derive(Clone)]
struct EbsInOff;

impl Subject for EbsInOff {
    fn actuation(&self, outputs: &Outputs, inputs: &Inputs) -> Actuation {
        let actuation = outputs.actuation(inputs);
        Actuation { ebs_triggered: actuation.ebs_triggered || outputs.state == AsState::Off, ..actuation }
    }
}

/// The pressures of both axles are added in a byte.
#[derive(Clone)]
struct PressuresInAByte;

impl Subject for PressuresInAByte {
    fn messages(&self, outputs: &Outputs, inputs: &Inputs) -> VcuMessages {
        let vehicle = &inputs.vehicle;
        assert!(u8::try_from(vehicle.hyd_press_f.raw() + vehicle.hyd_press_r.raw()).is_ok(), "overflow");
        outputs.messages(inputs)
    }
}

/// 520h shows the state before the step.
#[derive(Clone)]
struct Late;

impl Subject for Late {
    fn messages(&self, outputs: &Outputs, inputs: &Inputs) -> VcuMessages {
        let mut messages = outputs.messages(inputs);
        messages.status.as_state = outputs.from;
        messages
    }
}

/// The first byte is taken for the place of a message in the table.
#[derive(Clone)]
struct LooksUp;

impl Subject for LooksUp {
    fn sent(&self, frame: Frame) -> Frame {
        assert!(Edition::DEFAULT.bus.messages.get(usize::from(frame.data[0])).is_some(), "out of bounds");
        frame
    }
}

/// A frame is a byte longer than it can be.
#[derive(Clone)]
struct NineBytes;

impl Subject for NineBytes {
    fn sent(&self, frame: Frame) -> Frame {
        Frame { len: frame.len + 1, ..frame }
    }
}

/// What does not fit goes into the last byte.
#[derive(Clone)]
struct PutsAtTheEnd;

impl Subject for PutsAtTheEnd {
    fn put(&self, row: &SignalDef, data: [u8; 8], raw: i32) -> [u8; 8] {
        let mut put = row.put(data, raw);
        if u32::from(row.start) + u32::from(row.width) > 64 {
            put[7] ^= 1;
        }
        put
    }
}

/// An identifier of more than 11 bits is taken for what is left of it.
#[derive(Clone)]
struct CutsTheIdentifier;

impl Subject for CutsTheIdentifier {
    fn frame(&self, id: u16, data: &[u8]) -> Option<Frame> {
        Frame::new(id & Frame::MAX_ID, data)
    }
}
