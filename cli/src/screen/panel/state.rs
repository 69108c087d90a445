//! The AS state, its light, and how the car moves.

use adsdv_can::status::Status;
use adsdv_spec::Inputs;
use adsdv_spec::messages::WheelSpeed;
use ratatui::text::{Line, Span};

use super::seconds;
use crate::screen::theme::{STRONG, Theme};

/// The light with the name of the state in it.
pub(in crate::screen) fn light(status: &Status, lit: bool, theme: Theme, width: usize) -> Vec<Line<'static>> {
    let (name, style) = status.outputs.map_or(("no power", theme.bad()), |outputs| {
        (outputs.state.name(), theme.light(outputs.assi(), lit))
    });
    ["", name, ""].map(|text| Line::styled(format!("{text:^width$}"), style)).into()
}

/// The light in words, and for how long it has been so.
pub(in crate::screen) fn words(status: &Status) -> [Line<'static>; 2] {
    let light = status.outputs.map_or_else(|| "-".to_owned(), |outputs| outputs.assi().to_string());
    [
        Line::from(vec![Span::raw("ASSI "), Span::styled(light, STRONG)]),
        Line::from(vec![Span::raw("for "), Span::styled(seconds(status.in_state_ms), STRONG)]),
    ]
}

/// How the car moves.
pub(in crate::screen) fn motion(status: &Status) -> Line<'static> {
    Line::raw(format!("{:.1} m/s, {:.1} m", status.speed_mps, status.distance_m))
}

/// How its wheels turn.
pub(in crate::screen) fn wheels(inputs: &Inputs) -> Line<'static> {
    let speeds = inputs.vehicle.wheel_speeds;
    let others = [speeds.fl_wheel_speed, speeds.fr_wheel_speed, speeds.rl_wheel_speed];
    let [fl, fr, rl] = others.map(WheelSpeed::raw);
    Line::raw(format!("wheels {fl} {fr} {rl} {}", speeds.rr_wheel_speed))
}
