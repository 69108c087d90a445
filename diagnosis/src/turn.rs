//! The time, or the value, at which a program turns: found by halving.

use adsdv_oracle::conform::ProgramError;
use adsdv_spec::messages::{AsState, MissionStatus, SteerAngle, WheelSpeed};
use adsdv_spec::mutation::{Change, Threshold, Time};
use adsdv_spec::{AiSilence, Atom};

use crate::deviation::Deviation;
use crate::model::Model;
use crate::pilot::Pilot;
use crate::subject::Subject;

/// No time longer than this is tried, in milliseconds.
const LONGEST_MS: i32 = 32_000;

/// The times and thresholds of a program that are not those of the document, as far as it can be led to where they count.
pub(crate) fn all(subject: &mut dyn Subject, model: &Model) -> Result<Vec<Deviation>, ProgramError> {
    let mut found = Vec::new();
    let mut add = |change: fn(i16) -> Change, value: Option<i32>, usual: i32| {
        let by = value.map(|value| value - usual).filter(|by| *by != 0);
        if let Some(by) = by.and_then(|by| i16::try_from(by).ok()) {
            found.push(Deviation::Changed(change(by)));
        }
    };
    let rules = model.usual().rules;
    let dwell = first(1, LONGEST_MS, |ms| drives_after(subject, model, ms))?;
    add(|by| Change::Time(Time::ReadyDwell, by), dwell, rules.timing.ready_dwell_ms.into());
    let brakes = first(1, LONGEST_MS, |ms| is_off_after(subject, model, ms))?;
    add(|by| Change::Time(Time::EbsTimer, by), brakes, rules.timing.ebs_timer_ms.into());
    let lost = first(1, LONGEST_MS, |ms| is_lost_after(subject, model, ms))?;
    add(|by| Change::Time(Time::Handshake, by), lost, rules.timing.handshake_ms.into());
    let moving = first(1, WheelSpeed::MAX.raw(), |raw| moves_at(subject, model, raw))?;
    add(|by| Change::Threshold(Threshold::WheelSpeed, by), moving, rules.thresholds.wheel_speed.raw());
    let straight = first(1, SteerAngle::MAX.raw(), |raw| is_bent_at(subject, model, raw))?;
    add(|by| Change::Threshold(Threshold::Straight, by), straight, rules.thresholds.straight.raw());
    if let Some(usual) = rules.thresholds.missed_ms {
        let missed = first(1, 2000, |ms| is_missed_after(subject, model, ms))?;
        add(|by| Change::Threshold(Threshold::Missed, by), missed, usual.into());
    }
    Ok(found)
}

/// The first number for which it is so, where it is not so for the first and so for the last.
fn first(
    mut no: i32,
    mut yes: i32,
    mut is: impl FnMut(i32) -> Result<bool, ProgramError>,
) -> Result<Option<i32>, ProgramError> {
    if is(no)? || !is(yes)? {
        return Ok(None);
    }
    while yes - no > 1 {
        let between = no + (yes - no) / 2;
        if is(between)? { yes = between } else { no = between }
    }
    Ok(Some(yes))
}

fn ms(value: i32) -> u32 {
    u32::try_from(value).unwrap_or_default()
}

/// Whether an edge of "Go" is taken after AS_READY has lasted for this time.
fn drives_after(subject: &mut dyn Subject, model: &Model, lasts: i32) -> Result<bool, ProgramError> {
    let mut pilot = Pilot::new(subject, model)?;
    if !pilot.to(AsState::Ready)? {
        return Ok(false);
    }
    let Some(term) = pilot.term(AsState::Driving) else { return Ok(false) };
    for (atom, value) in term.literals() {
        pilot.show(atom, value);
    }
    pilot.inputs.go = false;
    pilot.step(ms(lasts))?;
    pilot.inputs.go = true;
    pilot.cycles(1)?;
    Ok(pilot.shows() == Some(AsState::Driving))
}

/// Whether EMERGENCY_BRAKE is left after it has lasted for this time.
fn is_off_after(subject: &mut dyn Subject, model: &Model, lasts: i32) -> Result<bool, ProgramError> {
    let mut pilot = Pilot::new(subject, model)?;
    if !pilot.to(AsState::EmergencyBrake)? {
        return Ok(false);
    }
    pilot.inputs.asms = false;
    pilot.step(ms(lasts))?;
    Ok(pilot.shows() == Some(AsState::Off))
}

/// Whether AI_COMMS_LOST is shown once the handshake is unanswered for this time.
fn is_lost_after(subject: &mut dyn Subject, model: &Model, lasts: i32) -> Result<bool, ProgramError> {
    let mut pilot = Pilot::new(subject, model)?;
    pilot.inputs.tsms = true;
    pilot.cycles(2)?;
    pilot.answers = false;
    pilot.step(ms(lasts))?;
    Ok(pilot.shows_comms_lost())
}

/// Whether a speed is too high for AS_FINISHED.
fn moves_at(subject: &mut dyn Subject, model: &Model, raw: i32) -> Result<bool, ProgramError> {
    let mut pilot = Pilot::new(subject, model)?;
    if !pilot.to(AsState::Driving)? {
        return Ok(false);
    }
    let speed = WheelSpeed::clamped(raw);
    let wheels = &mut pilot.inputs.vehicle.wheel_speeds;
    (wheels.fl_wheel_speed, wheels.fr_wheel_speed) = (speed, speed);
    (wheels.rl_wheel_speed, wheels.rr_wheel_speed) = (speed, speed);
    pilot.inputs.ai.status.mission_status = MissionStatus::Finished;
    pilot.cycles(1)?;
    Ok(pilot.shows() != Some(AsState::Finished))
}

/// Whether a steer angle is too large for "Go".
fn is_bent_at(subject: &mut dyn Subject, model: &Model, raw: i32) -> Result<bool, ProgramError> {
    let mut pilot = Pilot::new(subject, model)?;
    if !pilot.to(AsState::Ready)? {
        return Ok(false);
    }
    let Some(term) = pilot.term(AsState::Driving) else { return Ok(false) };
    pilot.prepare(&term, AsState::Driving, 0)?;
    pilot.inputs.vehicle.steer_angle = SteerAngle::clamped(raw);
    pilot.take(&term, AsState::Driving)?;
    Ok(pilot.shows() != Some(AsState::Driving))
}

/// Whether AI_COMMS_LOST is shown once all messages have been missing for this time.
fn is_missed_after(subject: &mut dyn Subject, model: &Model, lasts: i32) -> Result<bool, ProgramError> {
    let mut pilot = Pilot::new(subject, model)?;
    pilot.show(Atom::Tsms, true);
    pilot.cycles(2)?;
    pilot.inputs.ai_silence = AiSilence::of(u16::try_from(lasts).unwrap_or(u16::MAX));
    pilot.cycles(1)?;
    Ok(pilot.shows_comms_lost())
}
