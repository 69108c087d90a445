//! The three prints of Figure 2, under every choice of every reading: they say what the table says, the same in
//! every format, and a label never ends where its text does not.

use adsdv_spec::export::{Dot, Figure2, Mermaid};
use adsdv_spec::messages::MissionStatus;
use adsdv_spec::table::Row;
use adsdv_spec::{AsState, Choice, Control, Edition, Inputs, Machine, Readings, ShutdownCircuit};

/// An arrow as it is printed: from, to, section, and the alternatives of the guard.
type Printed = (String, String, String, Vec<String>);

fn machines() -> impl Iterator<Item = Machine> {
    Choice::ALL.iter().map(|&choice| Machine::new(*Edition::DEFAULT, Readings::DEFAULT.with(choice)))
}

/// An arrow and the conditions of its alternatives, each read from the table once more.
fn from_table(row: &Row, readings: Readings) -> Printed {
    let terms = row.terms().iter().filter(|term| term.readings.iter().all(|choice| readings.is(choice)));
    let alternatives = terms.map(|term| {
        let conditions: Vec<_> = term
            .literals()
            .map(|(atom, value)| Edition::DEFAULT.rules.text(atom, value).to_string())
            .collect();
        let section =
            if term.section == row.section { String::new() } else { format!(" ({})", term.section) };
        conditions.join(" and ") + &section
    });
    (row.from.to_string(), row.to.to_string(), row.section.to_owned(), alternatives.collect())
}

/// Undoes the escapes of a format, in the order given.
fn plain(text: &str, escapes: &[(&str, &str)]) -> String {
    escapes.iter().fold(text.to_owned(), |text, (escape, meant)| text.replace(escape, meant))
}

fn alternatives(guard: &str) -> Vec<String> {
    guard.replace("\nand ", " and ").split("\nor ").map(str::to_owned).collect()
}

/// An arrow of a diagram, whose label begins with the section.
fn from_diagram(from: &str, to: &str, label: &str) -> Printed {
    let (section, guard) = label.split_once('\n').expect("a label of two or more lines");
    let section = section.strip_prefix("section ").expect("a label that begins with its section");
    (from.to_owned(), to.to_owned(), section.to_owned(), alternatives(guard))
}

fn markdown(machine: &Machine) -> Vec<Printed> {
    let text = Figure2(machine).to_string();
    let rows = text.lines().skip(2).map(|line| {
        let cells: Vec<_> = line.split(" | ").collect();
        let [from, to, section, guard] = cells[..] else { panic!("not four cells: {line}") };
        let guard = guard.strip_suffix(" |").expect("the end of the row");
        let guard = plain(guard, &[("<br>", "\n"), ("&lt;", "<"), ("&amp;", "&")]);
        (from.trim_start_matches("| ").to_owned(), to.to_owned(), section.to_owned(), alternatives(&guard))
    });
    rows.collect()
}

fn mermaid(machine: &Machine) -> Vec<Printed> {
    let escapes = [("<br/>", "\n"), ("#quot;", "\""), ("#lt;", "<"), ("#gt;", ">")];
    let text = Mermaid(machine).to_string();
    let arrows =
        text.lines().filter_map(|line| line.split_once(" --> ")).filter(|(from, _)| !from.contains('*'));
    arrows
        .map(|(from, rest)| {
            let (to, label) = rest.split_once(" : ").expect("a label");
            let bare = escapes.iter().fold(label.to_owned(), |label, (escape, _)| label.replace(escape, ""));
            assert!(
                !bare.contains(['"', '<', '>', ':', ';', '#']),
                "would end the label, or be lost: {label}"
            );
            from_diagram(from.trim(), to, &plain(label, &escapes))
        })
        .collect()
}

fn dot(machine: &Machine) -> Vec<Printed> {
    let text = Dot(machine).to_string();
    let arrows =
        text.lines().filter_map(|line| line.split_once(" [label=\"")).filter(|(edge, _)| edge.contains("->"));
    arrows
        .map(|(edge, rest)| {
            let (from, to) = edge.split_once(" -> ").expect("an edge");
            let label = rest.strip_suffix("\\l\"];").expect("a label that ends its line");
            assert!(!label.replace("\\\"", "").contains('"'), "would end the label: {label}");
            from_diagram(from.trim(), to, &plain(label, &[("\\l", "\n"), ("\\\"", "\"")]))
        })
        .collect()
}

#[test]
fn every_print_says_what_the_table_says() {
    for machine in machines() {
        let readings = machine.readings();
        let mut table: Vec<_> =
            Edition::DEFAULT.rules.table.rows().iter().map(|row| from_table(row, readings)).collect();
        table.sort();
        for (format, mut printed) in
            [("Markdown", markdown(&machine)), ("Mermaid", mermaid(&machine)), ("DOT", dot(&machine))]
        {
            printed.sort();
            assert_eq!(printed, table, "{format}, read with {readings}");
        }
    }
}

/// Every arrow that can be taken in a state, at once: the machine takes the one that is printed first.
#[test]
fn arrows_stand_in_the_order_of_evaluation() {
    let at_once = |state| {
        let mut inputs = Inputs {
            sdc: ShutdownCircuit { vehicle_estop: true, ..Default::default() },
            ..Inputs::default()
        };
        inputs.asms = state == AsState::Driving;
        inputs.ai.status.mission_status = MissionStatus::Finished;
        inputs
    };
    for machine in machines() {
        for state in [AsState::Ready, AsState::Driving, AsState::Finished] {
            let control = Control { state, ..Control::INITIAL };
            let (control, _) = machine.step(&control, &at_once(state), 10);
            let first = mermaid(&machine).into_iter().find(|(from, ..)| *from == state.to_string());
            assert_eq!(
                first.map(|(_, to, ..)| to),
                Some(control.state.to_string()),
                "{}",
                machine.readings()
            );
        }
    }
}

#[test]
fn a_diagram_names_the_readings_that_are_not_the_default() {
    let machine = Machine::new(*Edition::DEFAULT, Readings::DEFAULT.with(Choice::FaultEdge));
    for text in [Mermaid(&machine).to_string(), Dot(&machine).to_string()] {
        let title = text.lines().next().unwrap_or_default();
        assert!(title.ends_with("Specification 3.0, read with fault-trigger=edge"), "{title}");
    }
}
