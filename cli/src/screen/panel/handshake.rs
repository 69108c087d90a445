//! The handshake: who sends what, and how fast the AI Computer answers.

use adsdv_can::status::Status;
use adsdv_spec::Machine;
use ratatui::style::Style;
use ratatui::text::Span;

use super::{ms, named, seconds};
use crate::screen::theme::{STRONG, Theme};

/// The bits, the silence, how fast the answers came, and where there is room for `all` how many.
pub(in crate::screen) fn pieces(status: &Status, theme: Theme, all: bool) -> Vec<Vec<Span<'static>>> {
    let vcu = status.outputs.map_or("-", |outputs| bit(outputs.handshake));
    let strong = STRONG;
    let mut pieces = vec![
        named("VCU", &vcu, strong),
        named("AI", &bit(status.inputs.ai.status.handshake), strong),
        silence(status, theme),
    ];
    let times = &status.responses;
    let values = [
        ("last", status.last_response_ms),
        ("median", times.quantile_ms(0.5)),
        ("p99", times.quantile_ms(0.99)),
        ("max", times.max_ms()),
    ];
    for (name, value) in values {
        if let Some(value) = value {
            pieces.push(named(name, &ms(value), strong));
        }
    }
    if all {
        pieces.push(named("answers", &times.count(), Style::new()));
    }
    pieces
}

fn silence(status: &Status, theme: Theme) -> Vec<Span<'static>> {
    // Silent is who does not send for longer than an answer may take.
    let limit = Machine::REFERENCE.edition().rules.timing.handshake_ms.into();
    let (text, style) = match status.ai_silent_ms {
        None => ("no frame of the AI yet".to_owned(), theme.care()),
        Some(silent) if silent > limit => (format!("silent for {}", seconds(silent)), theme.bad()),
        Some(silent) => (format!("heard {silent} ms ago"), Style::new()),
    };
    vec![Span::styled(text, style)]
}

fn bit(on: bool) -> &'static str {
    if on { "1" } else { "0" }
}
