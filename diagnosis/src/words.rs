//! A deviation in words, by its name, and by the requirements that it is against.

use std::fmt;

use adsdv_conform::protocol::{Domain, INPUTS, Protocol};
use adsdv_spec::messages::{AsState, SteerAngle, WheelSpeed};
use adsdv_spec::mutation::{Change, TermChange, Threshold, Time};
use adsdv_spec::{Edition, Row, Term};

use crate::deviation::{Deviation, Remembers, Wheels};

impl Deviation {
    /// In words, with what the edition asks for instead.
    pub fn text(self, edition: &Edition) -> impl fmt::Display {
        fmt::from_fn(move |f| write(f, &self, edition))
    }

    /// A stable name, such as `ready-driving:needs:ami=3`.
    pub fn id(self, edition: &Edition) -> String {
        let row = |row: usize| {
            edition.rules.table.rows().get(row).map_or(String::new(), |row| arrow(row.from, row.to))
        };
        match self {
            Self::Changed(Change::RowDropped(place)) => format!("{}:missing", row(place)),
            Self::Changed(Change::RowLeadsTo(place, to)) => format!("{}:leads-to:{}", row(place), short(to)),
            Self::Changed(Change::RowFirst(place)) => format!("{}:first", row(place)),
            Self::Changed(Change::Term(place, term, change)) => {
                let what = match change {
                    TermChange::Dropped => "missing".to_owned(),
                    TermChange::LiteralDropped(atom) => format!("without:{atom}"),
                    TermChange::LiteralFlipped(atom) => format!("opposite:{atom}"),
                    TermChange::FaultDropped => "no-fault".to_owned(),
                    TermChange::InEveryReading => "in-every-reading".to_owned(),
                };
                format!("{}:{}:{what}", row(place), term + 1)
            }
            Self::Changed(Change::Time(time, by)) => format!("{}:{by:+}ms", time_id(time)),
            Self::Changed(Change::Threshold(threshold, by)) => format!("{}:{by:+}", threshold_id(threshold)),
            Self::Needs { from, to, key, raw, is } => {
                format!("{}:needs:{key}{}{raw}", arrow(from, to), if is { "=" } else { "!=" })
            }
            Self::Also { from, to, key, raw } => format!("{}:also:{key}={raw}", arrow(from, to)),
            Self::Late { from, to, steps } => format!("{}:late:{steps}", arrow(from, to)),
            Self::Ignores { key } => format!("ignores:{key}"),
            Self::Opens { key, raw } => format!("opens:{key}={raw}"),
            Self::Wheels(Wheels::All) => "moving:all-wheels".to_owned(),
            Self::Wheels(Wheels::Only(wheel)) => format!("moving:wheel-{}", wheel + 1),
            Self::Wheels(Wheels::Front) => "moving:front-wheels".to_owned(),
            Self::Wheels(Wheels::Rear) => "moving:rear-wheels".to_owned(),
            Self::Wheels(Wheels::Mean) => "moving:mean".to_owned(),
            Self::GoLevel => "go:level".to_owned(),
            Self::GoNeedsHandshake => "go:needs-handshake".to_owned(),
            Self::Joined { row: place, one, other } => {
                format!("{}:{}:and:{}", row(place), one + 1, other + 1)
            }
            Self::Remembers(what) => format!("remembers:{}", remembers_id(what)),
            Self::Causes { from, value, raw } => format!("{}:cause:{value}={raw}", short(from)),
            Self::Prefers { from, value, raw } => format!("{}:cause:{raw}-before-{value}", short(from)),
            Self::Reads(choice) => format!("reads:{choice}"),
            Self::Shows { state, key, raw } => {
                format!("{}:shows:{key}={}", short(state), number_or_name(raw))
            }
            Self::Writes { key, value, raw } => format!("writes:{key}:{value}={}", number_or_name(raw)),
        }
    }

    /// The condition under which a state is left that should stay.
    pub(crate) fn condition(self, edition: &Edition) -> Option<String> {
        match self {
            Self::Also { key, raw, .. } => Some(format!("{key} == {}", input(edition, key, raw))),
            _ => None,
        }
    }

