//! What a step is: timers, handshake, memory, and the rows of a state in their order.

use std::fmt;

use adsdv_spec::messages::AsState;
use adsdv_spec::table::{Row, Term};
use adsdv_spec::{Atom, Atoms, Choice, Fault, Faults, Machine, Taken};

use super::words::{all, any, battery_is_apart, cause, in_words, name, one_of, seen_by};
use super::{Promela, checks};
use crate::document::Document;

/// Writes the states, the times, the readings that a step asks for, and the causes.
pub(super) fn constants(f: &mut fmt::Formatter<'_>, promela: &Promela<'_>) -> fmt::Result {
    let Promela { machine, document, .. } = promela;
    let timing = &machine.edition().rules.timing;
    f.write_str("\n/* The states, and where the time in each stops counting, in milliseconds. */\n")?;
    for state in AsState::ALL {
        writeln!(f, "#define {state} {}", state as u8)?;
    }
    for state in AsState::ALL {
        writeln!(f, "#define LIMIT_{state} {}", timing.in_state_limit(state))?;
    }
    writeln!(f, "#define CYCLE_MS {}\n#define HANDSHAKE_MS {}", timing.cycle_ms, timing.handshake_ms)?;
    f.write_str("\n/* The times of the document, by which the properties go. */\n")?;
    writeln!(f, "#define DOCUMENT_READY_DWELL_MS {}", document.ready_dwell_ms)?;
    writeln!(f, "#define DOCUMENT_EBS_TIMER_MS {}", document.ebs_timer_ms)?;
    writeln!(f, "#define DOCUMENT_HANDSHAKE_MS {}", document.handshake_ms)?;
    f.write_str("\n/* The readings that say what a step is; those that say which rows there are have chosen them already. */\n")?;
    let watched = machine.scope().has(Atom::AiMessagesMissed);
    for (choice, name) in CHOICES.into_iter().filter(|(choice, _)| watched || *choice != Choice::WatchAlways)
    {
        writeln!(f, "#define {name} {}  /* {choice} */", u8::from(machine.readings().is(choice)))?;
    }
    f.write_str("\n/* SHUTDOWN_CAUSE. */\n#define NO_SHUTDOWN 0\n")?;
    for fault in machine.edition().faults.iter() {
        writeln!(f, "#define {} {}", cause(fault), fault as u8)?;
    }
    f.write_str("\n")
}

/// The readings that a step asks for, and what Promela calls them.
const CHOICES: [(Choice, &str); 6] = [
    (Choice::FaultEdge, "FAULT_EDGE"),
    (Choice::GoEdgeEnough, "GO_EDGE_ENOUGH"),
    (Choice::GoRaw, "GO_RAW"),
    (Choice::HandshakeAlways, "HANDSHAKE_ALWAYS"),
    (Choice::PowerCycleLatched, "POWER_CYCLE_LATCHED"),
    (Choice::WatchAlways, "WATCH_ALWAYS"),
];

/// How many bits a number up to this takes.
const fn bits(most: u16) -> u32 {
    let bits = u16::BITS - most.leading_zeros();
    if bits == 0 { 1 } else { bits }
}

/// Writes the control state, and what a step knows of the one before it.
pub(super) fn control_state(f: &mut fmt::Formatter<'_>, machine: &Machine) -> fmt::Result {
    let timing = &machine.edition().rules.timing;
    let longest =
        AsState::ALL.into_iter().map(|state| timing.in_state_limit(state)).max().unwrap_or_default();
    writeln!(
        f,
        "/* The control state: what the VCU remembers between two steps. */
unsigned state : 3 = {};
unsigned in_state_ms : {};   /* how long the state has lasted */
bit go_seen_low;             /* AS_READY: \"Go\" was seen off, so that its rising edge counts (3.2, item 3) */
bit handshake_active;
bit handshake_bit;           /* the HANDSHAKE bit that the VCU sends (2.4) */
unsigned unanswered_ms : {};  /* for how long that bit has been unanswered */
bit power_cycle_needed;      /* after an emergency (3.9) */
unsigned shutdown_cause : 4; /* the first cause of an emergency (2.2) */
#if FAULT_EDGE
bit was_running;             /* AS_DRIVING: MISSION_STATUS was RUNNING */
bit was_forward;             /* AS_DRIVING: DIRECTION_REQUEST was FORWARD */
#else
#define was_running 0
#define was_forward 0
#endif

/* Within a step: the state that it leads to, and what was before it. */
hidden byte next;
hidden byte before;
hidden byte cause_before;
hidden byte armed_before;     /* go_seen_low */
hidden int lasted_ms;        /* how long the state before has lasted now */
",
        AsState::Off,
        bits(longest),
        bits(timing.handshake_ms),
    )
}

