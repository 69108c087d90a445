//! The transitions that were seen, each with the conditions that decided.

use std::fmt::{self, Write as _};

use adsdv_oracle::judge::Transition;
use adsdv_spec::{Atom, Knowledge, Rules, Term, Truth};

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
    let Transition { t_ns, from, to, section, justified, remote_estop, .. } = transition;
    let word = match justified {
        Truth::True => Styled(style::QUIET, "justified"),
        Truth::Unknown => Styled(style::CARE, "not certain"),
        Truth::False => Styled(style::BAD, "VIOLATION"),
    };
    writeln!(out, "{:>10} s  {from:<15} -> {to:<15}  {section:<8}  {word}", Seconds(*t_ns))?;
    if let Some((term, known)) = transition.decided {
        wrapped(out, conditions(rules, &term, known, *remote_estop), INDENT, width);
    }
    for (term, _) in &transition.or {
        let text = |(atom, needed)| rules.text(atom, needed).to_string();
        let conditions: Vec<String> = term.literals().map(text).collect();
        let line = format!("or {}, which the VCU reports alike", conditions.join(", "));
        wrapped(out, line.split(' '), INDENT, width);
    }
    Ok(())
}

/// Every condition of a term as it was, and where that is not as it must be, how it must be. Where the remote control shows that
/// its E-stop was pressed, that tells more than the open circuit.
fn conditions(rules: &Rules, term: &Term, known: Knowledge, remote_estop: bool) -> Vec<String> {
    let last = term.literals().count();
    term.literals()
        .zip(1..)
        .map(|((atom, needed), index)| {
            let comma = if index < last { "," } else { "" };
            match known.of(atom) {
                _ if atom == Atom::SdcOpen && remote_estop => format!("remote E-stop pressed{comma}"),
                Truth::Unknown => format!("{} ({}){comma}", rules.text(atom, needed), why_unknown(atom)),
                seen if seen == Truth::from(needed) => format!("{}{comma}", rules.text(atom, needed)),
                _ => format!("{} (needed: {}){comma}", rules.text(atom, !needed), rules.text(atom, needed)),
            }
        })
        .collect()
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
    use adsdv_spec::{Atoms, Edition};

    use super::*;

    #[test]
    fn a_condition_prints_what_was_seen_and_what_was_needed() {
        let term = Term::on("3.1", &[Atom::Asms, Atom::Tsms, Atom::EbsArmed, Atom::SdcOpen]);
        let seen = Atoms::of(&[Atom::Asms, Atom::Tsms]);
        let known = Knowledge::NOTHING.learn(seen, Atoms::of(&[Atom::Asms]));
        assert_eq!(
            conditions(&Edition::DEFAULT.rules, &term, known, false),
            [
                "SDC open (not visible in the log),",
                "AS master switch ON,",
                "TS master switch OFF (needed: TS master switch ON),",
                "EBS_state == ARMED (not certain)",
            ]
        );
        let pressed = conditions(&Edition::DEFAULT.rules, &term, known, true);
        assert_eq!(pressed.first().map(String::as_str), Some("remote E-stop pressed,"));
    }
}
