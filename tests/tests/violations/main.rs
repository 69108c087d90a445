//! For each row, term and threshold of the table a log in which exactly that is violated, and exactly that is reported;
//! beside it a conforming log of which nothing is said. Both also with 5 ms of jitter, and with frames lost.
//!
//! [`cases`] lists the literals of Figure 2 from the table itself, so that a new row is tested at once.

mod cases;
mod check;
mod said;

mod ai;
mod causes;
mod edges;
mod flags;
mod go;
mod handshake;
mod logs;
mod no_arrow;
mod not_taken;
mod online;
mod priorities;
mod thresholds;
mod timers;
mod values;
mod wrongly_taken;
