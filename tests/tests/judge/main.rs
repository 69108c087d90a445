//! The judge, on recordings of a simulated bus. One program: it is built anew for every mutant that `scripts/mutants.sh` makes.
//!
//! For each row, term and threshold of the table there is a log in which exactly that is violated, and exactly that is reported;
//! beside it a conforming log of which nothing is said. Both also with 5 ms of jitter, and with frames lost. [`cases`] lists the
//! literals of Figure 2 from the table itself, so that a new row is tested at once.
//!
//! [`conforming`] is what the reference VCU does whatever happens, and [`anything`] what any VCU does; [`curated`] holds what is
//! said of some sixty runs to the letter, and what holds of any run; and [`online`] is the judge while the bus goes on.

mod alike;
mod anything;
mod conforming;
mod curated;
mod online;
mod response;

mod cases;
mod check;

mod ai;
mod causes;
mod edges;
mod exercised;
mod flags;
mod go;
mod handshake;
mod likely;
mod limits;
mod logs;
mod margins;
mod much;
mod named;
mod no_arrow;
mod not_taken;
mod priorities;
mod recognise;
mod silent;
mod thresholds;
mod timers;
mod v2026;
mod v4_0;
mod values;
mod vcu_status;
mod why;
mod wrongly_taken;
