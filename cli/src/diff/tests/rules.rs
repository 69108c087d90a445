//! Figure 2, priorities, times, thresholds, faults and readings.

use adsdv_spec::messages::{SteerAngle, WheelSpeed};
use adsdv_spec::mutation::{Change, TermChange};
use adsdv_spec::table::Priority;
use adsdv_spec::{AsState, Atom, Choice, Fault, Term};

use super::*;

/// Where the way from `AS_DRIVING` into `EMERGENCY_BRAKE` stands.
fn driving() -> usize {
    let ends = |row: &Row| (row.from, row.to) == (AsState::Driving, AsState::EmergencyBrake);
    BEFORE.rules.table.rows().iter().position(ends).expect("a row")
}

/// What a change of one term of that row changes, and nothing else does.
fn of_the_alternatives(term: usize, change: TermChange) -> Value {
    let json = changed(&Change::Term(driving(), term, change).apply(BEFORE));
    let alternatives = json["arrows"]["changed"][0]["alternatives"].clone();
    let arrow = json!({
        "state": "AS_DRIVING", "next": "EMERGENCY_BRAKE", "changes": [], "alternatives": alternatives
    });
    assert_eq!(json, json!({ "arrows": only_changed(&arrow) }), "and nothing else");
    alternatives
}

/// The place of the term of that row with these conditions.
fn term(atom: Atom) -> usize {
    let terms = BEFORE.rules.table.rows()[driving()].terms();
    terms.iter().position(|term| term.on.has(atom) || term.off.has(atom)).expect("a term")
}

#[test]
fn an_alternative_is_new_or_gone_by_its_conditions() {
    let gone = of_the_alternatives(term(Atom::BmsFault), TermChange::Dropped);
    let battery = json!({
        "conditions": [{ "atom": "bms-fault", "value": true, "text": "BMS_FAULT == TRUE" }],
        "section": "3", "reports": "BMS_FAULT", "readings": []
    });
    assert_eq!(gone, json!({ "new": [], "gone": [battery], "changed": [] }));
    let flipped = of_the_alternatives(term(Atom::BmsFault), TermChange::LiteralFlipped(Atom::BmsFault));
    assert_eq!(flipped["gone"], json!([battery]));
    assert_eq!(flipped["new"][0]["conditions"][0]["text"], "BMS_FAULT == FALSE");
}

#[test]
fn each_property_of_an_alternative_is_compared() {
    let reports = of_the_alternatives(term(Atom::BmsFault), TermChange::FaultDropped);
    let conditions = json!([{ "atom": "bms-fault", "value": true, "text": "BMS_FAULT == TRUE" }]);
    let change = json!({ "property": "reports", "from": "BMS_FAULT", "to": null });
    assert_eq!(reports, only_changed(&json!({ "conditions": conditions, "changes": [change] })));
    let readings = of_the_alternatives(term(Atom::FrontTorqueZero), TermChange::InEveryReading);
    let change = json!({ "property": "readings", "from": ["torque-control=always"], "to": [] });
    assert_eq!(readings["changed"][0]["changes"], json!([change]));
    let other = with_rows(|rows| {
        let row = rows[driving()];
        let terms: Vec<Term> = row.terms().iter().map(|term| Term { section: "9", ..*term }).collect();
        rows[driving()] = Row::new(row.from, row.to, row.section, &terms);
    });
    let alternatives = changed(&other)["arrows"]["changed"][0]["alternatives"]["changed"].clone();
    assert_eq!(
        alternatives.as_array().map(Vec::len),
        Some(BEFORE.rules.table.rows()[driving()].terms().len())
    );
    assert_eq!(alternatives[0]["changes"], json!([{ "property": "section", "from": "3.7", "to": "9" }]));
}

