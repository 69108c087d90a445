//! How long states last, by a clock on the wall.

use adsdv_spec::{AsState, Choice, Readings, Timing};

use crate::run::{Property, Seen};

/// AS_DRIVING comes after AS_READY alone, which has lasted for its time, and after "Go" was seen off when it had; and
/// EMERGENCY_BRAKE ends once its time is over and ASMS is off, not before and not after.
//= DRV-4, DRV-12, DRV-13, ETO-1, ETO-2, D-6, D-23
pub(crate) struct Clocks {
    timing: Timing,
    go_edge_enough: bool,
    state: AsState,
    /// When the state was entered.
    since_ms: u64,
    /// In AS_READY: "Go" was off when it mattered.
    go_was_off: bool,
}

impl Clocks {
    pub(crate) fn new(timing: Timing, readings: Readings) -> Self {
        Self {
            timing,
            go_edge_enough: readings.is(Choice::GoEdgeEnough),
            state: AsState::Off,
            since_ms: 0,
            go_was_off: false,
        }
    }

    fn change(&self, seen: &Seen<'_>, lasted_ms: u64) -> Result<(), String> {
        let (from, to) = (self.state, seen.outputs.state);
        if to == AsState::Driving {
            if from != AsState::Ready {
                return Err(format!("AS_DRIVING comes after {from}, not after AS_READY"));
            }
            let least = u64::from(self.timing.ready_dwell_ms);
            if lasted_ms < least {
                return Err(format!("AS_READY has lasted for {lasted_ms} ms, not for {least} ms"));
            }
            if !self.go_was_off {
                return Err("AS_DRIVING without \"Go\" having been off".to_owned());
            }
        }
        if from == AsState::EmergencyBrake {
            let least = u64::from(self.timing.ebs_timer_ms);
            if to != AsState::Off {
                return Err(format!("{to} comes after EMERGENCY_BRAKE, not AS_OFF"));
            }
            if lasted_ms < least {
                return Err(format!("EMERGENCY_BRAKE has lasted for {lasted_ms} ms, not for {least} ms"));
            }
            if seen.inputs.asms {
                return Err("EMERGENCY_BRAKE was left with ASMS on".to_owned());
            }
        }
        Ok(())
    }
}

impl Property for Clocks {
    fn see(&mut self, seen: &Seen<'_>) -> Result<(), String> {
        if seen.power_cycled {
            self.state = AsState::Off;
        }
        let lasted_ms = seen.t_ms - self.since_ms;
        let (from, to) = (self.state, seen.outputs.state);
        if from != to {
            self.change(seen, lasted_ms)?;
            (self.state, self.since_ms, self.go_was_off) = (to, seen.t_ms, false);
        } else if from == AsState::EmergencyBrake
            && lasted_ms >= self.timing.ebs_timer_ms.into()
            && !seen.inputs.asms
        {
            return Err(format!("EMERGENCY_BRAKE has lasted for {lasted_ms} ms and ASMS is off"));
        }
        let dwelt = from == AsState::Ready && lasted_ms >= self.timing.ready_dwell_ms.into();
        if to == AsState::Ready && !seen.inputs.go && (dwelt || self.go_edge_enough) {
            self.go_was_off = true;
        }
        Ok(())
    }
}
