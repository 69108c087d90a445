//! Frames as such: lengths, ranges, and which message goes where.

use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, AsState, EbsState, Message,
    MessageDef, Node, OutOfRange, Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer,
    Vcu2AiWheelSpeeds, Vcu2LogDynamics1, Vcu2LogStatus, VcuStatus,
};
use adsdv_spec::{Atoms, Bus};

use super::finding::{Evidence, Finding, Party, Rule, Severity};
use super::lenient::{self, Lenient};
use super::{
    AI_BRAKE, AI_DRIVE_F, AI_DRIVE_R, AI_STATUS, AI_STEER, BRAKE, Judge, LOG_STATUS, REMOTE, SILENCE_NS,
    STATUS, STEER, WHEEL_SPEEDS,
};

/// The VCU's messages that tell requests back, and the AI Computer's that make them.
const ECHOES: [(u16, u16); 4] = [
    (Vcu2AiDriveF::ID, Ai2VcuDriveF::ID),
    (Vcu2AiDriveR::ID, Ai2VcuDriveR::ID),
    (Vcu2AiSteer::ID, Ai2VcuSteer::ID),
    (Vcu2AiBrake::ID, Ai2VcuBrake::ID),
];

impl Judge {
    /// A frame came with another content than the one before, or after a silence.
    pub(super) fn changed(&mut self, index: usize, t: i64, word: u64, len: u8, before: Option<i64>) {
        if index == REMOTE {
            return self.remote_changed(t, word, len);
        }
        let Some(def) = self.def_of(index) else { return };
        let Some(slot) = self.slots.get_mut(index) else { return };
        let was_fresh = slot.fresh;
        slot.word = word;
        slot.len = len;
        if usize::from(len) < def.bytes_needed() {
            slot.fresh = false;
            let first = !std::mem::replace(&mut slot.too_short, true);
            if first {
                self.too_short(t, index, len);
            }
            if index == AI_STATUS {
                self.handshake.ai_gone();
                self.update_comms(t);
            }
            return self.learn(t, self.known.forget(self.scope(index)));
        }
        slot.fresh = true;
        slot.too_short = false;
        let stale_at = slot.stale_at();
        if len != def.len && !std::mem::replace(&mut slot.length_noted, true) {
            self.other_length(t, index, len);
        }
        self.wake_at(stale_at);
        let silence = before.map_or(i64::MAX, |before| t - before);
        self.dispatch(index, t, word, before, was_fresh, silence);
    }

