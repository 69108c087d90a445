//! Spans, handshakes, glimpses and causes.

use adsdv_proofs::subject::Subject;
use adsdv_spec::belief::{Causes, Glimpse, Handshakes, KnownFaults, Memory, Span};
use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Atoms, Fault, Faults, Knowledge, Machine, Truth};

use crate::Mutant;

pub(crate) fn mutants() -> Vec<Mutant> {
    [spans(), handshakes(), glimpses(), causes()].into_iter().flatten().collect()
}

/// Of `span.rs`.
fn spans() -> Vec<Mutant> {
    let counts = |what, twin| Mutant::new("a_timer_stays_between_its_bounds", what, CountsUp(twin));
    let left = |what, twin| Mutant::new("a_span_is_cut_at_a_limit", what, Left(twin));
    let spans = |what, twin| Mutant::new("spans_are_joined", what, JoinsSpans(twin));
    vec![
        counts("all of it counts the least time", |timer, dt, limit| {
            timer.counted_up(Span::exact(dt.least_ms()), limit)
        }),
        counts("the upper bound goes beyond the limit", |timer, dt, limit| {
            Span::between(timer.counted_up(dt, limit).least_ms(), timer.counted_up(dt, u16::MAX).most_ms())
        }),
        counts("of a wide span only the upper bound is kept", |timer, dt, limit| {
            let after = timer.counted_up(dt, limit);
            if timer.most_ms() - timer.least_ms() > 1000 { Span::exact(after.most_ms()) } else { after }
        }),
        left("the limit itself is not reached", |span, limit, reached| {
            span.given(limit.saturating_add(1), reached)
        }),
        left("a limit of 0 may be not reached", |span, limit, reached| {
            if limit == 0 { Some(span) } else { span.given(limit, reached) }
        }),
        Mutant::new("a_span_is_cut_at_a_limit", "a limit that may be reached is", Reaches),
        spans("either is both", |one, other| (one.and(other).unwrap_or(one), one.and(other))),
        spans("both is either", |one, other| (one.or(other), Some(one.or(other)))),
        spans("either is anything", |one, other| (Span::between(0, u16::MAX), one.and(other))),
    ]
}

/// Of `handshakes.rs`.
fn handshakes() -> Vec<Mutant> {
    let steps = |theorem, what, twin| Mutant::new(theorem, what, Steps(twin));
    let step = "a_handshake_steps_within_what_may_be";
    let cut = "handshakes_are_cut_where_one_is_lost_or_seen";
    vec![
        steps(step, "an answer that is not known does not come", |before, active, answer, dt, limit| {
            let answer = if answer == Truth::Unknown { Truth::False } else { answer };
            before.step(active, answer, dt, limit)
        }),
        steps(step, "it may rest while it is performed", |before, active, answer, dt, limit| Handshakes {
            idle: true,
            ..before.step(active, answer, dt, limit)
        }),
        steps(step, "a first edge counts", |before, active, answer, dt, limit| {
            let low = if before.idle { Some(Span::exact(0)) } else { before.low };
            Handshakes { idle: false, low, ..*before }.step(active, answer, dt, limit)
        }),
        steps(
            "knowing_less_allows_no_fewer_handshakes",
            "who does not know the answer looks at one bit alone",
            |before, active, answer, dt, limit| {
                let after = before.step(active, answer, dt, limit);
                if answer == Truth::Unknown { Handshakes { low: None, ..after } } else { after }
            },
        ),
        Mutant::new(cut, "one that rests may be lost", Cut::Rests),
        Mutant::new(cut, "one that rests sends 1", Cut::Sends1),
        Mutant::new(cut, "nobody knows whether it is lost", Cut::Doubts),
    ]
}

