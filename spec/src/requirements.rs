//! Which requirements an edition asks for, by their numbers in `REQUIREMENTS.md`: as what it changes of the edition before it.

/// The requirements that an edition asks for.
///
/// ```
/// use adsdv_spec::Edition;
/// // "Within 50 ms", and since 4.0 "within 100 ms".
/// assert!(Edition::V3_0.requirements.has("HS-9") && !Edition::V4_0.requirements.has("HS-9"));
/// assert!(Edition::V2026.requirements.has("HS-17"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Requirements {
    /// Those of the edition before it, which hold unless they are [replaced](Self::replaced); `None` of the first one.
    pub before: Option<&'static Self>,
    /// What it asks for besides.
    pub added: &'static [Numbers],
    /// What it asks for instead of earlier ones.
    pub replaced: &'static [Replaced],
}

/// Requirements of one prefix whose numbers follow each other, such as HS-17 to HS-19.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Numbers {
    /// What they begin with, such as `HS`.
    pub prefix: &'static str,
    /// The first number.
    pub first: u16,
    /// The last one.
    pub last: u16,
}

/// A requirement that an edition replaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Replaced {
    /// The earlier one, such as `HS-9`.
    pub id: &'static str,
    /// What is asked for instead: the same with another number in it, or what has become of it. None where it is dropped; itself
    /// among others where it still holds and others say the same of more.
    pub by: &'static [&'static str],
}

impl Numbers {
    /// These numbers of a prefix.
    pub(crate) const fn new(prefix: &'static str, first: u16, last: u16) -> Self {
        Self { prefix, first, last }
    }

    fn has(&self, id: &str) -> bool {
        let number = id.strip_prefix(self.prefix).and_then(|rest| rest.strip_prefix('-'));
        number
            // As it is written: HS-9, and no HS-09 or HS-+9.
            .filter(|number| number.starts_with(|digit| matches!(digit, '1'..='9')))
            .and_then(|number| number.parse().ok())
            .is_some_and(|number| (self.first..=self.last).contains(&number))
    }
}

impl Replaced {
    /// What is asked for instead of a requirement.
    pub(crate) const fn new(id: &'static str, by: &'static [&'static str]) -> Self {
        Self { id, by }
    }
}

impl Requirements {
    /// Whether the edition asks for this requirement, such as `HS-9`.
    pub fn has(&self, id: &str) -> bool {
        match self.replaced_by(id) {
            Some(by) => by.contains(&id),
            None => {
                self.added.iter().any(|numbers| numbers.has(id))
                    || self.before.is_some_and(|before| before.has(id))
            }
        }
    }

    /// What this edition itself, and not one before it, asks for instead of a requirement; `None` if it does not replace it.
    pub fn replaced_by(&self, id: &str) -> Option<&'static [&'static str]> {
        self.replaced.iter().find(|replaced| replaced.id == id).map(|replaced| replaced.by)
    }
}

/// The file that numbers them.
const FILE: &str = include_str!("../REQUIREMENTS.md");

/// What a requirement asks for, in a sentence, with its places in the document behind it; `None` where there is no such requirement.
///
/// ```
/// let sentence = adsdv_spec::requirement("FIN-2").expect("it stands in REQUIREMENTS.md");
/// assert_eq!(sentence, "The AI Computer MUST stop the vehicle with the service brake at the end of each event (3.3).");
/// assert_eq!(adsdv_spec::requirement("FIN-99"), None);
/// ```
pub fn requirement(id: &str) -> Option<&'static str> {
    let item = |line: &'static str| line.strip_prefix("- **")?.strip_prefix(id)?.strip_prefix("** ");
    FILE.lines().find_map(item)
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::vec;
    use std::vec::Vec;

    use super::*;

    #[test]
    fn a_requirement_has_its_own_sentence() {
        let first = requirement("HS-1").expect("it stands in REQUIREMENTS.md");
        assert!(first.starts_with("The ") && first.ends_with(").") && !first.contains("**"), "{first}");
        assert_ne!(Some(first), requirement("HS-10"));
        assert_eq!((requirement("HS"), requirement("")), (None, None));
    }

    #[test]
    fn what_is_replaced_by_itself_among_others_still_holds() {
        let requirements = Requirements {
            before: None,
            added: Vec::leak(vec![Numbers::new("HS", 1, 2)]),
            replaced: Vec::leak(vec![Replaced::new("HS-1", &["HS-1", "HS-2"]), Replaced::new("HS-2", &[])]),
        };
        assert!(requirements.has("HS-1") && !requirements.has("HS-2") && !requirements.has("HS-3"));
    }

    #[test]
    fn a_requirement_has_one_name() {
        let requirements =
            Requirements { before: None, added: Vec::leak(vec![Numbers::new("HS", 0, 12)]), replaced: &[] };
        assert!(requirements.has("HS-1") && requirements.has("HS-12"));
        for other in ["HS-01", "HS-+1", "HS-0", "HS-", "HS1", "HS--1", " HS-1", "HS-1 "] {
            assert!(!requirements.has(other), "{other}");
        }
    }
}
