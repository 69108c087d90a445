//! What the theorems on the vehicle of 2026 catch. What of its messages is laid out anew is with the others in `codec.rs`.

use adsdv_proofs::subject::Subject;
use adsdv_spec::editions::V2026;
use adsdv_spec::messages::{
    Coding, Device, DeviceMessage, DeviceSignal, EbsStage, EbsState, Frame, Layout, Vcu2AiStatus,
};
use adsdv_spec::{Bus, Choice, Edition, Inputs, Machine, Outputs, VcuMessages};

use crate::otherwise::{Received, Sending, Sent};
use crate::{Changed, Mutant};

pub(crate) fn mutants() -> Vec<Mutant> {
    let mut mutants = of_the_machine();
    mutants.extend(of_the_bus());
    mutants.extend(of_the_devices());
    mutants.extend(of_the_outputs());
    mutants.extend(of_any());
    mutants
}

fn of_the_machine() -> Vec<Mutant> {
    let (same, words) =
        ("the_state_machine_of_2026_is_that_of_4_0", "a_step_of_2026_is_what_the_document_says");
    let table =
        |theorem, mutation| Mutant::new(theorem, mutation, Changed::named_in(&Edition::V2026, mutation));
    let mut mutants: Vec<Mutant> =
        ["handshake -1", "missed message -1", "wheel speed +1", "3.7 term 10: dropped", "3.4: dropped"]
            .into_iter()
            .flat_map(|mutation| [table(same, mutation), table(words, mutation)])
            .collect();
    mutants.extend([same, words].map(|theorem| {
        let always = Changed::read_as(&Edition::V2026, Choice::TorqueAlways);
        Mutant::new(theorem, "torque and brake at once are a fault", always)
    }));
    let changed = |what, change: fn(&mut Edition)| {
        let mut edition = Edition::V2026;
        change(&mut edition);
        Mutant::new(same, what, Changed::of(&edition))
    };
    mutants.extend([
        changed("an order of arrows is missing", |edition| edition.rules.priorities = &[]),
        changed("the faults of 3.0", |edition| edition.faults = Edition::V3_0.faults),
        changed("the questions of 3.0", |edition| edition.choices = Edition::V3_0.choices),
    ]);
    mutants
}

/// The bus of 2026, changed.
#[derive(Clone)]
struct Bus2026(Machine);

impl Bus2026 {
    fn with(change: impl FnOnce(&mut Bus)) -> Self {
        let mut edition = Edition::V2026;
        change(&mut edition.bus);
        Self(Machine::new(edition, edition.readings))
    }
}

impl Subject for Bus2026 {
    fn machine_of_2026(&self) -> &Machine {
        &self.0
    }
}

fn of_the_bus() -> Vec<Mutant> {
    let messages_of_4_0 = |bus: &mut Bus| bus.messages = Edition::V4_0.bus.messages;
    let who = "who_may_send_what_in_2026";
    vec![
        Mutant::new("lengths_and_cycles_of_2026", "those of 4.0", Bus2026::with(messages_of_4_0)),
        Mutant::new("names_of_2026", "those of 4.0", Bus2026::with(messages_of_4_0)),
        Mutant::new(
            "vcu_status_120h_is_no_message_of_2026",
            "it is in the table",
            Bus2026::with(messages_of_4_0),
        ),
        Mutant::new(who, "the devices have no messages", Bus2026::with(|bus| bus.devices = &[])),
        Mutant::new(
            who,
            "section 2.3 of 3.0",
            Bus2026::with(|bus| bus.reserved = Edition::V3_0.bus.reserved),
        ),
        Mutant::new(who, "no message is anyone's", Bus2026::with(|bus| bus.messages = &[])),
    ]
}

/// Two signals of a device, of which a test makes what no table may have.
const SIGNALS: [DeviceSignal; 2] = [signal(0, 12), signal(12, 4)];

const fn signal(start: u8, width: u8) -> DeviceSignal {
    DeviceSignal {
        name: "signal",
        start,
        width,
        coding: Coding::Unsigned,
        scale: 1.0,
        offset: 0.0,
        unit: "",
        min: 0.0,
        max: 1.0,
        values: &[],
    }
}

const fn message(len: u8, signals: &'static [DeviceSignal]) -> DeviceMessage {
    DeviceMessage { name: "message", id: 0x600, sender: Device::PcanGps, len, cycle_ms: None, signals }
}

