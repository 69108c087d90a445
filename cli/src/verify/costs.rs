//! What the readings of an edition cost, for a program and as a page. The form is described by `schema/costs.schema.json`.

use adsdv_model::{
    ClosedCost, Cost, Property, StoryLine, Sweep, goals, have_the_same_state_machine, properties, story,
    story_of,
};
use adsdv_report::{Mood, Outcome, PageError, Shown};
use adsdv_spec::{Choice, Choices, Edition};
use serde::Serialize;

use crate::json::{SCHEMA, line};
use crate::layout::counted;

/// Whether every exploration was complete, and nothing fails under the default answers.
pub(super) fn holds(sweep: &Sweep) -> bool {
    sweep.complete && sweep.costs.iter().all(|cost| !cost.choices.is_empty())
}

/// The costs as one JSON object on one line.
pub(super) fn json(sweep: &Sweep) -> String {
    let Sweep { edition, combinations, transitions, complete, costs, closed } = sweep;
    let same =
        |other: &&&Edition| other.version != edition.version && have_the_same_state_machine(other, edition);
    let fails = |name: &str| costs.iter().any(|cost| cost.name == name);
    line(&CostsJson {
        schema: SCHEMA,
        edition: edition.version,
        same: Edition::ALL.iter().filter(same).map(|other| other.version).collect(),
        combinations: *combinations,
        steps: *transitions,
        complete: *complete,
        ranking: sweep
            .ranked()
            .into_iter()
            .map(|one| RankedJson {
                answers: answers(edition, one.choices),
                harm: one.harm.text(),
                fails: one.fails,
            })
            .collect(),
        free: answers(edition, sweep.free()),
        costs: properties(edition)
            .flat_map(|property| {
                costs.iter().filter(|cost| cost.name == property.name).map(move |cost| (property, cost))
            })
            .map(|(property, cost)| CostJson::of(edition, property, cost))
            .collect(),
        closed: closed.iter().map(|cost| ClosedJson::of(edition, cost)).collect(),
        unreachable: costs
            .iter()
            .filter_map(|cost| Some((cost, goals(edition).iter().find(|goal| goal.name == cost.name)?)))
            .map(|(cost, goal)| GoalJson {
                name: goal.name,
                statement: goal.statement.to_string(),
                answers: answers(edition, cost.choices),
            })
            .collect(),
        holding: properties(edition)
            .filter(|property| !fails(property.name))
            .map(|property| CostlyJson::of(edition, property))
            .collect(),
    })
}

/// A page of the costs of editions, each a line of JSON.
pub(super) fn page(
    editions: &[&'static Edition],
    lines: &[String],
    holds: bool,
) -> Result<String, PageError> {
    let versions: Vec<&str> = editions.iter().map(|edition| edition.version).collect();
    let (mood, verdict) = if holds {
        (Mood::Good, "Every exploration was complete, and nothing fails under the default answers.")
    } else {
        (Mood::Bad, "An exploration was not complete, or a property fails under the default answers.")
    };
    let next = if holds {
        "Agree with your team, and with your simulator, on the answers at the top of the ranking: another answer is not wrong, and \
         two programs that answer differently differ in just this."
    } else {
        "Do not go by what follows: find out first what fails under the default answers, with adsdv verify."
    };
    let objects: Vec<&str> = lines.iter().map(|line| line.trim_end()).collect();
    let about = [format!("edition {}", versions.join(", ")), counted(editions.len() as u64, "state machine")];
    Outcome {
        title: "adsdv verify --readings: what each reading costs",
        about: &about,
        mood,
        verdict,
        next,
        json: &format!("[{}]", objects.join(",")),
        shown: Shown::Readings,
    }
    .html()
}

#[derive(Serialize)]
struct CostsJson {
    schema: u32,
    edition: &'static str,
    same: Vec<&'static str>,
    combinations: usize,
    steps: u64,
    complete: bool,
    ranking: Vec<RankedJson>,
    free: Vec<AnswerJson>,
    costs: Vec<CostJson>,
    closed: Vec<ClosedJson>,
    unreachable: Vec<GoalJson>,
    holding: Vec<CostlyJson>,
}

#[derive(Serialize)]
struct AnswerJson {
    id: String,
    text: &'static str,
    instead_of: &'static str,
}

#[derive(Serialize)]
struct RankedJson {
    answers: Vec<AnswerJson>,
    harm: &'static str,
    fails: Vec<&'static str>,
}

#[derive(Serialize)]
struct CostlyJson {
    name: &'static str,
    statement: String,
    requirements: Vec<&'static str>,
}

#[derive(Serialize)]
struct CostJson {
    #[serde(flatten)]
    property: CostlyJson,
    answers: Vec<AnswerJson>,
    undone_by: Vec<String>,
    harm: &'static str,
    run: Vec<LineJson>,
}

#[derive(Serialize)]
struct ClosedJson {
    #[serde(flatten)]
    property: CostlyJson,
    answers: Vec<AnswerJson>,
    run: Vec<LineJson>,
}

#[derive(Serialize)]
struct GoalJson {
    name: &'static str,
    statement: String,
    answers: Vec<AnswerJson>,
}

#[derive(Serialize)]
struct LineJson {
    ms: u64,
    text: String,
}

impl CostlyJson {
    fn of(edition: &Edition, property: &Property) -> Self {
        Self {
            name: property.name,
            statement: property.statement_in(edition),
            requirements: property.requirements_in(edition),
        }
    }
}

impl CostJson {
    fn of(edition: &Edition, property: &Property, cost: &Cost) -> Self {
        let run = cost.run.as_deref().map(|run| story(&cost.machine(), run, Some(property)));
        Self {
            property: CostlyJson::of(edition, property),
            answers: answers(edition, cost.choices),
            undone_by: cost.undone_by.iter().map(|choice| choice.to_string()).collect(),
            harm: cost.harm(property).text(),
            run: lines(run.unwrap_or_default()),
        }
    }
}

impl ClosedJson {
    fn of(edition: &Edition, ClosedCost { property, choice, run }: &ClosedCost) -> Self {
        Self {
            property: CostlyJson {
                name: property.name,
                statement: property.statement_in(edition),
                requirements: property.requirements_in(edition),
            },
            answers: vec![answer(edition, *choice)],
            run: lines(story_of(run)),
        }
    }
}

fn answers(edition: &Edition, choices: Choices) -> Vec<AnswerJson> {
    choices.iter().map(|choice| answer(edition, choice)).collect()
}

fn answer(edition: &Edition, choice: Choice) -> AnswerJson {
    let instead_of = edition.readings.choice(choice.reading()).text();
    AnswerJson { id: choice.to_string(), text: choice.text(), instead_of }
}

fn lines(story: Vec<StoryLine>) -> Vec<LineJson> {
    story.into_iter().map(|StoryLine { ms, text }| LineJson { ms, text }).collect()
}