    /// The arrows that it is about, by where they begin and lead; none where it is about no single ones.
    pub fn arrows(self, edition: &Edition) -> Vec<(AsState, AsState)> {
        let rows = edition.rules.table.rows();
        let of = |place: usize| rows.get(place).map(|row| (row.from, row.to));
        match self {
            Self::Changed(Change::RowLeadsTo(place, to)) => {
                of(place).into_iter().flat_map(|(from, usual)| [(from, to), (from, usual)]).collect()
            }
            Self::Changed(Change::RowFirst(place)) => {
                of(place).into_iter().chain(place.checked_sub(1).and_then(of)).collect()
            }
            Self::Changed(Change::RowDropped(place) | Change::Term(place, ..)) => {
                of(place).into_iter().collect()
            }
            Self::Joined { row, .. } => of(row).into_iter().collect(),
            Self::Needs { from, to, .. } | Self::Also { from, to, .. } | Self::Late { from, to, .. } => {
                vec![(from, to)]
            }
            Self::Causes { from, .. } | Self::Prefers { from, .. } => vec![(from, AsState::EmergencyBrake)],
            Self::Changed(Change::Time(..) | Change::Threshold(..))
            | Self::Ignores { .. }
            | Self::Opens { .. }
            | Self::Wheels(_)
            | Self::GoLevel
            | Self::GoNeedsHandshake
            | Self::Remembers(_)
            | Self::Reads(_)
            | Self::Shows { .. }
            | Self::Writes { .. } => Vec::new(),
        }
    }
}

/// The last word of a state's name.
fn short(state: AsState) -> String {
    let name = state.name().rsplit('_').next().unwrap_or_default();
    name.to_ascii_lowercase()
}

fn arrow(from: AsState, to: AsState) -> String {
    format!("{}-{}", short(from), short(to))
}

const fn time_id(time: Time) -> &'static str {
    match time {
        Time::ReadyDwell => "ready-dwell",
        Time::EbsTimer => "ebs-timer",
        Time::Handshake => "handshake",
    }
}

const fn threshold_id(threshold: Threshold) -> &'static str {
    match threshold {
        Threshold::WheelSpeed => "wheel-speed",
        Threshold::Straight => "straight",
        Threshold::Missed => "missed",
    }
}

const fn remembers_id(what: Remembers) -> &'static str {
    match what {
        Remembers::CauseUntilLeft => "cause-until-left",
        Remembers::LatestCause => "latest-cause",
        Remembers::DwellOfAllVisits => "dwell-of-all-visits",
        Remembers::TimerWhileAsmsOff => "timer-while-asms-off",
        Remembers::GoSeenOff => "go-seen-off",
        Remembers::CommsLost => "comms-lost",
        Remembers::CommsLostForGood => "comms-lost-for-good",
        Remembers::Handshake => "handshake",
        Remembers::HandshakeBit => "handshake-bit",
        Remembers::HandshakeBeginsWithOne => "handshake-begins-with-1",
        Remembers::LiveFlags => "live-flags",
        Remembers::TimeBeforeHandshake => "time-before-handshake",
    }
}

const fn remembers_text(what: Remembers) -> &'static str {
    match what {
        Remembers::CauseUntilLeft => {
            "SHUTDOWN_CAUSE is forgotten when EMERGENCY_BRAKE is left; expected until the power goes off"
        }
        Remembers::LatestCause => {
            "SHUTDOWN_CAUSE follows later faults in EMERGENCY_BRAKE; expected the cause that came first"
        }
        Remembers::DwellOfAllVisits => {
            "the time in AS_READY goes on where it was when AS_READY was left; expected from the beginning"
        }
        Remembers::TimerWhileAsmsOff => {
            "the EBS timer runs only while AS master switch OFF; expected from EMERGENCY_BRAKE on"
        }
        Remembers::GoSeenOff => {
            "\"Go\" seen off once counts until AS_READY is left; expected only if the other conditions hold meanwhile"
        }
        Remembers::CommsLost => {
            "AI_COMMS_LOST stays once it is raised; expected until the handshake is answered"
        }
        Remembers::CommsLostForGood => {
            "AI_COMMS_LOST stays until the power goes off once it is raised; expected until the handshake is answered"
        }
        Remembers::Handshake => {
            "the handshake stands still while TS master switch OFF, and goes on from there; expected bit 0, and from the beginning"
        }
        Remembers::HandshakeBit => {
            "the handshake bit stays as it was while TS master switch OFF; expected bit 0"
        }
        Remembers::HandshakeBeginsWithOne => {
            "the handshake begins with bit 1 whatever the AI Computer sends; expected bit 0 where it sends 1"
        }
        Remembers::LiveFlags => {
            "a fault flag ends with its fault; expected to stay while SHUTDOWN_CAUSE names the fault"
        }
        Remembers::TimeBeforeHandshake => {
            "the step in which the handshake begins counts as time without an answer; expected from the next one on"
        }
    }
}

/// A number, or the name that stands behind it: a name that no enumeration has is another number in each run of a process.
fn number_or_name(raw: i32) -> impl fmt::Display {
    adsdv_conform::protocol::Value { domain: Domain::Names(&[]), raw: Some(raw) }
}

