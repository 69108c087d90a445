//! The judge of a live bus or a log, behind a handle.

use core::ffi::c_char;
use std::collections::VecDeque;
use std::ffi::CString;

use adsdv_oracle::judge::{Finding, Judge, JudgeOptions, Severity};
use adsdv_oracle::rules::{RuleErrors, RuleFile, RuleReport};
use adsdv_spec::Choices;

use crate::border::{Plain, answer, check, load, out, slice};
use crate::edition::{self, adsdv_edition};
use crate::error::{Refusal, adsdv_error, adsdv_status};
use crate::machine::listed;
use crate::text::short;
use crate::texts::{Texts, without_nul};

/// How much a finding weighs.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum adsdv_severity {
    /// Against the document, under every reading that is not excluded.
    ADSDV_VIOLATION = 0,
    /// Not against the document, or only under some readings; worth a look.
    ADSDV_WARNING = 1,
    /// A fact about what was recorded.
    ADSDV_NOTE = 2,
}

impl From<Severity> for adsdv_severity {
    fn from(severity: Severity) -> Self {
        match severity {
            Severity::Violation => Self::ADSDV_VIOLATION,
            Severity::Warning => Self::ADSDV_WARNING,
            Severity::Note => Self::ADSDV_NOTE,
        }
    }
}

/// What the judge may assume. adsdv_judge_options_init sets what it assumes where nothing else is said.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct adsdv_judge_options {
    /// How long after a cause its effect may be seen, in ms: the cycle of the VCU and the delay of the bus.
    pub window_ms: u32,
    /// For how long a condition must hold before a missing effect is a violation, in ms.
    pub deadline_ms: u32,
    /// The edition of the interface to judge by; it is not recognised.
    pub edition: adsdv_edition,
    /// How the VCU is known to read the document, as for adsdv_machine_init_in; NULL if nothing is known. A violation is
    /// what is one under all readings that are possible.
    pub readings: *const c_char,
}

/// One thing that the judge found.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct adsdv_finding {
    /// When, in nanoseconds, on the clock of the frames.
    pub t_ns: i64,
    /// What was seen and what was expected instead. The text is the judge's; it stays until the next call with it.
    pub message: *const c_char,
    /// How much it weighs, an adsdv_severity.
    pub severity: u8,
    /// "violation", "warning" or "note".
    pub severity_name: [c_char; 12],
    /// Who is at fault: "AI", "VCU", or "LOG" for nobody; "OWN" where a rule of adsdv_judge_follow was broken.
    pub party: [c_char; 4],
    /// The section of the document, or the line of the user's own rules, as "line 3".
    pub section: [c_char; 12],
    /// What was checked: a stable name such as "transition-due".
    pub rule: [c_char; 32],
}

/// What all of it comes to.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct adsdv_report {
    /// How many frames there were.
    pub frames: u64,
    /// How many violations; none means that what was judged keeps to the document.
    pub violations: u64,
    /// How many warnings.
    pub warnings: u64,
    /// How many notes.
    pub notes: u64,
    /// The time from the first frame to the last, in nanoseconds.
    pub duration_ns: i64,
}

// SAFETY: `repr(C)`; integers and a pointer, which is followed only by `text`.
unsafe impl Plain for adsdv_judge_options {}
// SAFETY: `repr(C)`; integers, arrays of `char` and a pointer, which is never followed.
unsafe impl Plain for adsdv_finding {}
// SAFETY: `repr(C)`, integers only.
unsafe impl Plain for adsdv_report {}

/// A judge of one bus. It is made by adsdv_judge_new and freed by adsdv_judge_free.
#[derive(Debug)]
pub struct adsdv_judge {
    /// `None` once it has finished.
    judge: Option<Judge>,
    /// Whether the judge is at work: true where one begins means that a panic left it half done.
    at_work: bool,
    /// What was found and is not handed out yet. The judge itself keeps what is not asked for, in bounded memory.
    news: VecDeque<Finding>,
    /// The message of the finding that was handed out last.
    message: CString,
    report: adsdv_report,
    /// What became of the user's own rules, once it has finished; and the texts of the one that was handed out last.
    pub(crate) rules: Vec<RuleReport>,
    pub(crate) texts: Texts,
}

