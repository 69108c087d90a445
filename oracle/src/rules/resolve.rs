//! From names to the signals, words and units of an edition.

use adsdv_spec::Edition;
use adsdv_spec::messages::SignalDef;

use super::error::{RuleError, SpannedError};
use super::names::{self, SignalPlace};
use super::number;
use super::predicate::{Check, Predicate, Subject, SubjectKind};
use super::syntax::{Expression, Form, Relation, RuleLine, Spanned, Term, TermTest};

/// All rules under an edition, and what they are about.
pub(super) fn all(
    lines: &[RuleLine],
    edition: &Edition,
) -> Result<(Vec<Form<Predicate>>, Vec<Subject>), RuleError> {
    let mut resolver = Resolver { edition, subjects: Vec::new() };
    let mut forms = Vec::new();
    for line in lines {
        let form = line.form.try_map(|expression| resolver.predicate(expression));
        forms.push(form.map_err(|wrong| wrong.in_line(line.number, &line.text))?);
    }
    Ok((forms, resolver.subjects))
}

struct Resolver<'a> {
    edition: &'a Edition,
    subjects: Vec<Subject>,
}

impl Resolver<'_> {
    fn predicate(&mut self, expression: &Expression) -> Result<Predicate, SpannedError> {
        Ok(match expression {
            Expression::All(all) => Predicate::All(self.predicates(all)?),
            Expression::Any(all) => Predicate::Any(self.predicates(all)?),
            Expression::Not(inner) => Predicate::Not(Box::new(self.predicate(inner)?)),
            Expression::Term(term) => self.term(term)?,
        })
    }

    fn predicates(&mut self, all: &[Expression]) -> Result<Vec<Predicate>, SpannedError> {
        all.iter().map(|one| self.predicate(one)).collect()
    }

    fn term(&mut self, term: &Term) -> Result<Predicate, SpannedError> {
        let message = term.message.as_ref().map(|message| message.value.as_str());
        let atom = names::atom(&term.name.value).filter(|_| message.is_none());
        if let Some(atom) = atom {
            let check = switched(term, &format!("{:?} is a condition", term.name.value))?;
            return Ok(Predicate::Test(self.subject(SubjectKind::Atom(atom)), check));
        }
        let span = match &term.message {
            Some(message) => message.span.to(term.name.span),
            None => term.name.span,
        };
        let place = names::signal(self.edition, message, &term.name.value);
        let place = place.map_err(|why| SpannedError::new(span, why))?;
        let check = check(self.edition, place, term)?;
        Ok(Predicate::Test(self.subject(SubjectKind::Signal(place)), check))
    }

    fn subject(&mut self, what: SubjectKind) -> usize {
        let known = self.subjects.iter().position(|subject| subject.what == what);
        known.unwrap_or_else(|| {
            self.subjects.push(Subject::new(what));
            self.subjects.len() - 1
        })
    }
}

/// What is asked of something that is on or off.
fn switched(term: &Term, what: &str) -> Result<Check, SpannedError> {
    let refused = |span| SpannedError::new(span, format!("{what}; expected on or off behind it"));
    match &term.test {
        TermTest::Bare => Ok(Check::Is { raw: 1, equal: true }),
        TermTest::Word(equal, word) => match names::switch(&word.value) {
            Some(on) => Ok(Check::Is { raw: on.into(), equal: *equal }),
            None => Err(refused(word.span)),
        },
        TermTest::Number(_, number, _) => Err(refused(number.span)),
    }
}

