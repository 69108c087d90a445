//! Figure 2 with the state that the VCU is in: where its boxes stand and how its arrows run is that of every other picture of it.

use adsdv_can::status::Status;
use adsdv_spec::export::{BOX, Line as Arrow, Point, SIZE, place};
use adsdv_spec::messages::AsState;
use adsdv_spec::{Assi, Edition, Machine};
use ratatui::buffer::Buffer;
use ratatui::layout::{Constraint, Rect};
use ratatui::style::Style;
use ratatui::symbols::Marker;
use ratatui::text::Line;
use ratatui::widgets::canvas::{Canvas, Line as Stroke};
use ratatui::widgets::{Block, BorderType, Clear, Paragraph, Widget as _};

use super::theme::{QUIET, STRONG, Theme};

/// The width of the picture with its frame.
const WIDTH: u16 = 98;
/// Its height.
const HEIGHT: u16 = 28;
/// A curve is so many straight lines.
const PIECES: u8 = 12;

/// Draws it over everything else. A flashing light is `lit` or not.
pub(super) fn draw(status: &Status, lit: bool, theme: Theme, area: Rect, buffer: &mut Buffer) {
    let area = area.centered(Constraint::Max(WIDTH), Constraint::Max(HEIGHT));
    let block = Block::bordered().border_type(BorderType::Rounded).title(" Figure 2 ").title_style(STRONG);
    let block = block.title_bottom(" bold: from this state; Tab closes it ");
    let inner = block.inner(area);
    Clear.render(area, buffer);
    block.render(area, buffer);
    let state = status.outputs.map(|outputs| outputs.state);
    let arrows = arrows(status);
    let drawn = lines(&arrows, inner, buffer);
    for state_of_box in AsState::ALL {
        let here = state == Some(state_of_box);
        let style = if here { theme.light(Assi::of(state_of_box), lit) } else { Style::new() };
        let kind = if here { BorderType::Double } else { BorderType::Plain };
        let area = cells(place(state_of_box), inner);
        Clear.render(area, buffer);
        Paragraph::new(Line::raw(state_of_box.name()).centered())
            .block(Block::bordered().border_type(kind))
            .style(style)
            .render(area, buffer);
    }
    for (arrow, (from, _, section)) in drawn.iter().zip(&arrows) {
        let here = state == Some(*from);
        let style = if here { theme.key() } else { QUIET };
        write(head(arrow), outside(arrow, inner), style, inner, buffer);
        write(section, arrow.label, if here { STRONG } else { Style::new() }, inner, buffer);
    }
}

/// The arrows of the edition that the VCU follows, each with its section.
fn arrows(status: &Status) -> Vec<(AsState, AsState, &'static str)> {
    let Some(edition) = Edition::find(status.edition) else { return Vec::new() };
    let machine = Machine::new(*edition, edition.readings);
    let mut arrows = Vec::new();
    for taken in AsState::ALL.into_iter().flat_map(|state| machine.arrows(state)) {
        if let Some(row) = taken.row(&edition.rules.table) {
            let arrow = (row.from, row.to, row.section);
            if !arrows.contains(&arrow) {
                arrows.push(arrow);
            }
        }
    }
    arrows
}

/// Draws their lines, and tells how they run.
fn lines(arrows: &[(AsState, AsState, &'static str)], area: Rect, buffer: &mut Buffer) -> Vec<Arrow> {
    let pairs = arrows.iter().map(|(from, to, _)| (*from, *to));
    let drawn: Vec<Arrow> =
        (0..arrows.len()).filter_map(|which| Arrow::among(pairs.clone(), which)).collect();
    Canvas::default()
        .marker(Marker::Braille)
        .x_bounds([0.0, SIZE.0])
        .y_bounds([-SIZE.1, 0.0])
        .paint(|context| {
            for arrow in &drawn {
                for piece in 0..PIECES {
                    let at = |piece: u8| arrow.at(f64::from(piece) / f64::from(PIECES));
                    let (from, to) = (at(piece), at(piece + 1));
                    let color = ratatui::style::Color::Reset;
                    context.draw(&Stroke { x1: from.x, y1: -from.y, x2: to.x, y2: -to.y, color });
                }
            }
        })
        .render(area, buffer);
    drawn
}

/// The last point of an arrow in front of the box that it leads to, which takes more cells than its size.
fn outside(arrow: &Arrow, area: Rect) -> Point {
    let is_inside = |point: Point| {
        AsState::ALL.iter().any(|state| cells(place(*state), area).contains(cell(point, area).into()))
    };
    let back = (0..50_u8).map(|step| arrow.at(1.0 - f64::from(step) / 100.0));
    back.into_iter().find(|point| !is_inside(*point)).unwrap_or(arrow.to)
}

/// The head of an arrow, by where it leads.
fn head(arrow: &Arrow) -> &'static str {
    let (dx, dy) = (arrow.to.x - arrow.bend.x, arrow.to.y - arrow.bend.y);
    match (dx.abs() > dy.abs() * 2.0, dx > 0.0, dy > 0.0) {
        (true, true, _) => "\u{25b6}",
        (true, false, _) => "\u{25c0}",
        (false, _, true) => "\u{25bc}",
        (false, _, false) => "\u{25b2}",
    }
}

/// Writes a few letters with their middle there.
fn write(text: &str, at: Point, style: Style, area: Rect, buffer: &mut Buffer) {
    let (x, y) = cell(at, area);
    let half = u16::try_from(text.chars().count() / 2).unwrap_or(0);
    let x = x.saturating_sub(half);
    if area.contains((x, y).into()) {
        buffer.set_stringn(x, y, text, usize::from(area.right().saturating_sub(x)), style);
    }
}

/// The cell of a point.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "it is in the picture, and the picture in the area"
)]
fn cell(Point { x, y }: Point, area: Rect) -> (u16, u16) {
    let scaled = |at: f64, size: f64, cells: u16| {
        let last = f64::from(cells.saturating_sub(1));
        // What is a hair before a cell is in it.
        (at / size * f64::from(cells) + 1e-6).clamp(0.0, last.max(0.0)) as u16
    };
    (area.x + scaled(x, SIZE.0, area.width), area.y + scaled(y, SIZE.1, area.height))
}

/// The cells of a box: its name fits in, with a frame around it.
fn cells(middle: Point, area: Rect) -> Rect {
    let (left, top) = cell(Point { x: middle.x - BOX.0 / 2.0, y: middle.y - BOX.1 / 2.0 }, area);
    let (right, _) = cell(Point { x: middle.x + BOX.0 / 2.0, y: middle.y }, area);
    let longest = AsState::ALL.iter().map(|state| state.name().len()).max().unwrap_or(0);
    let width = (right - left).max(u16::try_from(longest + 2).unwrap_or(u16::MAX));
    Rect { x: left, y: top, width, height: 3 }.intersection(area)
}
