//! Systems other than Linux: they have no SocketCAN, and say so.

use std::convert::Infallible;
use std::time::Instant;

use adsdv_spec::messages::Frame;

use super::OpenError;
use crate::bus::{Bus, Disturbance, Event, Listen, Received};

/// A bus of SocketCAN. There is none on this system.
#[derive(Debug)]
pub struct CanBus(Infallible);

/// A bus of SocketCAN to listen to. There is none on this system.
#[derive(Debug)]
pub struct Listener(Infallible);

fn none(name: &str) -> OpenError {
    OpenError {
        what: name.to_owned(),
        why: "only Linux has SocketCAN, and this is another system".to_owned(),
        hint: "`adsdv demo --screen` is the car without CAN, `adsdv exam --stdio` examines a stack, and `adsdv watch -` judges what another program hears; or run this in a virtual machine with Linux".to_owned(),
    }
}

impl CanBus {
    pub(super) fn open(name: &str) -> Result<Self, OpenError> {
        Err(none(name))
    }
}

impl Listener {
    pub(super) fn open(name: &str) -> Result<Self, OpenError> {
        Err(none(name))
    }
}

macro_rules! listens {
    ($($bus:ty),+) => {
        $(impl Listen for $bus {
            fn name(&self) -> &str {
                match self.0 {}
            }

            fn receive(&mut self, _until: Instant) -> Event {
                match self.0 {}
            }

            fn dropped(&self) -> u64 {
                match self.0 {}
            }
        })+
    };
}

listens!(CanBus, Listener);

impl Bus for CanBus {
    fn send(&mut self, _frame: &Frame) -> Result<(), Disturbance> {
        match self.0 {}
    }
}

/// What an error frame says, in words.
pub fn error_text(frame: &Received) -> String {
    format!("error class {:X}", frame.id)
}
