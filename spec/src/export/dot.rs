//! Figure 2 as a Graphviz digraph.

use core::fmt;

use super::arrows::{Label, Title, arrows};
use super::escape::Escaped;
use super::light::{Background, Paint};
use super::mark::Mark;
use super::mermaid::in_title;
use crate::messages::AsState;
use crate::{Assi, Control, Machine};

/// The guard of section 3.2 would otherwise be wider than the rest of the graph.
const CONDITIONS_PER_LINE: usize = 2;

/// Displays Figure 2 as a Graphviz digraph, for `dot -Tsvg`.
///
/// ```
/// use adsdv_spec::{Machine, export::Dot};
///
/// let graph = Dot(&Machine::REFERENCE).to_string();
/// assert!(graph.contains(r#"AS_READY -> AS_OFF [label="section 3.6\lAS master switch OFF\l"];"#));
/// assert!(graph.contains(r#"or \"Go\" signal OFF"#));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Dot<'a>(pub &'a Machine);

impl fmt::Display for Dot<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all = arrows(self.0).map(|arrow| {
            (arrow.row.from, arrow.row.to, Label { arrow, wrap: CONDITIONS_PER_LINE }, Mark::Usual)
        });
        write(f, &Title(self.0), all)
    }
}

/// The graph of these arrows, each with what stands at it, and what it is.
pub(super) fn write<L: fmt::Display + Copy>(
    f: &mut fmt::Formatter<'_>,
    title: &dyn fmt::Display,
    arrows: impl Iterator<Item = (AsState, AsState, L, Mark)>,
) -> fmt::Result {
    writeln!(f, "// {}", Escaped(title, in_title))?;
    f.write_str("digraph figure_2 {\n")?;
    f.write_str("    node [shape=box, fontname=\"Helvetica\"];\n")?;
    f.write_str("    edge [fontname=\"Helvetica\", fontsize=10];\n")?;
    f.write_str("    start [shape=point, width=0.15];\n")?;
    for state in AsState::ALL {
        let light = Assi::of(state);
        let style = if light.flashes() { "rounded,filled,dashed" } else { "rounded,filled" };
        let label = Escaped(light, in_quotes);
        let Paint { fill, ink } = Paint::of(light, Background::Light);
        writeln!(
            f,
            "    {state} [label=\"{state}\\nASSI {label}\", style=\"{style}\", fillcolor=\"{fill}\", fontcolor=\"{ink}\"];"
        )?;
    }
    writeln!(f, "    start -> {};", Control::INITIAL.state)?;
    for (from, to, label, mark) in arrows {
        let style = match mark {
            Mark::Usual => "",
            Mark::Differs => ", color=\"#c00000\", fontcolor=\"#c00000\", penwidth=2",
            Mark::Missing => ", color=\"#808080\", fontcolor=\"#808080\", style=dashed",
        };
        writeln!(f, "    {from} -> {to} [label=\"{}\\l\"{style}];", Escaped(label, in_quotes))?;
    }
    f.write_str("}\n")
}

/// `\l` ends a line that is aligned to the left; entities such as `&lt;` are read even in plain labels.
fn in_quotes(character: char) -> Option<&'static str> {
    match character {
        '\n' => Some("\\l"),
        '"' => Some("\\\""),
        '\\' => Some("\\\\"),
        '&' => Some("&amp;"),
        _ => None,
    }
}
