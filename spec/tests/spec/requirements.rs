//! What an edition asks for is what `REQUIREMENTS.md` says of it.

use adsdv_spec::{Choice, Edition, Reading};

const REQUIREMENTS: &str = include_str!("../../REQUIREMENTS.md");

/// Each requirement with the editions that its parenthesis names; none stands for all.
fn all() -> impl Iterator<Item = (&'static str, Vec<&'static str>)> {
    let items = REQUIREMENTS.split("\n- **").skip(1);
    items.filter_map(|item| {
        let (id, rest) = item.split_once("** ")?;
        let sentence = rest.split("\n\n").next()?.trim_end();
        let (_, places) = sentence.strip_suffix(").")?.rsplit_once('(')?;
        let named = places.split(';').filter_map(|place| place.split_once(':'));
        Some((id, named.map(|(edition, _)| edition.trim()).collect()))
    })
}

#[test]
fn an_edition_asks_for_what_names_it() {
    assert!(all().count() > 300);
    let mut differs = Vec::new();
    for (id, editions) in all() {
        for edition in Edition::ALL {
            let named = editions.is_empty() || editions.contains(&edition.version);
            if edition.requirements.has(id) != named {
                let is = match (named, editions.is_empty()) {
                    (false, _) => "does not name",
                    (true, false) => "names",
                    (true, true) => "names no edition and so all, among them",
                };
                differs.push(format!(
                    "{id}: its parenthesis {is} {}, and its `requirements` say otherwise",
                    edition.version
                ));
            }
        }
    }
    assert!(differs.is_empty(), "{}", differs.join("\n"));
}

#[test]
fn there_is_none_that_the_file_does_not_have() {
    for edition in Edition::ALL {
        for numbers in edition.requirements.added {
            for number in numbers.first..=numbers.last {
                let id = format!("{}-{number}", numbers.prefix);
                assert!(
                    all().any(|(known, _)| known == id),
                    "{id}, which the `requirements` of {} add, has no line in REQUIREMENTS.md",
                    edition.version
                );
            }
        }
    }
    for id in ["SM-99", "SM-0", "SM", "HS-9x", "XX-1", ""] {
        assert!(Edition::ALL.iter().all(|edition| !edition.requirements.has(id)), "{id:?}");
    }
}

/// What is replaced was asked for, and what stands instead is asked for now.
#[test]
fn what_is_replaced_was_asked_for() {
    for edition in Edition::ALL {
        for replaced in edition.requirements.replaced {
            let before = edition.requirements.before.expect("an edition before it");
            assert!(before.has(replaced.id), "{}: {}", edition.version, replaced.id);
            assert!(
                replaced.by.iter().all(|id| edition.requirements.has(id)),
                "{}: {replaced:?}",
                edition.version
            );
        }
    }
}

/// The table "Readings" has a line for each question that an edition leaves open, with the answers that it allows.
#[test]
fn the_table_of_readings_is_that_of_each_edition() {
    let (_, table) = REQUIREMENTS.split_once("\n| item | editions | reading |").expect("the table");
    let (table, _) = table.split_once("\n\n").expect("its end");
    let rows: Vec<Vec<&str>> =
        table.lines().skip(2).map(|line| line.split('|').map(str::trim).collect()).collect();
    let mut wrong = Vec::new();
    for edition in Edition::ALL {
        for &reading in Reading::ALL {
            let id = format!("`{}`", reading.id());
            let of_both = |row: &&Vec<&str>| {
                row[3] == id && row[2].split(", ").any(|version| version == edition.version)
            };
            let listed = rows.iter().filter(of_both).map(|row| quoted(row[5]));
            let listed: Vec<Vec<&str>> = listed.collect();
            let mut answers: Vec<Choice> = edition.choices.of_reading(reading).collect();
            answers.sort_by_key(|&choice| !edition.readings.is(choice));
            let answers: Vec<&str> = answers.into_iter().map(Choice::id).collect();
            let expected = if answers.len() > 1 { vec![answers] } else { Vec::new() };
            if listed != expected {
                let version = edition.version;
                wrong.push(format!("{id} of {version}: the table has {listed:?}, expected {expected:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "the table \"Readings\" of REQUIREMENTS.md:\n{}", wrong.join("\n"));
}

/// What stands between backticks.
fn quoted(cell: &str) -> Vec<&str> {
    cell.split('`').skip(1).step_by(2).collect()
}
