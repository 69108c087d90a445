//! What other editions call a message or a signal: a person who types a name may know it from an older document or a newer one.
//!
//! No name is said twice for this: a message is the same by its identifier, and a signal by the field that carries it.

use crate::bus::Bus;
use crate::edition::Edition;
use crate::messages::{MessageDef, SignalDef};

impl Bus {
    /// The message with this name, or the one to which another edition gives it.
    ///
    /// ```
    /// use adsdv_spec::Edition;
    ///
    /// let bus = Edition::V4_0.bus;
    /// assert_eq!(bus.known_as("VCU2AI_Wheel_speeds").map(|message| message.name), Some("VCU2AI_Speeds"));
    /// assert_eq!(bus.known_as("VCU2AI_Wheels"), None);
    /// ```
    pub fn known_as(&self, name: &str) -> Option<&'static MessageDef> {
        let elsewhere = || Edition::ALL.iter().find_map(|other| self.message(other.bus.named(name)?.id));
        self.named(name).or_else(elsewhere)
    }
}

impl MessageDef {
    /// The signal with this name, or the one to which another edition gives it.
    ///
    /// ```
    /// use adsdv_spec::Edition;
    ///
    /// let steer = Edition::V4_0.bus.message(0x523).expect("VCU2AI_Steer");
    /// assert_eq!(steer.signal_known_as("STEER_ANGLE_MAX_deg").map(|signal| signal.name), Some("ANGLE_MAX"));
    /// assert_eq!(steer.signal_known_as("STEER_ANGLE"), None);
    /// ```
    pub fn signal_known_as(&self, name: &str) -> Option<&'static SignalDef> {
        let field = |other: &Edition| Some(other.bus.message(self.id)?.signal(name)?.field);
        let elsewhere = || Edition::ALL.iter().find_map(|other| self.signal_of(field(other)?));
        self.signal(name).or_else(elsewhere)
    }
}
