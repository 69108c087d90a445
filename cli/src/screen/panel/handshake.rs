//! The handshake: who sends what, and how fast the AI Computer answers.

use adsdv_can::status::Status;
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
    let limit = status.answer_limit_ms;
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

#[cfg(test)]
mod tests {
    use super::*;

    /// How long an answer may take is the edition's to say.
    #[test]
    fn silent_is_who_says_nothing_for_longer_than_the_edition_allows() {
        let text = |silent, answer_limit_ms| {
            let status = Status { ai_silent_ms: Some(silent), answer_limit_ms, ..Status::default() };
            silence(&status, Theme::new(false))
                .iter()
                .map(|span| span.content.to_string())
                .collect::<String>()
        };
        assert_eq!(text(60, 100), "heard 60 ms ago");
        assert!(text(60, 50).starts_with("silent for "), "{}", text(60, 50));
    }
}
