//! Figure 2 as the program does it: as text, and drawn.

use std::fmt::{self, Write as _};
use std::fs;
use std::path::Path;

use adsdv_diagnosis::Arrow;
use adsdv_spec::export::{Drawing, DrawnArrow, Mark};

use crate::error::Error;
use crate::layout::wrapped;
use crate::report::style::{self, Styled};

/// As text: of an arrow that is the document's only where it leads.
pub(super) fn write(out: &mut String, arrows: &[Arrow], width: usize) -> fmt::Result {
    writeln!(out, "\n{}", Styled(style::HEADING, "FIGURE 2 AS THE PROGRAM DOES IT"))?;
    for arrow in arrows {
        let Arrow { from, to, section, guard, otherwise, missing, not_shown } = arrow;
        let (leads, section) = (format!("{from} -> {to}"), section.map_or("-", |section| section));
        match mark(arrow) {
            Mark::Usual if *not_shown => {
                writeln!(out, "  {leads:34} {section:5} {}", Styled(style::QUIET, "not shown"))?;
                continue;
            }
            Mark::Usual => {
                writeln!(out, "  {leads:34} {section:5} as in the document")?;
                continue;
            }
            Mark::Missing => writeln!(out, "  {leads:34} {section:5} {}", Styled(style::BAD, "missing"))?,
            Mark::Differs => writeln!(out, "  {leads:34} {section:5} {}", Styled(style::BAD, "differs"))?,
        }
        for text in otherwise {
            wrapped(out, text.split(' '), 6, width);
        }
        if !missing {
            for (place, term) in guard.iter().enumerate() {
                let term = if place == 0 { format!("guard: {term}") } else { format!("or {term}") };
                let mut lines = String::new();
                wrapped(&mut lines, term.split(' '), 6, width);
                writeln!(out, "{}", Styled(style::QUIET, lines.trim_end_matches('\n')))?;
            }
        }
    }
    Ok(())
}

pub(super) fn mark(arrow: &Arrow) -> Mark {
    match arrow {
        Arrow { missing: true, .. } => Mark::Missing,
        Arrow { section: None, .. } => Mark::Differs,
        Arrow { otherwise, .. } if otherwise.is_empty() => Mark::Usual,
        _ => Mark::Differs,
    }
}

/// Writes the figure into a file: in the language of Graphviz if its name ends so, else as Mermaid.
pub(super) fn draw(path: &Path, title: &str, arrows: &[Arrow]) -> Result<(), Error> {
    let labels: Vec<String> = arrows.iter().map(label).collect();
    let drawn: Vec<DrawnArrow<'_>> = arrows
        .iter()
        .zip(&labels)
        .map(|(arrow, label)| DrawnArrow { from: arrow.from, to: arrow.to, label, mark: mark(arrow) })
        .collect();
    let drawing = Drawing { title, arrows: &drawn };
    let is_dot = path.extension().is_some_and(|ending| ending == "dot" || ending == "gv");
    let text = if is_dot { drawing.dot().to_string() } else { drawing.mermaid().to_string() };
    fs::write(path, text).map_err(|error| Error {
        what: path.display().to_string(),
        why: format!("cannot write the figure: {error}"),
        hint: "name a file that can be written, such as figure.mmd or figure.dot".to_owned(),
    })
}

fn label(Arrow { section, guard, otherwise, not_shown, .. }: &Arrow) -> String {
    let section = section.map(|section| format!("section {section}"));
    let guard = guard.iter().enumerate().map(|(place, term)| {
        let term = term.replace(" and ", "\nand ");
        if place == 0 { term } else { format!("or {term}") }
    });
    let not_shown = not_shown.then(|| "not shown".to_owned());
    section
        .into_iter()
        .chain(not_shown)
        .chain(otherwise.iter().cloned())
        .chain(guard)
        .collect::<Vec<_>>()
        .join("\n")
}
