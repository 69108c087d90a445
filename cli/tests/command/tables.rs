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
    // Behind the line that says the edition.
    let run = |args: &[&str]| {
        let printed = crate::run::run(args).stdout;
        printed.split_once('\n').map_or_else(String::new, |(_, rest)| rest.to_owned())
    };
    assert_eq!(run(&["diagram"]), Mermaid(&machine).to_string());
    assert_eq!(run(&["diagram", "--format", "mermaid"]), Mermaid(&machine).to_string());
    assert_eq!(run(&["diagram", "--format", "dot"]), Dot(&machine).to_string());
    assert_eq!(run(&["diagram", "--format", "markdown"]), format!("\n{}", Figure2(&machine)));
}

#[test]
fn figure_2_under_other_readings() {
    let readings = Readings::DEFAULT.with(Choice::CommsNoArrow).with(Choice::FaultEdge);
    let machine = Machine::new(*Edition::DEFAULT, readings);
    let printed =
        run(&["diagram", "--reading", "comms-lost=no-arrow", "--reading", "fault-trigger=edge"]).stdout;
    let (_, printed) = printed.split_once('\n').expect("the line that says the edition");
    assert_eq!(printed, Mermaid(&machine).to_string());
    assert_ne!(printed, Mermaid(&Machine::REFERENCE).to_string());
}