/// A value of an output in the words of the edition.
fn output(edition: &Edition, key: &str, raw: i32) -> String {
    let protocol = Protocol::of(edition);
    let field = protocol.shown().find(|(field, _)| field.key == key);
    field.map_or_else(
        || raw.to_string(),
        |(_, domain)| adsdv_conform::protocol::Value { domain, raw: Some(raw) }.to_string(),
    )
}

fn write(f: &mut fmt::Formatter<'_>, deviation: &Deviation, edition: &Edition) -> fmt::Result {
    match *deviation {
        Deviation::Changed(change) => changed(f, &change, edition),
        Deviation::Needs { from, to, key, raw, is } => {
            let sign = if is { "==" } else { "!=" };
            write!(f, "{from} -> {to} also needs {key} {sign} {}", input(edition, key, raw))
        }
        Deviation::Also { from, to, key, raw } => {
            write!(f, "{from} -> {to} as soon as {key} == {}; expected {from} to stay", input(edition, key, raw))
        }
        Deviation::Late { from, to, steps: 1 } => write!(f, "{from} -> {to} one step late"),
        Deviation::Late { from, to, steps } => write!(f, "{from} -> {to} {steps} steps late"),
        Deviation::Ignores { key } => {
            write!(f, "{key} makes no difference to the state machine; expected as in Figure 2")
        }
        Deviation::Opens { key, raw } => {
            write!(f, "{key} == {} opens the shutdown circuit; expected no effect on it", input(edition, key, raw))
        }
        Deviation::Wheels(Wheels::All) => f.write_str("the vehicle moves only if all wheels turn; expected any"),
        Deviation::Wheels(Wheels::Front) => {
            f.write_str("only the front wheels tell whether the vehicle moves; expected any")
        }
        Deviation::Wheels(Wheels::Rear) => {
            f.write_str("only the rear wheels tell whether the vehicle moves; expected any")
        }
        Deviation::Wheels(Wheels::Mean) => {
            f.write_str("the mean of the wheels tells whether the vehicle moves; expected any of them")
        }
        Deviation::Wheels(Wheels::Only(wheel)) => {
            const NAMES: [&str; 4] = ["front left", "front right", "rear left", "rear right"];
            let name = NAMES.get(usize::from(wheel)).copied().unwrap_or("one");
            write!(f, "only the {name} wheel tells whether the vehicle moves; expected any")
        }
        Deviation::GoLevel => {
            f.write_str("\"Go\" counts while it is on; expected only when it is switched on")
        }
        Deviation::GoNeedsHandshake => f.write_str(
            "an edge of \"Go\" is lost while the AI Computer's HANDSHAKE is not the VCU's; expected it to count",
        ),
        Deviation::Joined { row, one, other } => {
            let row = edition.rules.table.rows().get(row).ok_or(fmt::Error)?;
            let terms = row.terms();
            let (one, other) = (terms.get(one).ok_or(fmt::Error)?, terms.get(other).ok_or(fmt::Error)?);
            let (one, other) = (conditions(edition, one), conditions(edition, other));
            write!(f, "{} -> {} only by {one} together with {other}; expected by either", row.from, row.to)
        }
        Deviation::Remembers(what) => f.write_str(remembers_text(what)),
        Deviation::Causes { from, value, raw } => {
            let cause = |raw| output(edition, "shutdown_cause", raw);
            let to = AsState::EmergencyBrake;
            write!(f, "{from} -> {to} gives SHUTDOWN_CAUSE {}; expected {}", cause(raw), cause(value))
        }
        Deviation::Prefers { from, value, raw } => {
            let cause = |raw| output(edition, "shutdown_cause", raw);
            let (to, expected) = (AsState::EmergencyBrake, cause(value));
            let raw = cause(raw);
            write!(f, "{from} -> {to} by {expected} and {raw} at once gives {raw}; expected {expected}")
        }
        Deviation::Reads(choice) => write!(f, "{} {}", choice.reading().question(), choice.text()),
        Deviation::Shows { state, key, raw } => {
            write!(f, "{key} is {} in {state}, whatever it should be", output(edition, key, raw))
        }
        Deviation::Writes { key, value, raw } => {
            let (found, expected) = (output(edition, key, raw), output(edition, key, value));
            write!(f, "{key} is {found} where it should be {expected}")
        }
    }
}

/// The conditions of an alternative.
fn conditions(edition: &Edition, term: &Term) -> String {
    let rules = &edition.rules;
    let each: Vec<String> = term.literals().map(|(atom, on)| rules.text(atom, on).to_string()).collect();
    each.join(" and ")
}

