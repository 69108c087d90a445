//! A drawing as an SVG that brings all it needs.

use core::fmt::{self, Write as _};

use super::drawing::{Drawing, DrawnArrow};
use super::light::{Background, Paint};
use super::mark::Mark;
use super::places::{BOX, Line, Point, SIZE, Tenths, WHOLE, place};
use crate::Assi;
use crate::messages::AsState;

/// Labels that are longer do not fit at an arrow; they show where a browser shows titles.
const LETTERS: usize = 12;

/// Displays a [`Drawing`] as an SVG: the states where the document has them, in the colours of their lights. At an arrow stands the
/// first line of its label, and all of it in its title; a sign and a dashed line tell what differs.
///
/// ```
/// use adsdv_spec::AsState;
/// use adsdv_spec::export::{Drawing, DrawnArrow, Mark};
///
/// let (from, to) = (AsState::Ready, AsState::Off);
/// let arrows = [DrawnArrow { from, to, label: "3.6\nASMS off", mark: Mark::Missing }];
/// let svg = Drawing { title: "a simulator's own", arrows: &arrows }.svg().to_string();
/// assert!(svg.starts_with("<svg ") && svg.contains("<title>AS_READY to AS_OFF: missing, 3.6, ASMS off</title>"));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct AsSvg<'a> {
    drawing: Drawing<'a>,
    state: Option<AsState>,
    taken: Option<(AsState, AsState)>,
    on: Background,
    corner: (u32, u32),
    width: u32,
}

impl<'a> Drawing<'a> {
    /// As a picture, which any browser shows.
    pub const fn svg(&self) -> AsSvg<'a> {
        AsSvg::new(*self)
    }
}

impl<'a> AsSvg<'a> {
    const fn new(drawing: Drawing<'a>) -> Self {
        Self { drawing, state: None, taken: None, on: Background::Light, corner: (0, 0), width: WHOLE.0 }
    }

    /// With a state that somebody is in.
    #[must_use]
    pub const fn in_state(self, state: AsState) -> Self {
        Self { state: Some(state), ..self }
    }

    /// With an arrow that was just taken, if it was one.
    #[must_use]
    pub const fn taken(self, arrow: Option<(AsState, AsState)>) -> Self {
        Self { taken: arrow, ..self }
    }

    /// For this background.
    #[must_use]
    pub const fn on(self, background: Background) -> Self {
        Self { on: background, ..self }
    }

    /// In another SVG: its upper left corner, and its width. Its height goes with that, see [`AsSvg::height`].
    #[must_use]
    pub const fn within(self, x: u32, y: u32, width: u32) -> Self {
        Self { corner: (x, y), width, ..self }
    }

    /// How high it is where it is so wide.
    pub const fn height(width: u32) -> u32 {
        width.saturating_mul(WHOLE.1) / WHOLE.0
    }

    /// Ink, and what is less important.
    const fn inks(&self) -> (&'static str, &'static str, &'static str) {
        match self.on {
            Background::Light => ("#1b1f24", "#6b7681", "#ffffff"),
            Background::Dark => ("#e6e9ed", "#9fb3c4", "#142b46"),
        }
    }
}

impl fmt::Display for AsSvg<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ((x, y), (width, height), (ink, quiet, paper)) = (self.corner, SIZE, self.inks());
        let (shown_width, shown_height) = (self.width, Self::height(self.width));
        write!(
            f,
            r#"<svg xmlns="http://www.w3.org/2000/svg" x="{x}" y="{y}" width="{shown_width}" height="{shown_height}" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="13" text-anchor="middle" role="img"><title>{}</title><defs>"#,
            Text(self.drawing.title)
        )?;
        for (id, colour) in [("usual", quiet), ("strong", ink)] {
            write!(
                f,
                r#"<marker id="figure-2-{id}" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" orient="auto"><path d="M0 0L10 5L0 10z" fill="{colour}"/></marker>"#
            )?;
        }
        f.write_str("</defs>")?;
        let arrows = self.drawing.arrows;
        let pairs = arrows.iter().map(|arrow| (arrow.from, arrow.to));
        // The labels lie above all lines.
        for (which, arrow) in arrows.iter().enumerate() {
            if let Some(line) = Line::among(pairs.clone(), which) {
                self.line(f, arrow, &line)?;
            }
        }
        for (which, arrow) in arrows.iter().enumerate() {
            if let Some(line) = Line::among(pairs.clone(), which) {
                label(f, arrow, line.label, (ink, paper))?;
            }
        }
        for state in AsState::ALL {
            self.state(f, state, ink)?;
        }
        f.write_str("</svg>")
    }
}

