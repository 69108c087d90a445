//! Figure 2 as a machine reads it: where it is drawn, and its arrows with their guards.

use adsdv_report::Picture;
use adsdv_spec::{AsState, Machine};
use serde::{Serialize, Serializer};

/// The figure.
#[derive(Serialize)]
pub(crate) struct FigureJson {
    picture: Picture,
    arrows: Vec<ArrowJson>,
}

#[derive(Serialize)]
struct ArrowJson {
    #[serde(serialize_with = "name")]
    from: AsState,
    #[serde(serialize_with = "name")]
    to: AsState,
    section: &'static str,
    /// The alternatives of the guard, each of which takes the arrow.
    terms: Vec<TermJson>,
}

#[derive(Serialize)]
struct TermJson {
    section: &'static str,
    conditions: Vec<ConditionJson>,
}

#[derive(Serialize)]
struct ConditionJson {
    atom: &'static str,
    /// What it has to be.
    value: bool,
    text: String,
}

impl FigureJson {
    pub(crate) fn of(machine: &Machine) -> Self {
        let arrows: Vec<ArrowJson> = AsState::ALL.iter().flat_map(|state| arrows(machine, *state)).collect();
        let ends: Vec<(AsState, AsState)> = arrows.iter().map(|arrow| (arrow.from, arrow.to)).collect();
        Self { picture: Picture::of(&ends), arrows }
    }
}

fn name<S: Serializer>(state: &AsState, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(state.name())
}

/// The arrows of a state, in the order in which they are evaluated.
fn arrows(machine: &Machine, from: AsState) -> Vec<ArrowJson> {
    let rules = &machine.edition().rules;
    let mut rows: Vec<(u8, ArrowJson)> = Vec::new();
    for taken in machine.arrows(from) {
        let (Some(row), Some(term)) = (taken.row(&rules.table), taken.term(&rules.table)) else { continue };
        let condition = |(atom, value)| ConditionJson {
            atom: adsdv_spec::Atom::id(atom),
            value,
            text: rules.text(atom, value).to_string(),
        };
        let term = TermJson { section: term.section, conditions: term.literals().map(condition).collect() };
        if let Some((_, arrow)) = rows.iter_mut().find(|(place, _)| *place == taken.row) {
            arrow.terms.push(term);
        } else {
            let (from, to) = (row.from, row.to);
            rows.push((taken.row, ArrowJson { from, to, section: row.section, terms: vec![term] }));
        }
    }
    rows.into_iter().map(|(_, arrow)| arrow).collect()
}
