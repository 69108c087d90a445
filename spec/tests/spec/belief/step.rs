//! The whole step on what may be, of every edition and under every reading, on random steps: it allows what a step comes to, has
//! all of it where all is known, and knows no more where less is.

use adsdv_spec::belief::{Belief, Causes, Glimpse, Handshakes, KnownFaults, Memory, Span};
use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{AsState, Atoms, Control, Edition, Faults, Handshake, Machine, Observation, Truth};

use crate::random::Random;

/// Steps, and what may be known of them, drawn at random.
struct Draws(Random);

impl Draws {
    fn below(&mut self, n: u64) -> u64 {
        self.0.next() % n
    }

    fn flag(&mut self) -> bool {
        self.below(2) == 0
    }

    /// Any time up to this one, or just before it, or it.
    fn ms(&mut self, most: u16) -> u16 {
        let any = u16::try_from(self.below(u64::from(most) + 1)).expect("at most that");
        [any, most.saturating_sub(1), most][usize::try_from(self.below(3)).expect("less than 3")]
    }

    /// Hardly any atoms, any of them, or nearly all.
    fn atoms(&mut self) -> Atoms {
        let few = self.0.next() & self.0.next() & self.0.next();
        let bits = [few, self.0.next(), !few][usize::try_from(self.below(3)).expect("less than 3")];
        Atoms::from_bits(u32::try_from(bits & u64::from(Atoms::ALL.bits())).expect("in its bits"))
            .expect("atoms")
    }

    fn faults(&mut self) -> Faults {
        let bits =
            if self.flag() { 0 } else { self.0.next() & self.0.next() & u64::from(Faults::ALL.bits()) };
        Faults::from_bits(u16::try_from(bits).expect("in its bits")).expect("faults")
    }

    /// Any control state that keeps the invariant.
    fn control(&mut self, machine: &Machine) -> Control {
        let timing = &machine.edition().rules.timing;
        loop {
            let state = AsState::ALL[usize::try_from(self.below(5)).expect("less than 5")];
            let causes = ShutdownCause::ALL.len() as u64;
            let waits =
                Handshake { active: true, bit: self.flag(), unanswered_ms: self.ms(timing.handshake_ms) };
            let drawn = Control {
                state,
                in_state_ms: self.ms(timing.in_state_limit(state)),
                go_seen_low: self.flag(),
                was_running: self.flag(),
                was_forward: self.flag(),
                handshake: if self.below(4) == 0 { Handshake::IDLE } else { waits },
                power_cycle_needed: self.flag(),
                shutdown_cause: if self.flag() {
                    ShutdownCause::NoShutdown
                } else {
                    ShutdownCause::ALL[usize::try_from(self.below(causes)).expect("a cause")]
                },
            };
            if drawn.is_consistent(timing, machine.readings()) {
                return drawn;
            }
        }
    }

    fn wider(&mut self, span: Span) -> Span {
        let (before, after) = (self.ms(40), self.ms(40));
        Span::between(span.least_ms().saturating_sub(before), span.most_ms().saturating_add(after))
    }

    fn waits(&mut self, span: Option<Span>) -> Option<Span> {
        match span {
            Some(span) => Some(self.wider(span)),
            None => self.flag().then(|| Span::between(self.ms(100), self.ms(100))),
        }
    }

    fn less(&mut self, truth: Truth) -> Truth {
        if self.flag() { Truth::Unknown } else { truth }
    }

    fn more(&mut self, memory: &Memory) -> Memory {
        let Memory { handshake, shutdown_cause, .. } = *memory;
        Memory {
            in_state: self.wider(memory.in_state),
            go_seen_low: self.less(memory.go_seen_low),
            was_running: self.less(memory.was_running),
            was_forward: self.less(memory.was_forward),
            handshake: Handshakes {
                idle: handshake.idle || self.flag(),
                low: self.waits(handshake.low),
                high: self.waits(handshake.high),
            },
            power_cycle_needed: self.less(memory.power_cycle_needed),
            shutdown_cause: Causes {
                none: shutdown_cause.none || self.flag(),
                faults: shutdown_cause.faults.union(self.faults()),
            },
        }
    }
}

/// What is known of a step.
struct Known {
    belief: Belief,
    seen: Glimpse,
    dt: Span,
}

impl Known {
    /// As much of it, or less.
    fn less(&self, random: &mut Draws) -> Self {
        let mut belief = self.belief;
        for state in AsState::ALL {
            match self.belief.memory(state) {
                Some(memory) => belief = belief.with(state, random.more(memory)),
                None if random.below(8) == 0 => {
                    let timing = Edition::V3_0.rules.timing;
                    belief = belief.with(state, Memory::anything(state, &timing));
                }
                None => {}
            }
        }
        let unseen = random.faults();
        let known = self.seen.faults();
        let faults = KnownFaults::new(known.present().difference(unseen), known.absent().difference(unseen));
        let seen = Glimpse::new(self.seen.atoms().forget(random.atoms()), faults);
        Self { belief, seen, dt: random.wider(self.dt) }
    }

    fn react(&self, machine: &Machine) -> Belief {
        machine.react_known(&self.belief, &self.seen, self.dt.least_ms().into()..=self.dt.most_ms().into())
    }
}

/// Every edition with its default readings, and with each other answer.
fn machines() -> impl Iterator<Item = Machine> {
    Edition::ALL.iter().flat_map(|&&edition| {
        let others = edition.alternatives().iter().map(move |choice| edition.readings.with(choice));
        [edition.readings].into_iter().chain(others).map(move |readings| Machine::new(edition, readings))
    })
}

#[test]
fn a_step_on_what_may_be_allows_what_the_step_comes_to() {
    let mut random = Draws(Random::with_seed(20_261_123));
    let mut decided = 0;
    for machine in machines() {
        for _ in 0..400 {
            let control = random.control(&machine);
            let seen = Observation::new(random.atoms(), random.faults());
            let dt_ms = random.ms(120);
            let reaction = machine.react(&control, seen, dt_ms.into());
            let exact =
                Known { belief: Belief::exact(&control), seen: Glimpse::exact(seen), dt: Span::exact(dt_ms) };
            let about = || format!("{control:?}, {seen:?}, {dt_ms} ms, {}", machine.readings());
            assert_eq!(exact.react(&machine), Belief::exact(&reaction.control), "{}", about());
            let less = exact.less(&mut random);
            assert!(less.seen.allows(seen) && less.belief.allows(&control), "{}", about());
            let after = less.react(&machine);
            assert!(after.allows(&reaction.control), "{}", about());
            decided += u32::from(after.states().count() < 3);
            assert!(less.less(&mut random).react(&machine).covers(&after), "{}", about());
        }
    }
    assert!(decided > 100, "{decided}: hardly anything is known");
}
