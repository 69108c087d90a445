//! A scenario of the exam: what the operator does, what goes wrong, and what is expected of the AI Computer.

use adsdv_can::car::Physics;

use crate::disturbance::Disturbance;
use crate::expectation::Expectation;

/// A scenario. All of it is data.
#[derive(Clone, Debug)]
pub struct ExamScenario {
    /// Its name, such as `go-late`.
    pub name: String,
    /// What it is about, in a few words.
    pub about: String,
    /// What the operator does, as a [scenario](adsdv_can::scenario) of `adsdv demo`.
    pub operator: String,
    /// What goes wrong.
    pub disturbances: Vec<Disturbance>,
    /// What is expected of the AI Computer, beside what the judge finds by itself.
    pub expects: Vec<&'static Expectation>,
    /// When the VCU is switched on, in milliseconds.
    pub vcu_starts_ms: u64,
    /// When the AI Computer is.
    pub ai_starts_ms: u64,
    /// The vehicle; as text a scenario has the default one, or one with weak brakes.
    pub physics: Physics,
}
