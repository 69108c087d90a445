//! Where drawn values come from: bytes, or one small choice after the other until all have been made.

use arbitrary::Unstructured;

/// The source of the values of a run.
#[derive(Clone, Debug)]
pub struct Source {
    kind: Kind,
    /// The timers that were drawn last: what is just missing to a limit is a boundary too.
    timers: [u16; 2],
}

#[derive(Clone, Debug)]
enum Kind {
    /// Bytes, random or somebody's. Where they end, zeros follow.
    Bytes { data: Vec<u8>, at: usize },
    /// Each value of each draw in turn, like the digits of a counter.
    Counter { digits: Vec<Digit>, at: usize },
}

/// One draw of a run: which of how many values it was.
#[derive(Clone, Copy, Debug)]
struct Digit {
    value: u64,
    base: u64,
}

impl Source {
    /// Values made of these bytes.
    pub const fn bytes(data: Vec<u8>) -> Self {
        Self { kind: Kind::Bytes { data, at: 0 }, timers: [0; 2] }
    }

    /// The first of all combinations of values.
    pub(super) const fn first() -> Self {
        Self { kind: Kind::Counter { digits: Vec::new(), at: 0 }, timers: [0; 2] }
    }

    /// The combination after this one, once a run has made its draws; `None` after the last.
    pub(super) fn next(mut self) -> Option<Self> {
        let Kind::Counter { digits, at } = &mut self.kind else { return None };
        *at = 0;
        while let Some(last) = digits.last_mut() {
            last.value += 1;
            if last.value < last.base {
                return Some(self);
            }
            digits.pop();
        }
        None
    }

    /// Whether every combination is gone through.
    pub(super) const fn enumerates(&self) -> bool {
        matches!(self.kind, Kind::Counter { .. })
    }

    /// Remembers the timer of the AS state, or that of the handshake.
    pub(super) const fn note_timers(&mut self, in_state_ms: Option<u16>, unanswered_ms: u16) {
        if let Some(in_state_ms) = in_state_ms {
            self.timers[0] = in_state_ms;
        }
        self.timers[1] = unanswered_ms;
    }

    /// One of the timers remembered.
    pub(super) fn timer(&mut self) -> u16 {
        let timers = self.timers;
        self.one_of(&timers)
    }

    /// A number below `base`; 0 if there is none.
    pub fn below(&mut self, base: u64) -> u64 {
        match &mut self.kind {
            Kind::Bytes { .. } => self.arbitrary_with(|u| u.int_in_range(0..=base.saturating_sub(1))),
            Kind::Counter { digits, at } => {
                if *at == digits.len() {
                    digits.push(Digit { value: 0, base });
                }
                let value = digits.get(*at).map_or(0, |digit| digit.value);
                *at += 1;
                value
            }
        }
    }

    /// One of these; the default if there is none.
    pub fn one_of<T: Copy + Default>(&mut self, values: &[T]) -> T {
        let place = self.below(values.len() as u64);
        usize::try_from(place).ok().and_then(|place| values.get(place)).copied().unwrap_or_default()
    }

    /// A value as the `arbitrary` crate makes it out of bytes.
    pub fn arbitrary<T: for<'a> arbitrary::Arbitrary<'a> + Default>(&mut self) -> T {
        #[expect(clippy::redundant_closure_for_method_calls, reason = "the method is of one lifetime only")]
        self.arbitrary_with(|unstructured| unstructured.arbitrary())
    }

    /// What is made out of the bytes that follow. Not even one value is made of a counter: a domain that is large
    /// cannot be gone through.
    pub(super) fn arbitrary_with<T: Default>(
        &mut self,
        make: impl FnOnce(&mut Unstructured<'_>) -> arbitrary::Result<T>,
    ) -> T {
        match &mut self.kind {
            Kind::Bytes { data, at } => {
                let rest = data.get(*at..).unwrap_or_default();
                let mut unstructured = Unstructured::new(rest);
                let value = make(&mut unstructured).unwrap_or_default();
                *at += rest.len() - unstructured.len();
                value
            }
            Kind::Counter { .. } => panic!(
                "a harness that is run for all values draws a {}, of which there are too many; let it be run at random",
                std::any::type_name::<T>()
            ),
        }
    }
}