impl AsSvg<'_> {
    fn line(&self, f: &mut fmt::Formatter<'_>, arrow: &DrawnArrow<'_>, line: &Line) -> fmt::Result {
        let (ink, quiet, _) = self.inks();
        let strong = arrow.mark == Mark::Differs || self.taken == Some((arrow.from, arrow.to));
        let (colour, width, head) = if strong { (ink, 3, "strong") } else { (quiet, 1, "usual") };
        let dashes = if arrow.mark == Mark::Missing { r#" stroke-dasharray="3 5""# } else { "" };
        write!(
            f,
            r#"<path class="line" d="{line}" fill="none" stroke="{colour}" stroke-width="{width}"{dashes} marker-end="url(#figure-2-{head})"/>"#
        )
    }

    fn state(&self, f: &mut fmt::Formatter<'_>, state: AsState, edge: &str) -> fmt::Result {
        let light = Assi::of(state);
        let (Paint { fill, ink }, Point { x, y }) = (Paint::of(light, self.on), place(state));
        let (left, top, (width, height)) = (x - BOX.0 / 2.0, y - BOX.1 / 2.0, BOX);
        let dashes = if light.flashes() { r#" stroke-dasharray="7 4""# } else { "" };
        let (edge_width, weight) = if self.state == Some(state) { (5, "bold") } else { (1, "normal") };
        write!(
            f,
            r#"<rect class="state" x="{left}" y="{top}" width="{width}" height="{height}" rx="9" fill="{fill}" stroke="{edge}" stroke-width="{edge_width}"{dashes}/><text x="{x}" y="{}" fill="{ink}" font-weight="{weight}">{state}</text><text x="{x}" y="{}" fill="{ink}" font-size="11">{light}</text>"#,
            y - 3.0,
            y + 15.0,
        )
    }
}

fn label(
    f: &mut fmt::Formatter<'_>,
    DrawnArrow { from, to, label, mark }: &DrawnArrow<'_>,
    Point { x, y }: Point,
    (ink, paper): (&str, &str),
) -> fmt::Result {
    let (word, sign) = match mark {
        Mark::Usual => ("", ""),
        Mark::Differs => ("differs, ", "\u{2260} "),
        Mark::Missing => ("missing, ", "\u{2717} "),
    };
    let first = label.lines().next().unwrap_or_default().trim_start_matches("section ");
    let first = if first.chars().count() > LETTERS { "" } else { first };
    let width = (first.chars().count() + sign.chars().count()).max(3).saturating_mul(7) + 12;
    write!(f, r#"<g class="arrow"><title>{from} to {to}: {word}"#)?;
    for (place, line) in label.lines().enumerate() {
        write!(f, "{}{}", if place == 0 { "" } else { ", " }, Text(line))?;
    }
    let weight = if *mark == Mark::Usual { "normal" } else { "bold" };
    // No label is long enough to be rounded.
    let width = f64::from(u16::try_from(width).unwrap_or(u16::MAX));
    write!(
        f,
        r#"</title><rect x="{}" y="{}" width="{width}" height="20" rx="5" fill="{paper}" stroke="{ink}"/><text x="{}" y="{}" fill="{ink}" font-size="12" font-weight="{weight}">{sign}{}</text></g>"#,
        Tenths(x - width / 2.0),
        Tenths(y - 10.0),
        Tenths(x),
        Tenths(y + 4.0),
        Text(first)
    )
}

/// Text, with what XML reads as markup escaped, and without what it cannot hold.
struct Text<'a>(&'a str);

impl fmt::Display for Text<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.chars().try_for_each(|character| match character {
            '&' => f.write_str("&amp;"),
            '<' => f.write_str("&lt;"),
            '>' => f.write_str("&gt;"),
            '"' => f.write_str("&quot;"),
            character if character.is_control() => f.write_char(' '),
            character => f.write_char(character),
        })
    }
}
