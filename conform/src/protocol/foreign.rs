//! Names that a program answers, and that no enumeration has.
//!
//! A field is a number, so that answers are small and quick to compare. A name without one gets a number of its own, far from
//! all that the bus can carry, for as long as this process runs; by that number it is found again to be printed.

use std::sync::{Mutex, PoisonError};

/// So many different names are kept. A program that makes up more of them does not speak the protocol.
const MOST: usize = 256;
/// No longer name is kept, in bytes.
const LONGEST: usize = 64;
/// The number of the first name.
const FIRST: i32 = i32::MIN;

static NAMES: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// The number of a name; `None` if it is too long, or if there are too many already.
pub(super) fn number(name: &str) -> Option<i32> {
    let mut names = NAMES.lock().unwrap_or_else(PoisonError::into_inner);
    let place = match names.iter().position(|known| known == name) {
        Some(place) => place,
        None if names.len() < MOST && name.len() <= LONGEST => {
            names.push(name.to_owned());
            names.len() - 1
        }
        None => return None,
    };
    FIRST.checked_add(i32::try_from(place).ok()?)
}

/// The name with this number, if it is the number of one.
pub(super) fn name(number: i32) -> Option<String> {
    let place = usize::try_from(number.checked_sub(FIRST)?).ok()?;
    NAMES.lock().unwrap_or_else(PoisonError::into_inner).get(place).cloned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_found_again_by_its_number() {
        let (limp, braking) = (number("AS_LIMP_HOME"), number("AS_BRAKING"));
        assert!(limp.is_some() && limp != braking);
        assert_eq!(number("AS_LIMP_HOME"), limp);
        assert_eq!(limp.and_then(name).as_deref(), Some("AS_LIMP_HOME"));
        assert_eq!([0, 1, -1, i32::MAX].map(name), [const { None }; 4]);
    }

    #[test]
    fn a_name_of_no_end_is_none() {
        assert_eq!(number(&"A".repeat(LONGEST + 1)), None);
    }
}
