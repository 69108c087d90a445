//! Figure 2 as a Mermaid diagram.

use core::fmt;

use super::arrows::{Label, Title, arrows};
use super::escape::Escaped;
use super::light::{Background, Paint};
use crate::messages::AsState;
use crate::{Assi, Control, Machine};

/// Mermaid breaks the lines of a label where it likes once they are longer than about this.
const CONDITIONS_PER_LINE: usize = 1;

/// Displays Figure 2 as a Mermaid `stateDiagram-v2`.
///
/// Put it into a code block of the language `mermaid`, and GitHub, GitLab and `mdbook` draw it.
///
/// ```
/// use adsdv_spec::{Machine, export::Mermaid};
///
/// let diagram = Mermaid(&Machine::REFERENCE).to_string();
/// assert!(diagram.contains("stateDiagram-v2\n"));
/// assert!(diagram.contains("AS_READY --> AS_OFF : section 3.6<br/>AS master switch OFF\n"));
/// assert!(diagram.contains("AS_READY : ASSI yellow, continuous\n"));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Mermaid<'a>(pub &'a Machine);

impl fmt::Display for Mermaid<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let label = |arrow| Label { arrow, wrap: CONDITIONS_PER_LINE };
        write(f, &Title(self.0), arrows(self.0).map(|arrow| (arrow.row.from, arrow.row.to, label(arrow))))
    }
}

/// The diagram of these arrows, each with what stands at it.
pub(super) fn write<L: fmt::Display + Copy>(
    f: &mut fmt::Formatter<'_>,
    title: &dyn fmt::Display,
    arrows: impl Iterator<Item = (AsState, AsState, L)>,
) -> fmt::Result {
    writeln!(f, "%% {}", Escaped(title, in_title))?;
    f.write_str("stateDiagram-v2\n")?;
    for state in AsState::ALL {
        writeln!(f, "    state \"{state}\" as {state}")?;
        writeln!(f, "    {state} : ASSI {}", Escaped(Assi::of(state), in_text))?;
    }
    writeln!(f, "    [*] --> {}", Control::INITIAL.state)?;
    for (from, to, label) in arrows {
        writeln!(f, "    {from} --> {to} : {}", Escaped(label, in_text))?;
    }
    for state in AsState::ALL {
        let light = Assi::of(state);
        let Paint { fill, ink } = Paint::of(light, Background::Light);
        // Classes and states are named apart, so the name of the one serves the other.
        write!(f, "    classDef {state} fill:{fill},stroke:#333,color:{ink}")?;
        writeln!(f, "{}", if light.flashes() { ",stroke-dasharray:5 5" } else { "" })?;
        writeln!(f, "    class {state} {state}")?;
    }
    Ok(())
}

/// A title stays on its line.
pub(super) fn in_title(character: char) -> Option<&'static str> {
    (character == '\n').then_some(" ")
}

/// A text runs to the end of the line, and a colon or a semicolon ends it. Mermaid's own entity codes, `#` for
/// `&`, are read before all else.
fn in_text(character: char) -> Option<&'static str> {
    match character {
        '\n' => Some("<br/>"),
        '"' => Some("#quot;"),
        '<' => Some("#lt;"),
        '>' => Some("#gt;"),
        '&' => Some("#amp;"),
        '#' => Some("#35;"),
        ':' => Some("#58;"),
        ';' => Some("#59;"),
        _ => None,
    }
}