/// Of `glimpse.rs` and `atoms.rs`.
fn glimpses() -> Vec<Mutant> {
    let seen = |theorem, what, twin| Mutant::new(theorem, what, Sees(twin));
    let battery = "conditions_are_known_from_a_glimpse_where_the_battery_does_not_open_the_circuit_in_4_0";
    let of = |theorem, what, twin| Mutant::new(theorem, what, OfGlimpse(twin));
    let memory = |what, twin| Mutant::new("conditions_that_memory_decides_are_known", what, OfMemory(twin));
    vec![
        seen("a_glimpse_allows_what_was_seen", "an open circuit is open by HVIL", |atoms, faults| {
            let hvil = Faults::when(Fault::HvilOpenFault, atoms.on().has(Atom::SdcOpen));
            Glimpse::new(atoms, KnownFaults::new(faults.present().union(hvil), faults.absent()))
        }),
        seen("a_glimpse_allows_what_was_seen", "faults tell nothing of the circuit", |atoms, _| {
            Glimpse::new(atoms, KnownFaults::NOTHING)
        }),
        seen(
            "knowing_less_is_a_glimpse_of_no_more",
            "what is not known of \"Go\" is off",
            |atoms, faults| {
                let go = Atoms::NONE.with(Atom::GoOn);
                let unknown = atoms.of(Atom::GoOn) == Truth::Unknown;
                Glimpse::new(if unknown { atoms.learn(go, Atoms::NONE) } else { atoms }, faults)
            },
        ),
        of("conditions_are_known_from_a_glimpse", "an open circuit is forgotten", |_, seen| {
            seen.atoms().set(Atom::SdcOpen, Truth::Unknown)
        }),
        of("conditions_are_known_from_a_glimpse", "the estop is off if nobody says so", |machine, seen| {
            let known = machine.known_atoms_of(seen);
            let unknown = known.of(Atom::AiEstop) == Truth::Unknown;
            if unknown { known.set(Atom::AiEstop, Truth::False) } else { known }
        }),
        of(battery, "the battery opens the circuit", |_, seen| seen.atoms()),
        of(battery, "the battery closes the circuit", |machine, seen| {
            let known = machine.known_atoms_of(seen);
            let battery = seen.faults().of(Fault::BmsFault) == Truth::True;
            if battery { known.set(Atom::SdcOpen, Truth::False) } else { known }
        }),
        memory("the edge of \"Go\" is \"Go\"", |machine, from, memory, inputs, elapsed, lost| {
            let memory = Memory { go_seen_low: Truth::True, ..*memory };
            machine.known_atoms(from, &memory, inputs, elapsed, lost)
        }),
        memory("the time has never come", |machine, from, memory, inputs, _, lost| {
            machine.known_atoms(from, memory, inputs, false, lost)
        }),
        memory("the power cycle is forgotten", |machine, from, memory, inputs, elapsed, lost| {
            machine
                .known_atoms(from, memory, inputs, elapsed, lost)
                .set(Atom::PowerCycleNeeded, Truth::Unknown)
        }),
    ]
}

/// Of `causes.rs`.
fn causes() -> Vec<Mutant> {
    vec![
        Mutant::new(
            "the_first_cause_may_be",
            "the first that may be is the first",
            First(|faults, _| Causes::exact(faults.possible().cause())),
        ),
        Mutant::new(
            "the_first_cause_may_be",
            "there is always one",
            First(|faults, _| Causes::first_of(faults, true)),
        ),
        Mutant::new(
            "the_first_cause_may_be",
            "any that may be is the first",
            First(|faults, some| Causes {
                none: Causes::first_of(faults, some).none,
                faults: faults.possible(),
            }),
        ),
        Mutant::new("the_cause_that_was_there_stays", "a later cause counts", Then(|_, later| later)),
        Mutant::new("the_cause_that_was_there_stays", "none stays none", Then(|before, _| before)),
        Mutant::new(
            "the_flag_of_a_cause_may_be_shown",
            "the first that may be is shown",
            Shown(|causes| KnownFaults::exact(Faults::of_cause(causes.faults.cause()))),
        ),
        Mutant::new(
            "the_flag_of_a_cause_may_be_shown",
            "no flag is certain",
            Shown(|causes| KnownFaults::new(Faults::NONE, causes.shown().absent())),
        ),
        Mutant::new(
            "faults_are_joined_soundly",
            "both together are either",
            JoinsFaults(|one, other| (one.or(other), one.or(other))),
        ),
        Mutant::new(
            "faults_are_joined_soundly",
            "either is both together",
            JoinsFaults(|one, other| (one.together(other), one.together(other))),
        ),
    ]
}

#[derive(Clone)]
struct CountsUp(fn(Span, Span, u16) -> Span);

impl Subject for CountsUp {
    fn counted_up(&self, timer: Span, dt_ms: Span, limit_ms: u16) -> Span {
        (self.0)(timer, dt_ms, limit_ms)
    }
}

