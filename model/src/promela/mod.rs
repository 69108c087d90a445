//! The open model in Promela, so that Spin checks it independently.
//!
//! The text is written from the table: every row, term, condition, fault number, time and property that is data. What is
//! written by hand here, a second time beside [`Machine::react`](adsdv_spec::Machine::react), is what a step is: how the
//! timers count, how the handshake runs, what is remembered. Two programs that share only the table then agree, or one of
//! them is wrong.
//!
//! | file | what it writes |
//! |---|---|
//! | `words` | conditions, in Promela and in the words of Figure 2 |
//! | `choice` | what the environment chooses in a cycle |
//! | `frame` | what a step is |
//! | `checks` | the properties and the goals |

mod checks;
mod choice;
mod frame;
mod words;

use std::fmt;

use adsdv_spec::messages::AsState;
use adsdv_spec::{Edition, Machine, Timing};

use crate::document::Document;
use crate::vectors::Vectors;

/// Displays the open model of a machine in Promela, for Spin.
///
/// The text says at its head how it is run. The verifier prints the name of each property that is violated and of each goal
/// that is reached, and counts the control states.
///
/// ```
/// use adsdv_model::{Promela, Vectors};
/// use adsdv_spec::{Edition, Machine};
///
/// let document = Edition::DEFAULT.rules.timing;
/// let text = Promela { machine: &Machine::REFERENCE, document, vectors: Vectors::Read }.to_string();
/// assert!(text.contains("/* 3.6: AS master switch OFF */\n        :: !asms -> next = AS_OFF\n"));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Promela<'a> {
    /// The machine.
    pub machine: &'a Machine,
    /// The times that the properties speak of: the document's, but for a model with other timers.
    pub document: Timing,
    /// The input vectors that are tried at each control state: the same as in the model that stateright explores.
    pub vectors: Vectors,
}

impl fmt::Display for Promela<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let machine = self.machine;
        self.head(f)?;
        frame::constants(f, self)?;
        frame::control_state(f, machine)?;
        words::inputs(f, machine)?;
        frame::conditions(f, machine)?;
        checks::reports(f, Document::of_machine(machine))?;
        choice::inlines(f, machine)?;
        frame::inlines(f, machine)?;
        for from in AsState::ALL {
            frame::step(f, machine, from)?;
        }
        f.write_str("active proctype vcu() {\n    do\n")?;
        for from in AsState::ALL {
            choice::cycles(f, self, from)?;
        }
        frame::power_cycle(f)?;
        f.write_str("    od\n}\n")
    }
}

impl Promela<'_> {
    fn head(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Edition { document, readings: usual, .. } = self.machine.edition();
        let readings = self.machine.readings();
        writeln!(f, "/* The AS state machine of the {document}, sections 2.4 and 3,")?;
        if readings != *usual {
            writeln!(f, " * read with {readings},")?;
        }
        f.write_str(HEAD)?;
        f.write_str(match self.vectors {
            Vectors::Every => EVERY,
            Vectors::Read => READ,
            Vectors::Few => FEW,
        })
    }
}

const HEAD: &str = " * with any AI Computer, any driver and any fault. Written by adsdv from its table; not to be edited.
 *
 *     spin -a vcu.pml
 *     gcc -O2 -DSAFETY -DNOREDUCE -DNOCOMP -o pan pan.c
 *     ./pan -m1000000 -w20
 *
 * pan prints \"violated: NAME\" for each property that some step breaks, and \"reached: NAME\" for each arrow, cause and
 * mission that is seen, once each and in no order. It goes on to the end all the same: \"states, stored\" is the number of
 * control states that can be reached, and the transitions are the steps out of all of them, and one power cycle each.
 * The result counts only if pan did not stop early: no \"error:\", no \"max search depth too small\".
 *
 * A state is the control state between two cycles. A cycle is atomic: the inputs are chosen, then the step is made. The
 * inputs are hidden, for they are no part of the state. The rows of a state stand in the order in which they are evaluated:
 * within a d_step, Spin takes the first option that it can take.
 *
";

const EVERY: &str = " * In every cycle all faults are chosen, and all conditions that the rows of the state, the handshake and the memory
 * mention. The others cannot matter; they are off.
 */
";

const READ: &str = " * In every cycle those conditions are chosen that can still matter, and at most one of the faults that open the shutdown
 * circuit. The others cannot matter; they are off.
 */
";

const FEW: &str = " * In every cycle those conditions are chosen that can still matter, and one fault that opens the shutdown circuit. The
 * others cannot matter, but for the cause; they are off.
 */
";