/// An alternative that needs an answer which is not possible is none.
#[test]
fn what_no_answer_has_does_not_differ() {
    let impossible = Term::on("4", &[Atom::GoEdge]).reading(Choice::FaultEdge);
    assert!(!BEFORE.choices.has(Choice::FaultEdge), "version 4.0 has settled this");
    let more = with_rows(|rows| {
        let row = rows[driving()];
        rows[driving()] = Row::new(row.from, row.to, row.section, &[row.terms(), &[impossible]].concat());
    });
    assert_ne!(more, *BEFORE);
    assert!(!Difference::between(BEFORE, &more).differs);
    let only_answer = with_rows(|rows| {
        let row = rows[driving()];
        let mut terms = row.terms().to_vec();
        terms[term(Atom::BmsFault)] = terms[term(Atom::BmsFault)].reading(Choice::FaultLevel);
        rows[driving()] = Row::new(row.from, row.to, row.section, &terms);
    });
    assert!(!Difference::between(BEFORE, &only_answer).differs, "the only answer is no condition");
}

#[test]
fn an_arrow_is_new_or_gone_by_its_ends() {
    let gone = changed(&Change::RowDropped(0).apply(BEFORE));
    let arrow = &gone["arrows"]["gone"][0];
    assert_eq!((&arrow["state"], &arrow["next"]), (&json!("AS_OFF"), &json!("AS_READY")));
    assert_eq!(gone, json!({ "arrows": { "new": [], "gone": [arrow], "changed": [] } }));
    let elsewhere = changed(&Change::RowLeadsTo(0, AsState::Finished).apply(BEFORE));
    assert_eq!(elsewhere["arrows"]["new"][0]["next"], "AS_FINISHED");
    let section = changed(&with_rows(|rows| {
        rows[0] = Row::new(rows[0].from, rows[0].to, "9", rows[0].terms()).cites(rows[0].cites);
    }));
    let changes = &section["arrows"]["changed"][0]["changes"];
    assert_eq!(*changes, json!([{ "property": "section", "from": "3.1", "to": "9" }]));
}

#[test]
fn another_order_shows_what_changed_places_and_no_more() {
    let ready = BEFORE.rules.table.rows().iter().position(|row| row.from == AsState::Ready).expect("a row");
    let arrows = changed(&Change::RowFirst(ready + 1).apply(BEFORE));
    let (from, to) = (["EMERGENCY_BRAKE", "AS_OFF"], ["AS_OFF", "EMERGENCY_BRAKE"]);
    assert_eq!(arrows, json!({ "order": [{ "state": "AS_READY", "from": from, "to": to }] }));
    let terms = changed(&with_rows(|rows| {
        let row = rows[driving()];
        let mut terms = row.terms().to_vec();
        terms.swap(0, 1);
        terms[7..10].rotate_left(1);
        rows[driving()] = Row::new(row.from, row.to, row.section, &terms);
    }));
    let changes = terms["arrows"]["changed"][0]["changes"].as_array().cloned().expect("changes");
    assert_eq!(changes.iter().map(|change| &change["property"]).collect::<Vec<_>>(), ["order", "order"]);
    assert_eq!(changes[0]["from"], json!(["SDC open", "AS master switch OFF"]));
    assert_eq!(changes[0]["to"], json!(["AS master switch OFF", "SDC open"]));
    assert_eq!(changes[1]["from"].as_array().map(Vec::len), Some(3));
    // Between states there is no order.
    let rotated = with_rows(|rows| rows.rotate_left(1));
    assert!(!Difference::between(BEFORE, &rotated).differs);
}

#[test]
fn a_priority_is_new_or_gone() {
    let with = |priorities: Vec<Priority>| {
        let mut edition = *BEFORE;
        edition.rules.priorities = priorities.leak();
        changed(&edition)
    };
    let all = BEFORE.rules.priorities;
    let outline = json!({ "choice": "ready-priority=as-off", "state": "AS_READY", "first": "AS_OFF" });
    assert_eq!(with(all[1..].to_vec()), json!({ "priorities": { "new": [], "gone": [outline] } }));
    let other = Priority { first: AsState::Driving, ..all[0] };
    let mut more = all.to_vec();
    more.push(other);
    assert_eq!(with(more)["priorities"]["new"][0]["first"], "AS_DRIVING");
    let impossible = Priority { choice: Choice::FaultEdge, ..all[0] };
    assert_eq!(with([all, &[impossible]].concat()), json!({}));
}

