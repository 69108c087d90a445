//! The operator's switches: key, name, position.

use adsdv_can::car::Switch;
use adsdv_can::status::Status;
use ratatui::style::Style;
use ratatui::text::{Line, Span};

use crate::screen::keys::{KEYS, Key};
use crate::screen::theme::{QUIET, Theme};

/// One line for each; with headings where there is room for them.
pub(in crate::screen) fn lines(
    status: &Status,
    theme: Theme,
    width: usize,
    headings: bool,
) -> Vec<Line<'static>> {
    let mut lines = Vec::new();
    let mut part = "";
    for key in &KEYS {
        let switch = key.switch();
        let its_part = switch.map_or("", Switch::part);
        if headings && its_part != part {
            lines.push(Line::styled(heading(its_part), QUIET));
        }
        part = its_part;
        lines.push(match switch {
            Some(switch) => {
                let raw = switch.get(&status.inputs);
                line(key, &switch.position(raw), position_style(switch, raw, theme), theme, width)
            }
            None if status.outputs.is_none() => line(key, "no power", theme.bad(), theme, width),
            None => line(key, "", QUIET, theme, width),
        });
    }
    lines
}

fn heading(part: &str) -> &'static str {
    match part {
        "sdc" => "opens the shutdown circuit",
        "reports" => "is reported to the VCU",
        _ => "",
    }
}

fn line(key: &Key, position: &str, style: Style, theme: Theme, width: usize) -> Line<'static> {
    let room = width.saturating_sub(2 + key.name.chars().count());
    Line::from(vec![
        Span::styled(key.stroke.to_string(), theme.key()),
        Span::raw(format!(" {}", key.name)),
        Span::styled(format!("{position:>room$}"), style),
    ])
}

/// A switch of the car is well when it is on, a cause of trouble is not.
fn position_style(switch: Switch, raw: i32, theme: Theme) -> Style {
    let at_rest = switch.positions().first() == Some(&raw);
    match (at_rest, switch.part()) {
        (true, _) => QUIET,
        (false, "") => theme.good(),
        (false, _) => theme.bad(),
    }
}
