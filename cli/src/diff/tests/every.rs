//! What holds of all differences.

use adsdv_spec::{Choice, Choices, Mutation};

use super::*;
use crate::diff::{DiffJson, markdown, text};
use crate::json::{DIFF_SCHEMA, SCHEMA, line};

fn json(difference: &Difference) -> Value {
    serde_json::from_str(&line(&DiffJson { schema: SCHEMA, difference })).expect("JSON")
}

/// The pairs of editions, each with itself as well.
fn pairs() -> impl Iterator<Item = (&'static Edition, &'static Edition)> {
    Edition::ALL.iter().flat_map(|from| Edition::ALL.iter().map(move |to| (*from, *to)))
}

/// Of a difference, what the difference in the other direction says, in an order of its own. Names of what is changed are
/// those of the edition after, and the numbers in the words of conditions as well.
fn turned_round(value: &Value) -> Value {
    match value {
        Value::Object(object) => {
            let other = |key: &str| {
                match key {
                    "new" if object.contains_key("settled") => "settled",
                    "new" => "gone",
                    "settled" | "gone" => "new",
                    "from" => "to",
                    "to" => "from",
                    key => key,
                }
                .to_owned()
            };
            object.iter().map(|(key, value)| (other(key), turned_round(value))).collect()
        }
        Value::Array(list) => list.iter().map(turned_round).collect(),
        value => value.clone(),
    }
}

fn in_order(value: &Value) -> Value {
    match value {
        Value::Object(object) => {
            let is_changed = object.contains_key("changes");
            let kept = object.iter().filter(|(key, _)| !(is_changed && *key == "name") && *key != "text");
            kept.map(|(key, value)| (key.clone(), in_order(value))).collect()
        }
        Value::Array(list) => {
            let mut list: Vec<_> = list.iter().map(in_order).collect();
            list.sort_by_key(Value::to_string);
            Value::Array(list)
        }
        value => value.clone(),
    }
}

#[test]
fn the_other_direction_mirrors_it() {
    for (from, to) in pairs() {
        let (there, back) = (json(&Difference::between(from, to)), json(&Difference::between(to, from)));
        assert_eq!(in_order(&turned_round(&there)), in_order(&back), "{} and {}", from.version, to.version);
    }
}

#[test]
fn an_edition_does_not_differ_from_itself_and_all_others_do() {
    for (from, to) in pairs() {
        let difference = Difference::between(from, to);
        assert_eq!(difference.differs, from.version != to.version);
        let (text, markdown) = (text::text(&difference, 100), markdown::text(&difference));
        assert_eq!(text.ends_with("\n\nnothing differs\n"), from.version == to.version, "{text}");
        assert_eq!(markdown.ends_with("\n\nNothing differs.\n"), from.version == to.version, "{markdown}");
    }
}

/// Every mutation that the possible answers can show is a difference, and none panics when it is printed.
#[test]
fn every_mutation_differs_and_keeps_to_the_schema() {
    let schema = serde_json::from_str(DIFF_SCHEMA).expect("JSON");
    let validator = jsonschema::draft202012::new(&schema).expect("a schema");
    for edition in Edition::ALL {
        let mut compared = 0;
        for mutation in Mutation::all(edition) {
            let mutant = mutation.apply(edition);
            let difference = Difference::between(edition, &mutant);
            assert_eq!(difference.differs, is_shown(edition, &mutant), "{}: {mutation}", edition.version);
            let errors: Vec<_> =
                validator.iter_errors(&json(&difference)).map(|error| error.to_string()).collect();
            assert!(errors.is_empty(), "{mutation}: {errors:#?}");
            let (text, markdown) = (text::text(&difference, 100), markdown::text(&difference));
            assert!(!text.is_empty() && !markdown.is_empty());
            compared += usize::from(difference.differs);
        }
        assert!(compared > 100, "{}: {compared}", edition.version);
    }
}

/// Whether the mutant's rules say something else under the answers that are possible.
fn is_shown(edition: &Edition, mutant: &Edition) -> bool {
    let rows = |edition: &Edition| {
        let rows = edition.rules.table.rows().iter().map(|row| {
            let terms = row.terms().iter().filter(|term| term.readings.is_subset(edition.choices));
            let said =
                terms.map(|term| (term.on, term.off, term.fault, term.section, open(edition, term.readings)));
            (row.from, row.to, said.collect::<Vec<_>>())
        });
        rows.filter(|(_, _, terms)| !terms.is_empty()).collect::<Vec<_>>()
    };
    let numbers = |edition: &Edition| (edition.rules.timing, edition.rules.thresholds);
    rows(edition) != rows(mutant) || numbers(edition) != numbers(mutant)
}

/// The answers among these whose questions the edition leaves open.
fn open(edition: &Edition, choices: Choices) -> Vec<Choice> {
    choices.iter().filter(|choice| edition.choices.of_reading(choice.reading()).count() > 1).collect()
}

#[test]
fn lines_fit_into_the_width() {
    for (from, to) in pairs() {
        let difference = Difference::between(from, to);
        for width in [100, 120] {
            let text = anstream::adapter::strip_str(&text::text(&difference, width)).to_string();
            for line in text.lines() {
                assert!(line.chars().count() <= width, "{width}: {line}");
                assert_eq!(line, line.trim_end(), "no white space at the end");
            }
        }
    }
}

#[test]
fn each_line_of_a_table_has_all_its_columns() {
    for (from, to) in pairs() {
        let markdown = markdown::text(&Difference::between(from, to));
        for table in markdown.split("\n## ").skip(1) {
            let lines: Vec<_> = table.lines().filter(|line| line.starts_with('|')).collect();
            let count = |line: &&str| line.replace("\\|", "").matches('|').count();
            assert!(lines.len() > 2 && lines.iter().all(|line| count(line) == count(&lines[0])), "{table}");
            assert!(lines[1].replace(['|', ' ', '-'], "").is_empty(), "{table}");
        }
    }
}