/// Writes the conditions that memory decides, or has a part in.
pub(super) fn conditions(f: &mut fmt::Formatter<'_>, machine: &Machine) -> fmt::Result {
    f.write_str(
        "/* The conditions that the control state decides, some of them together with the inputs. */\n",
    )?;
    for state in AsState::ALL {
        if let Some(timer) = Atom::of_timer(state) {
            let timer = name(timer);
            writeln!(f, "#define {timer} (state == {state} && in_state_ms + CYCLE_MS >= LIMIT_{state})")?;
        }
    }
    f.write_str(
        "#define go_edge (go_seen_low && go_on)
#define mission_finished_edge (was_running && mission_finished)
#define direction_neutral_edge (was_forward && direction_neutral)
",
    )?;
    let unanswered = "handshake_active && unanswered_ms >= HANDSHAKE_MS";
    if machine.scope().has(Atom::AiMessagesMissed) {
        let missed = format!("{} && (WATCH_ALWAYS || handshake_active)", name(Atom::AiMessagesMissed));
        writeln!(f, "#define ai_comms_lost (({unanswered}) || ({missed}))\n")
    } else {
        writeln!(f, "#define ai_comms_lost ({unanswered})\n")
    }
}

/// Writes the parts that steps from all states have in common.
pub(super) fn inlines(f: &mut fmt::Formatter<'_>, machine: &Machine) -> fmt::Result {
    let arming = match go_conditions(machine) {
        None => "false".into(),
        Some(_) if machine.readings().is(Choice::GoEdgeEnough) => "!go_on".into(),
        Some(conditions) => format!("!go_on && {conditions}"),
    };
    f.write_str(HANDSHAKE)?;
    writeln!(
        f,
        "
/* What a step remembers; limit_ms is where the time in the state before stops counting. \"Go\" is armed while it is off
 * and, unless any rising edge counts, all else holds that AS_DRIVING needs. */
inline remember(limit_ms) {{
    go_seen_low = (next == {} && {arming});
#if FAULT_EDGE
    was_running = (next == {driving} && mission_running);
    was_forward = (next == {driving} && !direction_neutral);
#endif
    in_state_ms = (next != before -> 0 : (lasted_ms < limit_ms -> lasted_ms : limit_ms));
    state = next
}}
",
        AsState::Ready,
        driving = AsState::Driving,
    )
}

const HANDSHAKE: &str = "/* The handshake (2.4): an edge of the VCU's bit waits for the same bit of the AI Computer. The first active step does not
 * count as time without an answer. */
inline handshake() {
    if
    :: !(HANDSHAKE_ALWAYS || tsms) -> handshake_active = 0; handshake_bit = 0; unanswered_ms = 0
    :: else ->
        if
        :: ai_handshake == handshake_bit -> handshake_bit = !handshake_bit; unanswered_ms = 0
        :: else ->
            unanswered_ms = (!handshake_active -> 0 :
                (unanswered_ms + CYCLE_MS < HANDSHAKE_MS -> unanswered_ms + CYCLE_MS : HANDSHAKE_MS))
        fi;
        handshake_active = 1
    fi
}
";

/// What must hold before the \"Go\" edge counts: the guard of AS_READY to AS_DRIVING without \"Go\".
fn go_conditions(machine: &Machine) -> Option<String> {
    let (_, terms) = rows(machine, AsState::Ready).into_iter().find(|(row, _)| row.to == AsState::Driving)?;
    let conditions = all(terms.first()?.literals().filter(|(atom, _)| *atom != Atom::GoEdge));
    Some(seen_by(machine, conditions))
}