#[derive(Clone)]
struct Left(fn(Span, u16, bool) -> Option<Span>);

impl Subject for Left {
    fn span_given(&self, span: Span, limit_ms: u16, reached: bool) -> Option<Span> {
        (self.0)(span, limit_ms, reached)
    }
}

#[derive(Clone)]
struct Reaches;

impl Subject for Reaches {
    fn span_reaches(&self, span: Span, limit_ms: u16) -> Truth {
        (span.most_ms() >= limit_ms).into()
    }
}

#[derive(Clone)]
struct JoinsSpans(fn(Span, Span) -> (Span, Option<Span>));

impl Subject for JoinsSpans {
    fn join_spans(&self, one: Span, other: Span) -> (Span, Option<Span>) {
        (self.0)(one, other)
    }
}

#[derive(Clone)]
struct Steps(fn(&Handshakes, Truth, Truth, Span, u16) -> Handshakes);

impl Subject for Steps {
    fn handshakes_step(
        &self,
        before: &Handshakes,
        active: Truth,
        answer: Truth,
        dt_ms: Span,
        limit_ms: u16,
    ) -> Handshakes {
        (self.0)(before, active, answer, dt_ms, limit_ms)
    }
}

#[derive(Clone)]
enum Cut {
    Rests,
    Sends1,
    Doubts,
}

impl Subject for Cut {
    fn handshakes_given_lost(&self, handshakes: &Handshakes, limit_ms: u16, lost: bool) -> Handshakes {
        let left = handshakes.given_lost(limit_ms, lost);
        if matches!(self, Self::Rests) { Handshakes { idle: handshakes.idle, ..left } } else { left }
    }

    fn handshakes_given_bit(&self, handshakes: &Handshakes, bit: bool) -> Handshakes {
        let left = handshakes.given_bit(bit);
        if matches!(self, Self::Sends1) { Handshakes { idle: handshakes.idle && bit, ..left } } else { left }
    }

    fn handshakes_lost(&self, handshakes: &Handshakes, limit_ms: u16) -> Truth {
        if matches!(self, Self::Doubts) { Truth::Unknown } else { handshakes.is_lost(limit_ms) }
    }
}

#[derive(Clone)]
struct Sees(fn(Knowledge, KnownFaults) -> Glimpse);

impl Subject for Sees {
    fn glimpse(&self, atoms: Knowledge, faults: KnownFaults) -> Glimpse {
        (self.0)(atoms, faults)
    }
}

#[derive(Clone)]
struct OfGlimpse(fn(&Machine, &Glimpse) -> Knowledge);

impl Subject for OfGlimpse {
    fn known_atoms_of(&self, machine: &Machine, seen: &Glimpse) -> Knowledge {
        (self.0)(machine, seen)
    }
}

#[derive(Clone)]
struct OfMemory(fn(&Machine, AsState, &Memory, Knowledge, bool, bool) -> Knowledge);

impl Subject for OfMemory {
    fn known_atoms(
        &self,
        from: AsState,
        memory: &Memory,
        inputs: Knowledge,
        elapsed: bool,
        comms_lost: bool,
    ) -> Knowledge {
        (self.0)(&Machine::REFERENCE, from, memory, inputs, elapsed, comms_lost)
    }
}

#[derive(Clone)]
struct First(fn(KnownFaults, bool) -> Causes);

impl Subject for First {
    fn first_cause(&self, faults: KnownFaults, some: bool) -> Causes {
        (self.0)(faults, some)
    }
}

#[derive(Clone)]
struct Then(fn(Causes, Causes) -> Causes);

impl Subject for Then {
    fn cause_then(&self, before: Causes, later: Causes) -> Causes {
        (self.0)(before, later)
    }
}

#[derive(Clone)]
struct Shown(fn(Causes) -> KnownFaults);

impl Subject for Shown {
    fn cause_shown(&self, causes: Causes) -> KnownFaults {
        (self.0)(causes)
    }
}

#[derive(Clone)]
struct JoinsFaults(fn(KnownFaults, KnownFaults) -> (KnownFaults, KnownFaults));

impl Subject for JoinsFaults {
    fn join_faults(&self, one: KnownFaults, other: KnownFaults) -> (KnownFaults, KnownFaults) {
        (self.0)(one, other)
    }
}
