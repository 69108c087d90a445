//! The edition that fits best, and why.

use std::cmp::Reverse;
use std::fmt;

use adsdv_spec::Edition;

use super::fact::Fact;

/// Which edition the frames fit best.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recognised {
    /// The edition; the default where the frames do not tell.
    pub edition: &'static Edition,
    /// Whether it fits better than every other.
    pub certain: bool,
    /// The editions that fit as well, where it does not.
    pub alike: Vec<&'static Edition>,
    /// What fits it and not every other, in words, such as `511h has 4 bytes (3.0: 8)`.
    pub evidence: Vec<String>,
    /// What does not fit it, such as `120h is absent (4.0: every 10 ms)`. It is judged by this edition all the same.
    pub against: Vec<String>,
}

impl Recognised {
    /// An edition that was named and not recognised.
    pub const fn named(edition: &'static Edition) -> Self {
        Self { edition, certain: true, alike: Vec::new(), evidence: Vec::new(), against: Vec::new() }
    }

    /// The same, with what fits it and not this one of the editions for evidence.
    pub(super) fn rather_than(self, own: usize, editions: &[&'static Edition], facts: &[Fact]) -> Self {
        let place = editions.iter().position(|edition| edition.version == self.edition.version);
        let tells = |fact: &&Fact| fact.weight > 0 && fact.is_against(own);
        let evidence =
            facts.iter().filter(tells).filter(|fact| !place.is_some_and(|place| fact.is_against(place)));
        let evidence = evidence.map(|fact| in_words(editions, fact)).collect();
        Self { evidence, ..self }
    }

    /// What is to be said where others fit as well, such as `as the frames do not tell which`; `None` where it is certain.
    ///
    /// ```
    /// use adsdv_oracle::recognise::Recogniser;
    /// use adsdv_spec::Edition;
    ///
    /// let mut recogniser = Recogniser::new(Edition::DEFAULT);
    /// recogniser.frame(0, 0x520, &[0, 0, 1, 0, 0, 0, 0, 0]);
    /// let doubt = recogniser.recognise().doubt();
    /// assert_eq!(doubt.as_deref(), Some("as the frames do not tell which"));
    /// recogniser.frame(0, 0x511, &[0; 4]);
    /// assert_eq!(recogniser.recognise().doubt().as_deref(), Some("though 4.0 fits as well"));
    /// ```
    pub fn doubt(&self) -> Option<String> {
        if self.certain {
            return None;
        }
        // Where nothing speaks for an edition, no other is ruled out by it.
        if self.evidence.is_empty() || self.alike.is_empty() {
            return Some("as the frames do not tell which".to_owned());
        }
        let alike: Vec<&str> = self.alike.iter().map(|edition| edition.version).collect();
        let verb = if alike.len() == 1 { "fits" } else { "fit" };
        Some(format!("though {} {verb} as well", alike.join(" and ")))
    }
}

/// In one line, such as `version 4.0: 120h is there (3.0: no such message, 2026: no such message)`.
impl fmt::Display for Recognised {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "version {}", self.edition.version)?;
        if let Some(doubt) = self.doubt() {
            write!(f, ", {doubt}")?;
        }
        if !self.evidence.is_empty() {
            write!(f, ": {}", self.evidence.join(", "))?;
        }
        if !self.against.is_empty() {
            let but = if self.evidence.is_empty() { ", but " } else { "; but " };
            write!(f, "{but}{}", self.against.join(", "))?;
        }
        Ok(())
    }
}

/// The edition that the fewest facts speak against.
pub(super) fn best(editions: &[&'static Edition], default: &'static Edition, facts: &[Fact]) -> Recognised {
    let misfits = |place: usize| facts.iter().filter(move |fact| fact.tells() && fact.is_against(place));
    let score = |place: usize| misfits(place).fold(0, |sum: u32, fact| sum.saturating_add(fact.weight));
    // Of those that fit as well: the default, the one that lacks the least, the newest.
    let rank = |&place: &usize| {
        let other = editions.get(place).is_none_or(|edition| edition.version != default.version);
        (score(place), other, misfits(place).count(), Reverse(place))
    };
    let Some(place) = (0..editions.len()).min_by_key(rank) else {
        return Recognised { certain: false, ..Recognised::named(default) };
    };
    let least = score(place);
    let others = (0..editions.len()).filter(|&other| other != place && score(other) <= least);
    let alike: Vec<_> = others.filter_map(|other| editions.get(other).copied()).collect();
    let fits = |fact: &&Fact| !fact.is_against(place);
    let in_words = |fact: &Fact| in_words(editions, fact);
    Recognised {
        edition: editions.get(place).copied().unwrap_or(default),
        certain: alike.is_empty(),
        alike,
        evidence: facts.iter().filter(fits).filter(|fact| fact.weight > 0).map(in_words).collect(),
        against: facts.iter().filter(|fact| !fits(fact)).map(in_words).collect(),
    }
}

/// A fact, and what each edition that it does not fit says instead.
fn in_words(editions: &[&Edition], fact: &Fact) -> String {
    let said = editions.iter().zip(&fact.instead);
    let said = said.filter_map(|(edition, instead)| Some((edition.version, instead.as_ref()?)));
    let said: Vec<String> = said.map(|(version, instead)| format!("{version}: {instead}")).collect();
    format!("{} ({})", fact.text, said.join(", "))
}
