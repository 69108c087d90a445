//! What may be: each part allows exactly what it should, tried on all values of small domains, and the whole step on random
//! ones.

mod examples;
mod faults;
mod glimpse;
mod handshakes;
mod joins;
mod span;
mod step;

use adsdv_spec::Truth;

/// The three truths.
const TRUTHS: [Truth; 3] = [Truth::False, Truth::Unknown, Truth::True];

/// What can be said of something that came out in these ways.
fn claimed(ways: &[bool]) -> Truth {
    match (ways.contains(&true), ways.contains(&false)) {
        (true, false) => Truth::True,
        (false, true) => Truth::False,
        _ => Truth::Unknown,
    }
}
