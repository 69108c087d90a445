//! The readings: the questions that the document leaves open, and the answers one can give.
//!
//! Each question is a [`Reading`] with two or three [`Choice`]s, one of them the default. A [`Readings`] value
//! answers every question; [`Choices`] is any set of answers, and says which are still possible.

use core::fmt;

macro_rules! readings {
    ($($(#[$doc:meta])* $reading:ident = $id:literal, $question:literal, $section:literal, $decision:literal {
        $($(#[$cdoc:meta])* $choice:ident = $cid:literal, $ctext:literal;)*
    })*) => {
        /// A question that the document leaves open.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
        #[repr(u8)]
        pub enum Reading { $($(#[$doc])* $reading,)* }

        impl Reading {
            /// Every question.
            pub const ALL: &'static [Self] = &[$(Self::$reading),*];

            /// The stable identifier, such as `fault-trigger`.
            pub const fn id(self) -> &'static str {
                match self { $(Self::$reading => $id,)* }
            }

            /// The question in words.
            pub const fn question(self) -> &'static str {
                match self { $(Self::$reading => $question,)* }
            }

            /// The sections of the document that raise the question.
            pub const fn section(self) -> &'static str {
                match self { $(Self::$reading => $section,)* }
            }

            /// The decision behind the default answer, as `REQUIREMENTS.md` has it.
            pub const fn decision(self) -> &'static str {
                match self { $(Self::$reading => $decision,)* }
            }

            /// The possible answers; the first is the default.
            pub const fn choices(self) -> &'static [Choice] {
                match self { $(Self::$reading => &[$(Choice::$choice),*],)* }
            }
        }

        /// An answer to a [`Reading`].
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
        #[repr(u8)]
        pub enum Choice { $($($(#[$cdoc])* $choice,)*)* }

        impl Choice {
            /// Every answer to every question.
            pub const ALL: &'static [Self] = &[$($(Self::$choice),*),*];

            /// The question this answers.
            pub const fn reading(self) -> Reading {
                match self { $($(Self::$choice => Reading::$reading,)*)* }
            }

            /// The stable identifier within its question, such as `level`.
            pub const fn id(self) -> &'static str {
                match self { $($(Self::$choice => $cid,)*)* }
            }

            /// The answer in words.
            pub const fn text(self) -> &'static str {
                match self { $($(Self::$choice => $ctext,)*)* }
            }
        }
    };
}

readings! {
    /// What "mission selected" means when AS_OFF is left.
    MissionSelected = "mission-selected",
        "AMI selection (text) or MISSION_STATUS == SELECTED (Figure 2)?", "3.1, Figure 2", "D-1" {
        //= D-1
        /// Both must hold.
        MissionBoth = "both", "both must hold";
        /// The selection on the Autonomous Mission Indicator decides.
        MissionAmi = "ami", "the AMI selection alone";
        /// The AI Computer's `MISSION_STATUS` decides.
        MissionStatusOnly = "status", "MISSION_STATUS == SELECTED alone";
    }
    /// Whether FINISHED or NEUTRAL at speed is a level or a change.
    FaultTrigger = "fault-trigger",
        "\"is set to\" FINISHED or NEUTRAL while moving (level), or \"is changed\" to it (edge)?", "3.7, 4", "D-2" {
        //= D-2
        /// The value counts as long as it is there.
        FaultLevel = "level", "the level counts";
        /// The change RUNNING to FINISHED, or FORWARD to NEUTRAL, counts.
        FaultEdge = "edge", "the change counts";
    }
    /// Which arrow wins in AS_READY.
    ReadyPriority = "ready-priority", "AS_READY with SDC open and ASMS off at once?", "3.5, 3.6", "D-3" {
        //= D-3
        /// EMERGENCY_BRAKE first.
        ReadyBrakeFirst = "emergency-brake", "EMERGENCY_BRAKE first";
        /// AS_OFF first.
        ReadyOffFirst = "as-off", "AS_OFF first";
    }
    /// Which arrow wins in AS_FINISHED.
    FinishedPriority = "finished-priority", "AS_FINISHED with SDC open and ASMS off at once?", "3.4, 3.8", "D-4" {
        //= D-4
        /// EMERGENCY_BRAKE first.
        FinishedBrakeFirst = "emergency-brake", "EMERGENCY_BRAKE first";
        /// AS_OFF first.
        FinishedOffFirst = "as-off", "AS_OFF first";
    }
    /// Which arrow wins in AS_DRIVING.
    DrivingPriority = "driving-priority",
        "AS_DRIVING with an emergency condition and FINISHED at rest at once?", "3.3, 3.7", "D-5" {
        //= D-5
        /// EMERGENCY_BRAKE first.
        DrivingBrakeFirst = "emergency-brake", "EMERGENCY_BRAKE first";
        /// AS_FINISHED first.
        DrivingFinishedFirst = "as-finished", "AS_FINISHED first";
    }
    /// What makes a "Go" edge acceptable.
    GoEdge = "go-edge",
        "must \"Go\" be seen low while the conditions already hold, or is a rising edge with them holding enough?",
        "3.2", "D-6" {
        //= D-6
        /// The switch must have been seen off while all other conditions held.
        GoSeenLow = "seen-low", "seen low first";
        /// A rising edge while all other conditions hold.
        GoEdgeEnough = "edge", "a rising edge is enough";
    }
    /// What GO_SIGNAL carries on the bus.
    GoSignal = "go-signal", "is GO_SIGNAL the accepted edge, or the raw switch?", "3.2", "D-7" {
        //= D-7
        /// The accepted edge.
        GoAccepted = "accepted", "the accepted edge";
        /// The switch as it stands.
        GoRaw = "raw", "the raw switch";
    }
    /// When the handshake runs.
    HandshakeActive = "handshake-active", "while the tractive system is enabled, or always?", "2.4", "D-8" {
        //= D-8
        /// While TSMS is on.
        HandshakeTsms = "tsms", "while TSMS is on";
        /// Always.
        HandshakeAlways = "always", "always";
    }
    /// Where ESTOP_REQUEST acts.
    AiEstop = "ai-estop", "does ESTOP_REQUEST act in every active state, or in AS_DRIVING only?", "2.1, 3.5", "D-9" {
        //= D-9
        /// It acts like an open shutdown circuit in every active state.
        EstopEveryState = "every-state", "every active state";
        /// It acts in AS_DRIVING only.
        EstopDriving = "driving", "AS_DRIVING only";
    }
    /// What AI_COMMS_LOST does.
    CommsLost = "comms-lost",
        "does AI_COMMS_LOST mean EMERGENCY_BRAKE in every state but AS_OFF (2.4), in AS_DRIVING, or nowhere (Figure 2)?",
        "2.4, Figure 2", "D-10" {
        //= D-10
        /// EMERGENCY_BRAKE from every state but AS_OFF.
        CommsEveryState = "every-state", "every state but AS_OFF";
        /// The flag is raised and no arrow is taken.
        CommsNoArrow = "no-arrow", "no arrow";
        /// EMERGENCY_BRAKE from AS_DRIVING; elsewhere only the flag.
        CommsDriving = "driving", "AS_DRIVING only";
    }
    /// Whether an emergency is remembered.
    PowerCycle = "power-cycle", "does AS_READY need a power cycle after EMERGENCY_BRAKE?", "3.9", "D-11" {
        //= D-11
        /// It does.
        PowerCycleLatched = "latched", "latched until a power cycle";
        /// It does not.
        PowerCycleNotLatched = "not-latched", "not latched";
    }
    /// When missed messages are watched.
    MessageWatch = "message-watch",
        "are missed messages a fault while the handshake is performed, or always?", "2.4, 4", "D-51" {
        //= D-51
        /// While the handshake is performed.
        WatchHandshake = "handshake", "while the handshake is performed";
        /// Always.
        WatchAlways = "always", "always";
    }
    /// Whether the drive motors are in torque control mode, in which torque and brake exclude each other.
    TorqueControl = "torque-control",
        "are the drive motors always in torque control mode, or never?", "4", "D-53" {
        //= D-53
        /// They always are.
        TorqueAlways = "always", "always";
        /// They never are.
        TorqueNever = "never", "never";
    }
    /// Whether a fault of the battery acts outside of AS_DRIVING.
    BmsFault = "bms-fault",
        "does BMS_FAULT open the shutdown circuit (3.5), or act in AS_DRIVING only (Figure 2)?", "3.5, Figure 2", "D-54" {
        //= D-54
        /// It opens the shutdown circuit.
        BmsSdc = "sdc", "by the shutdown circuit";
        /// It acts in AS_DRIVING only.
        BmsDriving = "driving", "AS_DRIVING only";
    }
}

impl Choice {
    /// The choice named by `reading-id` and `choice-id`; `None` if there is none of that name.
    ///
    /// ```
    /// use adsdv_spec::Choice;
    /// assert_eq!(Choice::find("fault-trigger", "edge"), Some(Choice::FaultEdge));
    /// ```
    pub fn find(reading: &str, choice: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|c| c.reading().id() == reading && c.id() == choice)
    }
}

crate::named::impl_find!(Reading by id, "fault-trigger");
crate::named::impl_named!(Reading, "the id of a reading, such as \"fault-trigger\"");

impl fmt::Display for Reading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.id())
    }
}