impl adsdv_judge {
    fn new(options: JudgeOptions) -> Self {
        Self {
            judge: Some(Judge::new(options)),
            at_work: false,
            news: VecDeque::new(),
            message: CString::default(),
            report: adsdv_report::default(),
            rules: Vec::new(),
            texts: Texts::default(),
        }
    }

    /// Does what can go wrong in a way that nobody foresaw; after that, the judge is of no use.
    fn at_work<T>(
        &mut self,
        work: impl FnOnce(&mut Self) -> Result<T, Refusal<'static>>,
    ) -> Result<T, Refusal<'static>> {
        if self.at_work {
            return Err(Refusal::Internal);
        }
        self.at_work = true;
        let done = work(self);
        self.at_work = false;
        done
    }

    /// Shows the judge a frame.
    fn see(&mut self, frame: impl FnOnce(&mut Judge)) -> Result<(), Refusal<'static>> {
        self.at_work(|this| {
            frame(this.judge.as_mut().ok_or(Refusal::Finished)?);
            Ok(())
        })
    }

    /// Follows the rules of this text from now on, or says all that is wrong with it.
    pub(crate) fn follow(&mut self, rules: &str) -> Result<Result<(), RuleErrors>, Refusal<'static>> {
        self.at_work(|this| {
            let judge = this.judge.as_mut().ok_or(Refusal::Finished)?;
            let rules = RuleFile::read(rules, Some(judge.edition()));
            Ok(rules.and_then(|rules| judge.follow(&rules)))
        })
    }

    fn finish(&mut self) -> Result<adsdv_report, Refusal<'static>> {
        self.at_work(|this| {
            if let Some(judge) = this.judge.take() {
                let report = judge.finish();
                (this.report.frames, this.report.duration_ns) = (report.frames, report.duration_ns);
                this.rules = report.rules;
                this.hear(report.findings);
            }
            Ok(this.report)
        })
    }

    /// The next finding, for C.
    fn next(&mut self) -> Result<Option<adsdv_finding>, Refusal<'static>> {
        self.at_work(|this| {
            if let (true, Some(judge)) = (this.news.is_empty(), &mut this.judge) {
                let (_, findings) = judge.take_news();
                this.hear(findings);
            }
            Ok(this.news.pop_front().map(|finding| this.report(&finding)))
        })
    }

    fn hear(&mut self, findings: Vec<Finding>) {
        for finding in &findings {
            *match finding.severity {
                Severity::Violation => &mut self.report.violations,
                Severity::Warning => &mut self.report.warnings,
                Severity::Note => &mut self.report.notes,
            } += 1;
        }
        self.news.extend(findings);
    }

    fn report(&mut self, finding: &Finding) -> adsdv_finding {
        self.message = without_nul(&finding.message());
        adsdv_finding {
            t_ns: finding.t_ns,
            message: self.message.as_ptr(),
            severity: adsdv_severity::from(finding.severity) as u8,
            severity_name: short(finding.severity.name()),
            party: short(finding.party.name()),
            section: short(&finding.section.to_string()),
            rule: short(finding.rule.id()),
        }
    }
}

/// The judge behind a handle. The caller promises that it is NULL or a handle of adsdv_judge_new that is not freed yet,
/// and that no other thread uses it meanwhile.
pub(crate) unsafe fn handle<'a>(judge: *mut adsdv_judge) -> Result<&'a mut adsdv_judge, Refusal<'static>> {
    check(judge, "judge")?;
    // SAFETY: it is not NULL, it is aligned, and the caller promises the rest.
    Ok(unsafe { &mut *judge })
}

/// What the judge assumes where nothing else is said; it is of the default edition.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_judge_options_init(
    options: *mut adsdv_judge_options,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        // SAFETY: the caller promises it for the options.
        let place = unsafe { out(options, "options")? };
        let JudgeOptions { window_ms, deadline_ms, .. } = JudgeOptions::default();
        let edition = edition::DEFAULT;
        place.set(adsdv_judge_options { window_ms, deadline_ms, edition, readings: core::ptr::null() });
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}

