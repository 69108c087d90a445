//! The transitions that were seen, each with the conditions that decided.

use std::fmt::{self, Write as _};

use adsdv_oracle::judge::{Decided, Transition};
use adsdv_spec::{Atom, Rules, Truth};

use super::INDENT;
use super::style::{self, Styled};
use crate::layout::{Seconds, wrapped};

pub(super) fn write(
    out: &mut String,
    rules: &Rules,
    transitions: &[Transition],
    width: usize,
) -> fmt::Result {
    writeln!(out, "\n{}", Styled(style::HEADING, "TIMELINE"))?;
    if transitions.is_empty() {
        writeln!(out, "  no change of AS_STATE seen")?;
    }
    transitions.iter().try_for_each(|transition| write_one(out, rules, transition, width))
}

pub(super) fn write_one(
    out: &mut String,
    rules: &Rules,
    transition: &Transition,
    width: usize,
) -> fmt::Result {
    let Transition { t_ns, from, to, section, justified, .. } = transition;
    let word = match justified {
        Truth::True => Styled(style::QUIET, "justified"),
        Truth::Unknown => Styled(style::CARE, "not certain"),
        Truth::False => Styled(style::BAD, "VIOLATION"),
    };
    writeln!(out, "{:>10} s  {from:<15} -> {to:<15}  {section:<8}  {word}", Seconds(*t_ns))?;
    if transition.decided.is_some() {
        wrapped(out, conditions(rules, &transition.conditions()), INDENT, width);
    }
    for other in transition.others(rules) {
        let line = format!("or {other}, which the VCU reports alike");
        wrapped(out, line.split(' '), INDENT, width);
    }
    Ok(())
}

/// Every condition as it was, and where that is not as it must be, how it must be.
fn conditions(rules: &Rules, decided: &[Decided]) -> Vec<String> {
    let last = decided.len();
    let one = |(one, index): (&Decided, usize)| {
        let comma = if index < last { "," } else { "" };
        let text = one.text(rules);
        match one.held {
            Truth::True => format!("{text}{comma}"),
            Truth::Unknown => format!("{text} ({}){comma}", why_unknown(one.atom)),
            Truth::False => format!("{} (needed: {text}){comma}", rules.text(one.atom, !one.needed)),
        }
    };
    decided.iter().zip(1..).map(one).collect()
}

/// No message shows these two. The others are shown, but may have been missing or have changed at that moment.
fn why_unknown(atom: Atom) -> &'static str {
    match atom {
        Atom::SdcOpen | Atom::PowerCycleNeeded => "not visible in the log",
        _ => "not certain",
    }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::{AsState, Atoms, Edition, Knowledge, Term};

    use super::*;

    #[test]
    fn a_condition_prints_what_was_seen_and_what_was_needed() {
        let term = Term::on("3.1", &[Atom::Asms, Atom::Tsms, Atom::EbsArmed, Atom::SdcOpen]);
        let seen = Atoms::of(&[Atom::Asms, Atom::Tsms]);
        let known = Knowledge::NOTHING.learn(seen, Atoms::of(&[Atom::Asms]));
        let transition = Transition {
            t_ns: 0,
            from: AsState::Off,
            to: AsState::Ready,
            section: "3.1",
            justified: Truth::Unknown,
            decided: Some((term, known)),
            remote_estop: false,
            or: Vec::new(),
        };
        let rules = &Edition::DEFAULT.rules;
        assert_eq!(
            conditions(rules, &transition.conditions()),
            [
                "SDC open (not visible in the log),",
                "AS master switch ON,",
                "TS master switch OFF (needed: TS master switch ON),",
                "EBS_state == ARMED (not certain)",
            ]
        );
        let pressed = Transition { remote_estop: true, ..transition };
        let pressed = conditions(rules, &pressed.conditions());
        assert_eq!(pressed.first().map(String::as_str), Some("remote E-stop pressed,"));
    }
}
