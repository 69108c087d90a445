//! What is still missing before AS_DRIVING.

use adsdv_can::car::Missing;
use adsdv_can::status::Status;
use adsdv_spec::messages::AsState;
use ratatui::text::{Line, Span};

use super::spaced;
use crate::screen::theme::{QUIET, STRONG, Theme};

/// All conditions hold.
const NOTHING: &str = "nothing";

/// What the conditions are missing for.
pub(in crate::screen) fn title(status: &Status) -> String {
    status.missing.as_ref().map_or_else(
        || format!("Missing for {}", AsState::Driving),
        |missing| format!("Missing for {} ({})", missing.to, missing.clause),
    )
}

/// The conditions: one on each line if there is so much room, otherwise one after the other.
pub(in crate::screen) fn lines(
    status: &Status,
    theme: Theme,
    width: usize,
    height: usize,
) -> Vec<Line<'static>> {
    let Some(missing) = &status.missing else {
        return vec![Line::styled(without(status), QUIET)];
    };
    if missing.conditions.len() > height {
        return spaced(pieces(missing, theme), " ", width);
    }
    if missing.conditions.is_empty() {
        return vec![Line::styled(NOTHING, theme.good())];
    }
    missing.conditions.iter().map(|&condition| Line::styled(condition, theme.care())).collect()
}

/// All in a row, and no rule above it; nothing where nothing can be missing.
pub(in crate::screen) fn in_a_row(status: &Status, theme: Theme, width: usize) -> Vec<Line<'static>> {
    let Some(missing) = &status.missing else {
        return Vec::new();
    };
    let mut all = vec![vec![Span::styled(format!("Missing for {}", missing.to), STRONG)]];
    all.extend(pieces(missing, theme));
    if missing.conditions.is_empty() {
        all.push(vec![Span::styled(NOTHING, theme.good())]);
    }
    spaced(all, " ", width)
}

/// The height at which each condition has a line.
pub(in crate::screen) fn height(status: &Status) -> usize {
    status.missing.as_ref().map_or(0, |missing| missing.conditions.len())
}

fn pieces(missing: &Missing, theme: Theme) -> Vec<Vec<Span<'static>>> {
    let count = missing.conditions.len();
    let piece = |(&condition, place)| {
        let comma = if place == count { "" } else { "," };
        vec![Span::styled(format!("{condition}{comma}"), theme.care())]
    };
    missing.conditions.iter().zip(1..).map(piece).collect()
}

/// Why nothing is missing.
fn without(status: &Status) -> String {
    match status.outputs.map(|outputs| outputs.state) {
        None => "power".to_owned(),
        Some(AsState::Driving) => "nothing: the AI Computer drives".to_owned(),
        Some(state) => format!("not on the way: {state}"),
    }
}
