//! The time, or the value, at which a program turns: found by halving.

use std::time::Instant;

use adsdv_conform::ProgramError;
use adsdv_spec::messages::{AsState, SteerAngle, WheelSpeed};
use adsdv_spec::mutation::{Change, Threshold, Time};
use adsdv_spec::{AiSilence, Atom, Edition, Mutation, Rules, Term};

use crate::deviation::Deviation;
use crate::lead::lead;
use crate::pilot::Pilot;
use crate::subject::Subject;
use crate::ways::Ways;

/// No time longer than this is tried, in milliseconds.
const LONGEST_MS: i32 = 32_000;
/// No silence longer than this is tried, in milliseconds.
const LONGEST_SILENCE_MS: i32 = 2_000;
/// An arrow is no more steps late than these.
const LATEST: u8 = 3;

/// A number that decides about a condition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Number {
    Time(Time),
    Threshold(Threshold),
}

impl Number {
    /// All of them that an edition has.
    fn all(edition: &Edition) -> Vec<Self> {
        let mut all: Vec<Self> = Vec::new();
        for Mutation { change, .. } in Mutation::all(edition) {
            let number = match change {
                Change::Time(time, _) => Self::Time(time),
                Change::Threshold(threshold, _) => Self::Threshold(threshold),
                _ => continue,
            };
            if !all.contains(&number) {
                all.push(number);
            }
        }
        all
    }

    /// The number behind a condition of an arrow.
    const fn of(atom: Atom) -> Option<Self> {
        Some(match atom {
            Atom::DwellElapsed => Self::Time(Time::ReadyDwell),
            Atom::EbsTimerComplete => Self::Time(Time::EbsTimer),
            Atom::AiCommsLost => Self::Time(Time::Handshake),
            Atom::Moving | Atom::AtRest => Self::Threshold(Threshold::WheelSpeed),
            Atom::SteerStraight => Self::Threshold(Threshold::Straight),
            _ => return None,
        })
    }

    /// The greatest that is tried.
    const fn most(self) -> i32 {
        match self {
            Self::Time(Time::Handshake) | Self::Threshold(Threshold::Missed) => LONGEST_SILENCE_MS,
            Self::Time(_) => LONGEST_MS,
            Self::Threshold(Threshold::WheelSpeed) => WheelSpeed::MAX.raw(),
            Self::Threshold(Threshold::Straight) => SteerAngle::MAX.raw(),
        }
    }

    /// As the rules have it.
    fn usual(self, rules: &Rules) -> i32 {
        let timing = &rules.timing;
        match self {
            Self::Time(Time::ReadyDwell) => timing.ready_dwell_ms.into(),
            Self::Time(Time::EbsTimer) => timing.ebs_timer_ms.into(),
            Self::Time(Time::Handshake) => timing.handshake_ms.into(),
            Self::Threshold(Threshold::WheelSpeed) => rules.thresholds.wheel_speed.raw(),
            Self::Threshold(Threshold::Straight) => rules.thresholds.straight.raw(),
            Self::Threshold(Threshold::Missed) => rules.thresholds.missed_ms.unwrap_or_default().into(),
        }
    }

    /// The end of the cycle in which a time is over; the usual one where that is over in the same cycle.
    fn at_cycle(self, value: i32, cycle: Option<i32>, rules: &Rules) -> i32 {
        let (Self::Time(_), Some(cycle)) = (self, cycle) else { return value };
        let end = |value: i32| (value + cycle - 1) / cycle * cycle;
        let usual = self.usual(rules);
        if end(usual) == end(value) { usual } else { end(value) }
    }

    /// That it has this value; `None` if that is the usual one.
    pub(crate) fn deviation(self, value: i32, rules: &Rules) -> Option<Deviation> {
        let by = i16::try_from(value - self.usual(rules)).ok().filter(|by| *by != 0)?;
        Some(Deviation::Changed(match self {
            Self::Time(time) => Change::Time(time, by),
            Self::Threshold(threshold) => Change::Threshold(threshold, by),
        }))
    }
}

