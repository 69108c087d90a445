//! What the theorems of `codec` catch: for each signal of each message a bit that is lost on the way in, one that is lost on
//! the way out, values that stand for others, and a value that is made to fit; and more of the whole.

use adsdv_proofs::subject::Subject;
use adsdv_proofs::theorems::Theorem;
use adsdv_spec::messages::{Ai2VcuDriveF, Ai2VcuStatus, Frame, MessageDef, Node, SignalDef};
use adsdv_spec::{AiMessages, Bus, Edition, Machine};

use crate::Mutant;
use crate::otherwise::{Received, Sent};

const BUS: &Bus = &Edition::DEFAULT.bus;

pub(crate) fn mutants() -> Vec<Mutant> {
    let mut mutants: Vec<Mutant> =
        BUS.messages.iter().flat_map(|message| of_message(theorem(message, ""), message)).collect();
    // What 4.0 has as 3.0 has it has its theorem there.
    let anew = Edition::V4_0.bus.messages.iter().filter(|message| !matches!(message.id, 0x501 | 0x526));
    mutants.extend(anew.flat_map(|message| of_message(theorem(message, "_in_4_0"), message)));
    mutants.extend(of_4_0());
    // What 2026 lays out anew.
    let anew =
        Edition::V2026.bus.messages.iter().filter(|&message| !Edition::V4_0.bus.messages.contains(message));
    mutants.extend(anew.flat_map(|message| of_message(theorem(message, "_in_2026"), message)));
    mutants.extend(of_any());
    mutants.extend(of_the_table());
    mutants.extend(of_identifiers());
    mutants
}

fn received(
    theorem: &'static str,
    what: &str,
    change: impl Fn(u16, [u8; 9]) -> [u8; 9] + Clone + 'static,
) -> Mutant {
    Mutant::new(theorem, what, Received::new(change))
}

fn sent(theorem: &'static str, what: &str, change: impl Fn(Frame) -> Frame + Clone + 'static) -> Mutant {
    Mutant::new(theorem, what, Sent::new(change))
}

/// A codec that has a signal otherwise, the same way in as out: what it writes it reads.
#[derive(Clone)]
struct BothWays<F>(F);

impl<F: Fn([u8; 8]) -> [u8; 8]> Subject for BothWays<F> {
    fn received(&self, _id: u16, data: [u8; 9]) -> [u8; 9] {
        head(data, &self.0)
    }

    fn sent(&self, frame: Frame) -> Frame {
        Frame { data: (self.0)(frame.data), ..frame }
    }
}

/// The first eight bytes changed.
fn head(mut data: [u8; 9], change: impl FnOnce([u8; 8]) -> [u8; 8]) -> [u8; 9] {
    let [bytes @ .., _] = data;
    data[..8].copy_from_slice(&change(bytes));
    data
}

/// The theorem of this name with an identifier in it.
fn named(before: &str, id: u16, behind: &str) -> &'static str {
    let name = format!("{before}{id:03x}h{behind}");
    Theorem::find(&name).unwrap_or_else(|| panic!("there is no theorem {name}")).name
}

/// The theorem of a message: `ai2vcu_steer_513h`, and what is added for an edition.
fn theorem(message: &MessageDef, of_edition: &str) -> &'static str {
    let name = format!("{}_{:x}h{of_edition}", message.name.to_lowercase(), message.id);
    Theorem::find(&name).unwrap_or_else(|| panic!("there is no theorem {name}")).name
}

fn of_message(theorem: &'static str, message: &'static MessageDef) -> Vec<Mutant> {
    let mut mutants = vec![
        sent(theorem, "another identifier", |frame| Frame { id: frame.id ^ 0x10, ..frame }),
        sent(theorem, "a byte less", |frame| Frame { len: frame.len - 1, ..frame }),
        received(theorem, "big endian", |_, data| {
            head(data, |bytes| u64::from_le_bytes(bytes).to_be_bytes())
        }),
    ];
    let used = message.signals.iter().fold(0, |used, signal| used | bits(signal));
    if used != u64::MAX {
        mutants.push(sent(theorem, "ones in unused bits", move |frame| {
            let data = u64::from_le_bytes(frame.data) | !used;
            Frame { data: data.to_le_bytes(), ..frame }
        }));
    }
    mutants.extend(message.signals.iter().flat_map(|signal| of_signal(theorem, signal)));
    mutants
}

/// The bits of a signal in a frame, as a word.
fn bits(signal: &SignalDef) -> u64 {
    u64::from_le_bytes(signal.put([0; 8], -1))
}

