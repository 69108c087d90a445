//! Input vectors for machine words: 64 of them at a time, as planes.

use std::ops::Deref;

use adsdv_network::{LANES, Planes};
use adsdv_spec::Observation;

/// Input vectors, in words of 64.
#[derive(Debug)]
pub(crate) struct Words {
    seen: Vec<Observation>,
    planes: Vec<Planes>,
}

impl Words {
    pub(crate) fn of(seen: Vec<Observation>) -> Self {
        let planes = seen.chunks(LANES).map(Planes::of).collect();
        Self { seen, planes }
    }

    /// The words, one after the other: up to 64 vectors each.
    pub(crate) fn words(&self) -> impl Iterator<Item = (&[Observation], &Planes)> {
        self.seen.chunks(LANES).zip(&self.planes)
    }
}

impl FromIterator<Observation> for Words {
    fn from_iter<I: IntoIterator<Item = Observation>>(seen: I) -> Self {
        Self::of(seen.into_iter().collect())
    }
}

/// The vectors, one by one.
impl Deref for Words {
    type Target = [Observation];

    fn deref(&self) -> &[Observation] {
        &self.seen
    }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::{Atom, Atoms, Faults};

    use super::*;

    #[test]
    fn a_word_shows_what_its_vectors_show() {
        let seen = |atoms: &[Atom]| Observation::new(Atoms::of(atoms), Faults::NONE);
        let (one, other) = (seen(&[Atom::Asms]), seen(&[Atom::Asms, Atom::Tsms]));
        let vectors: Words = (0..70).map(|place| if place % 3 == 0 { one } else { other }).collect();
        let shows = |on: &[Atom], off: &[Atom]| -> Vec<usize> {
            let words = vectors.words().enumerate();
            let bits = |(word, (_, planes)): (usize, (_, &Planes))| {
                let bits = planes.show(Atoms::of(on), Atoms::of(off)) & planes.lanes();
                (0..64).filter(move |bit| bits >> bit & 1 == 1).map(move |bit| word * 64 + bit)
            };
            words.flat_map(bits).collect()
        };
        let every = |third: bool| (0..70).filter(|place| (place % 3 == 0) == third).collect::<Vec<_>>();
        assert_eq!(shows(&[Atom::Asms], &[Atom::Tsms]), every(true));
        assert_eq!(shows(&[Atom::Tsms], &[]), every(false));
        assert!(shows(&[], &[Atom::Asms]).is_empty());
    }
}