    fn dispatch(
        &mut self,
        index: usize,
        t: i64,
        word: u64,
        before: Option<i64>,
        was_fresh: bool,
        silence: i64,
    ) {
        match index {
            STATUS => {
                let Lenient { mut message, bad } = self.read::<Vcu2AiStatus>(index, t, word);
                if is_bad::<Vcu2AiStatus>(&self.edition.bus, bad, "shutdown_cause") {
                    // A cause that cannot be read says nothing about the one before.
                    message.shutdown_cause =
                        self.vcu.status.map_or(message.shutdown_cause, |s| s.shutdown_cause);
                }
                let state_bad = is_bad::<Vcu2AiStatus>(&self.edition.bus, bad, "as_state");
                let ami_bad = is_bad::<Vcu2AiStatus>(&self.edition.bus, bad, "ami_state");
                let stage_unreadable = is_bad::<Vcu2AiStatus>(&self.edition.bus, bad, "ebs_state");
                self.ebs.stage = Some(message.ebs_state).filter(|_| self.shown.stage && !stage_unreadable);
                let shown = self.scope(index);
                let readable = if ami_bad { shown.without(adsdv_spec::Atom::AmiSelected) } else { shown };
                self.status(t, message, !state_bad, readable, before);
            }
            AI_STATUS => {
                let Lenient { message, bad } = self.read::<Ai2VcuStatus>(index, t, word);
                if bad == 0 {
                    self.ai_status(t, message, was_fresh);
                } else {
                    // Whether a VCU takes anything from such a frame is not known.
                    self.handshake.ai_gone();
                    self.update_comms(t);
                    self.learn(t, self.known.forget(self.scope(index)));
                }
            }
            WHEEL_SPEEDS => {
                let Lenient { message, bad } = self.read::<Vcu2AiWheelSpeeds>(index, t, word);
                self.measured(
                    index,
                    t,
                    message.atoms(&self.edition.rules.thresholds),
                    bad,
                    was_fresh,
                    silence,
                );
            }
            STEER => {
                let Lenient { message, bad } = self.read::<Vcu2AiSteer>(index, t, word);
                let bad = u32::from(is_bad::<Vcu2AiSteer>(&self.edition.bus, bad, "steer_angle"));
                self.measured(
                    index,
                    t,
                    message.steer_angle.atoms(&self.edition.rules.thresholds),
                    bad,
                    was_fresh,
                    silence,
                );
            }
            LOG_STATUS => {
                let Lenient { message, bad } = self.read::<Vcu2LogStatus>(index, t, word);
                // In EMERGENCY_BRAKE it is TRIGGERED whatever the EBS itself reports, and has reported since the sample before.
                //= D-28
                let hidden = message.state_assi == AsState::EmergencyBrake
                    && message.state_ebs == EbsState::Triggered
                    && !is_bad::<Vcu2LogStatus>(&self.edition.bus, bad, "state_assi");
                let ebs_bad =
                    u32::from(hidden || is_bad::<Vcu2LogStatus>(&self.edition.bus, bad, "state_ebs"));
                self.measured(index, t, message.atoms(), ebs_bad, was_fresh, silence);
                if !is_bad::<Vcu2LogStatus>(&self.edition.bus, bad, "state_assi") {
                    self.assi_seen(t, message.state_assi);
                }
            }
            BRAKE => {
                let Lenient { message, bad } = self.read::<Vcu2AiBrake>(index, t, word);
                // In EMERGENCY_BRAKE it is TRIGGERED whatever the EBS itself reports, and a 520h may be missing that would
                // have shown that state; none but AS_OFF is safe from it.
                //= D-28, D-61
                let hidden =
                    message.status_ebs == EbsState::Triggered && self.vcu.state != Some(AsState::Off);
                let unreadable = is_bad::<Vcu2AiBrake>(&self.edition.bus, bad, "status_ebs");
                self.ebs.status = Some(message.status_ebs).filter(|_| !unreadable);
                let bad = hidden || unreadable;
                let shown = Vcu2LogStatus { state_ebs: message.status_ebs, ..Vcu2LogStatus::default() };
                self.measured(index, t, shown.atoms(), bad.into(), was_fresh, silence);
            }
            AI_BRAKE => {
                let Lenient { message, bad } = self.read::<Ai2VcuBrake>(index, t, word);
                self.requested(index, t, message.atoms(), bad);
            }
            AI_DRIVE_F => {
                let Lenient { message, bad } = self.read::<Ai2VcuDriveF>(index, t, word);
                self.requested(index, t, message.atoms(), bad);
            }
            AI_DRIVE_R => {
                let Lenient { message, bad } = self.read::<Ai2VcuDriveR>(index, t, word);
                self.requested(index, t, message.atoms(), bad);
            }
            AI_STEER => {
                let Lenient { message, bad } = self.read::<Ai2VcuSteer>(index, t, word);
                self.requested(index, t, message.atoms(), bad);
            }
            _ => self.only_values(index, t, word),
        }
    }

    /// The messages of which only the values are checked.
    fn only_values(&mut self, index: usize, t: i64, word: u64) {
        match self.def_of(index).map(|def| def.id) {
            Some(Vcu2LogDynamics1::ID) => drop(self.read::<Vcu2LogDynamics1>(index, t, word)),
            Some(Vcu2AiDriveF::ID) => drop(self.read::<Vcu2AiDriveF>(index, t, word)),
            Some(Vcu2AiDriveR::ID) => drop(self.read::<Vcu2AiDriveR>(index, t, word)),
            Some(VcuStatus::ID) => drop(self.read::<VcuStatus>(index, t, word)),
            // All of their bits are allowed.
            _ => {}
        }
    }

