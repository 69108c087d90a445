//! Where a page draws the states of Figure 2, and how the arrows run.

use adsdv_spec::export::{BOX, Line, Point, SIZE, place};
use adsdv_spec::{AsState, Assi};
use serde::Serialize;

/// The places of the states, and of arrows between them, for a page that draws both.
///
/// ```
/// use adsdv_report::Picture;
/// use adsdv_spec::AsState;
///
/// let picture = Picture::of(&[(AsState::Off, AsState::Ready)]);
/// let json = serde_json::to_value(&picture)?;
/// assert_eq!(json["states"][1]["name"], "AS_READY");
/// assert_eq!(json["lines"][0]["path"], "M400 76 Q400 120 400 164");
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, Serialize)]
pub struct Picture {
    size: (f64, f64),
    #[serde(rename = "box")]
    size_of_box: (f64, f64),
    states: Vec<StateJson>,
    lines: Vec<RunJson>,
}

#[derive(Clone, Debug, Serialize)]
struct StateJson {
    name: &'static str,
    /// What its light shows.
    light: String,
    x: f64,
    y: f64,
}

#[derive(Clone, Debug, Serialize)]
struct RunJson {
    /// As an SVG has it.
    path: String,
    label: (f64, f64),
    length: f64,
}

impl Picture {
    /// Of these arrows, in their order.
    pub fn of(arrows: &[(AsState, AsState)]) -> Self {
        let state = |state: AsState| {
            let Point { x, y } = place(state);
            StateJson { name: state.name(), light: Assi::of(state).to_string(), x, y }
        };
        let lines = (0..arrows.len()).filter_map(|which| Line::among(arrows.iter().copied(), which));
        Self {
            size: SIZE,
            size_of_box: BOX,
            states: AsState::ALL.map(state).into(),
            lines: lines.map(|line| RunJson::from(&line)).collect(),
        }
    }
}

impl From<&Line> for RunJson {
    fn from(line: &Line) -> Self {
        Self { path: line.to_string(), label: (line.label.x, line.label.y), length: line.length }
    }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::export::{Background, Paint};

    use super::*;

    /// The style of a page, of its light part or of its dark one.
    fn style(template: &str, on: Background) -> &str {
        let (light, dark) = template.split_once("(prefers-color-scheme:dark)").expect("a page has both");
        if on == Background::Light { light } else { dark }
    }

    #[test]
    fn the_lights_have_the_colors_of_the_specification_on_every_page() {
        for template in [crate::page::TEMPLATE, crate::outcome::TEMPLATE] {
            for on in [Background::Light, Background::Dark] {
                let lights = [
                    ("dark-light", Assi::Off),
                    ("yellow", Assi::YellowContinuous),
                    ("blue", Assi::BlueContinuous),
                ];
                for (name, light) in lights {
                    let Paint { fill, ink } = Paint::of(light, on);
                    for (name, color) in [(format!("--{name}:"), fill), (format!("--on-{name}:"), ink)] {
                        let (_, rest) =
                            style(template, on).split_once(&name).expect("the page has that color");
                        let (shown, _) = rest.split_once([';', '}']).expect("its end");
                        assert_eq!(long(shown.trim()), color, "{name} on {on:?}");
                    }
                }
            }
        }
    }

    /// A color as it was before it was made short.
    fn long(color: &str) -> String {
        match color.strip_prefix('#') {
            Some(short) if short.len() == 3 => {
                format!("#{}", short.chars().flat_map(|c| [c, c]).collect::<String>())
            }
            _ => color.to_owned(),
        }
    }
}
