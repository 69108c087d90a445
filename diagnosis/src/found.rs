//! What is found out about a program.

use adsdv_spec::Choice;
use adsdv_spec::messages::AsState;

use crate::deviation::Deviation;
use crate::record::Record;

/// What a program does otherwise.
#[derive(Clone, Debug)]
pub struct Diagnosis {
    /// The deviations, in the order in which they were found.
    pub deviations: Vec<Deviation>,
    /// The answers to questions that the document leaves open, where they are not the edition's: all else is by these.
    pub readings: Vec<Choice>,
    /// What was asked and answered, and none of them explains.
    pub unexplained: Vec<Record>,
    /// How many experiments there were.
    pub experiments: usize,
    /// The outputs that were left out, for no deviation explains what they show. All else is about the others.
    pub left_out: Vec<&'static str>,
    /// Whether the time was over before all was tried: there may be more, and what was found may be otherwise.
    pub cut: bool,
    /// The states that the program did not show, or in which some of its answers are not explained.
    pub unclear: Vec<AsState>,
    /// The arrows of which nothing is known: the program did not show what it does there, or what it did is not explained.
    pub not_shown: Vec<(AsState, AsState)>,
    /// Whether it answered alike what it was asked again. If not, it goes by chance or a clock, or keeps something over a reset, and
    /// nothing that is said of it is sure.
    pub repeats: bool,
}
