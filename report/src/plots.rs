//! What is plotted: which signals stand over each other, and which limits beside them.
//!
//! A field that an edition has not is left out, and so is a plot of which nothing is left.

use adsdv_spec::Edition;
use adsdv_spec::messages::Node::{self, Ai, Vcu};
use serde::Serialize;

use crate::recording::{Found, signal};

/// What a line of a plot is: it is drawn so that the three differ without color.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Role {
    /// What was asked for.
    Request,
    /// What was.
    Actual,
    /// What was allowed.
    Limit,
}

use Role::{Actual, Limit, Request};

/// A plot: a title, a unit, and the fields in it with who says them.
type Rows = (&'static str, &'static str, &'static [(Node, &'static str, Role)]);

// What was asked for is drawn last, so that it shows on what was.
const PLOTS: &[Rows] = &[
    (
        "speed",
        "Speed",
        &[
            (Ai, "veh_speed_actual", Actual),
            (Vcu, "speed_actual", Actual),
            (Ai, "veh_speed_demand", Request),
            (Vcu, "speed_target", Request),
        ],
    ),
    (
        "torque-front",
        "Torque, front axle",
        &[
            (Vcu, "front_axle_trq", Actual),
            (Vcu, "front_axle_trq_max", Limit),
            (Ai, "front_axle_trq_request", Request),
            (Vcu, "front_axle_trq_request", Request),
        ],
    ),
    (
        "torque-rear",
        "Torque, rear axle",
        &[
            (Vcu, "rear_axle_trq", Actual),
            (Vcu, "rear_axle_trq_max", Limit),
            (Ai, "rear_axle_trq_request", Request),
            (Vcu, "rear_axle_trq_request", Request),
        ],
    ),
    (
        "motor-speed",
        "Speed limits of the motors",
        &[(Ai, "front_motor_speed_max", Limit), (Ai, "rear_motor_speed_max", Limit)],
    ),
    (
        "steering",
        "Steering",
        &[
            (Vcu, "steer_angle", Actual),
            (Vcu, "steer_angle_max", Limit),
            (Ai, "steer_request", Request),
            (Vcu, "steer_angle_request", Request),
        ],
    ),
    (
        "brake",
        "Brake pressure",
        &[
            (Vcu, "hyd_press_f", Actual),
            (Vcu, "hyd_press_r", Actual),
            (Ai, "hyd_press_f_req", Request),
            (Ai, "hyd_press_r_req", Request),
        ],
    ),
    (
        "wheels",
        "Wheel speeds",
        &[
            (Vcu, "fl_wheel_speed", Actual),
            (Vcu, "fr_wheel_speed", Actual),
            (Vcu, "rl_wheel_speed", Actual),
            (Vcu, "rr_wheel_speed", Actual),
        ],
    ),
];

/// The name of the plot of the answers to the handshake.
pub(crate) const ANSWERS: &str = "handshake";
/// The name of the plot of the periods of the messages.
pub(crate) const PERIODS: &str = "periods";

/// A plot.
#[derive(Serialize)]
pub(crate) struct PlotJson {
    pub(crate) id: &'static str,
    title: &'static str,
    unit: String,
    pub(crate) lines: Vec<LineJson>,
    limits: Vec<LimitJson>,
}

/// A line of a plot.
#[derive(Serialize)]
pub(crate) struct LineJson {
    label: String,
    role: Role,
    #[serde(flatten)]
    pub(crate) source: Source,
}

/// Where the values of a line are from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "of", rename_all = "kebab-case")]
pub(crate) enum Source {
    /// A signal.
    Signal {
        /// The identifier of its message.
        id: u16,
        /// Its name.
        signal: &'static str,
    },
    /// The time between the frames of a message, in milliseconds.
    Period {
        /// Its identifier.
        id: u16,
    },
    /// How long the AI Computer took to answer the handshake, in milliseconds.
    Answer,
}

/// A value that something is held against.
#[derive(Serialize)]
struct LimitJson {
    text: String,
    value: f64,
}

/// The plots of an edition, each with the lines that it has there.
pub(crate) fn plots(edition: &Edition) -> Vec<PlotJson> {
    let bus = &edition.bus;
    let mut plots = Vec::new();
    for &(id, title, rows) in PLOTS {
        let found =
            |&(sender, field, role): &(Node, &str, Role)| Some((sender, signal(bus, sender, field)?, role));
        let rows: Vec<(Node, Found, Role)> = rows.iter().filter_map(found).collect();
        let Some((_, first, _)) = rows.first() else { continue };
        let limits = if id == "wheels" { vec![at_rest(edition, first)] } else { Vec::new() };
        let unit = first.signal.unit.to_owned();
        plots.push(PlotJson { id, title, unit, lines: rows.into_iter().map(line).collect(), limits });
    }
    let answers =
        LineJson { label: "answer of the AI Computer".to_owned(), role: Actual, source: Source::Answer };
    plots.push(PlotJson {
        id: ANSWERS,
        title: "Handshake response",
        unit: "ms".to_owned(),
        lines: vec![answers],
        limits: vec![LimitJson {
            text: "limit of the document".to_owned(),
            value: edition.rules.timing.handshake_ms.into(),
        }],
    });
    let period = |message: &&adsdv_spec::messages::MessageDef| LineJson {
        label: format!("{:03X}h {}", message.id, message.name),
        role: Actual,
        source: Source::Period { id: message.id },
    };
    plots.push(PlotJson {
        id: PERIODS,
        title: "Period of each message",
        unit: "ms".to_owned(),
        lines: bus.messages.iter().map(period).collect(),
        limits: missed(edition).into_iter().collect(),
    });
    plots
}

fn line((sender, Found { id, signal }, role): (Node, Found, Role)) -> LineJson {
    LineJson {
        label: format!("{sender} {id:03X}h {}", signal.name),
        role,
        source: Source::Signal { id, signal: signal.name },
    }
}

fn at_rest(edition: &Edition, wheel: &Found) -> LimitJson {
    let value = wheel.signal.physical(edition.rules.thresholds.wheel_speed.raw());
    LimitJson { text: "at rest below".to_owned(), value }
}

fn missed(edition: &Edition) -> Option<LimitJson> {
    let value = edition.rules.thresholds.missed_ms?;
    Some(LimitJson { text: "a message of the AI Computer counts as missed".to_owned(), value: value.into() })
}
