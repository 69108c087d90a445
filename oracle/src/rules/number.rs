//! Numbers and units, exactly: no rule goes by a rounded number.

use adsdv_spec::messages::SignalDef;

use super::limits::DIGITS;

/// A number as `mantissa / power`, a power of ten.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Decimal {
    pub(super) mantissa: i128,
    pub(super) power: i128,
}

/// The number that is written; or what is wrong with it.
pub(super) fn decimal(text: &str) -> Result<Decimal, String> {
    let (whole, behind) = text.split_once('.').unwrap_or((text, ""));
    let digits = text.chars().filter(char::is_ascii_digit).count();
    let mantissa = format!("{whole}{behind}").parse().ok().filter(|_| digits <= DIGITS);
    let mantissa = mantissa.ok_or_else(|| format!("found {digits} digits; expected at most {DIGITS}"))?;
    let behind = u32::try_from(behind.len()).unwrap_or(0);
    Ok(Decimal { mantissa, power: 10_i128.pow(behind) })
}

/// What units are called; the first of each is what the signals have.
const UNITS: [&[&str]; 8] = [
    &["km/h", "kmh", "kph"],
    &["m/s", "mps"],
    &["deg", "°", "degree", "degrees"],
    &["deg/s", "°/s"],
    &["rpm"],
    &["%", "pct", "percent"],
    &["Nm"],
    &["m/s^2", "m/s2"],
];

/// What one of the first unit is in the second, as a fraction, where they are of different units.
const CONVERSIONS: [(&str, &str, i128, i128); 1] = [("m/s", "km/h", 18, 5)];

/// What a number in this unit has to be multiplied by to be in the signal's, as a fraction; or what is wrong with the unit.
pub(super) fn factor(unit: &str, signal: &SignalDef) -> Result<(i128, i128), String> {
    let known = UNITS.iter().find(|names| names.iter().any(|name| name.eq_ignore_ascii_case(unit)));
    let known = known.and_then(|names| names.first()).copied().unwrap_or(unit);
    if known == signal.unit {
        return Ok((1, 1));
    }
    let converted = CONVERSIONS.iter().find(|(from, to, ..)| (*from, *to) == (known, signal.unit));
    converted.map(|(_, _, num, den)| (*num, *den)).ok_or_else(|| {
        let also = CONVERSIONS.iter().find(|(_, to, ..)| *to == signal.unit);
        let expected = match (signal.unit, also) {
            ("", _) => "no unit".to_owned(),
            (own, Some((other, ..))) => format!("{own} or {other}"),
            (own, None) => own.to_owned(),
        };
        format!("found {unit:?}; expected {expected}, as {} is", signal.name)
    })
}