/// The rows of a state in the order of evaluation, each with the terms that the readings have.
fn rows(machine: &Machine, from: AsState) -> Vec<(&Row, Vec<&Term>)> {
    let table = &machine.edition().rules.table;
    let mut rows: Vec<(u8, &Row, Vec<&Term>)> = Vec::new();
    for taken in machine.arrows(from) {
        let (Some(row), Some(term)) = (Taken::row(taken, table), Taken::term(taken, table)) else { continue };
        match rows.last_mut() {
            Some((place, _, terms)) if *place == taken.row => terms.push(term),
            _ => rows.push((taken.row, row, vec![term])),
        }
    }
    rows.into_iter().map(|(_, row, terms)| (row, terms)).collect()
}

/// Writes the step from a state.
pub(super) fn step(f: &mut fmt::Formatter<'_>, machine: &Machine, from: AsState) -> fmt::Result {
    writeln!(
        f,
        "inline step_{from}() {{
    d_step {{
        BEGIN_STEP
        before = {from}; cause_before = shutdown_cause; armed_before = go_seen_low;
        lasted_ms = in_state_ms + CYCLE_MS;
        handshake();
        if"
    )?;
    for (row, terms) in rows(machine, from) {
        let words = in_words(&machine.edition().rules, terms.iter().copied(), row.section);
        writeln!(f, "        /* {}: {words} */", row.section)?;
        write!(f, "        :: {} -> next = {}", seen_by(machine, any(terms.iter().copied())), row.to)?;
        if row.to == AsState::EmergencyBrake && row.to != from {
            f.write_str(";\n")?;
            emergency(f, machine, &terms)?;
        }
        f.write_str("\n")?;
    }
    writeln!(f, "        :: else -> next = {from}\n        fi;\n        remember(LIMIT_{from});")?;
    checks::of_step(f, Document::of_machine(machine), from)?;
    f.write_str("    }\n}\n\n")
}

/// Writes what an emergency sets: the first cause, which is the lowest number of the reasons, and the latch.
fn emergency(f: &mut fmt::Formatter<'_>, machine: &Machine, terms: &[&Term]) -> fmt::Result {
    f.write_str("            power_cycle_needed = POWER_CYCLE_LATCHED;\n            if\n")?;
    f.write_str("            :: shutdown_cause != NO_SHUTDOWN\n")?;
    for &fault in Fault::ALL {
        let named = terms.iter().filter(|term| term.fault == Some(fault)).copied();
        let by_name = named.map(|term| seen_by(machine, all(term.literals())));
        // A term without a fault of its own has those that open the shutdown circuit.
        let unnamed: Vec<&Term> = terms.iter().filter(|term| term.fault.is_none()).copied().collect();
        let shown = Faults::OPENING.has(fault) && !unnamed.is_empty();
        let by_input = shown.then(|| shown_by(fault, machine, &unnamed));
        let reasons: Vec<_> = by_name.chain(by_input).collect();
        if !reasons.is_empty() {
            let reasons = one_of(reasons.into_iter());
            writeln!(f, "            :: {reasons} -> shutdown_cause = {}", cause(fault))?;
        }
    }
    f.write_str("            :: else\n            fi")
}

/// That a fault is present, and a term holds that leaves it to the faults to say why.
fn shown_by(fault: Fault, machine: &Machine, terms: &[&Term]) -> String {
    let sdc_open = Atoms::NONE.with(Atom::SdcOpen);
    // The fault itself opens the circuit.
    let opens = !battery_is_apart(machine) || fault != Fault::BmsFault;
    let follows = opens && terms.iter().any(|term| (term.on, term.off) == (sdc_open, Atoms::NONE));
    if follows {
        fault.flag().into()
    } else {
        format!("{} && ({})", fault.flag(), seen_by(machine, any(terms.iter().copied())))
    }
}

/// Writes the power cycle, which is possible at any time; in the state that it leads to it changes nothing.
pub(super) fn power_cycle(f: &mut fmt::Formatter<'_>) -> fmt::Result {
    writeln!(
        f,
        "    :: d_step {{
        state != {off} || handshake_active || power_cycle_needed || shutdown_cause != NO_SHUTDOWN ->
        state = {off}; in_state_ms = 0; go_seen_low = 0; handshake_active = 0; handshake_bit = 0; unanswered_ms = 0;
        power_cycle_needed = 0; shutdown_cause = NO_SHUTDOWN
#if FAULT_EDGE
        ; was_running = 0; was_forward = 0
#endif
       }}",
        off = AsState::Off
    )
}
