//! Reading as much of a frame as can be read: signals that are not allowed are set aside, the rest is kept.

use adsdv_spec::messages::{AnyMessage, AsState, EbsState, MessageDef, Vcu2LogStatus};
use adsdv_spec::{Atoms, Bus, Thresholds};

/// What a frame says.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrameContent {
    /// The message, with an allowed value in place of each that was not.
    pub(crate) message: AnyMessage,
    def: &'static MessageDef,
    /// The signals whose values were not allowed, one bit each in the order of the table.
    pub(crate) bad: u32,
}

impl FrameContent {
    /// Reads data that is long enough for every signal.
    pub(super) fn of(bus: &Bus, def: &'static MessageDef, data: [u8; 8]) -> Option<Self> {
        match bus.decode(def.id, &data) {
            Ok(message) => Some(Self { message, def, bad: 0 }),
            Err(_) => Self::mended(bus, def, data),
        }
    }

    #[cold]
    fn mended(bus: &Bus, def: &'static MessageDef, mut data: [u8; 8]) -> Option<Self> {
        let mut bad = 0;
        for (place, signal) in def.signals.iter().enumerate() {
            if signal.raw(&data).is_some_and(|raw| !signal.allows(raw)) {
                bad |= 1 << place;
                data = signal.put(data, signal.min);
            }
        }
        Some(Self { message: bus.decode(def.id, &data).ok()?, def, bad })
    }

    /// Whether the signal that this field carries has a value that is not allowed.
    pub(crate) fn is_bad(&self, field: &str) -> bool {
        let place = || self.def.signals.iter().position(|signal| signal.field == field);
        self.bad != 0 && place().is_some_and(|place| self.bad >> place & 1 == 1)
    }

    /// The conditions that hold by what it says; `None` where it says nothing certain.
    pub(crate) fn atoms(&self, thresholds: &Thresholds) -> Option<Atoms> {
        let all_good = |atoms| Some(atoms).filter(|_| self.bad == 0);
        match &self.message {
            // Whether a VCU takes anything from a frame of the AI Computer that is partly wrong is not known.
            AnyMessage::Ai2VcuStatus(message) => all_good(message.atoms()),
            AnyMessage::Ai2VcuDriveF(message) => all_good(message.atoms()),
            AnyMessage::Ai2VcuDriveR(message) => all_good(message.atoms()),
            AnyMessage::Ai2VcuSteer(message) => all_good(message.atoms()),
            AnyMessage::Ai2VcuBrake(message) => all_good(message.atoms()),
            AnyMessage::Vcu2AiWheelSpeeds(message) => all_good(message.atoms(thresholds)),
            AnyMessage::Vcu2AiSteer(message) => {
                Some(message.steer_angle.atoms(thresholds)).filter(|_| !self.is_bad("steer_angle"))
            }
            AnyMessage::Vcu2LogStatus(message) => {
                // In EMERGENCY_BRAKE it is TRIGGERED whatever the EBS itself reports, and has reported since the sample before.
                //= D-28
                let hidden = message.state_assi == AsState::EmergencyBrake
                    && message.state_ebs == EbsState::Triggered
                    && !self.is_bad("state_assi");
                Some(message.atoms()).filter(|_| !hidden && !self.is_bad("state_ebs"))
            }
            AnyMessage::Vcu2AiBrake(message) => {
                let shown = Vcu2LogStatus { state_ebs: message.status_ebs, ..Vcu2LogStatus::default() };
                Some(shown.atoms()).filter(|_| !self.is_bad("status_ebs"))
            }
            _ => None,
        }
    }
}
