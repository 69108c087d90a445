//! The quantities of section 2, each once, with its unit, step and range.
//!
//! A quantity is a raw integer that is known to be in range. Whatever is compared is compared as that
//! integer; floats appear only where a physical value comes in from a person or goes out to one.

use core::fmt;

use super::definition::with_unit;
use super::{Decimal, Scale, SignalValue};

/// A value that a quantity cannot have.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct QuantityError {
    /// The name of the quantity's type.
    pub quantity: &'static str,
    /// The value given.
    pub given: GivenValue,
    /// The lowest raw value allowed.
    pub min: i32,
    /// The highest raw value allowed.
    pub max: i32,
    /// The physical size of one raw step.
    pub scale: Scale,
    /// The unit, empty where there is none.
    pub unit: &'static str,
}

/// A value as it was given.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum GivenValue {
    /// In raw steps.
    Raw(i32),
    /// In the quantity's unit.
    Physical(f64),
}

impl fmt::Display for QuantityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { quantity, given, min, max, scale, unit } = *self;
        let space = if unit.is_empty() { "" } else { " " };
        write!(f, "{quantity} cannot be ")?;
        match given {
            GivenValue::Raw(raw) => write!(f, "{}{space}{unit} (raw {raw})", Decimal { raw, scale })?,
            GivenValue::Physical(physical) => write!(f, "{physical}{space}{unit}")?,
        }
        write!(f, ", allowed: {} to ", Decimal { raw: min, scale })?;
        with_unit(f, max, scale, unit)?;
        write!(f, " in steps of {scale} (raw {min} to {max})")
    }
}

impl core::error::Error for QuantityError {}

/// Reads a list of quantities: `Name(integer): lowest..=highest raw, step "unit", constructor;`, where a
/// mere count has no constructor of its own.
macro_rules! quantities {
    ($(
        $(#[$meta:meta])*
        $name:ident($repr:ident): $min:literal..=$max:literal, $num:literal/$den:literal $unit:literal
            $(, $from:ident)?;
    )+) => {$(
        $(#[$meta])*
        ///
        #[doc = concat!("Raw `", $min, "..=", $max, "`, one step is `", $num, "/", $den, " ", $unit, "`.")]
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(try_from = "i32", into = "i32"))]
        pub struct $name($repr);

        impl $name {
            /// The lowest value.
            pub const MIN: Self = Self::of(<Self as SignalValue>::MIN);
            /// The highest value.
            pub const MAX: Self = Self::of(<Self as SignalValue>::MAX);

            /// This many raw steps; the caller has checked the range.
            #[inline]
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "in range, hence lossless")]
            const fn of(raw: i32) -> Self {
                Self(raw as $repr)
            }

            const fn allows(raw: i64) -> bool {
                <Self as SignalValue>::MIN as i64 <= raw && raw <= <Self as SignalValue>::MAX as i64
            }

            /// This many raw steps, if they are in range.
            ///
            /// # Errors
            ///
            /// Fails if they are not in range; the error has the range.
            pub const fn from_raw(raw: i32) -> Result<Self, QuantityError> {
                if Self::allows(raw as i64) { Ok(Self::of(raw)) } else { Err(Self::refused(GivenValue::Raw(raw))) }
            }

            $(
                #[doc = concat!("The value nearest to this many ", $unit, ", if that is in range.")]
                ///
                /// NaN is refused.
                ///
                /// # Errors
                ///
                /// Fails if it is not in range, or NaN; the error has the range.
                #[allow(clippy::cast_possible_truncation, reason = "in range, hence lossless")]
                pub const fn $from(physical: f64) -> Result<Self, QuantityError> {
                    match <Self as SignalValue>::SCALE.nearest_raw(physical) {
                        Some(raw) if Self::allows(raw) => Ok(Self::of(raw as i32)),
                        _ => Err(Self::refused(GivenValue::Physical(physical))),
                    }
                }
            )?

            /// The value nearest to this many raw steps: what is out of range becomes [`MIN`](Self::MIN) or
            /// [`MAX`](Self::MAX).
            pub const fn clamped(raw: i32) -> Self {
                if raw < Self::MIN.raw() {
                    Self::MIN
                } else if raw > Self::MAX.raw() {
                    Self::MAX
                } else {
                    Self::of(raw)
                }
            }

            #[cold]
            const fn refused(given: GivenValue) -> QuantityError {
                QuantityError {
                    quantity: stringify!($name),
                    given,
                    min: <Self as SignalValue>::MIN,
                    max: <Self as SignalValue>::MAX,
                    scale: <Self as SignalValue>::SCALE,
                    unit: <Self as SignalValue>::UNIT,
                }
            }

            /// The number of raw steps.
            #[inline]
            #[allow(clippy::cast_possible_wrap, reason = "the range fits both")]
            pub const fn raw(self) -> i32 {
                self.0 as i32
            }

            /// The value in its unit, for display and plotting.
            pub fn to_physical(self) -> f64 {
                <Self as SignalValue>::SCALE.physical(self.raw())
            }
        }

        // Every value of the range fits the integer behind it.
        const _: () = assert!($min >= $repr::MIN as i64 && $max <= $repr::MAX as i64);

        impl SignalValue for $name {
            const SIGNED: bool = $min < 0;
            const SCALE: Scale = Scale::new($num, $den);
            const UNIT: &'static str = $unit;
            const MIN: i32 = $min;
            const MAX: i32 = $max;
            const VALUES: &'static [(i32, &'static str)] = &[];

            #[inline]
            fn from_raw(raw: i32) -> Option<Self> {
                (<Self as SignalValue>::MIN..=<Self as SignalValue>::MAX).contains(&raw).then_some(Self::of(raw))
            }

            #[inline]
            fn to_raw(self) -> i32 {
                self.raw()
            }
        }

        impl TryFrom<i32> for $name {
            type Error = QuantityError;

            fn try_from(raw: i32) -> Result<Self, QuantityError> {
                Self::from_raw(raw)
            }
        }

        impl From<$name> for i32 {
            fn from(quantity: $name) -> Self {
                quantity.raw()
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                with_unit(f, self.raw(), <Self as SignalValue>::SCALE, <Self as SignalValue>::UNIT)
            }
        }

        #[cfg(kani)]
        impl kani::Arbitrary for $name {
            fn any() -> Self {
                let value: $repr = kani::any();
                kani::assume(Self::allows(i64::from(value)));
                Self(value)
            }
        }

        #[cfg(feature = "arbitrary")]
        impl<'a> arbitrary::Arbitrary<'a> for $name {
            fn arbitrary(u: &mut arbitrary::Unstructured<'a>) -> arbitrary::Result<Self> {
                u.int_in_range(<Self as SignalValue>::MIN..=<Self as SignalValue>::MAX).map(Self::of)
            }
        }

        #[cfg(feature = "proptest")]
        impl proptest::arbitrary::Arbitrary for $name {
            type Parameters = ();
            type Strategy = proptest::strategy::Map<core::ops::RangeInclusive<i32>, fn(i32) -> Self>;

            fn arbitrary_with((): ()) -> Self::Strategy {
                use proptest::prelude::Strategy;
                (<Self as SignalValue>::MIN..=<Self as SignalValue>::MAX).prop_map(Self::of)
            }
        }
    )+};
}