/// A new judge of a bus, which adsdv_judge_free must free; NULL if there is an error. `options` may be NULL: then
/// it judges by the default edition.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_judge_new(
    options: *const adsdv_judge_options,
    error: *mut adsdv_error,
) -> *mut adsdv_judge {
    let mut made = core::ptr::null_mut();
    let work = || {
        let mut chosen = JudgeOptions::default();
        if !options.is_null() {
            // SAFETY: the caller promises it for the options.
            let given = unsafe { load(options, "options")? };
            let edition = edition::given(given.edition, "options.")?;
            chosen = JudgeOptions::of(edition);
            (chosen.window_ms, chosen.deadline_ms) = (given.window_ms, given.deadline_ms);
            // SAFETY: and for the text that they point to.
            chosen.readings = unsafe { listed(edition, given.readings, chosen.readings, Choices::pin)? };
        }
        made = Box::into_raw(Box::new(adsdv_judge::new(chosen)));
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) };
    made
}

/// Frees a judge, whose texts are gone then. NULL is left alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_judge_free(judge: *mut adsdv_judge) {
    let work = || {
        check(judge, "judge")?;
        // SAFETY: it is not NULL, so the caller promises that `adsdv_judge_new` made it, with a `Box`, and that it was
        // not freed before.
        drop(unsafe { Box::from_raw(judge) });
        Ok(())
    };
    // SAFETY: there is no error to write.
    unsafe { answer(core::ptr::null_mut(), work) };
}

/// Judges a classic CAN data frame with an 11-bit identifier: `t_ns` is its time in nanoseconds on any clock, best since
/// the first frame; time may jump. Identifiers that are not the interface's and any `length` are fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_judge_frame(
    judge: *mut adsdv_judge,
    t_ns: i64,
    id: u32,
    data: *const u8,
    length: usize,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        // SAFETY: the caller promises it for the judge and for `length` bytes.
        let (judge, data) = unsafe { (handle(judge)?, slice(data, length, "data")?) };
        judge.see(|judge| judge.frame(t_ns, id, data))
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}

/// Counts a frame that is not judged (extended, remote, CAN FD, of another bus), and lets time pass.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_judge_other_frame(
    judge: *mut adsdv_judge,
    t_ns: i64,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        // SAFETY: the caller promises it for the judge.
        let judge = unsafe { handle(judge)? };
        judge.see(|judge| {
            judge.other_frame(t_ns);
        })
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}

/// The next thing that the judge found and that was not taken yet: true, and it is in `finding`; or false: there is
/// none at present, or a pointer is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_judge_next(judge: *mut adsdv_judge, finding: *mut adsdv_finding) -> bool {
    let mut found = false;
    let work = || {
        // SAFETY: the caller promises it for the judge and the finding.
        let (judge, place) = unsafe { (handle(judge)?, out(finding, "finding")?) };
        if let Some(finding) = judge.next()? {
            place.set(finding);
            found = true;
        }
        Ok(())
    };
    // SAFETY: there is no error to write.
    unsafe { answer(core::ptr::null_mut(), work) };
    found
}

/// The end: settles what is still open, which adsdv_judge_next then has, and says what it all comes to. `report` may be
/// NULL. A second call says the same.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_judge_finish(
    judge: *mut adsdv_judge,
    report: *mut adsdv_report,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        // SAFETY: the caller promises it for the judge.
        let judge = unsafe { handle(judge)? };
        let place = if report.is_null() {
            None
        } else {
            // SAFETY: the caller promises it for the report.
            Some(unsafe { out(report, "report")? })
        };
        let all = judge.finish()?;
        if let Some(place) = place {
            place.set(all);
        }
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::{AssertUnwindSafe, catch_unwind};

    #[test]
    fn a_judge_that_panicked_is_not_used_again() {
        let mut judge = adsdv_judge::new(JudgeOptions::default());
        assert!(judge.see(|judge| judge.frame(0, 0x520, &[])).is_ok());
        assert!(catch_unwind(AssertUnwindSafe(|| judge.see(|_| panic!("once")))).is_err());
        assert!(matches!(judge.see(|judge| judge.frame(0, 0x520, &[])), Err(Refusal::Internal)));
        assert!(matches!(judge.next(), Err(Refusal::Internal)));
        assert!(matches!(judge.finish(), Err(Refusal::Internal)));
    }
}