    /// What a request of the AI Computer says; a frame with a value out of range says nothing certain.
    fn requested(&mut self, index: usize, t: i64, atoms: Atoms, bad: u32) {
        let known = if bad == 0 {
            self.known.learn(self.scope(index), atoms)
        } else {
            self.known.forget(self.scope(index))
        };
        self.learn(t, known);
    }

    /// What the VCU measures. A silence between two frames that say the same hid nothing: it is physical.
    fn measured(&mut self, index: usize, t: i64, atoms: Atoms, bad: u32, was_fresh: bool, silence: i64) {
        let Some(slot) = self.slots.get_mut(index) else { return };
        let same = slot.atoms.replace(atoms) == Some(atoms);
        if bad == 0 && same && !was_fresh && silence < SILENCE_NS {
            self.history.fill(t - silence, self.scope(index), atoms);
        }
        self.requested(index, t, atoms, bad);
    }

    /// Reads a message, and reports the signals whose values have become wrong.
    #[inline]
    fn read<M: Message>(&mut self, index: usize, t: i64, word: u64) -> Lenient<M> {
        let lenient = lenient::decode::<M>(&self.edition.bus, word.to_le_bytes());
        if let Some(slot) = self.slots.get_mut(index).filter(|slot| slot.bad != lenient.bad) {
            let new = lenient.bad & !slot.bad;
            slot.bad = lenient.bad;
            self.bad_values::<M>(t, word, new);
        }
        lenient
    }

    #[cold]
    fn bad_values<M: Message>(&mut self, t: i64, word: u64, new: u32) {
        let Some(def) = self.edition.bus.message(M::ID) else { return };
        for (place, signal) in def.signals.iter().enumerate() {
            let Some(raw) = signal.raw(&word.to_le_bytes()).filter(|_| new >> place & 1 == 1) else {
                continue;
            };
            // What is shown of the EBS, and what else is logged with it, has the database's start value until it is there.
            let late = M::ID == Vcu2LogStatus::ID || signal.field == "status_ebs";
            let start = late && lenient::is_start_value(signal, raw);
            let echo = self.echoes_bad_request(M::ID, signal.name);
            let elsewhere = self.is_within_another_limit(signal, raw);
            let (severity, rule, remark) = match (start, echo) {
                (true, _) => (Severity::Note, Rule::StartValue, ": the start value of the CAN database"),
                _ if elsewhere => {
                    (Severity::Note, Rule::Value, ": the VCU's limit is that of another version")
                }
                (_, true) => (Severity::Note, Rule::Value, ": as the AI Computer requested it"),
                _ => (Severity::Violation, Rule::Value, ""),
            };
            let refused = OutOfRange { given: raw, def: signal };
            let seen = format!(": {}{remark}", refused.seen());
            self.found(of_message(severity, def, rule, t, &seen).expected(refused.allowed().to_string()));
        }
    }

