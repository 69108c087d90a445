//! The readings: under each choice that is not the default, a step is what the document says when it is read so.

use adsdv_spec::{Choice, Control, Edition, Inputs, Machine, Readings};

use crate::prelude::*;
use crate::words::{self, Verdict};

/// One theorem for each choice: from every control state that can be under it, with every input and after every time, the
/// step of the machine with that choice is what the words say under it. A choice that version 3.0 has not is one of 4.0.
macro_rules! by_the_words {
    ($($(#[$doc:meta])* $name:ident = $edition:ident $choice:ident by $step:ident;)+) => {
        $(
            $(#[$doc])*
            #[cfg_attr(kani, kani::proof, kani::unwind(14))]
            pub fn $name() {
                const READINGS: Readings = $edition.readings.with(Choice::$choice);
                const MACHINE: Machine = Machine::new(*$edition, READINGS);
                $step(&MACHINE);
            }
        )+

        theorems![$($name),+];

        /// The choice of which a theorem speaks, and its edition.
        #[cfg(not(kani))]
        pub const CHOICES: &[(&str, &Edition, Choice)] =
            &[$((stringify!($name), $edition, Choice::$choice)),+];
    };
}

const V4_0: &Edition = &Edition::V4_0;

fn step_by_the_words(machine: &Machine) {
    let (timing, readings) = (machine.edition().rules.timing, machine.readings());
    let before = kani::any_where(|control: &Control| control.is_consistent(&timing, readings));
    let (inputs, dt_ms) = (kani::any(), kani::any());
    let (after, outputs) = subject().step_of(machine, &before, &inputs, dt_ms);
    let said = words::step(&before, &inputs, dt_ms, readings);
    // Of the words: they are what the step is, and cost a proof less than one more step.
    let as_default = words::step(&before, &inputs, dt_ms, machine.edition().readings);
    kani::cover!(outputs.taken.is_some(), "an arrow is taken");
    kani::cover!(said != as_default, "the choice makes a difference");
    assert!(Verdict::of(after, &outputs) == said, "the words");
    assert!(after.is_consistent(&timing, readings), "the invariant of this reading is kept");
}

fn step_of_4_0_by_the_words(machine: &Machine) {
    let (timing, readings) = (machine.edition().rules.timing, machine.readings());
    let before = kani::any_where(|control: &Control| control.is_consistent(&timing, readings));
    let (inputs, dt_ms): (Inputs, u32) = (kani::any(), kani::any());
    #[cfg(not(kani))]
    let (before, inputs, dt_ms) = crate::steps::in_time(machine.edition(), before, inputs, dt_ms);
    let (after, outputs) = subject().step_of(machine, &before, &inputs, dt_ms);
    let said = words::step_of_4_0(&before, &inputs, dt_ms, readings);
    let as_default = words::step_of_4_0(&before, &inputs, dt_ms, machine.edition().readings);
    kani::cover!(outputs.taken.is_some(), "an arrow is taken");
    kani::cover!(said != as_default, "the choice makes a difference");
    assert!(Verdict::of(after, &outputs) == said, "the words");
    assert!(after.is_consistent(&timing, readings), "the invariant of this reading is kept");
}

by_the_words! {
    /// **`mission-selected=ami`**: AS_READY needs the selection on the AMI, and no MISSION_STATUS.
    ///
    /// Requirements: D-1, RDY-5.
    read_as_mission_ami = EDITION MissionAmi by step_by_the_words;
    /// **`mission-selected=status`**: AS_READY needs MISSION_STATUS SELECTED, and no selection on the AMI.
    ///
    /// Requirements: D-1, SM-9.
    read_as_mission_status_only = EDITION MissionStatusOnly by step_by_the_words;
    /// **`fault-trigger=edge`**: the change to FINISHED or NEUTRAL counts while moving, not the value.
    ///
    /// Requirements: D-2, IMP-2, IMP-3.
    read_as_fault_edge = EDITION FaultEdge by step_by_the_words;
    /// **`ready-priority=as-off`**: AS_READY goes to AS_OFF with ASMS off, also with a reason to brake.
    ///
    /// Requirements: D-3.
    read_as_ready_off_first = EDITION ReadyOffFirst by step_by_the_words;
    /// **`finished-priority=as-off`**: AS_FINISHED goes to AS_OFF with ASMS off, also with a reason to brake.
    ///
    /// Requirements: D-4.
    read_as_finished_off_first = EDITION FinishedOffFirst by step_by_the_words;
    /// **`driving-priority=as-finished`**: AS_DRIVING goes to AS_FINISHED when it can, also with a reason to brake.
    ///
    /// Requirements: D-5.
    read_as_driving_finished_first = EDITION DrivingFinishedFirst by step_by_the_words;
    /// **`go-edge=edge`**: any rising edge of "Go" is accepted while the other conditions hold.
    ///
    /// Requirements: D-6.
    read_as_go_edge_enough = EDITION GoEdgeEnough by step_by_the_words;
    /// **`go-signal=raw`**: GO_SIGNAL is the switch as it stands.
    ///
    /// Requirements: D-7.
    read_as_go_raw = EDITION GoRaw by step_by_the_words;
    /// **`handshake-active=always`**: the handshake runs with TSMS off as well.
    ///
    /// Requirements: D-8.
    read_as_handshake_always = EDITION HandshakeAlways by step_by_the_words;
    /// **`ai-estop=driving`**: ESTOP_REQUEST acts in AS_DRIVING only.
    ///
    /// Requirements: D-9.
    read_as_estop_driving = EDITION EstopDriving by step_by_the_words;
    /// **`comms-lost=no-arrow`**: a lost handshake raises its flag, and no arrow is taken.
    ///
    /// Requirements: D-10.
    read_as_comms_no_arrow = EDITION CommsNoArrow by step_by_the_words;
    /// **`power-cycle=not-latched`**: AS_READY can come again after EMERGENCY_BRAKE.
    ///
    /// Requirements: D-11.
    read_as_power_cycle_not_latched = EDITION PowerCycleNotLatched by step_by_the_words;
    /// **`ai-estop=every-state` in 4.0**: ESTOP_REQUEST acts in every active state, as it does in 3.0.
    ///
    /// Requirements: D-62.
    read_as_estop_every_state = V4_0 EstopEveryState by step_of_4_0_by_the_words;
    /// **`comms-lost=driving`**: AI_COMMS_LOST leads to EMERGENCY_BRAKE from AS_DRIVING only.
    ///
    /// Requirements: D-63.
    read_as_comms_driving = V4_0 CommsDriving by step_of_4_0_by_the_words;
    /// **`message-watch=always`**: missed messages are watched with TSMS off as well.
    ///
    /// Requirements: D-51.
    read_as_watch_always = V4_0 WatchAlways by step_of_4_0_by_the_words;
    /// **`torque-control=never`**: torque and hydraulic braking at once are no fault.
    ///
    /// Requirements: D-53.
    read_as_torque_never = V4_0 TorqueNever by step_of_4_0_by_the_words;
    /// **`bms-fault=driving`**: BMS_FAULT does not open the shutdown circuit, and acts in AS_DRIVING only.
    ///
    /// Requirements: D-54.
    read_as_bms_driving = V4_0 BmsDriving by step_of_4_0_by_the_words;
}
