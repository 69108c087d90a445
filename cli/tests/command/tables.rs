//! The tables that are printed are the specification's own exports.

use adsdv_spec::export::{Dbc, Dot, Figure2, Mermaid};
use adsdv_spec::{Choice, Edition, Machine, Readings};

use crate::run::run;

#[test]
fn the_database() {
    let dbc = run(&["dbc"]);
    assert_eq!((dbc.status, dbc.stdout), (Some(0), Dbc(Edition::DEFAULT).to_string()));
}

#[test]
fn figure_2_in_each_language() {
    let machine = Machine::REFERENCE;
    assert_eq!(run(&["diagram"]).stdout, Mermaid(&machine).to_string());
    assert_eq!(run(&["diagram", "--format", "mermaid"]).stdout, Mermaid(&machine).to_string());
    assert_eq!(run(&["diagram", "--format", "dot"]).stdout, Dot(&machine).to_string());
    assert_eq!(run(&["diagram", "--format", "markdown"]).stdout, Figure2(&machine).to_string());
}

#[test]
fn figure_2_under_other_readings() {
    let readings = Readings::DEFAULT.with(Choice::CommsNoArrow).with(Choice::FaultEdge);
    let machine = Machine::new(*Edition::DEFAULT, readings);
    let printed =
        run(&["diagram", "--reading", "comms-lost=no-arrow", "--reading", "fault-trigger=edge"]).stdout;
    assert_eq!(printed, Mermaid(&machine).to_string());
    assert_ne!(printed, Mermaid(&Machine::REFERENCE).to_string());
}
