//! What a step shows: the signals of 520h, and what reaches the actuators.

use std::fmt;

use adsdv_spec::messages::{FieldDef, Message as _, ReadAs, SignalValue, Vcu2AiStatus};
use adsdv_spec::{Actuation, Bus, Edition, Fault, Inputs, Outputs};

use super::field::{Domain, Value, Words};
use super::inputs::InputField;
use super::unsaid::UNSAID;
use super::values::Values;

/// Something that a step shows.
#[derive(Clone, Copy, Debug)]
pub struct ShownField {
    /// Its key.
    pub key: &'static str,
    /// Its values in the edition that a program speaks of [where nobody says](UNSAID), or, where that does not have it, those
    /// of its type; those of another edition are in its [`Protocol`](super::Protocol). `null` is one more for what is
    /// sometimes not there.
    pub domain: Domain,
    /// The values of its type, which are those of all editions.
    pub(super) of_type: Domain,
    /// The field of a message whose values these are, if one has them.
    pub(super) signal: &'static str,
    /// Whether `null` is one of its values.
    pub nullable: bool,
    /// The fault whose flag it is.
    pub fault: Option<Fault>,
    /// The requirements that say what it is to show, as `spec/REQUIREMENTS.md` numbers them; those of all editions. The first
    /// is the output itself: what is broken if it is wrong where nothing more special asks for it. Those of a signal are what
    /// its field cites, and what is beside it here.
    pub requirements: &'static [&'static str],
    /// Whether it is a signal of 520h, and not something of the actuators.
    pub(crate) is_signal: bool,
}

impl ShownField {
    /// The output with this key. One that there is not does not compile where a constant asks for it.
    pub(crate) const fn of(key: &str) -> &'static Self {
        &FIELDS[place(key)]
    }

    /// Whether an edition has it: a signal only where its 520h does, and the flag of a fault only where there is that fault.
    pub const fn is_in(&self, edition: &Edition) -> bool {
        match (self.fault, edition.bus.message(Vcu2AiStatus::ID)) {
            (Some(fault), _) => edition.faults.has(fault),
            (None, Some(status)) => !self.is_signal || status.signal_of(self.key).is_some(),
            (None, None) => !self.is_signal,
        }
    }

    /// What one of its raw values counts as, where a bus does not tell two apart.
    pub(super) const fn read_as(&self, bus: &Bus) -> Option<ReadAs> {
        match (self.is_signal, bus.signal_of(self.signal)) {
            (true, Some(signal)) => signal.read_as,
            _ => None,
        }
    }

    /// Its values in an edition; `None` where that does not have it.
    pub(super) const fn domain_in(&self, edition: &Edition) -> Option<Domain> {
        if self.is_in(edition) { Some(self.domain_on(&edition.bus)) } else { None }
    }

    /// Its values in the words of a bus.
    pub(super) const fn domain_on(&self, bus: &Bus) -> Domain {
        self.of_type.on_bus(self.signal, bus)
    }
}

/// The place of an output in [`SHOWN`]. One that there is not does not compile where a constant asks for it.
const fn place(key: &str) -> usize {
    let mut place = 0;
    while !FIELDS[place].key.eq_ignore_ascii_case(key) {
        place += 1;
    }
    place
}

/// The fault whose flag has this key: the name of its signal, in small letters.
const fn fault_of(key: &str) -> Option<Fault> {
    let mut i = 0;
    while i < Fault::ALL.len() {
        if Fault::ALL[i].flag().eq_ignore_ascii_case(key) {
            return Some(Fault::ALL[i]);
        }
        i += 1;
    }
    None
}

/// The requirements about a signal of 520h: those that its field cites.
const fn of_signal(name: &str) -> &'static [&'static str] {
    const FIELDS: &[FieldDef] = Vcu2AiStatus::FIELDS;
    let mut i = 0;
    while i < FIELDS.len() {
        if FIELDS[i].name.eq_ignore_ascii_case(name) {
            return FIELDS[i].requirements;
        }
        i += 1;
    }
    &[]
}