fn of_the_devices() -> Vec<Mutant> {
    const OVERLAP: &[DeviceMessage] = &[message(2, &[signal(0, 12), signal(11, 4)])];
    const LONGER: &[DeviceMessage] = &[message(1, &SIGNALS)];
    const BEYOND: &[DeviceMessage] = &[message(8, &[SIGNALS[0], signal(60, 8)])];
    const NEGATIVE: &[DeviceMessage] =
        &[message(2, &[SIGNALS[0], DeviceSignal { coding: Coding::Signed, ..signal(12, 1) }])];
    let of = |theorem, what, devices| Mutant::new(theorem, what, Bus2026::with(|bus| bus.devices = devices));
    let (bits, held) =
        ("no_two_signals_of_a_device_share_a_bit", "what_is_put_into_a_signal_of_a_device_is_what_it_holds");
    let mut mutants = vec![
        of(bits, "two signals have a bit in common", OVERLAP),
        of(bits, "a signal ends behind its message", LONGER),
        of(bits, "a signal ends behind the frame", BEYOND),
        of(held, "a flag is a negative number", NEGATIVE),
        of(held, "a signal ends behind the frame", BEYOND),
    ];
    let changed = |what, change: fn(&mut [DeviceMessage])| {
        let mut devices = Edition::V2026.bus.devices.to_vec();
        change(&mut devices);
        // There are a few of them in a test.
        of(
            "the_messages_of_the_devices_are_those_of_the_database",
            what,
            Box::leak(devices.into_boxed_slice()),
        )
    };
    mutants.extend([
        changed("another identifier", |devices| devices[5].id += 1),
        changed("another sender", |devices| devices[32].sender = Device::Vcu),
        changed("another length", |devices| devices[1].len = 8),
        changed("a signal is missing", |devices| devices[5].signals = &devices[5].signals[1..]),
        changed("another order", |devices| devices.swap(3, 4)),
        of("the_messages_of_the_devices_are_those_of_the_database", "hardly any", OVERLAP),
    ]);
    mutants
}

/// Frames that are read or written otherwise than what they carry.
fn of_any() -> Vec<Mutant> {
    let theorem = "what_2026_does_not_lay_out_anew_is_as_in_4_0";
    vec![
        Mutant::new(
            theorem,
            "524h: no EBS is read",
            Received::new(|id, mut data| {
                if id == 0x524 {
                    data[4] &= 0x0F;
                }
                data
            }),
        ),
        Mutant::new(
            theorem,
            "520h: no mode is read",
            Received::new(|id, mut data| {
                if id == 0x520 {
                    data[0] &= 0x0F;
                }
                data
            }),
        ),
        Mutant::new(
            theorem,
            "523h has eight bytes",
            Sent::new(|frame| match frame.id {
                0x523 => Frame { len: 8, ..frame },
                _ => frame,
            }),
        ),
    ]
}

fn of_the_outputs() -> Vec<Mutant> {
    let (states, frames) =
        ("status_520h_shows_operation_tractive_system_and_ebs", "each_message_of_2026_goes_out_in_its_frame");
    let rows = <V2026 as Layout<Vcu2AiStatus>>::DEF.signals.iter();
    let anew = rows.filter(|row| matches!(row.name, "OP_STATE" | "TS_STATE" | "EBS_STATE"));
    let mut mutants: Vec<Mutant> = anew
        .map(|row| {
            let change = move |messages: &mut VcuMessages, _: &Outputs, _: &Inputs| {
                let data = V2026::encode(&messages.status).data;
                let raw = row.raw(&data).map(|raw| raw + 1).filter(|&raw| row.allows(raw));
                let other = row.put(data, raw.unwrap_or(row.min));
                messages.status = V2026::decode(&other).unwrap_or(messages.status);
            };
            Mutant::new(states, &format!("520h, {}: another value", row.name), Sending(change))
        })
        .collect();
    assert_eq!(mutants.len(), 3, "the three states that 2026 adds");
    mutants.extend([
        Mutant::new(
            states,
            "the EBS as it reports itself",
            Sending(|messages: &mut VcuMessages, _: &Outputs, inputs: &Inputs| {
                if inputs.ebs == EbsState::Unavailable {
                    messages.status.ebs_state = EbsStage::Init;
                }
            }),
        ),
        Mutant::new(
            frames,
            "521h is sent as 522h",
            Sent::new(|frame| match frame.id {
                0x521 => Frame { id: 0x522, ..frame },
                _ => frame,
            }),
        ),
        Mutant::new(
            frames,
            "502h has eight bytes",
            Sent::new(|frame| match frame.id {
                0x502 => Frame { len: 8, ..frame },
                _ => frame,
            }),
        ),
    ]);
    mutants
}
