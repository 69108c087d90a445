//! Faults, the cause of a shutdown, and warnings, by the names of 520h.

use adsdv_can::status::Status;
use adsdv_spec::messages::{ShutdownCause, Vcu2AiStatus};
use ratatui::style::Style;
use ratatui::text::Span;

use super::named;
use crate::screen::theme::{QUIET, Theme};

/// The cause, every flag that is set, and every warning.
pub(in crate::screen) fn pieces(status: &Status, theme: Theme) -> Vec<Vec<Span<'static>>> {
    let Some(outputs) = status.outputs else {
        return vec![vec![Span::styled("-", QUIET)]];
    };
    let message = outputs.messages(&status.inputs).status;
    let faults = outputs.faults.iter().map(|fault| (fault.flag(), theme.bad()));
    let warnings = warnings(&message).map(|name| (name, theme.care()));
    let flags: Vec<_> = faults.chain(warnings).collect();
    let mut pieces = Vec::new();
    if outputs.shutdown_cause != ShutdownCause::NoShutdown {
        pieces.push(named("SHUTDOWN_CAUSE", &outputs.shutdown_cause, theme.bad()));
    }
    if flags.is_empty() {
        let style = if pieces.is_empty() { QUIET } else { Style::new() };
        pieces.push(vec![Span::styled("no fault, no warning", style)]);
    }
    pieces.extend(flags.into_iter().map(|(name, style)| vec![Span::styled(name, style)]));
    pieces
}

fn warnings(message: &Vcu2AiStatus) -> impl Iterator<Item = &'static str> {
    [(message.warn_batt_temp_high, "WARN_BATT_TEMP_HIGH"), (message.warn_batt_soc_low, "WARN_BATT_SOC_LOW")]
        .into_iter()
        .filter_map(|(set, name)| set.then_some(name))
}
