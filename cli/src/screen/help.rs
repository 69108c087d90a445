//! What the keys mean.

use ratatui::buffer::Buffer;
use ratatui::layout::{Constraint, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, BorderType, Clear, Paragraph, Widget as _};

use super::keys::KEYS;
use super::theme::{STRONG, Theme};

/// The width of the box.
const WIDTH: u16 = 80;
/// The column of the names.
const NAME: usize = 23;

/// Draws the explanation over everything else.
pub(super) fn draw(theme: Theme, area: Rect, buffer: &mut Buffer) {
    let mut lines: Vec<Line<'static>> = KEYS
        .iter()
        .map(|key| {
            Line::from(vec![
                Span::styled(format!(" {} ", key.stroke), theme.key()),
                Span::raw(format!("{:<NAME$}", key.name)),
                Span::raw(key.meaning()),
            ])
        })
        .collect();
    let other = |key: &'static str, meaning: &'static str| {
        [Span::styled(format!(" {key} "), theme.key()), Span::raw(meaning)]
    };
    for row in [
        [other("A-Z", "the position before"), other("  Up Down PgUp PgDn Home End", "scroll what happened")]
            .as_slice(),
        &[
            other("?", "this help"),
            other("  Tab", "Figure 2"),
            other("  q Ctrl-C", "quit"),
            other("  Ctrl-Z", "stop"),
            other("  Ctrl-L", "draw anew"),
        ],
    ] {
        lines.push(row.iter().flatten().cloned().collect());
    }
    let height = u16::try_from(lines.len() + 2).unwrap_or(u16::MAX);
    let area = area.centered(Constraint::Max(WIDTH), Constraint::Max(height));
    let block = Block::bordered().border_type(BorderType::Rounded).title(" Keys ").title_style(STRONG);
    Clear.render(area, buffer);
    Paragraph::new(lines).block(block).render(area, buffer);
}
