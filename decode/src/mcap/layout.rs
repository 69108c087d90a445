//! A layout for Foxglove and Lichtblick, made of what the edition has: nothing about its messages is written down here.
//!
//! ```text
//! the state, and each signal whose values have names | a plot for each unit
//! what blocks each arrow of Figure 2, by its state   |
//! the findings                                       | the status of the VCU
//! ```

use std::collections::BTreeSet;

use adsdv_spec::Edition;
use adsdv_spec::messages::{MessageDef, Vcu2AiStatus};
use serde_json::{Map, Value as Json, json};

use super::judged::{BLOCKED, FINDINGS, STATE};
use super::schema::name_property;
use super::topics::topic;
use crate::arrows::{GuardedArrow, condition_name};
use crate::{Catalog, Message, Signal};

/// The panels so far, by name.
#[derive(Default)]
struct Panels(Map<String, Json>);

impl Panels {
    /// Adds one of a kind, and returns its name.
    fn add(&mut self, kind: &str, title: &str, mut config: Json) -> Json {
        let name = format!("{kind}!adsdv{}", self.0.len());
        if let Some(config) = config.as_object_mut() {
            // Each of the two programs has its own word for it.
            for key in ["foxglovePanelTitle", "lichtblickPanelTitle"] {
                config.insert(key.to_owned(), title.into());
            }
        }
        self.0.insert(name.clone(), config);
        name.into()
    }

    fn transitions(&mut self, title: &str, paths: &[(String, String)]) -> Json {
        let path = |(value, label): &(String, String)| json!({"value": value, "label": label, "timestampMethod": "receiveTime", "enabled": true});
        let paths: Vec<_> = paths.iter().map(path).collect();
        self.add("StateTransitions", title, json!({"paths": paths, "isSynced": true}))
    }

    fn plot(&mut self, title: &str, paths: &[(String, String)]) -> Json {
        let path = |(value, label): &(String, String)| json!({"value": value, "label": label, "timestampMethod": "receiveTime", "enabled": true, "showLine": true});
        let config = json!({
            "paths": paths.iter().map(path).collect::<Vec<_>>(),
            "isSynced": true,
            "xAxisVal": "timestamp",
            "showXAxisLabels": true,
            "showYAxisLabels": true,
            "showLegend": true,
            "legendDisplay": "left",
            "showPlotValuesInLegend": true,
            "sidebarDimension": 200,
        });
        self.add("Plot", title, config)
    }
}

/// The layout for an edition.
pub(super) fn of(edition: &'static Edition) -> String {
    let catalog = Catalog::of(edition);
    let documented = || edition.bus.messages.iter().copied().zip(catalog.messages());
    let mut panels = Panels::default();

    let mut states = vec![(format!("{STATE}.state"), "AS state".to_owned())];
    states.extend(documented().flat_map(|(_, message)| named(message)));
    let states = panels.transitions("States", &states);
    let blocked = blocked(edition, &mut panels);
    let plots = plots(documented, &mut panels);
    let log = json!({"topicToRender": FINDINGS, "minLogLevel": 1, "searchTerms": [], "nameFilter": {}});
    let findings = panels.add("RosOut", "Findings", log);
    let vcu = documented().find(|(row, _)| row.id == Vcu2AiStatus::ID);
    let vcu = vcu.map(|(_, message)| topic(message, None)).unwrap_or_default();
    let raw = json!({"topicPath": vcu, "diffEnabled": true, "diffMethod": "previous message"});
    let raw = panels.add("RawMessages", "Status of the VCU", raw);

    let left = stacked("column", &[states, blocked, findings]);
    let right = split("column", 80, &plots, &raw);
    let layout = json!({
        "configById": panels.0,
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": {"speed": 1},
        "layout": split("row", 50, &left, &right),
    });
    format!("{layout:#}\n")
}

/// The signals of a message whose values have more than two names: states, and no switches.
fn named(message: &Message) -> Vec<(String, String)> {
    let several = message.signals.iter().filter(|signal| signal.names.len() > 2);
    let path = |signal: &Signal| {
        let property = name_property(message, signal)?;
        Some((format!("{}.{property}", topic(message, None)), label(message, signal)))
    };
    several.filter_map(path).collect()
}

fn label(message: &Message, signal: &Signal) -> String {
    format!("{} {}", message.id_text(), signal.name)
}

/// A tab with what blocks all arrows, and one for each state with the conditions of those that begin there.
fn blocked(edition: &Edition, panels: &mut Panels) -> Json {
    let arrows = GuardedArrow::all(edition);
    let all = arrows.iter().map(|arrow| (format!("{BLOCKED}.{}.by", arrow.name()), arrow.name()));
    let mut tabs =
        vec![("Blocked".to_owned(), panels.transitions("What blocks each arrow", &all.collect::<Vec<_>>()))];
    let states: BTreeSet<_> = arrows.iter().map(|arrow| arrow.from).collect();
    for state in states {
        let mut paths = Vec::new();
        for arrow in arrows.iter().filter(|arrow| arrow.from == state) {
            let (name, to) = (arrow.name(), arrow.to.name());
            paths.push((format!("{BLOCKED}.{name}.blocked"), format!("to {to}: blocked")));
            paths.extend(arrow.conditions.iter().map(|condition| {
                let condition = condition_name(*condition);
                (format!("{BLOCKED}.{name}.{condition}"), format!("to {to}: {condition}"))
            }));
        }
        tabs.push((state.name().to_owned(), panels.transitions(&format!("Out of {}", state.name()), &paths)));
    }
    tabbed("What blocks", &tabs, panels)
}

/// A plot for each unit, two beside each other: what is requested and what is, without the limits.
fn plots<'a, I>(documented: impl Fn() -> I, panels: &mut Panels) -> Json
where
    I: Iterator<Item = (&'static MessageDef, &'a Message)>,
{
    let mut units: Vec<(&str, Vec<(String, String)>)> = Vec::new();
    for (row, message) in documented() {
        for (field, signal) in row.signals.iter().map(|row| row.field).zip(&message.signals) {
            if signal.unit.is_empty() || field.split('_').any(|word| word == "max") {
                continue;
            }
            let path = (format!("{}.{}", topic(message, None), signal.name), label(message, signal));
            match units.iter_mut().find(|(unit, _)| **unit == *signal.unit) {
                Some((_, paths)) => paths.push(path),
                None => units.push((&signal.unit, vec![path])),
            }
        }
    }
    units.sort_by_key(|(_, paths)| std::cmp::Reverse(paths.len()));
    let plots: Vec<_> = units.iter().map(|(unit, paths)| panels.plot(unit, paths)).collect();
    let rows: Vec<_> = plots.chunks(2).map(|row| stacked("row", row)).collect();
    stacked("column", &rows)
}

fn tabbed(title: &str, tabs: &[(String, Json)], panels: &mut Panels) -> Json {
    let tabs: Vec<_> = tabs.iter().map(|(title, layout)| json!({"title": title, "layout": layout})).collect();
    panels.add("Tab", title, json!({"activeTabIdx": 0, "tabs": tabs}))
}

/// Parts of the same size in a row or a column.
fn stacked(direction: &str, parts: &[Json]) -> Json {
    match parts {
        [] => Json::Null,
        [one] => one.clone(),
        [first, rest @ ..] => split(direction, 100 / parts.len(), first, &stacked(direction, rest)),
    }
}

/// Two parts in a row or a column, the first of which has so many percent.
fn split(direction: &str, percent: usize, first: &Json, second: &Json) -> Json {
    json!({"direction": direction, "first": first, "second": second, "splitPercentage": percent})
}
