//! The step on what may be is sound: what a VCU remembers after a step is of what
//! [`Machine::react_known`](adsdv_spec::Machine::react_known) allows, for whatever it remembered, saw and whatever time passed of
//! what was allowed.
//!
//! The whole is too much for one proof: bounds, times, memory and the table at once had no answer in ten minutes. But it is made of
//! factors, each the twin of one of [`Machine::react`](adsdv_spec::Machine::react), and each is proven by itself to be
//!
//! - sound: what is so of what was allowed is allowed afterwards;
//! - exact: where all is known, all is known afterwards, and it is what the concrete factor says;
//! - monotone: who knows less before knows no more afterwards.
//!
//! | factor | its concrete twin | file |
//! |---|---|---|
//! | `Span::counted_up`, `given`, `or` | a timer | [`span`] |
//! | `Handshakes::step`, `given_lost`, `is_lost` | `Handshake::step` | [`handshakes`] |
//! | `Glimpse::new`, `Machine::known_atoms_of` | `Observation::new`, `Machine::atoms_of` | [`glimpse`] |
//! | `Machine::known_atoms` | `Machine::control_atoms` | [`atoms`] |
//! | `Machine::look`, and with it `outcomes` | `Machine::first_arrow` | [`outcomes`] |
//! | `Machine::remember_known` | `Machine::remember` | [`remember`] |
//! | `Causes`, `KnownFaults` | `Faults::cause` and the flags | [`causes`] |
//! | `Memory::or`, `Belief::or`, `covers` | | [`joins`] |
//!
//! Why that is enough. Take a control state, an observation and a time that are allowed. The conditions of the inputs are of
//! what `known_atoms_of` allows, so whether the handshake is performed, and what its answer is, are of the truths that are read
//! from there; so the handshake after the step is of what `Handshakes::step` allows, and the time in the state of what
//! `counted_up` does. Communication is lost or not, and the time has come or not: of the four cases that
//! `react_known` goes through, one is this one, and what is left of the handshake and of the timer in it (`given_lost`, `given`)
//! still allows them. In that case the conditions are of what `known_atoms` allows; one of the outcomes is the arrow that is
//! taken, with conditions that still allow those that there are; and what `remember_known` makes of it allows what is remembered.
//! The belief afterwards is the join of all cases, and a join allows what each of its parts does. Each link of this chain is exact
//! and monotone too, and so is the chain; where all is known, every case but one is empty.
//!
//! What joins the factors, the loop over the cases, has no harness. It is run whole on random beliefs, of every edition and
//! under any readings, by the fuzzer `belief` and the property tests of `adsdv-tests`.

use adsdv_spec::Knowledge;

mod around;
pub mod atoms;
pub mod causes;
pub mod glimpse;
pub mod handshakes;
pub mod joins;
pub mod outcomes;
pub mod remember;
pub mod span;

/// Whether one knowledge allows all that the other does.
const fn covers(one: Knowledge, other: Knowledge) -> bool {
    one.on().is_subset(other.on()) && one.off().is_subset(other.off())
}