    /// What the edition says of the message of a slot.
    fn def_of(&self, index: usize) -> Option<&'static MessageDef> {
        self.slots.get(index)?.def
    }

    /// Whether this signal tells the AI Computer's own request back, and that is out of range.
    fn echoes_bad_request(&self, id: u16, signal: &str) -> bool {
        let request = ECHOES.iter().find(|(vcu, _)| *vcu == id).map(|&(_, ai)| ai);
        let slot = request.and_then(|ai| self.slot_of.get(ai.into())).and_then(|index| self.slots.get(index));
        signal.contains("_REQ") && slot.is_some_and(|slot| slot.bad != 0)
    }

    #[cold]
    fn too_short(&mut self, t: i64, index: usize, len: u8) {
        let Some(def) = self.def_of(index) else { return };
        let needed = format!("at least {} for its signals", def.bytes_needed());
        let finding = of_message(Severity::Violation, def, Rule::TooShort, t, &format!(" has {len} bytes"));
        self.found(finding.expected(needed));
    }

    #[cold]
    fn other_length(&mut self, t: i64, index: usize, len: u8) {
        let Some(def) = self.def_of(index) else { return };
        let seen = format!(
            " has {len} bytes; the CAN database says {}, its signals need {}",
            def.len,
            def.bytes_needed()
        );
        self.found(of_message(Severity::Note, def, Rule::Length, t, &seen));
    }

    /// A frame of no message of the document.
    ///
    /// Those of the vehicle's devices have their senders, and nothing is said of them, whatever they hold.
    pub(super) fn other_id(&mut self, t: i64, id: u32) {
        let bus = &self.edition.bus;
        let reserved = u16::try_from(id).is_ok_and(|id| bus.is_reserved(id) && bus.device(id).is_none());
        if reserved && self.out.first_of_id(id) {
            let seen = format!(
                "{id:03X}h is reserved and was sent; the log does not say by whom; the AI Computer must not"
            );
            self.found(Finding::note(Party::Log, "2.3", Rule::Reserved, t).seen(seen));
        }
    }

    /// The log says that the AI Computer itself sent a frame with this identifier, which is not for it to send. It says
    /// nothing about the VCU.
    pub fn sent_by_ai(&mut self, t_ns: i64, id: u32) {
        let t = self.other_frame(t_ns);
        let short = u16::try_from(id).unwrap_or(u16::MAX);
        let bus = &self.edition.bus;
        let of_the_vcu = bus.message(short).filter(|def| def.sender == Node::Vcu);
        let (section, rule, what, expected) = match (bus.device(short), of_the_vcu) {
            _ if bus.is_reserved(short) => {
                ("2.3", Rule::Reserved, format!("{id:03X}h, which is reserved"), "")
            }
            (Some(device), _) => {
                ("2.2", Rule::Sender, format!("{} ({id:03X}h)", device.name), device.sender.name())
            }
            (_, Some(def)) => (def.section, Rule::Sender, format!("{} ({id:03X}h)", def.name), "the VCU"),
            (None, None) => return,
        };
        if self.out.first_by_ai(id) {
            let expected = match expected {
                "" => "it not to".to_owned(),
                sender => format!("that message from {sender} only"),
            };
            let finding =
                Finding::violation(Party::Ai, section, rule, t).seen(format!("the AI Computer sent {what}"));
            self.found(finding.expected(expected).shown_by(vec![Evidence { t_ns: t, id: short }]));
        }
    }

    /// The end of the log: says which side was not there.
    pub(super) fn note_one_sided(&mut self) {
        let seen = |node| self.slots.iter().any(|slot| slot.is_from(node) && slot.last.is_some());
        let (severity, what, expected) = match (seen(Node::Ai), seen(Node::Vcu)) {
            (true, true) => return,
            (false, false) => (
                Severity::Warning,
                "no message of the document in the log: nothing was judged",
                "500h to 526h",
            ),
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
        let finding = Finding::new(severity, Party::Log, "2", Rule::OneSided, self.now);
        self.found(finding.seen(what).expected(expected));
    }
}

/// A finding about a frame that has just come.
fn of_message(severity: Severity, def: &MessageDef, rule: Rule, t_ns: i64, what: &str) -> Finding {
    Finding::new(severity, def.sender.into(), def.section, rule, t_ns)
        .seen(format!("{} ({:03X}h){what}", def.name, def.id))
        .shown_by(vec![Evidence { t_ns, id: def.id }])
}

/// Whether the signal that this field carries has a value that is not allowed.
fn is_bad<M: Message>(bus: &Bus, bad: u32, field: &str) -> bool {
    let place = || bus.message(M::ID)?.signals.iter().position(|signal| signal.field == field);
    bad != 0 && place().is_some_and(|place| bad >> place & 1 == 1)
}