//= D-31
quantities! {
    /// Steer angle of the bicycle model; positive turns the front wheels to the left (ISO 8855).
    ///
    /// This is the widest range of all editions; that of one edition stands with its signals.
    SteerAngle(i16): -300..=300, 1/10 "deg", from_deg;
    /// The largest steer angle, to either side.
    ///
    /// This is the widest range of all editions; that of one edition stands with its signals.
    SteerAngleMax(u16): 0..=300, 1/10 "deg", from_deg;
    /// Torque at an axle (motor torque times gear ratio); negative brakes.
    AxleTorque(i16): -1950..=1950, 1/10 "Nm", from_nm;
    /// The size of a torque at an axle that is requested or allowed.
    AxleTorqueRequest(u16): 0..=1950, 1/10 "Nm", from_nm;
    /// The speed that a drive motor must not exceed.
    MotorSpeedMax(u16): 0..=4000, 1/1 "rpm", from_rpm;
    /// Wheel speed.
    WheelSpeed(u16): 0..=1250, 1/1 "rpm", from_rpm;
    /// Normalised hydraulic pressure of the friction brakes of an axle.
    BrakePressure(u8): 0..=200, 1/2 "%", from_pct;
    /// Vehicle speed.
    SpeedKmh(u8): 0..=255, 1/1 "km/h", from_kmh;
    /// Steer angle of the bicycle model, as it is logged: coarser and wider than [`SteerAngle`].
    LogSteerAngle(i8): -128..=127, 1/2 "deg", from_deg;
    /// Mechanical braking, as it is logged.
    LogBrake(u8): 0..=100, 1/1 "%", from_pct;
    /// Sum of the axle torques, as it is logged; negative brakes.
    LogDriveTorque(i8): -100..=100, 1/1 "%", from_pct;
    /// Vehicle acceleration.
    ///
    /// The step is the database's decimal for 1/512, and every 16-bit value is allowed: the database's
    /// limits, -64 and 63.998, are rounded.
    Acceleration(i16): -32768..=32767, 195_313/100_000_000 "m/s^2", from_mps2;
    /// Yaw rate.
    YawRate(i16): -32768..=32767, 1/128 "deg/s", from_degps;
    /// Number of laps in the Track drive mission.
    LapCounter(u8): 0..=15, 1/1 "";
    /// Total number of cones detected, as it is logged.
    ConesCountAll(u32): 0..=131_071, 1/1 "";
}
