//! What came of a program, or of the readings of the document, as one page.
//!
//! ```text
//! what --json prints ---\
//! verdict, what to do ---+--> Outcome --> one object of JSON --> page/dist/outcome.html
//! sentences, Figure 2 --/
//! ```

mod named;

use std::collections::BTreeMap;

use adsdv_spec::{AsState, Edition};
use serde::Serialize;
use serde_json::value::RawValue;

use crate::catalog::{MessageJson, messages};
use crate::figure::Picture;
use crate::mood::Mood;
use crate::page::PageError;
use crate::template::{filled, harmless};

/// The page without data, as `page/` builds it.
pub(crate) const TEMPLATE: &str = include_str!("../../page/dist/outcome.html");

/// An outcome, as a page is made of it.
///
/// ```
/// use adsdv_report::{Mood, Outcome, Shown};
///
/// let outcome = Outcome {
///     title: "adsdv exam: ./stack",
///     about: &[],
///     mood: Mood::Good,
///     verdict: "It passes.",
///     next: "Nothing is to be done.",
///     json: r#"{"requirements":[{"id":"HS-5"}]}"#,
///     shown: Shown::Exam(&adsdv_spec::Edition::V3_0),
/// };
/// let page = outcome.html()?;
/// assert!(page.starts_with("<!doctype html>") && page.contains("It passes."));
/// # Ok::<(), adsdv_report::PageError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Outcome<'a> {
    /// What was asked, and of what.
    pub title: &'a str,
    /// How, a line each.
    pub about: &'a [String],
    /// How the verdict looks.
    pub mood: Mood,
    /// The verdict, in a sentence.
    pub verdict: &'a str,
    /// What is to be done next.
    pub next: &'a str,
    /// The outcome as `--json` prints it: its numbers are those on the page.
    pub json: &'a str,
    /// What it is.
    pub shown: Shown<'a>,
}

/// What an outcome is of.
#[derive(Clone, Copy, Debug)]
pub enum Shown<'a> {
    /// A program that is a VCU: `adsdv conform`. With the arrows of its own Figure 2 in the order of the JSON's, none where it was not
    /// found out.
    Conform(&'a [(AsState, AsState)]),
    /// An AI Computer: `adsdv exam`, by this edition.
    Exam(&'a Edition),
    /// The readings of the document: `adsdv verify --readings`.
    Readings,
}

#[derive(Serialize)]
struct OutcomeJson<'a> {
    kind: &'static str,
    version: &'static str,
    title: &'a str,
    about: &'a [String],
    mood: Mood,
    verdict: &'a str,
    next: &'a str,
    /// The sentences of the requirements that are named.
    requirements: BTreeMap<String, &'static str>,
    /// The questions that the document leaves open, and the answers to them, in words.
    readings: BTreeMap<String, &'static str>,
    picture: Option<Picture>,
    /// How frames are read, where there are some.
    messages: Vec<MessageJson>,
    json: &'a RawValue,
}

impl Outcome<'_> {
    /// The page, which needs nothing else: a browser opens it from a file or a mail.
    ///
    /// # Errors
    ///
    /// As [`data`](Self::data).
    pub fn html(&self) -> Result<String, PageError> {
        Ok(filled(TEMPLATE, &self.data()?))
    }

    /// The data of the page, as one JSON object in which no `<` can end the script that it stands in.
    ///
    /// # Errors
    ///
    /// Fails if what it is about cannot be written as JSON.
    pub fn data(&self) -> Result<String, PageError> {
        let Self { title, about, mood, verdict, next, json, shown } = *self;
        let (kind, picture, edition) = match shown {
            Shown::Conform(arrows) => ("conform", Some(arrows).filter(|arrows| !arrows.is_empty()), None),
            Shown::Exam(edition) => ("exam", None, Some(edition)),
            Shown::Readings => ("readings", None, None),
        };
        let json = json.trim_end();
        let data = OutcomeJson {
            kind,
            version: env!("CARGO_PKG_VERSION"),
            title,
            about,
            mood,
            verdict,
            next,
            requirements: named::requirements(&serde_json::from_str(json)?),
            readings: named::readings(),
            picture: picture.map(Picture::of),
            messages: edition.map(messages).unwrap_or_default(),
            json: serde_json::from_str(json)?,
        };
        Ok(harmless(&serde_json::to_string(&data)?))
    }
}
