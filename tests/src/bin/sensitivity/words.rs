//! What could be told by the documents' words alone: an observer who excuses what was only decided where the documents are silent, and
//! gives a VCU as long to react as the judge does.
//!
//! What this observer tells and the judge calls no violation, the judge misses. It looks at the 520h, with what 524h shows of the EBS,
//! and excuses rather too much than too little:
//!
//! - what no document says when it is 1: STEERING_STATUS, SHUTDOWN_REQUEST, FAULT_STATUS and WARNING_STATUS beyond the flags that
//!   they sum up, "Go" outside of AS_DRIVING, and the states of 2026's 520h (D-7, D-37 to D-40, D-71 to D-73);
//! - a fault flag that stays when its fault is gone, or one of the cause that does not (D-17), and what SHUTDOWN_CAUSE names of
//!   several, or 0 where the emergency has no number of its own (D-13 to D-16);
//! - an open shutdown circuit that no flag shows (D-12 to D-14);
//! - whatever the handshake is while TSMS is off, and a step that is not counted when it begins (D-8, D-26, D-44);
//! - steps that see what was so up to the deadline and a cycle before, each switch and the EBS by
//!   themselves, flags that are so late, and a state that began a step before it shows.

use std::collections::HashSet;

use adsdv_oracle::judge::JudgeOptions;
use adsdv_spec::messages::{EbsState, Frame, ShutdownCause, Vcu2AiBrake, Vcu2AiStatus};
use adsdv_spec::{AsState, Control, Edition, Fault, Faults, Handshake, Inputs, Machine};
use adsdv_tests::world::World;

use super::observer::{CYCLE_MS, either, hidden, steps};

/// What may be of the VCU: what it remembers, and for how many steps its flags have been late.
type Possible = HashSet<(Control, u32)>;

/// Whether the recording of a run, with nothing late and nothing lost, shows that its VCU breaks what a document says.
pub(crate) fn can_tell(specification: &Machine, world: &World) -> bool {
    let cycle_ms = u32::from(CYCLE_MS);
    let late = JudgeOptions::of(Edition::DEFAULT).deadline_ms / cycle_ms;
    let mut before: Option<Vcu2AiStatus> = None;
    // What each of the last steps may have seen.
    let mut seen: Vec<Vec<Inputs>> = Vec::new();
    let mut possible: Possible = beginnings().map(|control| (control, 0)).collect();
    for (inputs, frames) in steps(world) {
        let Some(sent) = status(specification, &frames) else { continue };
        seen.insert(0, consistent(specification, inputs, &frames, &sent));
        seen.truncate(2 + usize::try_from(late).unwrap_or_default());
        let mut after = Possible::new();
        let mut tried = HashSet::new();
        for inputs in &late_by_itself(&seen) {
            if !tried.insert((inputs.observe(&specification.edition().rules.thresholds), inputs.tsms)) {
                continue;
            }
            for (control, so_late) in &possible {
                let (next, outputs) = specification.step(control, inputs, cycle_ms);
                let expected = outputs.messages(inputs).status;
                let mut nexts = vec![next];
                if next.state != control.state {
                    nexts.push(Control { in_state_ms: CYCLE_MS, ..next });
                }
                if !inputs.tsms {
                    let shown = Handshake { active: true, bit: sent.handshake, unanswered_ms: 0 };
                    nexts.push(Control { handshake: shown, ..next });
                }
                if next.handshake.unanswered_ms == CYCLE_MS {
                    let later = Handshake { unanswered_ms: 0, ..next.handshake };
                    nexts.push(Control { handshake: later, ..next });
                }
                match agrees(&sent, before.as_ref(), &expected) {
                    Agreement::Full => after.extend(nexts.into_iter().map(|next| (next, 0))),
                    Agreement::Late if *so_late < late => {
                        after.extend(nexts.into_iter().map(|next| (next, so_late + 1)));
                    }
                    Agreement::Late | Agreement::None => {}
                }
            }
        }
        if after.is_empty() {
            return true;
        }
        possible = after;
        before = Some(sent);
    }
    false
}

