//! Sets of outputs.

use adsdv_spec::Edition;

use super::vcu::Reply;
use crate::protocol::{SHOWN, Showing};

/// Some of the outputs, by their places in [`SHOWN`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Keys(u64);

const _: () = assert!(SHOWN.len() <= 64, "each output has a bit");

impl Keys {
    /// No output.
    pub(super) const NONE: Self = Self(0);
    /// Every output, and every bit that is none.
    pub(super) const ALL: Self = Self(u64::MAX);

    /// The outputs with these keys.
    pub(super) fn of(keys: &[&str]) -> Self {
        let mut all = Self::NONE;
        for key in keys {
            all.insert(key);
        }
        all
    }

    /// The outputs that an edition has.
    pub(super) fn of_edition(edition: &Edition) -> Self {
        Self(Showing::has(edition))
    }

    /// Those that an answer tells of.
    pub(super) fn given(reply: &Reply) -> Self {
        match reply {
            Reply::Answer(answer) => Self(answer.given()),
            Reply::Nothing => Self::NONE,
        }
    }

    pub(super) fn insert(&mut self, key: &str) {
        if let Some(place) = SHOWN.iter().position(|field| field.key == key) {
            self.0 |= 1 << place;
        }
    }

    pub(super) fn has(self, key: &str) -> bool {
        self.meets(Self::of(&[key]))
    }

    pub(super) const fn has_all(self, those: Self) -> bool {
        self.0 & those.0 == those.0
    }

    pub(super) const fn is_empty(self) -> bool {
        self.0 == 0
    }

    pub(super) const fn meets(self, those: Self) -> bool {
        self.0 & those.0 != 0
    }

    pub(super) const fn and(self, those: Self) -> Self {
        Self(self.0 & those.0)
    }

    pub(super) const fn or(self, those: Self) -> Self {
        Self(self.0 | those.0)
    }

    /// The keys, in the order in which an answer has them.
    pub(super) fn iter(self) -> impl Iterator<Item = &'static str> {
        SHOWN.iter().map(|field| field.key).filter(move |key| self.has(key))
    }
}

#[cfg(test)]
mod tests {
    use super::Keys;
    use crate::conform::vcu::Reply;

    #[test]
    fn sets_of_outputs_are_sets() {
        let both = Keys::of(&["steer", "as_state"]);
        assert_eq!(both.iter().collect::<Vec<_>>(), ["as_state", "steer"]);
        assert!(both.has("steer") && !both.has("handshake") && both.has_all(Keys::of(&["steer"])));
        assert!(!Keys::of(&["steer"]).has_all(both) && both.meets(Keys::of(&["steer"])));
        assert!(Keys::of(&["no such key"]).is_empty() && Keys::ALL.and(both) == both);
        assert_eq!(Keys::of(&["steer"]).or(Keys::of(&["as_state"])), both);
        let reply = Reply::Answer(r#"{"as_state":1,"steer":null}"#.parse().unwrap());
        assert_eq!((Keys::given(&reply), Keys::given(&Reply::Nothing)), (both, Keys::NONE));
    }
}
