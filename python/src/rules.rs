//! A team's own rules, which a judge follows beside the document.

use adsdv_oracle::rules::{RuleErrors, RuleFile, RuleReport};
use adsdv_spec::Edition;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::error::RulesError;
use crate::value::{self, seconds};

/// The rules of a text, if there is one; for an edition, or where a log is to tell which it is, for any.
pub(crate) fn read(
    py: Python<'_>,
    text: Option<&Bound<'_, PyAny>>,
    edition: Option<&Edition>,
) -> PyResult<Option<RuleFile>> {
    let Some(given) = text else { return Ok(None) };
    let text = value::text(given)
        .ok_or_else(|| value::refused("rules", given, "the text of a file of rules, or None"))?;
    RuleFile::read(&text, edition).map(Some).map_err(|errors| wrong(py, &errors))
}

/// What is wrong with rules, as an exception that has the place of the first mistake, and all that are listed.
pub(crate) fn wrong(py: Python<'_>, errors: &RuleErrors) -> PyErr {
    let exception = RulesError::new_err(format!("rules, {errors}"));
    let value = exception.value(py);
    let placed = || {
        let mistakes = PyList::empty(py);
        for error in errors.iter() {
            let dict = PyDict::new(py);
            dict.set_item("line", error.line)?;
            dict.set_item("column", error.column)?;
            dict.set_item("width", error.width)?;
            dict.set_item("why", &error.why)?;
            mistakes.append(dict)?;
        }
        value.setattr("line", errors.first().line)?;
        value.setattr("column", errors.first().column)?;
        value.setattr("mistakes", mistakes)?;
        value.setattr("more", errors.more())
    };
    placed().err().unwrap_or(exception)
}

/// What became of each, as `adsdv check --json` has it.
pub(crate) fn reports<'py>(py: Python<'py>, rules: &[RuleReport]) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    for report in rules {
        let dict = PyDict::new(py);
        dict.set_item("name", &report.name)?;
        dict.set_item("line", report.line)?;
        dict.set_item("rule", &report.rule)?;
        if let Some(note) = &report.note {
            dict.set_item("note", note)?;
        }
        dict.set_item("verdict", report.verdict().name())?;
        dict.set_item("held", report.held)?;
        dict.set_item("broken", report.broken)?;
        dict.set_item("undecided", report.undecided)?;
        let breaches = PyList::empty(py);
        for breach in &report.breaches {
            let dict = PyDict::new(py);
            dict.set_item("t", seconds(breach.t_ns))?;
            dict.set_item("seen", &breach.seen)?;
            breaches.append(dict)?;
        }
        dict.set_item("breaches", breaches)?;
        if let Some(why) = &report.why {
            dict.set_item("why", why)?;
        }
        list.append(dict)?;
    }
    Ok(list)
}