/// What a step may have seen where each switch and the EBS is late by itself, and all else is.
fn late_by_itself(seen: &[Vec<Inputs>]) -> Vec<Inputs> {
    let any = || seen.iter().flatten();
    let asms: HashSet<bool> = any().map(|inputs| inputs.asms).collect();
    let tsms: HashSet<bool> = any().map(|inputs| inputs.tsms).collect();
    let ebs: HashSet<EbsState> = any().map(|inputs| inputs.ebs).collect();
    let mut all = Vec::new();
    for inputs in any() {
        for &asms in &asms {
            for &tsms in &tsms {
                all.extend(ebs.iter().map(|&ebs| Inputs { asms, tsms, ebs, ..*inputs }));
            }
        }
    }
    all
}

/// A VCU whose power has come on, with either bit of the handshake.
fn beginnings() -> impl Iterator<Item = Control> {
    let initial = Control::INITIAL;
    let other = Handshake { active: true, bit: true, ..initial.handshake };
    [initial.handshake, other].into_iter().map(move |handshake| Control { handshake, ..initial })
}

/// The 520h of these frames.
fn status(specification: &Machine, frames: &[Frame]) -> Option<Vcu2AiStatus> {
    let bus = &specification.edition().bus;
    bus.decode_as(frames.iter().find(|frame| frame.id == Vcu2AiStatus::ID)?.data()).ok()
}

/// The inputs that a step may have had by what is shown of the switches and of the EBS.
fn consistent(
    specification: &Machine,
    inputs: &Inputs,
    frames: &[Frame],
    sent: &Vcu2AiStatus,
) -> Vec<Inputs> {
    let bus = &specification.edition().bus;
    let shows_ebs = bus.message(Vcu2AiBrake::ID).is_some_and(|def| def.signal_of("status_ebs").is_some());
    let brake = frames.iter().find(|frame| frame.id == Vcu2AiBrake::ID).filter(|_| shows_ebs);
    let brake: Option<Vcu2AiBrake> = brake.and_then(|frame| bus.decode_as(frame.data()).ok());
    // In EMERGENCY_BRAKE it has triggered, whatever else it is (D-28).
    let brake = brake.filter(|_| sent.as_state != AsState::EmergencyBrake);
    let switches =
        |inputs: &Inputs| inputs.asms == sent.as_switch_status && inputs.tsms == sent.ts_switch_status;
    let mut all = hidden(specification, inputs, frames);
    either(&mut all, |inputs| inputs.show_fault(Fault::HvilOpenFault, true));
    all.retain(|inputs| switches(inputs) && brake.is_none_or(|brake| brake.status_ebs == inputs.ebs));
    all
}

/// Whether 520h agrees with what is expected.
enum Agreement {
    Full,
    /// In its flags it does not, which it may for a while.
    Late,
    None,
}

fn agrees(sent: &Vcu2AiStatus, before: Option<&Vcu2AiStatus>, expected: &Vcu2AiStatus) -> Agreement {
    let handshake = sent.handshake == expected.handshake || !sent.ts_switch_status;
    if sent.as_state != expected.as_state || !handshake {
        return Agreement::None;
    }
    let go = sent.go_signal == expected.go_signal || sent.as_state != AsState::Driving;
    let (shown, due) = (Faults::shown_by(sent), Faults::shown_by(expected));
    // One that was shown from the beginning may have been there before it.
    let kept = before.map_or(shown, |before| shown.intersection(Faults::shown_by(before)));
    let of_cause = Faults::of_cause(expected.shutdown_cause);
    let flags = shown.difference(due).is_subset(kept)
        && due.difference(shown).is_subset(of_cause.with(Fault::HvilOpenFault));
    let present = shown.without(Fault::AiComputerRequest);
    let fault_sum = sent.fault_status || present.is_empty();
    let warning_sum = sent.warning_status || !(sent.warn_batt_temp_high || sent.warn_batt_soc_low);
    let earlier = before.map_or(ShutdownCause::NoShutdown, |before| before.shutdown_cause);
    let cause = sent.shutdown_cause == expected.shutdown_cause
        || sent.shutdown_cause == earlier
        || sent.shutdown_cause == ShutdownCause::NoShutdown
        || Faults::of_cause(sent.shutdown_cause).is_subset(shown);
    if go && flags && fault_sum && warning_sum && cause { Agreement::Full } else { Agreement::Late }
}
