//! Each kind of difference shows where an edition is changed in just that: of the bus (`bus`), of the state machine (`rules`),
//! and what holds of all differences (`every`).

mod bus;
mod every;
mod rules;

use adsdv_spec::messages::{MessageDef, SignalDef};
use adsdv_spec::{Edition, Row, Table};
use serde_json::{Value, json};

use super::difference::Difference;

/// The edition that is changed.
const BEFORE: &Edition = &Edition::V4_0;

/// What a changed edition changes, as programs get it, without the parts of which nothing differs.
fn changed(after: &Edition) -> Value {
    let difference = Difference::between(BEFORE, after);
    let mut json = serde_json::to_value(&difference).expect("JSON");
    assert_eq!(json["differs"], !super::sections::of(&difference).is_empty(), "what differs is printed");
    let parts = json.as_object_mut().expect("an object");
    parts.retain(|key, part| !matches!(key.as_str(), "from" | "to" | "differs") && !is_empty(part));
    json
}

fn is_empty(part: &Value) -> bool {
    match part {
        Value::Array(list) => list.is_empty(),
        Value::Object(lists) => lists.values().all(is_empty),
        _ => false,
    }
}

/// The edition with one message changed, left out or more.
fn with_messages(change: impl FnOnce(&mut Vec<&'static MessageDef>)) -> Edition {
    let mut messages = BEFORE.bus.messages.to_vec();
    change(&mut messages);
    let mut edition = *BEFORE;
    edition.bus.messages = messages.leak();
    edition
}

/// The edition with one message changed.
fn with_message(id: u16, change: impl FnOnce(&mut MessageDef)) -> Edition {
    with_messages(|messages| {
        let slot = messages.iter_mut().find(|message| message.id == id).expect("a message");
        let mut message = **slot;
        change(&mut message);
        *slot = Box::leak(Box::new(message));
    })
}

/// The edition with the signals of one message changed.
fn with_signals(id: u16, change: impl FnOnce(&mut Vec<SignalDef>)) -> Edition {
    with_message(id, |message| {
        let mut signals = message.signals.to_vec();
        change(&mut signals);
        message.signals = signals.leak();
    })
}

/// The edition with the rows of Figure 2 changed.
fn with_rows(change: impl FnOnce(&mut Vec<Row>)) -> Edition {
    let mut rows = BEFORE.rules.table.rows().to_vec();
    change(&mut rows);
    BEFORE.with_table(Table::new(&rows))
}

/// What is listed where one thing is changed, and nothing is new or gone.
fn only_changed(change: &Value) -> Value {
    json!({ "new": [], "gone": [], "changed": [change] })
}