/// The times and thresholds of a program that are not those of the document, as far as it can be led to where they count until this
/// time: by each arrow that they decide about, and by the flag of communication that is lost. Where nothing turns, a time may always
/// be over, and any speed too much: that is 0.
pub(crate) fn all(
    subject: &mut dyn Subject,
    ways: &Ways<'_>,
    until: Instant,
) -> Result<Vec<Deviation>, ProgramError> {
    let rules = ways.model.usual().rules;
    let mut found: Vec<Deviation> = Vec::new();
    let cycle = ways.interface.cycle_ms().and_then(|cycle| i32::try_from(cycle).ok());
    let mut turning: Vec<Number> = Vec::new();
    let mut add = |number: Number, value: Option<i32>| {
        turning.extend(value.map(|_| number));
        let value = value.map(|value| number.at_cycle(value, cycle, &rules));
        let deviation = value.and_then(|value| number.deviation(value, &rules));
        found.extend(deviation.filter(|deviation| !found.contains(deviation)));
    };
    for state in AsState::ALL.into_iter().filter(|state| ways.to(*state).is_some()) {
        for (term, to) in ways.model.terms(state) {
            for (atom, _) in term.literals() {
                let Some(number) = Number::of(atom) else { continue };
                let delay = ways.model.delay((state, to));
                if Instant::now() >= until {
                    return Ok(found);
                }
                for late in (delay..=delay).chain((0..=LATEST).filter(|late| *late != delay)) {
                    let turn = Turn { ways, state, term, to, late };
                    let value = turns(1, number.most(), |value| turn.is_taken(subject, number, value))?;
                    // "Moving" is what is above the limit.
                    add(number, value.map(|value| if atom == Atom::Moving { value - 1 } else { value }));
                    if atom == Atom::DwellElapsed {
                        // Where "Go" need not be seen off before, the step in which it is on counts as well.
                        add(number, value.map(|value| value + i32::from(rules.timing.cycle_ms)));
                    }
                    if value.is_some() {
                        break;
                    }
                }
            }
        }
        let lost =
            |missed| move |subject: &mut dyn Subject, ms| is_lost_after(subject, ways, state, missed, ms);
        let handshake = Number::Time(Time::Handshake);
        add(handshake, turns(1, handshake.most(), |ms| lost(false)(subject, ms))?);
        if rules.thresholds.missed_ms.is_some() {
            let missed = Number::Threshold(Threshold::Missed);
            add(missed, turns(1, missed.most(), |ms| lost(true)(subject, ms))?);
        }
    }
    let steady = Number::all(ways.model.usual()).into_iter().filter(|number| !turning.contains(number));
    found.extend(steady.filter_map(|number| number.deviation(0, &rules)));
    Ok(found)
}

/// The first number for which it is otherwise than for the first of all, where it is otherwise for the last.
fn turns(
    mut no: i32,
    mut yes: i32,
    mut is: impl FnMut(i32) -> Result<bool, ProgramError>,
) -> Result<Option<i32>, ProgramError> {
    let first = is(no)?;
    if is(yes)? == first {
        return Ok(None);
    }
    while yes - no > 1 {
        let between = no + (yes - no) / 2;
        if is(between)? == first { no = between } else { yes = between }
    }
    Ok(Some(yes))
}

fn ms(value: i32) -> u32 {
    u32::try_from(value).unwrap_or_default()
}

/// An alternative of an arrow, that is taken so many steps late.
struct Turn<'a> {
    ways: &'a Ways<'a>,
    state: AsState,
    term: Term,
    to: AsState,
    late: u8,
}

impl Turn<'_> {
    /// Whether it is taken with a number as it is given here.
    fn is_taken(&self, subject: &mut dyn Subject, number: Number, value: i32) -> Result<bool, ProgramError> {
        Ok(lead(subject, self.ways, |pilot| self.takes(pilot, number, value))?.0)
    }

    fn takes(&self, pilot: &mut Pilot<'_>, number: Number, value: i32) -> Result<bool, ProgramError> {
        let Self { term, to, .. } = *self;
        if !pilot.to(self.state)? {
            return Ok(false);
        }
        let mut last_ms = pilot.last_ms(&term);
        match number {
            Number::Time(Time::ReadyDwell) => {
                pilot.ready(&term, to);
                pilot.inputs.go = false;
                pilot.wait(ms(value))?;
                pilot.inputs.go = true;
                pilot.aim(to, last_ms);
            }
            Number::Time(Time::EbsTimer) => {
                pilot.ready(&term, to);
                pilot.aim(to, last_ms);
                last_ms = ms(value);
            }
            Number::Time(Time::Handshake) => {
                pilot.prepare(&term, to, 0)?;
                last_ms = ms(value);
            }
            Number::Threshold(threshold) => {
                if term.on.has(Atom::DwellElapsed) {
                    pilot.wait(LONGEST_MS.unsigned_abs())?;
                }
                pilot.prepare(&term, to, 0)?;
                let (speed, angle) = (WheelSpeed::clamped(value), SteerAngle::clamped(value));
                let vehicle = &mut pilot.inputs.vehicle;
                if threshold == Threshold::WheelSpeed {
                    let wheels = &mut vehicle.wheel_speeds;
                    (wheels.fl_wheel_speed, wheels.fr_wheel_speed) = (speed, speed);
                    (wheels.rl_wheel_speed, wheels.rr_wheel_speed) = (speed, speed);
                } else {
                    vehicle.steer_angle = angle;
                }
            }
        }
        pilot.step_until(last_ms, to)?;
        for _ in 0..self.late {
            pilot.cycles(1)?;
        }
        Ok(pilot.state() == to)
    }
}

/// Whether AI_COMMS_LOST is shown in a state once the handshake is unanswered, or all messages have been missing, for this time.
fn is_lost_after(
    subject: &mut dyn Subject,
    ways: &Ways<'_>,
    state: AsState,
    missed: bool,
    lasts: i32,
) -> Result<bool, ProgramError> {
    let (is, _) = lead(subject, ways, |pilot| {
        if !pilot.to(state)? {
            return Ok(false);
        }
        pilot.inputs.tsms = true;
        pilot.cycles(2)?;
        if missed {
            pilot.inputs.ai_silence = AiSilence::of(u16::try_from(lasts).unwrap_or(u16::MAX));
            pilot.cycles(1)?;
        } else {
            pilot.answers = false;
            pilot.step(ms(lasts))?;
        }
        Ok(pilot.shows_comms_lost())
    })?;
    Ok(is)
}
