//! Figure 2 as a program does it: each of its arrows, with what is otherwise about it.

use adsdv_spec::{AsState, Edition, Row, Term};

use crate::deviation::Deviation;
use crate::model::Model;

/// An arrow as the program takes it, or as it should.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Arrow {
    /// Where it begins.
    pub from: AsState,
    /// Where it leads.
    pub to: AsState,
    /// The section of the document; `None` for an arrow that the document does not have.
    pub section: Option<&'static str>,
    /// The alternatives of its guard, each in words.
    pub guard: Vec<String>,
    /// What is otherwise than in the document, in words; none: it is the document's arrow.
    pub otherwise: Vec<String>,
    /// Whether it is the document's, and the program never takes it.
    pub missing: bool,
    /// Whether nothing is known of it.
    pub not_shown: bool,
}

/// The arrows of a program that deviates in this way, and did not show some of them: those of one state in the order in which they are tried, then those that the
/// document has and the program does not.
pub fn figure(edition: &Edition, deviations: &[Deviation], not_shown: &[(AsState, AsState)]) -> Vec<Arrow> {
    let model = Model::new(edition, deviations);
    let machine = model.machine();
    let table = &machine.edition().rules.table;
    let mut arrows: Vec<(u8, Arrow)> = Vec::new();
    for state in AsState::ALL {
        for taken in machine.arrows(state) {
            let (Some(row), Some(term)) = (taken.row(table), taken.term(table)) else { continue };
            let guard = in_words(machine.edition(), &model, row, term);
            match arrows.last_mut() {
                Some((place, arrow)) if *place == taken.row && arrow.from == state => arrow.guard.push(guard),
                _ => arrows.push((
                    taken.row,
                    Arrow {
                        from: state,
                        to: row.to,
                        section: Some(row.section),
                        guard: vec![guard],
                        otherwise: Vec::new(),
                        missing: false,
                        not_shown: false,
                    },
                )),
            }
        }
    }
    let mut arrows: Vec<Arrow> = arrows.into_iter().map(|(_, arrow)| arrow).collect();
    add_those_beside(edition, deviations, &mut arrows);
    mark(edition, deviations, &mut arrows);
    for arrow in &mut arrows {
        // What is otherwise about it the program did show.
        arrow.not_shown =
            !arrow.missing && arrow.otherwise.is_empty() && not_shown.contains(&(arrow.from, arrow.to));
    }
    arrows
}

/// Arrows that the document does not have, and those of it that are gone.
fn add_those_beside(edition: &Edition, deviations: &[Deviation], arrows: &mut Vec<Arrow>) {
    for deviation in deviations {
        if let Deviation::Also { from, to, .. } = deviation {
            let guard = vec![deviation.condition(edition).unwrap_or_default()];
            let arrow = Arrow {
                from: *from,
                to: *to,
                section: None,
                guard,
                otherwise: Vec::new(),
                missing: false,
                not_shown: false,
            };
            arrows.push(arrow);
        }
    }
    let usual = Model::new(edition, &[]);
    for row in edition.rules.table.rows() {
        if arrows.iter().any(|arrow| (arrow.from, arrow.to) == (row.from, row.to)) {
            continue;
        }
        let guard = row.terms().iter().map(|term| in_words(edition, &usual, row, term)).collect();
        let (section, otherwise) = (Some(row.section), Vec::new());
        arrows.push(Arrow {
            from: row.from,
            to: row.to,
            section,
            guard,
            otherwise,
            missing: true,
            not_shown: false,
        });
    }
}

/// Says of each arrow what is otherwise about it.
fn mark(edition: &Edition, deviations: &[Deviation], arrows: &mut [Arrow]) {
    for deviation in deviations {
        let text = deviation.text(edition).to_string();
        for arrow in &mut *arrows {
            let is_its_own = deviation.arrows(edition).contains(&(arrow.from, arrow.to));
            if is_its_own && !arrow.otherwise.contains(&text) {
                arrow.otherwise.push(text.clone());
            }
        }
    }
}

/// The conditions of an alternative, with what the program needs besides.
fn in_words(edition: &Edition, model: &Model, row: &Row, term: &Term) -> String {
    let own = term.literals().map(|(atom, on)| edition.rules.text(atom, on).to_string());
    let besides = model.needs((row.from, row.to)).map(|(field, raw, is)| {
        format!(
            "{} {} {}",
            field.key,
            if is { "==" } else { "!=" },
            crate::words::input(edition, field.key, raw)
        )
    });
    own.chain(besides).collect::<Vec<_>>().join(" and ")
}
