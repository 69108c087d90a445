//! Frames as such: lengths, ranges, and which message goes where.

use adsdv_spec::Edition;
use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuSteer, MessageDef, Node, OutOfRange, SignalDef,
    Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiSteer, Vcu2LogStatus,
};

use crate::judge::book::Book;
use crate::judge::finding::{Evidence, Finding, Party, Rule, Severity};
use crate::judge::sampler::places::STEER;
use crate::judge::sampler::{Came, Sampler, Says};

/// The VCU's messages that tell requests back, and the AI Computer's that make them.
const ECHOES: [(u16, u16); 4] = [
    (Vcu2AiDriveF::ID, Ai2VcuDriveF::ID),
    (Vcu2AiDriveR::ID, Ai2VcuDriveR::ID),
    (Vcu2AiSteer::ID, Ai2VcuSteer::ID),
    (Vcu2AiBrake::ID, Ai2VcuBrake::ID),
];

/// The field of 523h that shows the limit of the steer angle: each version of the document has one of its own, and the VCU shows
/// the one in force.
const LIMIT: &str = "steer_angle_max";
/// The fields that it limits, of 513h and 523h.
const LIMITED: [&str; 3] = ["steer_request", "steer_angle", "steer_angle_request"];

/// Whether any edition allows this limit.
fn is_some_limit(raw: i32) -> bool {
    Edition::ALL.iter().filter_map(|edition| edition.bus.signal_of(LIMIT)).any(|limit| limit.allows(raw))
}

/// A frame says something else than the one before: is it as long as it should be, and does it say only what is allowed?
pub(super) fn judge(sampler: &Sampler, book: &mut Book, came: &Came, says: &Says) {
    let Some(def) = sampler.def(came.index) else { return };
    let slot_len = sampler.slot(came.index).map_or(0, |slot| slot.len);
    match *says {
        Says::TooShort { first: true } => {
            let finding = of_message(
                Severity::Violation,
                def,
                Rule::TooShort,
                came.t,
                &format!(" has {slot_len} bytes"),
            );
            let needed = format!("at least {} for its signals", def.bytes_needed());
            book.found(finding.against(def.requirements).expected(needed));
        }
        Says::This { newly_bad, other_length, .. } => {
            if other_length {
                let seen = format!(
                    " has {slot_len} bytes; the CAN database says {}, its signals need {}",
                    def.len,
                    def.bytes_needed()
                );
                let finding = of_message(Severity::Note, def, Rule::Length, came.t, &seen);
                let lengths = book.edition().bus.lengths;
                book.found(finding.against(lengths));
            }
            if newly_bad != 0 {
                bad_values(sampler, book, came, def, newly_bad);
            }
        }
        _ => {}
    }
}

#[cold]
fn bad_values(sampler: &Sampler, book: &mut Book, came: &Came, def: &MessageDef, newly_bad: u32) {
    let Some(data) = sampler.slot(came.index).map(|slot| slot.word.to_le_bytes()) else { return };
    let new = def.signals.iter().enumerate().filter(|(place, _)| newly_bad >> place & 1 == 1);
    for (signal, raw) in new.filter_map(|(_, signal)| Some((signal, signal.raw(&data)?))) {
        // What is shown of the EBS, and what else is logged with it, has the database's start value until it is there.
        let late = def.id == Vcu2LogStatus::ID || signal.field == "status_ebs";
        let (severity, rule, remark) = if late && raw == 0 && !signal.values.is_empty() {
            (Severity::Note, Rule::StartValue, ": the start value of the CAN database")
        } else if is_within_another_limit(sampler, signal, raw) {
            (Severity::Note, Rule::Value, ": the VCU's limit is that of another version")
        } else if echoes_bad_request(sampler, def.id, signal.name) {
            (Severity::Note, Rule::Value, ": as the AI Computer requested it")
        } else {
            (Severity::Violation, Rule::Value, "")
        };
        let refused = OutOfRange { given: raw, def: signal };
        let seen = format!(": {}{remark}", refused.seen());
        let finding = of_message(severity, def, rule, came.t, &seen);
        book.found(finding.against(signal.requirements).expected(refused.allowed().to_string()));
    }
}

/// Whether a value that the edition does not allow is the limit of another edition, or within that limit as the VCU shows it.
/// Then the judge can blame nobody for it.
fn is_within_another_limit(sampler: &Sampler, signal: &SignalDef, raw: i32) -> bool {
    let shown = || {
        let slot = sampler.slot(STEER).filter(|slot| slot.last.is_some())?;
        slot.def?.signal_of(LIMIT)?.raw(&slot.word.to_le_bytes()).filter(|&limit| is_some_limit(limit))
    };
    match signal.field {
        LIMIT => is_some_limit(raw),
        field => LIMITED.contains(&field) && shown().is_some_and(|limit| raw.abs() <= limit),
    }
}

/// Whether this signal tells the AI Computer's own request back, and that is out of range.
fn echoes_bad_request(sampler: &Sampler, id: u16, signal: &str) -> bool {
    let request = ECHOES.iter().find(|(vcu, _)| *vcu == id).and_then(|&(_, ai)| sampler.index(ai.into()));
    signal.contains("_REQ") && request.and_then(|index| sampler.slot(index)).is_some_and(|slot| slot.bad != 0)
}

/// That the vehicle of 2026 does not send 120h.
const DROPPED: &str = "MSG-116"; //= MSG-116

