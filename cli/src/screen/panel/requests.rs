//! What the AI Computer asks for, what of it reaches the actuators, and what the vehicle does.

use adsdv_can::status::Status;
use adsdv_spec::messages::{AxleTorqueRequest, MotorSpeedMax};
use ratatui::style::Style;
use ratatui::text::{Line, Span};

use crate::screen::theme::{QUIET, STRONG, Theme};

/// The first column.
const NAME: usize = 13;
/// A column of this width has room for a speed limit beside the torque.
const WITH_LIMIT: usize = 19;
/// Where there is nothing to tell.
const NOTHING: &str = "-";

/// So many lines there are.
pub(in crate::screen) const HEIGHT: u16 = 7;

/// The title, with the heads of the columns.
pub(in crate::screen) fn title(width: usize) -> Line<'static> {
    let column = column(width);
    let head = |text: &str, width: usize| Span::styled(format!("{text:─<width$}"), QUIET);
    Line::from(vec![
        Span::raw(" AI Computer "),
        head(" requests ", column),
        head(" reaches ", column),
        head(" actual ", 0),
    ])
}

/// A line for each request.
pub(in crate::screen) fn lines(status: &Status, theme: Theme, width: usize) -> Vec<Line<'static>> {
    let column = column(width);
    let (ai, vehicle) = (&status.inputs.ai, &status.inputs.vehicle);
    let reaches = status.outputs.map(|outputs| outputs.actuation(&status.inputs));
    let row = |name: &str, asked: String, reaches: Option<String>, actual: String| {
        let style = if reaches.as_ref() == Some(&asked) { Style::new() } else { theme.care() };
        let reaches = reaches.unwrap_or_else(|| NOTHING.to_owned());
        Line::from(vec![
            Span::raw(format!("{name:<NAME$}{asked:<column$}")),
            Span::styled(format!("{reaches:<column$}"), style),
            Span::raw(actual),
        ])
    };
    let torque = |torque: AxleTorqueRequest, limit: MotorSpeedMax| {
        if column >= WITH_LIMIT { format!("{torque}, {limit}") } else { torque.to_string() }
    };
    vec![
        mission(status, theme, column),
        row(
            "direction",
            ai.status.direction_request.to_string(),
            reaches.map(|to| to.direction.to_string()),
            format!("{:.1} m/s", status.speed_mps),
        ),
        row(
            "torque front",
            torque(ai.drive_f.front_axle_trq_request, ai.drive_f.front_motor_speed_max),
            reaches.map(|to| torque(to.front_axle_trq, to.front_motor_speed_max)),
            vehicle.front_axle_trq.to_string(),
        ),
        row(
            "torque rear",
            torque(ai.drive_r.rear_axle_trq_request, ai.drive_r.rear_motor_speed_max),
            reaches.map(|to| torque(to.rear_axle_trq, to.rear_motor_speed_max)),
            vehicle.rear_axle_trq.to_string(),
        ),
        row(
            "steering",
            ai.steer.steer_request.to_string(),
            reaches.map(|to| to.steer.map_or_else(|| "not active".to_owned(), |angle| angle.to_string())),
            vehicle.steer_angle.to_string(),
        ),
        row(
            "brake front",
            ai.brake.hyd_press_f_req.to_string(),
            reaches.map(|to| to.hyd_press_f.to_string()),
            vehicle.hyd_press_f.to_string(),
        ),
        row(
            "brake rear",
            ai.brake.hyd_press_r_req.to_string(),
            reaches.map(|to| to.hyd_press_r.to_string()),
            vehicle.hyd_press_r.to_string(),
        ),
    ]
}

/// What goes to the VCU, and not to an actuator.
fn mission(status: &Status, theme: Theme, column: usize) -> Line<'static> {
    let ai = &status.inputs.ai.status;
    let estop = if ai.estop_request { theme.bad() } else { Style::new() };
    let name = ai.mission_status.name();
    let column = column.max(name.len() + 1);
    Line::from(vec![
        Span::raw(format!("{:<NAME$}", "mission")),
        Span::styled(format!("{name:<column$}"), STRONG),
        Span::styled(format!("ESTOP_REQUEST {}", u8::from(ai.estop_request)), estop),
    ])
}

fn column(width: usize) -> usize {
    width.saturating_sub(NAME) / 3
}