/// Both lists, one behind the other.
const fn joined<const N: usize>(first: &[&'static str], then: &[&'static str]) -> [&'static str; N] {
    assert!(first.len() + then.len() == N && N > 0, "each output has a requirement");
    let mut all = [""; N];
    let mut i = 0;
    while i < N {
        all[i] = if i < first.len() { first[i] } else { then[i - first.len()] };
        i += 1;
    }
    all
}

const fn domain_of<T: SignalValue>(_: fn(&Vcu2AiStatus, &Actuation) -> Option<T>) -> Domain {
    Domain::of::<T>()
}

macro_rules! shown {
    ($(
        $source:ident => $($field:ident $([$($id:literal)+])?)+ $(, or null $nullable:ident [$($null_id:literal)+])?;
    )+) => {
        /// Everything that a step shows in any edition, in the order in which an answer of this crate has it.
        pub const SHOWN: [ShownField; [$($(stringify!($field),)+ $(stringify!($nullable),)?)+].len()] = [$(
            $(
                ShownField {
                    key: stringify!($field),
                    domain: domain_of(|status, actuation| Some(from!($source status actuation).$field))
                        .on_bus(signal!($source $field), &UNSAID.bus),
                    of_type: domain_of(|status, actuation| Some(from!($source status actuation).$field)),
                    signal: signal!($source $field),
                    nullable: false,
                    fault: fault_of(stringify!($field)),
                    requirements: {
                        const OF_SIGNAL: &[&str] = of_signal(signal!($source $field));
                        const BESIDES: &[&str] = &[$($($id),+)?];
                        const ALL: [&str; OF_SIGNAL.len() + BESIDES.len()] = joined(OF_SIGNAL, BESIDES);
                        &ALL
                    },
                    is_signal: is_signal!($source),
                },
            )+
            $(
                ShownField {
                    key: stringify!($nullable),
                    domain: domain_of(|status, actuation| from!($source status actuation).$nullable)
                        .on_bus("steer_request", &UNSAID.bus),
                    of_type: domain_of(|status, actuation| from!($source status actuation).$nullable),
                    signal: "steer_request",
                    nullable: true,
                    fault: None,
                    requirements: [$($null_id),+].as_slice(),
                    is_signal: is_signal!($source),
                },
            )?
        )+];

        /// The raw value of each, whether an edition has it or not, and a bit for each that is not `null`.
        #[inline]
        fn raw_of_all(status: &Vcu2AiStatus, actuation: &Actuation) -> ([i32; SHOWN.len()], u64) {
            let mut there = u64::MAX;
            let numbers = [$(
                $(SignalValue::to_raw(from!($source status actuation).$field),)+
                $({
                    const PLACE: usize = place(stringify!($nullable));
                    let value = from!($source status actuation).$nullable;
                    if value.is_none() {
                        there &= !(1 << PLACE);
                    }
                    value.map_or(0, SignalValue::to_raw)
                },)?
            )+];
            (numbers, there)
        }
    };
}

/// The field of 520h whose values these are. What reaches the actuators is named as what is measured there, and is not that.
macro_rules! signal {
    (status $field:ident) => {
        stringify!($field)
    };
    (actuation $field:ident) => {
        ""
    };
}

/// Whether what is shown from here is a signal of 520h.
macro_rules! is_signal {
    (status) => {
        true
    };
    (actuation) => {
        false
    };
}

macro_rules! from {
    (status $status:ident $actuation:ident) => {{
        let _ = $actuation;
        $status
    }};
    (actuation $status:ident $actuation:ident) => {{
        let _ = $status;
        $actuation
    }};
}

shown! {
    status =>
        as_state ["SM-1" "SM-3"]
        handshake
        go_signal
        steering_status ["D-37"]
        shutdown_cause
        as_switch_status
        ts_switch_status
        ami_state ["RDY-6"]
        shutdown_request ["D-38"]
        op_state ["D-71"]
        ts_state ["D-72"]
        ebs_state ["D-73"]
        fault_status ["D-40"]
        ai_estop_request hvil_open_fault hvil_short_fault ebs_fault offboard_charger_fault ai_comms_lost
        autonomous_braking_fault mission_status_fault charge_procedure_fault bms_fault brake_plausibility_fault
        warning_status ["D-39"]
        warn_batt_temp_high
        warn_batt_soc_low;
    actuation =>
        front_axle_trq ["D-21"]
        front_motor_speed_max ["D-21"]
        rear_axle_trq ["D-21"]
        rear_motor_speed_max ["D-21"]
        direction ["D-21"]
        hyd_press_f ["D-41"]
        hyd_press_r ["D-41"]
        ebs_triggered ["D-43"],
        or null steer ["D-21"];
}

