//! The readings: under each choice that is not the default, a step is what the document says when it is read so.

use adsdv_spec::{Choice, Control, Edition, Machine, Readings};

use crate::prelude::*;
use crate::words::{self, Verdict};

/// One theorem for each choice: from every control state that can be under it, with every input and after every time, the
/// step of the machine with that choice is what the words say under it.
macro_rules! by_the_words {
    ($($(#[$doc:meta])* $name:ident = $choice:ident;)+) => {
        $(
            $(#[$doc])*
            #[cfg_attr(kani, kani::proof, kani::unwind(12))]
            pub fn $name() {
                const READINGS: Readings = Readings::DEFAULT.with(Choice::$choice);
                const MACHINE: Machine = Machine::new(*Edition::DEFAULT, READINGS);
                step_by_the_words(&MACHINE);
            }
        )+

        theorems![$($name),+];

        /// The choice of which a theorem speaks.
        #[cfg(not(kani))]
        pub const CHOICES: &[(&str, Choice)] = &[$((stringify!($name), Choice::$choice)),+];
    };
}

fn step_by_the_words(machine: &Machine) {
    let (timing, readings) = (machine.edition().rules.timing, machine.readings());
    let before = kani::any_where(|control: &Control| control.is_consistent(&timing, readings));
    let (inputs, dt_ms) = (kani::any(), kani::any());
    let (after, outputs) = subject().step_of(machine, &before, &inputs, dt_ms);
    let as_default = subject().step(&before, &inputs, dt_ms);
    kani::cover!(outputs.taken.is_some(), "an arrow is taken");
    kani::cover!((after, outputs) != as_default, "the choice makes a difference");
    assert!(Verdict::of(after, &outputs) == words::step(&before, &inputs, dt_ms, readings), "the words");
    assert!(after.is_consistent(&timing, readings), "the invariant of this reading is kept");
}

by_the_words! {
    /// **`mission-selected=ami`**: AS_READY needs the selection on the AMI, and no MISSION_STATUS.
    ///
    /// Requirements: D-1, RDY-5.
    read_as_mission_ami = MissionAmi;
    /// **`mission-selected=status`**: AS_READY needs MISSION_STATUS SELECTED, and no selection on the AMI.
    ///
    /// Requirements: D-1, SM-9.
    read_as_mission_status_only = MissionStatusOnly;
    /// **`fault-trigger=edge`**: the change to FINISHED or NEUTRAL counts while moving, not the value.
    ///
    /// Requirements: D-2, IMP-2, IMP-3.
    read_as_fault_edge = FaultEdge;
    /// **`ready-priority=as-off`**: AS_READY goes to AS_OFF with ASMS off, also with a reason to brake.
    ///
    /// Requirements: D-3.
    read_as_ready_off_first = ReadyOffFirst;
    /// **`finished-priority=as-off`**: AS_FINISHED goes to AS_OFF with ASMS off, also with a reason to brake.
    ///
    /// Requirements: D-4.
    read_as_finished_off_first = FinishedOffFirst;
    /// **`driving-priority=as-finished`**: AS_DRIVING goes to AS_FINISHED when it can, also with a reason to brake.
    ///
    /// Requirements: D-5.
    read_as_driving_finished_first = DrivingFinishedFirst;
    /// **`go-edge=edge`**: any rising edge of "Go" is accepted while the other conditions hold.
    ///
    /// Requirements: D-6.
    read_as_go_edge_enough = GoEdgeEnough;
    /// **`go-signal=raw`**: GO_SIGNAL is the switch as it stands.
    ///
    /// Requirements: D-7.
    read_as_go_raw = GoRaw;
    /// **`handshake-active=always`**: the handshake runs with TSMS off as well.
    ///
    /// Requirements: D-8.
    read_as_handshake_always = HandshakeAlways;
    /// **`ai-estop=driving`**: ESTOP_REQUEST acts in AS_DRIVING only.
    ///
    /// Requirements: D-9.
    read_as_estop_driving = EstopDriving;
    /// **`comms-lost=no-arrow`**: a lost handshake raises its flag, and no arrow is taken.
    ///
    /// Requirements: D-10.
    read_as_comms_no_arrow = CommsNoArrow;
    /// **`power-cycle=not-latched`**: AS_READY can come again after EMERGENCY_BRAKE.
    ///
    /// Requirements: D-11.
    read_as_power_cycle_not_latched = PowerCycleNotLatched;
}
