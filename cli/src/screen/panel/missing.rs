//! What is still missing before AS_DRIVING, or before the way there is open again.

use adsdv_can::car::{Condition, Missing};
use adsdv_can::status::Status;
use adsdv_spec::messages::AsState;
use ratatui::text::{Line, Span};

use super::spaced;
use crate::screen::keys::Key;
use crate::screen::theme::{QUIET, STRONG, Theme};

/// All conditions hold.
const NOTHING: &str = "nothing";

/// What the conditions are missing for.
pub(in crate::screen) fn title(status: &Status) -> String {
    status.missing.as_ref().map_or_else(
        || format!("Missing for {}", AsState::Driving),
        |missing| format!("Missing for {} ({})", missing.to, missing.section),
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
    if count(missing) > height {
        return spaced(pieces(missing, theme), " ", width);
    }
    if count(missing) == 0 {
        return vec![Line::styled(NOTHING, theme.good())];
    }
    texts(missing).map(|text| Line::styled(text, theme.care())).collect()
}

/// All in a row, and no rule above it; nothing where nothing can be missing.
pub(in crate::screen) fn in_a_row(status: &Status, theme: Theme, width: usize) -> Vec<Line<'static>> {
    let Some(missing) = &status.missing else {
        return Vec::new();
    };
    let mut all = vec![vec![Span::styled(format!("Missing for {}", missing.to), STRONG)]];
    all.extend(pieces(missing, theme));
    if count(missing) == 0 {
        all.push(vec![Span::styled(NOTHING, theme.good())]);
    }
    spaced(all, " ", width)
}

/// The height at which each condition has a line.
pub(in crate::screen) fn height(status: &Status) -> usize {
    status.missing.as_ref().map_or(0, count)
}

fn count(missing: &Missing) -> usize {
    texts(missing).count()
}

/// What is missing, each with its key where a key does it.
fn texts(missing: &Missing) -> impl Iterator<Item = String> {
    let conditions = missing.conditions.iter().map(text);
    conditions.chain(missing.then.iter().map(|condition| format!("then {}", text(condition))))
}

fn text(condition: &Condition) -> String {
    match condition.action.and_then(Key::of) {
        Some(key) => format!("{condition} ({})", key.stroke),
        None => condition.to_string(),
    }
}

fn pieces(missing: &Missing, theme: Theme) -> Vec<Vec<Span<'static>>> {
    let count = count(missing);
    let piece = |(text, place)| {
        let comma = if place == count { "" } else { "," };
        vec![Span::styled(format!("{text}{comma}"), theme.care())]
    };
    texts(missing).zip(1..).map(piece).collect()
}

/// Why nothing is missing.
fn without(status: &Status) -> String {
    match status.outputs.map(|outputs| outputs.state) {
        None => "power".to_owned(),
        Some(AsState::Driving) => "nothing: the AI Computer drives".to_owned(),
        Some(state) => format!("not on the way: {state}"),
    }
}