#[test]
fn each_time_and_each_threshold_is_compared() {
    let timing = BEFORE.rules.timing;
    let thresholds = BEFORE.rules.thresholds;
    for (name, from, change) in [
        (
            "ready_dwell_ms",
            timing.ready_dwell_ms,
            (|e| e.rules.timing.ready_dwell_ms = 1) as fn(&mut Edition),
        ),
        ("ebs_timer_ms", timing.ebs_timer_ms, |e| e.rules.timing.ebs_timer_ms = 1),
        ("handshake_ms", timing.handshake_ms, |e| e.rules.timing.handshake_ms = 1),
        ("cycle_ms", timing.cycle_ms, |e| e.rules.timing.cycle_ms = 1),
    ] {
        let mut edition = *BEFORE;
        change(&mut edition);
        assert_eq!(changed(&edition), json!({ "timing": [{ "property": name, "from": from, "to": 1 }] }));
    }
    let limit = |change: fn(&mut Edition)| {
        let mut edition = *BEFORE;
        change(&mut edition);
        changed(&edition)
    };
    let one = |name, from: Value, to: Value| json!({ "thresholds": [{ "property": name, "from": from, "to": to }] });
    let wheel = limit(|edition| edition.rules.thresholds.wheel_speed = WheelSpeed::clamped(1));
    assert_eq!(wheel, one("wheel_speed", json!(thresholds.wheel_speed.raw()), json!(1)));
    let straight = limit(|edition| edition.rules.thresholds.straight = SteerAngle::clamped(1));
    assert_eq!(straight, one("straight", json!(thresholds.straight.raw()), json!(1)));
    let missed = limit(|edition| edition.rules.thresholds.missed_ms = None);
    assert_eq!(missed, one("missed_ms", json!(thresholds.missed_ms), Value::Null));
}

#[test]
fn a_fault_is_new_or_gone() {
    let fewer = Edition { faults: BEFORE.faults.without(Fault::BmsFault), ..*BEFORE };
    let battery = json!({ "flag": "BMS_FAULT", "cause": 10 });
    assert_eq!(changed(&fewer), json!({ "faults": { "new": [], "gone": [battery] } }));
    let back = serde_json::to_value(Difference::between(&fewer, BEFORE)).expect("JSON");
    assert_eq!(back["faults"], json!({ "new": [battery], "gone": [] }));
}

#[test]
fn a_question_is_new_settled_or_changed() {
    let lists = |edition: &Edition| {
        let json = changed(edition);
        ["new", "settled", "changed"].map(|list| json["readings"][list][0]["id"].clone())
    };
    let settled = Edition { choices: BEFORE.choices.without(Choice::TorqueNever), ..*BEFORE };
    assert_eq!(lists(&settled), [Value::Null, json!("torque-control"), Value::Null]);
    let open = Edition { choices: BEFORE.choices.with(Choice::FaultEdge), ..*BEFORE };
    assert_eq!(lists(&open), [json!("fault-trigger"), Value::Null, Value::Null]);
    let more = Edition { choices: BEFORE.choices.with(Choice::CommsNoArrow), ..*BEFORE };
    assert_eq!(lists(&more), [Value::Null, Value::Null, json!("comms-lost")]);
    let default = Edition { readings: BEFORE.readings.with(Choice::WatchAlways), ..*BEFORE };
    let json = changed(&default);
    let [from, to] = ["handshake", "always"]
        .map(|default| json!({ "choices": ["handshake", "always"], "default": default }));
    let question = &json["readings"]["changed"][0];
    assert_eq!((&question["from"], &question["to"]), (&from, &to));
    assert_eq!(json.as_object().map(serde_json::Map::len), Some(1), "{json}");
}