fn changed(f: &mut fmt::Formatter<'_>, change: &Change, edition: &Edition) -> fmt::Result {
    let rows = edition.rules.table.rows();
    let row = |place: usize| rows.get(place).ok_or(fmt::Error);
    match *change {
        Change::RowDropped(place) => write!(f, "{} -> {} is never taken", row(place)?.from, row(place)?.to),
        Change::RowLeadsTo(place, to) => {
            let Row { from, to: expected, .. } = *row(place)?;
            write!(f, "{from} -> {to} where {from} -> {expected} is expected")
        }
        Change::RowFirst(place) => {
            let (before, first) = (row(place.checked_sub(1).ok_or(fmt::Error)?)?, row(place)?);
            let Row { from, to, .. } = first;
            write!(f, "{from} -> {to} comes before {from} -> {}; expected behind it", before.to)
        }
        Change::Term(place, term, change) => {
            let row = row(place)?;
            term_changed(f, row, row.terms().get(term).ok_or(fmt::Error)?, change, edition)
        }
        Change::Time(time, by) => {
            let timing = &edition.rules.timing;
            let (what, usual) = match time {
                Time::ReadyDwell => ("\"Go\" counts after AS_READY has lasted for", timing.ready_dwell_ms),
                Time::EbsTimer => ("EMERGENCY_BRAKE can be left after", timing.ebs_timer_ms),
                Time::Handshake => ("AI_COMMS_LOST after", timing.handshake_ms),
            };
            write!(f, "{what} {} ms; expected {usual} ms", usual.saturating_add_signed(by))
        }
        Change::Threshold(threshold, by) => {
            let thresholds = &edition.rules.thresholds;
            match threshold {
                Threshold::WheelSpeed => {
                    let usual = thresholds.wheel_speed;
                    let found = WheelSpeed::clamped(usual.raw() + i32::from(by));
                    write!(f, "the limit of the wheel speeds is {found}; expected {usual}")
                }
                Threshold::Straight => {
                    let usual = thresholds.straight;
                    let found = SteerAngle::clamped(usual.raw() + i32::from(by));
                    write!(f, "the limit of the steer angle is {found}; expected {usual}")
                }
                Threshold::Missed => {
                    let usual = thresholds.missed_ms.unwrap_or_default();
                    let found = usual.saturating_add_signed(by);
                    write!(f, "a message counts as missed after {found} ms; expected {usual} ms")
                }
            }
        }
    }
}

fn term_changed(
    f: &mut fmt::Formatter<'_>,
    row: &Row,
    term: &Term,
    change: TermChange,
    edition: &Edition,
) -> fmt::Result {
    let Row { from, to, .. } = row;
    let rules = &edition.rules;
    let conditions = || conditions(edition, term);
    let needed = |of| term.literals().find(|(atom, _)| *atom == of).is_none_or(|(_, on)| on);
    match change {
        TermChange::Dropped => write!(f, "{from} -> {to} is not taken by {}", conditions()),
        TermChange::LiteralDropped(atom) => {
            let (expected, other) = (rules.text(atom, needed(atom)), rules.text(atom, !needed(atom)));
            let expected = expected.to_string();
            // "Does not need no power cycle needed" would say the opposite.
            if expected.starts_with("no ") {
                return write!(f, "{from} -> {to} even with {other}");
            }
            write!(f, "{from} -> {to} does not need {expected}")
        }
        TermChange::LiteralFlipped(atom) => {
            let (found, expected) = (rules.text(atom, !needed(atom)), rules.text(atom, needed(atom)));
            write!(f, "{from} -> {to} wants {found}; expected {expected}")
        }
        TermChange::FaultDropped => {
            let flag = term.fault.map_or("a fault", adsdv_spec::Fault::flag);
            write!(f, "{from} -> {to} by {} does not raise {flag}", conditions())
        }
        TermChange::InEveryReading => write!(f, "{from} -> {to} also by {}", conditions()),
    }
}

/// A value of an input in the words of the edition.
pub(crate) fn input(edition: &Edition, key: &str, raw: i32) -> String {
    let protocol = Protocol::of(edition);
    let domain = protocol.inputs().find(|(field, _)| field.key == key).map(|(_, domain)| domain);
    let domain = domain.or_else(|| INPUTS.iter().find(|field| field.key == key).map(|field| field.domain));
    domain.map_or_else(
        || raw.to_string(),
        |domain| adsdv_conform::protocol::Value { domain, raw: Some(raw) }.to_string(),
    )
}
