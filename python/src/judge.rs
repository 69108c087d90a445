//! `Judge`: judges a live bus, frame by frame.

use adsdv_spec::Edition;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::check;
use crate::edition;
use crate::error::InputError;
use crate::report::{self, Report};
use crate::rules;
use crate::value;

/// The latest time that a frame may have, in seconds: that of a log, nanoseconds in 63 bits.
const LATEST_S: f64 = 9_223_372_036.0;

/// Judges frames as they come, in memory that does not grow with their number but for what it finds.
///
/// readings, window_ms, deadline_ms, rules: as of check.
/// edition: the edition of the interface to judge by, one of adsdv.editions(); None for adsdv.INTERFACE_VERSION. It is not
/// recognised: that would take a second of frames.
///
/// >>> import adsdv
/// >>> judge, vcu = adsdv.Judge(), adsdv.Vcu()
/// >>> for cycle in range(100):
/// ...     for id, data in adsdv.frames(vcu.step(dt_ms=10)):
/// ...         judge.frame(cycle * 0.010, id, data)
/// >>> judge.state
/// 'AS_OFF'
/// >>> judge.finish().verdict
/// 'conforms'
#[pyclass(module = "adsdv")]
pub(crate) struct Judge {
    /// None once it has finished.
    working: Option<Box<adsdv_oracle::judge::Judge>>,
    edition: &'static Edition,
    /// The time of the first frame.
    origin: Option<i64>,
}

impl Judge {
    fn judging(&mut self) -> PyResult<&mut adsdv_oracle::judge::Judge> {
        self.working.as_deref_mut().ok_or_else(finished)
    }
}

fn finished() -> PyErr {
    InputError::new_err("this judge has finished; expected a new one: adsdv.Judge()")
}

#[pymethods]
impl Judge {
    #[new]
    #[pyo3(signature = (*, readings=None, window_ms=None, deadline_ms=None, edition=None, rules=None))]
    fn new(
        py: Python<'_>,
        readings: Option<&Bound<'_, PyAny>>,
        window_ms: Option<&Bound<'_, PyAny>>,
        deadline_ms: Option<&Bound<'_, PyAny>>,
        edition: Option<&Bound<'_, PyAny>>,
        rules: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let edition = edition::or_default(edition)?;
        let readings = edition::pinned(edition, &value::choices(readings)?)?;
        let options = check::options(edition, readings, window_ms, deadline_ms)?;
        let mut judge = adsdv_oracle::judge::Judge::new(options);
        if let Some(rules) = rules::read(py, rules, Some(edition))? {
            judge.follow(&rules).map_err(|error| rules::wrong(py, &error))?;
        }
        Ok(Self { working: Some(Box::new(judge)), edition, origin: None })
    }

    /// Judges a classic data frame with an identifier of 11 bits.
    ///
    /// time: in seconds since any origin, such as 1970; the report counts from the first frame.
    /// data: bytes of any kind, or a list of numbers.
    ///
    /// >>> import adsdv
    /// >>> judge = adsdv.Judge()
    /// >>> judge.frame(1795209995.234358, 0x520, bytes(8))
    /// >>> judge.frame("now", 0x520, bytes(8))
    /// Traceback (most recent call last):
    ///     ...
    /// adsdv.InputError: "time" is 'now'; expected seconds, from 0 to 9223372036
    fn frame(
        slf: &Bound<'_, Self>,
        time: &Bound<'_, PyAny>,
        id: &Bound<'_, PyAny>,
        data: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        // The arguments may run code of their own, which may use this judge. So it is not held meanwhile.
        let (time, id, data) = (nanoseconds(time)?, value::id(id)?, value::data(data)?);
        let mut this = slf.try_borrow_mut()?;
        let origin = *this.origin.get_or_insert(time);
        this.judging()?.frame(time - origin, id.into(), &data);
        Ok(())
    }

    /// What has been found since it was last asked, as in a Report: the transitions and the findings.
    ///
    /// What this has returned is not in the report of finish.
    ///
    /// >>> import adsdv
    /// >>> judge = adsdv.Judge()
    /// >>> judge.frame(1.00, 0x520, bytes.fromhex("0000010000000000"))
    /// >>> judge.frame(1.01, 0x181, b"")
    /// >>> transitions, findings = judge.news()
    /// >>> findings[0]["rule"]
    /// 'reserved-identifier'
    /// >>> judge.news()
    /// ([], [])
    fn news<'py>(&mut self, py: Python<'py>) -> PyResult<(Bound<'py, PyList>, Bound<'py, PyList>)> {
        let (transitions, findings) = self.judging()?.take_news();
        Ok((report::transitions(py, &transitions)?, report::findings(py, &findings)?))
    }

    /// The version of the edition that it judges by, one of adsdv.editions().
    ///
    /// >>> import adsdv
    /// >>> adsdv.Judge(edition="4.0").edition
    /// '4.0'
    #[getter]
    fn edition(&self) -> &'static str {
        self.edition.version
    }

    /// The AS state that the VCU showed last, such as "AS_READY"; None while nothing fresh was seen of it, or after finish.
    #[getter]
    fn state(&self) -> Option<&'static str> {
        Some(self.working.as_deref()?.state()?.name())
    }

    /// How fast the AI Computer has answered the handshake so far, as in a Report; None if no answer was seen.
    #[getter]
    fn handshake_response_ms<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let judge = self.working.as_deref().ok_or_else(finished)?;
        report::responses(py, judge.responses())
    }

    /// The end of the log: settles what is still open, and makes the Report. After it, the judge is of no more use.
    fn finish(&mut self, py: Python<'_>) -> PyResult<Report> {
        let judge = self.working.take().ok_or_else(finished)?;
        Report::of(py, self.edition, None, &judge.finish())
    }

    fn __repr__(&self) -> String {
        let state = self.state().unwrap_or(if self.working.is_none() { "finished" } else { "no state seen" });
        format!("<adsdv.Judge: {state}>")
    }
}

fn nanoseconds(time: &Bound<'_, PyAny>) -> PyResult<i64> {
    let seconds = time.extract::<f64>().ok().filter(|seconds| (0.0..=LATEST_S).contains(seconds));
    let seconds =
        seconds.ok_or_else(|| value::refused("time", time, format_args!("seconds, from 0 to {LATEST_S}")))?;
    #[expect(clippy::cast_possible_truncation, reason = "it is whole, and within the range")]
    Ok((seconds * 1e9).round() as i64)
}
