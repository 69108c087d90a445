//! How an exam is held, by what was given.

use std::path::PathBuf;
use std::time::Duration;

use adsdv_exam::{ExamOptions, ExamScenario, NoScenario, SEED, chosen, random_scenarios};
use adsdv_spec::Edition;
use pyo3::prelude::*;
use pyo3::types::PyBool;

use crate::error::InputError;
use crate::value;

/// No more scenarios by chance, and no more runs of each search: some hours.
const MOST_RUNS: u32 = 100_000;
/// No more seconds: a day.
const LONGEST_S: f64 = 86_400.0;
/// As the command has them.
const SHRINK: u32 = 40;
const TIMEOUT_S: f64 = 5.0;
const TIME_LIMIT_S: f64 = 900.0;

/// How an exam is held.
pub(super) struct Options {
    pub(super) exam: ExamOptions,
    pub(super) shrink: u32,
    pub(super) timeout: Duration,
    pub(super) time_limit: Duration,
    pub(super) logs: Logs,
}

/// What becomes of the logs of the scenarios.
pub(super) enum Logs {
    None,
    Report,
    Directory(PathBuf),
}

impl Options {
    pub(super) fn of(
        edition: &'static Edition,
        shrink: Option<&Bound<'_, PyAny>>,
        mission_time: Option<&Bound<'_, PyAny>>,
        timeout: Option<&Bound<'_, PyAny>>,
        time_limit: Option<&Bound<'_, PyAny>>,
        logs: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let mut exam = ExamOptions::of(edition);
        if let Some(given) = mission_time {
            let time = seconds("mission_time", Some(given), 0.0)?;
            exam.mission_ms = u64::try_from(time.as_millis()).unwrap_or(u64::MAX);
        }
        Ok(Self {
            exam,
            shrink: whole("shrink", shrink, SHRINK)?,
            timeout: seconds("timeout", timeout, TIMEOUT_S)?,
            time_limit: seconds("time_limit", time_limit, TIME_LIMIT_S)?,
            logs: logs.map_or(Ok(Logs::None), Logs::of)?,
        })
    }
}

impl Logs {
    fn of(given: &Bound<'_, PyAny>) -> PyResult<Self> {
        if given.is_instance_of::<PyBool>() {
            return Ok(if given.is_truthy()? { Self::Report } else { Self::None });
        }
        let path = given.extract().ok().filter(|path: &PathBuf| !path.as_os_str().is_empty());
        path.map(Self::Directory).ok_or_else(|| {
            value::refused("logs", given, "True to have them in the report, or the path of a directory")
        })
    }
}

/// The scenarios that are asked for.
pub(super) fn scenarios(
    only: Option<&Bound<'_, PyAny>>,
    quick: bool,
    scenario: Option<&Bound<'_, PyAny>>,
    runs: Option<&Bound<'_, PyAny>>,
    seed: Option<&Bound<'_, PyAny>>,
) -> PyResult<Vec<ExamScenario>> {
    let names = only.map_or(Ok(Vec::new()), names)?;
    let runs = whole("runs", runs, 0)?;
    let seed = match seed {
        Some(given) => given
            .extract::<u64>()
            .ok()
            .filter(|_| !given.is_instance_of::<PyBool>())
            .ok_or_else(|| value::refused("seed", given, "a whole number from 0 to 2**64 - 1"))?,
        None => SEED,
    };
    if let Some(given) = scenario {
        if only.is_some() || quick || runs > 0 {
            return Err(InputError::new_err(
                "\"scenario\" is given, and \"only\", \"quick\" or \"runs\"; expected a scenario, or which of those that there are",
            ));
        }
        let text =
            value::text(given).ok_or_else(|| value::refused("scenario", given, "the text of a scenario"))?;
        let read = ExamScenario::read("scenario", &text);
        return match read {
            Ok(scenario) => Ok(vec![scenario]),
            Err(wrong) => Err(InputError::new_err(format!("\"scenario\" is no scenario\n{wrong}"))),
        };
    }
    if quick && only.is_some() {
        return Err(InputError::new_err(
            "\"only\" and \"quick\" are given; expected one of them: the quick ones are chosen already",
        ));
    }
    let mut all = adsdv_exam::scenarios();
    all.extend(random_scenarios(seed, runs));
    chosen(all, &names, quick).map_err(|NoScenario(unknown)| {
        let names: Vec<String> = adsdv_exam::scenarios().into_iter().map(|one| one.name).collect();
        InputError::new_err(format!(
            "\"only\": no scenario begins with {unknown:?}; expected one of {}, or with runs one from random-0 on",
            names.join(", ")
        ))
    })
}

fn names(given: &Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    /// There are not so many scenarios; an iterable may have no end.
    const MOST: usize = 10_000;
    if let Some(name) = value::text(given) {
        return Ok(vec![name]);
    }
    let names = given.try_iter().ok().and_then(|names| {
        let names: Option<Vec<String>> =
            names.take(MOST).map(|name| name.ok().and_then(|name| value::text(&name))).collect();
        names.filter(|names| !names.is_empty() && names.len() < MOST)
    });
    names
        .ok_or_else(|| value::refused("only", given, "the beginning of a scenario's name, or a list of such"))
}

fn whole(key: &str, given: Option<&Bound<'_, PyAny>>, usual: u32) -> PyResult<u32> {
    given.map_or(Ok(usual), |given| value::whole(key, given, 0, MOST_RUNS))
}

fn seconds(key: &str, given: Option<&Bound<'_, PyAny>>, usual: f64) -> PyResult<Duration> {
    let Some(given) = given else { return Ok(Duration::from_secs_f64(usual)) };
    let number = given.extract::<f64>().ok().filter(|_| !given.is_instance_of::<PyBool>());
    let number = number.filter(|number| (0.001..=LONGEST_S).contains(number));
    number
        .map(Duration::from_secs_f64)
        .ok_or_else(|| value::refused(key, given, format_args!("seconds, from 0.001 to {LONGEST_S}")))
}