fn check(edition: &Edition, place: SignalPlace, term: &Term) -> Result<Check, SpannedError> {
    let SignalPlace { signal, .. } = place;
    let is_flag = (signal.min, signal.max) == (0, 1);
    match &term.test {
        TermTest::Number(comparison, number, unit) if signal.values.is_empty() || is_flag => {
            number_check(signal, term.abs, *comparison, number, unit.as_ref())
        }
        TermTest::Number(comparison, number, unit) => {
            let equal = match comparison {
                Relation::Equal => true,
                Relation::NotEqual => false,
                _ => return Err(SpannedError::new(number.span, has_words(signal))),
            };
            let raw =
                number.value.parse().ok().filter(|raw| signal.allows(*raw) && unit.is_none() && !term.abs);
            let raw = raw.ok_or_else(|| SpannedError::new(number.span, has_words(signal)))?;
            Ok(Check::Is { raw, equal })
        }
        TermTest::Word(equal, word) => match named(edition, place, &word.value) {
            Some(Ok(raw)) => Ok(Check::Is { raw, equal: *equal }),
            None if is_flag && names::switch(&word.value).is_some() => switched(term, signal.name),
            Some(Err(version)) => {
                let why = format!(
                    "found {:?}, and edition {} has no such word of {}; expected one that it has, or the edition that has this: {version}",
                    word.value, edition.version, signal.name
                );
                Err(SpannedError::new(word.span, why))
            }
            None if signal.values.is_empty() => {
                let unit =
                    if signal.unit.is_empty() { String::new() } else { format!(" in {}", signal.unit) };
                let why =
                    format!("found {:?}, and {} is a number; expected one{unit}", word.value, signal.name);
                Err(SpannedError::new(word.span, why))
            }
            None => {
                let near = words(signal);
                let why =
                    format!("found {:?}, which is no word of {}; expected {near}", word.value, signal.name);
                Err(SpannedError::new(word.span, why))
            }
        },
        TermTest::Bare if is_flag => switched(term, signal.name),
        TermTest::Bare => {
            let why = match signal.values {
                [] => format!("{} is a number; expected a comparison behind it, such as > 5", signal.name),
                _ => has_words(signal),
            };
            Err(SpannedError::new(term.name.span, why))
        }
    }
}

fn number_check(
    signal: &SignalDef,
    abs: bool,
    comparison: Relation,
    number: &Spanned<String>,
    unit: Option<&Spanned<String>>,
) -> Result<Check, SpannedError> {
    let decimal = number::decimal(&number.value).map_err(|why| SpannedError::new(number.span, why))?;
    let (num, den) = match unit {
        Some(unit) => number::factor(&unit.value, signal).map_err(|why| SpannedError::new(unit.span, why))?,
        None => (1, 1),
    };
    // raw * scale against mantissa / power * num / den, without a fraction.
    let left = i128::from(signal.scale.num()) * decimal.power * den;
    let right = decimal.mantissa * num * i128::from(signal.scale.den());
    Ok(Check::Number { comparison, abs, left, right })
}

/// The raw value of a word: in this edition, or as another one spells it; the version of one whose word this has not.
fn named(edition: &Edition, place: SignalPlace, word: &str) -> Option<Result<i32, &'static str>> {
    let raw_in = |signal: &SignalDef| {
        signal.values.iter().find(|(_, name)| plain(name) == plain(word)).map(|(raw, _)| *raw)
    };
    if let Some(raw) = raw_in(place.signal) {
        return Some(Ok(raw));
    }
    let others = Edition::ALL.iter().filter(|other| other.version != edition.version);
    let mut elsewhere = others.filter_map(|other| {
        let signal = other.bus.message(place.message.id)?.signal_of(place.signal.field)?;
        Some((raw_in(signal)?, other.version))
    });
    let (raw, version) = elsewhere.next()?;
    Some(if place.signal.value_name(raw).is_some() { Ok(raw) } else { Err(version) })
}

/// A word, as it counts: upper or lower case, blank or underscore.
fn plain(word: &str) -> String {
    word.to_ascii_uppercase().replace(' ', "_")
}

fn has_words(signal: &SignalDef) -> String {
    format!("{} has words; expected == or is, and {}", signal.name, words(signal))
}

/// The words of a signal, as a rule has them.
fn words(signal: &SignalDef) -> String {
    let words: Vec<String> = signal.values.iter().map(|(_, name)| name.replace(' ', "_")).collect();
    match &words[..] {
        [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
        _ => words.concat(),
    }
}