crate::named::impl_named!(Choice, "a reading and a choice, such as \"fault-trigger=edge\"");

/// As `reading=choice`, such as `fault-trigger=edge`.
impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.reading().id(), self.id())
    }
}

/// A set of [`Choice`]s: those that are still possible, or those that a term of the table needs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Choices(u32);

crate::set::impl_set!(Choices(u32) of Choice, "choice");

impl Choices {
    /// The set without the other choices of the same reading: the reading is pinned.
    #[must_use]
    pub const fn pin(self, choice: Choice) -> Self {
        self.difference(Self::of(choice.reading().choices())).with(choice)
    }

    /// The choices of one reading that are in the set.
    pub fn of_reading(self, reading: Reading) -> impl Iterator<Item = Choice> + Clone {
        reading.choices().iter().copied().filter(move |&choice| self.has(choice))
    }

    /// Every full answer that can be given with the choices of the set, varying the readings named and taking
    /// the first possible choice of every other one. Readings of which no choice is possible keep the default.
    pub fn combinations(self, readings: &[Reading]) -> impl Iterator<Item = Readings> {
        let first = Reading::ALL
            .iter()
            .filter_map(|&reading| self.of_reading(reading).next())
            .fold(Readings::DEFAULT, Readings::with);
        let count = move |reading: Reading| self.of_reading(reading).count().max(1);
        let total: usize = readings.iter().map(|&reading| count(reading)).product();
        (0..total).map(move |mut index| {
            readings.iter().fold(first, |answer, &reading| {
                let pick = index % count(reading);
                index /= count(reading);
                self.of_reading(reading).nth(pick).map_or(answer, |choice| answer.with(choice))
            })
        })
    }
}