fn of_signal(theorem: &'static str, signal: &'static SignalDef) -> Vec<Mutant> {
    let without = |bit: u8| move |data: [u8; 8]| (u64::from_le_bytes(data) & !(1 << bit)).to_le_bytes();
    // The highest is not set in every signal that is allowed.
    let (lowest, highest) = (without(signal.start), without(signal.start + signal.width - 1));
    let name = signal.name;
    let mut mutants = vec![
        received(theorem, &format!("{name}: the highest bit is not read"), move |_, data| {
            head(data, highest)
        }),
        sent(theorem, &format!("{name}: the lowest bit is not written"), move |frame| Frame {
            data: lowest(frame.data),
            ..frame
        }),
        Mutant::new(
            theorem,
            &format!("{name}: from the highest to the lowest"),
            BothWays(move |data: [u8; 8]| {
                let mirrored = |raw| signal.allows(raw).then_some(signal.min + signal.max - raw);
                signal.raw(&data).and_then(mirrored).map_or(data, |raw| signal.put(data, raw))
            }),
        ),
    ];
    let ends = if signal.signed {
        (-1 << (signal.width - 1), !(-1 << (signal.width - 1)))
    } else {
        (0, !(-1 << signal.width))
    };
    if !signal.allows(ends.0) || !signal.allows(ends.1) {
        mutants.push(received(theorem, &format!("{name}: made to fit"), move |_, data| {
            head(data, |bytes| {
                let raw = signal.raw(&bytes).filter(|&raw| signal.allows(raw)).unwrap_or(signal.max);
                signal.put(bytes, raw)
            })
        }));
    }
    mutants
}

/// What the VCU takes of the AI Computer.
#[derive(Clone)]
struct Receiving(fn(&mut AiMessages, u16, &[u8]) -> bool);

impl Subject for Receiving {
    fn receive(&self, ai: &mut AiMessages, id: u16, data: &[u8]) -> bool {
        (self.0)(ai, id, data)
    }
}

fn of_any() -> Vec<Mutant> {
    let takes = "the_vcu_takes_what_it_can_read_of_the_ai_computer";
    let of = |what, change| Mutant::new(takes, what, Receiving(change));
    let mut mutants = vec![
        of("what does not decode is the default", |ai, id, data| {
            let done = ai.receive(BUS, id, data);
            if done.is_err() && id == 0x510 {
                ai.status = Ai2VcuStatus::default();
            }
            done == Ok(true)
        }),
        of("a new mission forgets the torque", |ai, id, data| {
            let done = ai.receive(BUS, id, data) == Ok(true);
            if done && id == 0x510 {
                ai.drive_f = Ai2VcuDriveF::default();
            }
            done
        }),
        of("513h is 514h too", |ai, id, data| {
            ai.receive(BUS, if id == 0x514 { 0x513 } else { id }, data) == Ok(true)
        }),
        of("500h is taken too", |ai, id, data| ai.receive(BUS, id, data) == Ok(true) || id == 0x500),
        Mutant::new(
            "a_frame_of_no_message_is_refused_for_its_identifier",
            "527h is taken for a status",
            Receiving(|ai, id, data| ai.receive(BUS, if id == 0x527 { 0x510 } else { id }, data) == Ok(true)),
        ),
        sent("a_quantity_stays_in_its_range", "a limit of 4000 rpm is sent as 3999", |frame| {
            match (frame.id, frame.data) {
                (0x511, [a, b, 0xA0, 0x0F, ..]) => Frame { data: [a, b, 0x9F, 0x0F, 0, 0, 0, 0], ..frame },
                _ => frame,
            }
        }),
        received("a_quantity_stays_in_its_range", "angles are from 0 to 48 degrees", |id, data| {
            let angle = i16::from_le_bytes([data[0], data[1]]);
            let [low, high] = angle.wrapping_add(240).to_le_bytes();
            if id == 0x513 { [low, high, 0, 0, 0, 0, 0, 0, 0] } else { data }
        }),
    ];
    for message in BUS.messages {
        let id = message.id;
        let lost = received(
            named("a_frame_of_", id, "_is_read_as_its_message"),
            "the first byte is lost",
            |_, data| head(data, |bytes| (u64::from_le_bytes(bytes) & !0xFF).to_le_bytes()),
        );
        let next = sent(named("a_message_is_sent_as_", id, ""), "it is sent as the next one", move |frame| {
            Frame { id: frame.id + 1, ..frame }
        });
        mutants.extend([lost, next]);
    }
    mutants
}

