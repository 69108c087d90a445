//! The layout: what it shows is in the file.

use std::collections::BTreeSet;

use adsdv_decode::mcap_layout;
use adsdv_spec::Edition;
use serde_json::Value as Json;

use super::read::{Contents, contents};
use crate::frames::catalog;

/// The words under these keys, wherever they stand.
fn under<'a>(json: &'a Json, keys: &[&str], found: &mut Vec<&'a str>) {
    match json {
        Json::Object(object) => {
            for (key, value) in object {
                match value {
                    Json::String(text) if keys.contains(&&**key) => found.push(text),
                    _ => under(value, keys, found),
                }
            }
        }
        Json::Array(array) => array.iter().for_each(|value| under(value, keys, found)),
        _ => {}
    }
}

/// The type of what a path of Foxglove leads to: a topic, and properties.
fn resolve<'a>(contents: &'a Contents, path: &str) -> Option<&'a str> {
    let mut parts = path.split('.');
    let mut schema = contents.schemas.get(parts.next()?)?;
    for part in parts {
        schema = schema.get("properties")?.get(part)?;
    }
    schema.get("type")?.as_str()
}

fn layout(edition: &'static Edition) -> Json {
    serde_json::from_str(&mcap_layout(edition).expect("it was built in")).expect("JSON")
}

/// The least that a recording can have: every file has the channels that the layout shows.
fn least(edition: &'static Edition) -> Contents {
    contents("(1.0) can0 7FF#00\n", &catalog(edition))
}

#[test]
fn every_path_of_every_editions_layout_is_in_the_file() {
    for edition in Edition::ALL {
        let (layout, contents) = (layout(edition), least(edition));
        let (mut values, mut topics) = (Vec::new(), Vec::new());
        under(&layout, &["value"], &mut values);
        under(&layout, &["topicPath", "topicToRender"], &mut topics);
        for path in &values {
            let kind = resolve(&contents, path);
            assert!(
                matches!(kind, Some("string" | "number" | "integer")),
                "{}: {path}: {kind:?}",
                edition.version
            );
        }
        assert_eq!(topics.len(), 2);
        for topic in &topics {
            assert_eq!(resolve(&contents, topic), Some("object"), "{}: {topic}", edition.version);
        }
        let has = |wanted: &str| values.iter().any(|path| path.starts_with(wanted));
        for wanted in [
            "/adsdv/as_state.state",
            "/adsdv/blocked.AS_OFF_to_AS_READY.by",
            "/adsdv/blocked.AS_DRIVING_to_AS_FINISHED.blocked",
            "/adsdv/VCU2AI_Status.AS_STATE_name",
            "/adsdv/VCU2AI_Drive_F.",
            "/adsdv/AI2VCU_Steer.",
            "/adsdv/VCU2AI_Brake.",
        ] {
            assert!(has(wanted), "{}: {wanted}: {values:#?}", edition.version);
        }
        assert!(
            !values.iter().any(|path| path.to_uppercase().contains("_MAX")),
            "limits are left out: {values:#?}"
        );
    }
}

#[test]
fn a_path_that_is_not_in_the_file_does_not_resolve() {
    let contents = least(&Edition::V2026);
    for path in ["/adsdv/nothing", "/adsdv/as_state.nothing", "/adsdv/as_state.state.nothing"] {
        assert_eq!(resolve(&contents, path), None, "{path}");
    }
}

#[test]
fn each_panel_stands_in_the_layout_once() {
    for edition in Edition::ALL {
        let layout = layout(edition);
        let panels: BTreeSet<_> = layout["configById"].as_object().expect("panels").keys().cloned().collect();
        let mut placed = Vec::new();
        under(&layout, &["first", "second", "layout"], &mut placed);
        let unique: BTreeSet<_> = placed.iter().map(|name| (*name).to_owned()).collect();
        assert_eq!((unique.len(), &unique), (placed.len(), &panels));
        let kinds: BTreeSet<_> = panels.iter().filter_map(|name| name.split('!').next()).collect();
        assert_eq!(kinds, BTreeSet::from(["Plot", "RawMessages", "RosOut", "StateTransitions", "Tab"]));
        for key in ["globalVariables", "userNodes", "playbackConfig", "layout"] {
            assert!(layout[key].is_object(), "{key}");
        }
    }
}