/// One answer to every question.
///
/// ```
/// use adsdv_spec::{Choice, Reading, Readings};
/// let readings = Readings::DEFAULT.with(Choice::FaultEdge);
/// assert_eq!(readings.choice(Reading::FaultTrigger), Choice::FaultEdge);
/// assert_eq!(readings.choice(Reading::CommsLost), Choice::CommsEveryState);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Readings(Choices);

impl Readings {
    /// The default answer to every question.
    pub const DEFAULT: Self = {
        let mut set = Choices::NONE;
        let mut i = 0;
        while i < Reading::ALL.len() {
            set = set.with(Reading::ALL[i].choices()[0]);
            i += 1;
        }
        Self(set)
    };

    /// The same answers but for this one.
    #[must_use]
    pub const fn with(self, choice: Choice) -> Self {
        Self(self.0.pin(choice))
    }

    /// Whether this choice was made.
    pub const fn is(self, choice: Choice) -> bool {
        self.0.has(choice)
    }

    /// The answer to one question.
    pub const fn choice(self, reading: Reading) -> Choice {
        let choices = reading.choices();
        let mut i = 0;
        while i + 1 < choices.len() && !self.0.has(choices[i]) {
            i += 1;
        }
        choices[i]
    }

    /// All answers as a set.
    pub const fn choices(self) -> Choices {
        self.0
    }
}

impl Default for Readings {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// As a list of choices such as `fault-trigger=edge`, the non-default ones only; empty means all defaults.
impl fmt::Display for Readings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        crate::named::separated(f, " ", self.0.difference(Self::DEFAULT.0).iter())
    }
}

#[cfg(kani)]
impl kani::Arbitrary for Readings {
    fn any() -> Self {
        let mut readings = Self::DEFAULT;
        let mut i = 0;
        while i < Reading::ALL.len() {
            let choices = Reading::ALL[i].choices();
            let pick: usize = kani::any();
            kani::assume(pick < choices.len());
            readings = readings.with(choices[pick]);
            i += 1;
        }
        readings
    }
}

#[cfg(feature = "arbitrary")]
impl arbitrary::Arbitrary<'_> for Readings {
    fn arbitrary(u: &mut arbitrary::Unstructured<'_>) -> arbitrary::Result<Self> {
        let mut readings = Self::DEFAULT;
        for reading in Reading::ALL {
            readings = readings.with(*u.choose(reading.choices())?);
        }
        Ok(readings)
    }
}

#[cfg(feature = "proptest")]
impl proptest::arbitrary::Arbitrary for Readings {
    type Parameters = ();
    type Strategy = proptest::strategy::BoxedStrategy<Self>;

    /// Shrinks towards the defaults.
    fn arbitrary_with((): ()) -> Self::Strategy {
        use proptest::strategy::Strategy;
        let answers: std::vec::Vec<_> =
            Reading::ALL.iter().map(|reading| proptest::sample::select(reading.choices())).collect();
        answers.prop_map(|answers| answers.into_iter().fold(Self::DEFAULT, Self::with)).boxed()
    }
}
