//! `check`: judges a recorded log.

use adsdv_formats::Log;
use adsdv_oracle::judge::JudgeOptions;
use adsdv_oracle::log::{Judged, LogError, LogOptions, judge_by};
use adsdv_spec::{Choice, Choices, Edition};
use pyo3::prelude::*;

use crate::edition;
use crate::report::Report;
use crate::rules;
use crate::source;
use crate::value;

/// The longest window and deadline that make sense, in milliseconds.
const LONGEST: u32 = 60_000;

/// Judges a log: says who broke which section of the document, when, and what was expected instead.
///
/// log: the path of a file (str or os.PathLike), its contents (bytes), or its lines, from any iterable of str or bytes: a
/// list, a generator. The format is recognised by the content: candump, Vector ASC and BLF, PEAK TRC, the CSV of
/// python-can and of SavvyCAN, MCAP of ROS 2; gzip and Zstandard around any of these.
/// readings: where the document allows more than one meaning, those that are known to be followed, such as
/// {"fault-trigger": "edge"}; adsdv.readings() lists them. A violation is what is one under all that remain possible.
/// window_ms: how long after a cause its effect may be seen; None for 30.
/// deadline_ms: for how long a condition must hold before a missing effect is a violation; None for 50.
/// interface: the CAN interface to judge, such as "can0"; None for the first that carries a message of the document.
/// edition: the edition of the interface to judge by, one of adsdv.editions(); None to recognise it by the frames, and where
/// they do not tell, adsdv.INTERFACE_VERSION. The report says which one it is.
/// rules: rules of one's own, which are judged beside the document: the text of a file of rules, of which RULES.md has the
/// language; None for no rules. What is wrong with them is a RulesError, which has the line and the column.
///
/// Other threads run meanwhile, so that logs can be judged side by side in threads; check_many does that. Ctrl-C stops it. A line that is no frame is a finding; a
/// log without a frame is a LogError; a log that cannot be read is an OSError.
///
/// >>> import adsdv
/// >>> adsdv.check(["(1.000000) can0 520#0000010000000000"]).verdict
/// 'conforms'
/// >>> adsdv.check(["(1.00) can0 120#0010000000000000", "(1.01) can0 520#0000010000000000"]).edition
/// '4.0'
/// >>> adsdv.check(b"")
/// Traceback (most recent call last):
///     ...
/// adsdv.LogError: the log is empty; expected lines of candump -L, such as (1.000000) can0 520#0000010000000000
// They are keyword arguments in Python.
#[allow(clippy::too_many_arguments)]
#[pyfunction]
#[pyo3(signature = (log, *, readings=None, window_ms=None, deadline_ms=None, interface=None, edition=None, rules=None))]
pub(crate) fn check(
    py: Python<'_>,
    log: &Bound<'_, PyAny>,
    readings: Option<&Bound<'_, PyAny>>,
    window_ms: Option<&Bound<'_, PyAny>>,
    deadline_ms: Option<&Bound<'_, PyAny>>,
    interface: Option<String>,
    edition: Option<&Bound<'_, PyAny>>,
    rules: Option<&Bound<'_, PyAny>>,
) -> PyResult<Report> {
    let plan = Plan::of(py, readings, window_ms, deadline_ms, interface, edition, rules)?;
    let (origin, log) = source::open(log)?;
    let judged = py.detach(|| plan.judge(log)).map_err(|error| origin.error(py, &error))?;
    plan.possible(&judged)?;
    match judged.failure {
        Some(failure) => Err(origin.error(py, &LogError::Read(failure))),
        None => plan.report(py, &judged),
    }
}

/// How logs are judged, by the arguments.
pub(crate) struct Plan {
    /// The edition that was named; `None` to recognise it.
    edition: Option<&'static Edition>,
    pins: Vec<Choice>,
    options: LogOptions,
}

impl Plan {
    pub(crate) fn of(
        py: Python<'_>,
        readings: Option<&Bound<'_, PyAny>>,
        window_ms: Option<&Bound<'_, PyAny>>,
        deadline_ms: Option<&Bound<'_, PyAny>>,
        interface: Option<String>,
        edition: Option<&Bound<'_, PyAny>>,
        rules: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let edition = edition.map(edition::named).transpose()?;
        let pins = value::choices(readings)?;
        let (by, readings) = match edition {
            Some(edition) => (edition, edition::pinned(edition, &pins)?),
            None => (edition::DEFAULT, edition::pinned_in_some(edition::DEFAULT, &pins)?),
        };
        let rules = rules::read(py, rules, edition)?;
        let options = LogOptions { judge: options(by, readings, window_ms, deadline_ms)?, interface, rules };
        Ok(Self { edition, pins, options })
    }

    /// Whether the edition is recognised.
    pub(crate) const fn recognises(&self) -> bool {
        self.edition.is_none()
    }

    /// Judges a log, by the edition that was named or by the one that the log tells. Python is not needed for it.
    pub(crate) fn judge(&self, log: Log) -> Result<Judged, LogError> {
        judge_by(log, &self.options, self.recognises(), |_| {})
    }

    /// Refuses a log of an edition that does not leave open what was pinned.
    pub(crate) fn possible(&self, judged: &Judged) -> PyResult<()> {
        edition::pinned(judged.recognised.edition, &self.pins).map(drop)
    }

    /// What is said of it.
    pub(crate) fn report(&self, py: Python<'_>, judged: &Judged) -> PyResult<Report> {
        let recognised = Some(&judged.recognised).filter(|_| self.recognises());
        Report::of(py, judged.recognised.edition, recognised, &judged.report)
    }
}

/// What a judge may assume.
pub(crate) fn options(
    edition: &'static Edition,
    readings: Choices,
    window_ms: Option<&Bound<'_, PyAny>>,
    deadline_ms: Option<&Bound<'_, PyAny>>,
) -> PyResult<JudgeOptions> {
    let usual = JudgeOptions::of(edition);
    let ms = |key: &str, given: Option<&Bound<'_, PyAny>>, usual: u32| match given {
        Some(given) => value::whole(key, given, 0, LONGEST),
        None => Ok(usual),
    };
    Ok(JudgeOptions {
        window_ms: ms("window_ms", window_ms, usual.window_ms)?,
        deadline_ms: ms("deadline_ms", deadline_ms, usual.deadline_ms)?,
        readings,
        ..usual
    })
}
