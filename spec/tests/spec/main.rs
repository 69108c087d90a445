//! The specification's own tests, in one program: it is built anew for every mutant that `scripts/mutants.sh` makes.

mod alias;
mod belief;
mod codec;
mod consistent;
mod drawing;
mod edition;
mod faults;
#[cfg(any(feature = "arbitrary", feature = "proptest"))]
mod generators;
mod golden;
mod handshake;
mod memory;
mod mutation;
mod outputs;
mod possible;
mod random;
mod readings;
mod reads;
mod receive;
mod requirements;
mod reserved;
mod rows;
#[cfg(feature = "serde")]
mod serde;
mod show;
mod small;
mod truth;
mod v2026;
mod v4_0;
