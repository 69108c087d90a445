//! A picture of the screen, for the README.

use std::fmt::Write as _;
use std::time::Duration;

use ratatui::buffer::{Buffer, Cell};
use ratatui::style::{Color, Modifier};

use super::golden::{compare, drawn};
use super::{Screen, simulated};

/// A cell, in pixels: the font's size makes its letters as wide.
const CELL: (usize, usize) = (8, 17);
/// Around everything, in pixels.
const MARGIN: usize = 12;
const FOREGROUND: &str = "#d8dee9";
const BACKGROUND: &str = "#16191f";
const DIM: &str = "#7b8494";

#[test]
fn screenshot() {
    let (buffer, _) = drawn(&simulated::mission(Duration::from_millis(12_500)), &Screen::new(true), 100, 30);
    compare("../docs/screen.svg", &svg(&buffer));
}

/// The cells as an SVG.
fn svg(buffer: &Buffer) -> String {
    let (columns, rows) = (usize::from(buffer.area.width), usize::from(buffer.area.height));
    let (width, height) = (columns * CELL.0 + 2 * MARGIN, rows * CELL.1 + 2 * MARGIN);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\"\n  \
         font-family=\"'DejaVu Sans Mono', Menlo, Consolas, monospace\" font-size=\"13.3\">\n\
         <title>adsdv vcu: the terminal screen of the virtual VCU</title>\n\
         <rect width=\"100%\" height=\"100%\" rx=\"6\" fill=\"{BACKGROUND}\"/>\n",
    );
    for (row, cells) in buffer.content().chunks(columns).enumerate() {
        let mut column = 0;
        for run in cells.chunk_by(|one, other| one.style() == other.style()) {
            draw(&mut out, run, column, row);
            column += run.len();
        }
    }
    out + "</svg>\n"
}

/// Cells of one style.
fn draw(out: &mut String, run: &[Cell], column: usize, row: usize) {
    let Some(cell) = run.first() else { return };
    let reversed = cell.modifier.contains(Modifier::REVERSED);
    let dim = cell.modifier.contains(Modifier::DIM);
    let plain = if dim { DIM } else { FOREGROUND };
    let (mut foreground, mut background) = (hex(cell.fg).unwrap_or(plain), hex(cell.bg));
    if reversed {
        (foreground, background) = (background.unwrap_or(BACKGROUND), Some(foreground));
    }
    let (x, y) = (MARGIN + column * CELL.0, MARGIN + row * CELL.1);
    let (width, height) = (run.len() * CELL.0, CELL.1);
    if let Some(fill) = background {
        writeln!(out, "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"{fill}\" shape-rendering=\"crispEdges\"/>")
            .expect("text");
    }
    let bold = if cell.modifier.contains(Modifier::BOLD) { " font-weight=\"bold\"" } else { "" };
    let text: String = run.iter().map(Cell::symbol).collect();
    let mut x = x;
    // Columns stay columns, whatever the font: what stands apart is written apart.
    for part in text.split("  ") {
        let shown = part.trim_start();
        let at = x + (part.chars().count() - shown.chars().count()) * CELL.0;
        x += (part.chars().count() + 2) * CELL.0;
        let shown = shown.trim_end();
        if shown.is_empty() {
            continue;
        }
        let (width, y) = (shown.chars().count() * CELL.0, y + CELL.1 - 4);
        let shown = shown.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
        writeln!(
            out,
            "<text x=\"{at}\" y=\"{y}\" textLength=\"{width}\" lengthAdjust=\"spacingAndGlyphs\" \
             fill=\"{foreground}\"{bold}>{shown}</text>",
        )
        .expect("text");
    }
}

/// The colors of a terminal.
fn hex(color: Color) -> Option<&'static str> {
    match color {
        Color::Reset => None,
        Color::Black => Some("#16191f"),
        Color::White => Some("#ffffff"),
        Color::Green => Some("#8fc07a"),
        Color::Yellow => Some("#d9b56c"),
        Color::LightYellow => Some("#ffd93b"),
        Color::Blue => Some("#2f6fe0"),
        Color::LightBlue => Some("#7aa8ff"),
        Color::Cyan => Some("#6cc5d9"),
        Color::LightRed => Some("#ff7b72"),
        other => panic!("the picture has no {other:?} yet"),
    }
}