/// The same, where they stay.
pub(super) static FIELDS: [ShownField; SHOWN.len()] = SHOWN;

/// The raw values of all outputs, in the order of [`SHOWN`].
pub type ShownValues = Values<{ SHOWN.len() }>;

/// What a step shows, field by field as in [`SHOWN`]. It displays as a JSON object, in the words of its edition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Shown {
    /// The values. What is never `null` and has none is not in the edition.
    pub(super) raw: ShownValues,
    pub(super) words: Words,
}

/// What steps of an edition show: which fields it has is looked up once, for who asks for millions of steps.
#[derive(Clone, Copy, Debug)]
pub struct Showing {
    /// A bit for each field that it has.
    has: u64,
    words: Words,
}

impl Showing {
    /// Of an edition.
    pub fn of(edition: &Edition) -> Self {
        Self { has: Self::has(edition), words: Words(edition.bus) }
    }

    /// A bit for each field of [`SHOWN`] that an edition has.
    pub(crate) fn has(edition: &Edition) -> u64 {
        let there = FIELDS.iter().enumerate().filter(|(_, field)| field.is_in(edition));
        there.fold(0, |bits, (place, _)| bits | 1 << place)
    }

    /// What a step shows.
    pub fn shown(&self, outputs: &Outputs, inputs: &Inputs) -> Shown {
        self.in_words(self.values(outputs, inputs))
    }

    /// These values, in the words of the edition.
    pub const fn in_words(&self, values: ShownValues) -> Shown {
        Shown { raw: values, words: self.words }
    }

    /// What a step shows, as plain numbers.
    pub fn values(&self, outputs: &Outputs, inputs: &Inputs) -> ShownValues {
        let (numbers, there) = raw_of_all(&outputs.status(inputs), &outputs.actuation(inputs));
        ShownValues::of(numbers, there & self.has)
    }
}

impl Shown {
    /// What a step of an edition's specification shows.
    pub fn of(edition: &Edition, outputs: &Outputs, inputs: &Inputs) -> Self {
        Showing::of(edition).shown(outputs, inputs)
    }

    /// The raw value of the field at this place in [`SHOWN`].
    pub fn raw_at(&self, place: usize) -> Option<i32> {
        self.raw.at(place)
    }

    /// The value of a field; `None` if there is no such field.
    pub fn get(&self, key: &str) -> Option<Value> {
        self.iter().find(|(field, _)| field.key == key).map(|(_, value)| value)
    }

    /// The same with another raw value of the field at this place in [`SHOWN`], for a state machine that shows it wrongly.
    #[must_use]
    pub const fn with(mut self, place: usize, raw: i32) -> Self {
        self.raw = self.raw.with(place, raw);
        self
    }

    /// Each field that the edition has, with its value.
    pub fn iter(&self) -> impl Iterator<Item = (&'static ShownField, Value)> {
        let Self { raw, words } = *self;
        let there = FIELDS.iter().zip(raw.iter()).filter(|(field, raw)| field.nullable || raw.is_some());
        there.map(move |(field, raw)| (field, Value { domain: field.domain_on(&words.0), raw }))
    }

    /// A value of an input, in the same words.
    pub(crate) fn input(&self, field: &InputField, inputs: &Inputs) -> Value {
        Value { domain: field.domain_on(&self.words.0), raw: Some((field.get)(inputs)) }
    }
}

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, (field, value)) in self.iter().enumerate() {
            write!(f, "{}\"{}\":", if place == 0 { "{" } else { "," }, field.key)?;
            value.write_json(f)?;
        }
        f.write_str("}")
    }
}