fn of_the_table() -> Vec<Mutant> {
    let mut mutants = vec![
        sent("no_two_signals_of_a_message_share_a_bit", "AS_STATE has a bit of AMI_STATE", |frame| {
            let [a, b, c, ..] = frame.data;
            match frame.id {
                0x520 => Frame { data: [a, b, c | (c & 1) << 4, 0, 0, 0, 0, 0], ..frame },
                _ => frame,
            }
        }),
        sent("no_two_signals_of_a_message_share_a_bit", "AS_STATE has one in place of its own", |frame| {
            let [a, b, c, ..] = frame.data;
            match frame.id {
                0x520 => Frame { data: [a, b, c & !8 | (c & 8) << 1, 0, 0, 0, 0, 0], ..frame },
                _ => frame,
            }
        }),
        sent("what_is_put_into_a_signal_is_what_it_holds", "HANDSHAKE is ESTOP_REQUEST too", |mut frame| {
            let [handshake, estop_request, ..] = &mut frame.data;
            if frame.id == 0x510 {
                *estop_request |= *handshake & 1;
            }
            frame
        }),
        sent("what_is_put_into_a_signal_is_what_it_holds", "510h: a bit of no signal is 1", |mut frame| {
            let [first, ..] = &mut frame.data;
            if frame.id == 0x510 {
                *first |= 2;
            }
            frame
        }),
        sent("what_is_put_into_a_signal_is_what_it_holds", "513h: numbers are positive", |mut frame| {
            let [_, high, ..] = &mut frame.data;
            if frame.id == 0x513 {
                *high &= 0x7F;
            }
            frame
        }),
        sent("each_identifier_is_of_one_message", "526h has 12 bits", |frame| match frame.id {
            0x526 => Frame { id: 0xD26, ..frame },
            _ => frame,
        }),
        sent("each_identifier_is_of_one_message", "502h is sent as 500h", |frame| match frame.id {
            0x502 => Frame { id: 0x500, ..frame },
            _ => frame,
        }),
        sent("each_identifier_is_of_one_message", "514h is sent as 550h", |frame| match frame.id {
            0x514 => Frame { id: 0x550, ..frame },
            _ => frame,
        }),
        sent("each_identifier_is_of_one_message", "514h is sent as 527h", |frame| match frame.id {
            0x514 => Frame { id: 0x527, ..frame },
            _ => frame,
        }),
    ];
    for message in BUS.messages {
        let id = message.id;
        let theorem = match id {
            0x520 => "what_is_read_of_520h_is_written_with_its_values",
            _ => named("the_table_agrees_with_the_decoder_on_", id, ""),
        };
        mutants.extend(message.signals.iter().map(move |signal| {
            let what = format!("{id:03X}h, {}: one less is read", signal.name);
            received(theorem, &what, move |of, data| {
                let less = |bytes: [u8; 8]| {
                    signal.put(bytes, signal.raw(&bytes).map_or(0, |raw| raw.wrapping_sub(1)))
                };
                if of == id { head(data, less) } else { data }
            })
        }));
    }
    mutants.push(received("the_table_allows_what_is_read_of_520h", "each number is one more", |_, data| {
        head(data, |bytes| bytes.map(|byte| byte.wrapping_add(1)))
    }));
    mutants
}

/// Other identifiers.
#[derive(Clone)]
struct Identifiers {
    is_reserved: fn(u16) -> bool,
    may_send: fn(Node, u16) -> bool,
}

impl Subject for Identifiers {
    fn is_reserved(&self, id: u16) -> bool {
        (self.is_reserved)(id)
    }

    fn may_send(&self, node: Node, id: u16) -> bool {
        (self.may_send)(node, id)
    }
}

fn of_identifiers() -> Vec<Mutant> {
    let reserved = |what, is_reserved| {
        let subject = Identifiers { is_reserved, may_send: |node, id| BUS.may_send(node, id) };
        Mutant::new("reserved_is_what_section_2_3_lists", what, subject)
    };
    let sends = |what, may_send| {
        let subject = Identifiers { is_reserved: |id| BUS.is_reserved(id), may_send };
        Mutant::new("who_may_send_what", what, subject)
    };
    vec![
        reserved("470h is not", |id| BUS.is_reserved(id) && id != 0x470),
        reserved("185h is", |id| BUS.is_reserved(id) || id == 0x185),
        reserved("what is longer than 11 bits is", |id| BUS.is_reserved(id) || id > 0x7FF),
        sends("the AI Computer may send what is reserved", |node, id| {
            BUS.may_send(node, id) || node == Node::Ai && BUS.is_reserved(id)
        }),
        sends("the VCU may send 514h", |node, id| BUS.may_send(node, id) || node == Node::Vcu && id == 0x514),
        sends("the VCU may send its own messages only", |node, id| {
            BUS.may_send(node, id) && (node == Node::Ai || BUS.message(id).is_some())
        }),
    ]
}

/// The bus of 4.0, changed.
#[derive(Clone)]
struct Bus4(Machine);

impl Bus4 {
    fn with(change: impl FnOnce(&mut Bus)) -> Self {
        let mut edition = Edition::V4_0;
        change(&mut edition.bus);
        Self(Machine::new(edition, edition.readings))
    }
}

impl Subject for Bus4 {
    fn machine_of_4_0(&self) -> &Machine {
        &self.0
    }
}

fn of_4_0() -> Vec<Mutant> {
    let messages_of_3_0 = |bus: &mut Bus| bus.messages = BUS.messages;
    let reserved_of_3_0 = |bus: &mut Bus| bus.reserved = BUS.reserved;
    vec![
        Mutant::new("lengths_and_cycles_of_4_0", "those of 3.0", Bus4::with(messages_of_3_0)),
        Mutant::new("names_of_4_0", "those of 3.0", Bus4::with(messages_of_3_0)),
        Mutant::new("reserved_is_what_section_2_3_of_4_0_lists", "that of 3.0", Bus4::with(reserved_of_3_0)),
        Mutant::new("who_may_send_what_in_4_0", "what 3.0 reserves", Bus4::with(reserved_of_3_0)),
        Mutant::new(
            "who_may_send_what_in_4_0",
            "no message is anyone's",
            Bus4::with(|bus| {
                bus.messages = &[];
            }),
        ),
    ]
}
