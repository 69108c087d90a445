//! A team's own rules, which a judge follows beside the document. RULES.md has the language.

use core::ffi::c_char;

use adsdv_oracle::rules::{RuleError, RuleReport, RuleVerdict};

use crate::border::{Plain, answer, out, text};
use crate::error::{Refusal, adsdv_error, adsdv_status};
use crate::judge::{adsdv_judge, handle};
use crate::text::short;
use crate::texts::Texts;

/// Where a text of rules is wrong.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct adsdv_rule_place {
    /// The line, from 1.
    pub line: u32,
    /// The character in it where the trouble begins, from 1.
    pub column: u32,
    /// How many characters are meant, at least 1.
    pub width: u32,
}

/// What a rule came to.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum adsdv_rule_verdict {
    /// It was kept at least once, and never seen broken.
    ADSDV_RULE_HOLDS = 0,
    /// It was broken.
    ADSDV_RULE_BROKEN = 1,
    /// The recording does not decide it, or there was nothing to keep it in.
    ADSDV_RULE_UNDECIDED = 2,
}

impl From<RuleVerdict> for adsdv_rule_verdict {
    fn from(verdict: RuleVerdict) -> Self {
        match verdict {
            RuleVerdict::Holds => Self::ADSDV_RULE_HOLDS,
            RuleVerdict::Broken => Self::ADSDV_RULE_BROKEN,
            RuleVerdict::Undecided => Self::ADSDV_RULE_UNDECIDED,
        }
    }
}

/// What became of a rule.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct adsdv_rule_report {
    /// How many times it was kept.
    pub held: u64,
    /// How many times it was broken.
    pub broken: u64,
    /// How many times it came up and stayed undecided.
    pub undecided: u64,
    /// Its name. The texts are the judge's; they stay until the next call with it.
    pub name: *const c_char,
    /// What it asks for, as it is written.
    pub rule: *const c_char,
    /// Why it was never decided; empty where it was.
    pub why: *const c_char,
    /// The line that it is in, from 1.
    pub line: u32,
    /// What it came to, an adsdv_rule_verdict.
    pub verdict: u8,
    /// "holds", "broken" or "never decided".
    pub verdict_name: [c_char; 16],
}

// SAFETY: `repr(C)`, integers only.
unsafe impl Plain for adsdv_rule_place {}
// SAFETY: `repr(C)`; integers, an array of `char` and pointers, which are never followed.
unsafe impl Plain for adsdv_rule_report {}

/// A number of a place, as C has it.
fn number(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

impl From<&RuleError> for adsdv_rule_place {
    fn from(error: &RuleError) -> Self {
        let [line, column, width] = [error.line, error.column, error.width].map(number);
        Self { line, column, width }
    }
}

/// What became of a rule, whose texts are kept here.
fn report(texts: &mut Texts, rule: &RuleReport) -> adsdv_rule_report {
    let RuleReport { held, broken, undecided, line, .. } = *rule;
    let why = rule.why.as_deref().unwrap_or_default();
    let [name, rule_text, why] = texts.keep([&rule.name, &rule.rule, why]);
    let verdict = rule.verdict();
    adsdv_rule_report {
        held,
        broken,
        undecided,
        name,
        rule: rule_text,
        why,
        line: number(line),
        verdict: adsdv_rule_verdict::from(verdict) as u8,
        verdict_name: short(verdict.name()),
    }
}

/// Has a judge follow rules of the user's own from now on, beside the document: best before the first frame. `rules` is the text of
/// a file of rules. What breaks one is a violation among the findings, of party "OWN", whose section is the line. Rules that it was
/// given before are followed no longer.
///
/// A text that is wrong, or names what the edition has not, is an error (ADSDV_BAD_RULES) that says of the first mistake what was
/// found and what was expected, and how many more there are; `place`, which may be NULL, is where the first is.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_judge_follow(
    judge: *mut adsdv_judge,
    rules: *const c_char,
    place: *mut adsdv_rule_place,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        // SAFETY: the caller promises it for the judge and the text.
        let (judge, rules) = unsafe { (handle(judge)?, text(rules, "rules")?) };
        let place = if place.is_null() {
            None
        } else {
            // SAFETY: the caller promises it for the place.
            Some(unsafe { out(place, "place")? })
        };
        judge.follow(rules)?.map_err(|wrong| {
            if let Some(place) = place {
                place.set(wrong.first().into());
            }
            Refusal::Rules(Box::new(wrong))
        })
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}

/// What became of the rule with this index, from 0 in the order of the text, once the judge has finished: true, and it is in
/// `report`; or false: there is none, the judge has not finished, or a pointer is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_judge_rule(
    judge: *mut adsdv_judge,
    index: usize,
    report: *mut adsdv_rule_report,
) -> bool {
    let mut there = false;
    let work = || {
        // SAFETY: the caller promises it for the judge and the report.
        let (judge, place) = unsafe { (handle(judge)?, out(report, "report")?) };
        if let Some(rule) = judge.rules.get(index) {
            place.set(self::report(&mut judge.texts, rule));
            there = true;
        }
        Ok(())
    };
    // SAFETY: there is no error to write.
    unsafe { answer(core::ptr::null_mut(), work) };
    there
}
