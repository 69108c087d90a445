//! What the sweep prints of readings that cost something, and of those that cost nothing.

use adsdv_model::closed::{CLOSED_PROPERTIES, Closed, Operator};
use adsdv_model::{ClosedCost, Cost, Run, Sweep};
use adsdv_spec::{Choice, Choices, Edition, Machine, Readings};
use expect_test::expect_file;

use crate::{SHORT, verified};

fn others() -> Vec<Choice> {
    Edition::DEFAULT.alternatives().iter().collect()
}

/// A property or a goal that fails under these of the other choices.
fn fails(name: &'static str, under: &[usize], undone_by: &[usize]) -> Cost {
    let others = others();
    let choices =
        |places: &[usize]| places.iter().map(|&place| others[place]).fold(Choices::NONE, Choices::with);
    let run = verified(&SHORT).runs.remove("arrow-3.5");
    Cost { edition: Edition::DEFAULT, name, choices: choices(under), undone_by: choices(undone_by), run }
}

fn printed(complete: bool, costs: Vec<Cost>, closed: Vec<ClosedCost>) -> String {
    let all = Sweep { edition: Edition::DEFAULT, combinations: 5, transitions: 7, complete, costs, closed }
        .to_string();
    // The introduction says the same each time.
    let begin = all.find("5 combinations").expect("so many were given");
    all[begin..].to_owned()
}

#[test]
fn what_the_readings_cost() {
    let model = Closed::scaled(*Edition::DEFAULT, Readings::DEFAULT, Operator::Any);
    let run = model.clone().run_for("emergency-can-happen").expect("it can");
    let inputs = model.inputs_for(&Machine::REFERENCE, &run);
    let closed = ClosedCost {
        property: &CLOSED_PROPERTIES[1],
        choice: others()[3],
        run: Run::seeing(&Machine::REFERENCE, inputs),
    };
    let together = vec![
        fails("ready-asms", &[2], &[]),
        fails("driving-sdc", &[0, 4], &[5, 6]),
        fails("ready-sdc", &[2], &[7]),
        fails("arrow-3.9", &[1], &[]),
    ];
    let alone = vec![fails("go-signal", &[1], &[]), fails("driving-due", &[3], &[])];
    let all = [
        printed(true, Vec::new(), Vec::new()),
        printed(true, alone, Vec::new()),
        printed(true, together, vec![closed]),
        printed(false, vec![fails("ready-asms", &[], &[])], Vec::new()),
    ];
    expect_file!["readings.txt"].assert_eq(&all.join("\n================\n\n"));
}