/// The message of the VCU that an edition before this one has under an identifier that means nothing in this one, and the version
/// of that edition.
fn dropped(edition: &Edition, id: u16) -> Option<(&'static str, &'static MessageDef)> {
    let earlier = Edition::ALL.iter().take_while(|earlier| earlier.version != edition.version);
    let message = |earlier: &&Edition| Some((earlier.version, earlier.bus.message(id)?));
    { earlier }.filter_map(message).find(|(_, def)| def.sender == Node::Vcu)
}

/// A frame of no message of the document.
///
/// Those of the vehicle's devices have their senders, and nothing is said of them, whatever they hold. One that the VCU had under an
/// earlier edition is most likely still the VCU's; but the log does not say so, and no document but the database says that it is gone.
pub(crate) fn other_id(edition: &Edition, book: &mut Book, t: i64, id: u32) {
    let bus = &edition.bus;
    let other = u16::try_from(id).ok().filter(|&id| bus.device(id).is_none());
    if let Some((id, (version, def))) = other.and_then(|id| Some((id, dropped(edition, id)?))) {
        if book.out.first_of_id(id.into()) {
            let seen = format!(
                "{} ({id:03X}h) was sent, which the VCU sends in version {version} and not in this one; the log does not say by whom",
                def.name
            );
            let finding = Finding::note(Party::Vcu, def.section, Rule::Reserved, t).against(&[DROPPED]);
            let finding = finding.seen(seen).expected("no such message");
            book.found(finding.shown_by(vec![Evidence { t_ns: t, id }]));
        }
        return;
    }
    let reserved = other.and_then(|id| bus.reserved_of(id));
    if let Some(reserved) = reserved.filter(|_| book.out.first_of_id(id)) {
        let seen = format!(
            "{id:03X}h is reserved and was sent; the log does not say by whom; the AI Computer must not"
        );
        let finding = Finding::note(Party::Log, "2.3", Rule::Reserved, t).against(reserved.requirements);
        book.found(finding.seen(seen));
    }
}

/// The log says that the AI Computer itself sent a frame with this identifier, which is not for it to send.
pub(crate) fn sent_by_ai(edition: &Edition, book: &mut Book, t: i64, id: u32) {
    let short = u16::try_from(id).unwrap_or(u16::MAX);
    let bus = &edition.bus;
    let of_the_vcu = bus.message(short).filter(|def| def.sender == Node::Vcu);
    let reserved = bus.reserved_of(short);
    let (section, rule, what, sender) = match (bus.device(short), of_the_vcu) {
        _ if reserved.is_some() => ("2.3", Rule::Reserved, format!("{id:03X}h, which is reserved"), ""),
        (Some(device), _) => {
            ("2.2", Rule::Sender, format!("{} ({id:03X}h)", device.name), device.sender.name())
        }
        (_, Some(def)) => (def.section, Rule::Sender, format!("{} ({id:03X}h)", def.name), "the VCU"),
        (None, None) => return,
    };
    if book.out.first_by_ai(id) {
        let only = || format!("that message from {sender} only");
        let expected = if sender.is_empty() { "it not to".to_owned() } else { only() };
        let forbidden = reserved.map_or(bus.senders, |reserved| reserved.requirements);
        let finding =
            Finding::violation(Party::Ai, section, rule, t).seen(format!("the AI Computer sent {what}"));
        book.found(
            finding.against(forbidden).expected(expected).shown_by(vec![Evidence { t_ns: t, id: short }]),
        );
    }
}

/// The end of the log: the messages of the VCU that an edition after this one does without, and that never came though the VCU
/// was there. Nothing that is judged needs them.
pub(crate) fn absent(sampler: &Sampler, edition: &Edition, t: i64) -> Vec<Finding> {
    let later = Edition::ALL.iter().skip_while(|later| later.version != edition.version).skip(1);
    let without = |def: &&'static MessageDef| later.clone().find(|one| one.bus.message(def.id).is_none());
    let never = |def: &&'static MessageDef| {
        let slot = sampler.index(def.id.into()).and_then(|index| sampler.slot(index));
        slot.is_some_and(|slot| slot.last.is_none())
    };
    let sent = edition.bus.messages.iter().copied().filter(|def| def.sender == Node::Vcu);
    let sent = sent.filter(|_| sampler.heard(Node::Vcu)).filter(never);
    let one = |def: &'static MessageDef| {
        let later = without(&def)?;
        let seen = format!(
            "{} ({:03X}h) never came; edition {} does without it, and nothing that is judged needs it",
            def.name, def.id, later.version
        );
        Some(Finding::note(Party::Log, def.section, Rule::Edition, t).seen(seen))
    };
    sent.filter_map(one).collect()
}

/// The end of the log: says which side was not there.
pub(crate) fn one_sided(sampler: &Sampler, t: i64) -> Option<Finding> {
    let nothing = "no message of the document in the log: nothing was judged";
    let (severity, what, expected) = match (sampler.heard(Node::Ai), sampler.heard(Node::Vcu)) {
        (true, true) => return None,
        (false, false) => (Severity::Warning, nothing, "500h to 526h"),
        (true, false) => (
            Severity::Note,
            "no message of the VCU in the log; the AI Computer was judged as far as it can be",
            "",
        ),
        (false, true) => (
            Severity::Note,
            "no message of the AI Computer in the log; the VCU was judged as far as it can be",
            "",
        ),
    };
    Some(Finding::new(severity, Party::Log, "2", Rule::OneSided, t).seen(what).expected(expected))
}

/// A finding about a frame that has just come.
fn of_message(severity: Severity, def: &MessageDef, rule: Rule, t_ns: i64, what: &str) -> Finding {
    Finding::new(severity, def.sender.into(), def.section, rule, t_ns)
        .seen(format!("{} ({:03X}h){what}", def.name, def.id))
        .shown_by(vec![Evidence { t_ns, id: def.id }])
}
