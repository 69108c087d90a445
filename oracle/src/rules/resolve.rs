//! From names to the signals, words and units of an edition.

use adsdv_spec::Edition;
use adsdv_spec::messages::SignalDef;

use super::error::{Span, SpannedError};
use super::mistakes::{Mistakes, RuleErrors};
use super::names::{self, NoSignal, SignalPlace};
use super::number;
use super::predicate::{Check, Predicate, Subject, SubjectKind};
use super::syntax::{Expression, Form, Relation, RuleLine, Spanned, Term, TermTest};

/// Which editions are asked for what a rule names.
#[derive(Clone, Copy, Debug)]
pub(super) enum Scope<'a> {
    /// This one has to have all of it.
    One(&'a Edition),
    /// Any may turn out to be the one: each name has to be in some edition, and all of them in one.
    Any,
}

/// All rules under an edition, and what they are about.
pub(super) fn all(
    lines: &[RuleLine],
    edition: &Edition,
) -> Result<(Vec<Form<Predicate>>, Vec<Subject>), RuleErrors> {
    let mut resolver = Resolver { edition, subjects: Vec::new() };
    let (mut forms, mut mistakes) = (Vec::new(), Mistakes::default());
    for line in lines {
        match line.form.try_map(|expression| resolver.predicate(expression)) {
            Ok(form) => forms.push(form),
            // That is the first mistake of the line only.
            Err(_) => check_line(line, Scope::One(edition), &mut mistakes),
        }
    }
    mistakes.finish().map(|()| (forms, resolver.subjects))
}

/// Adds what a rule names and this scope has not.
pub(super) fn check_line(line: &RuleLine, scope: Scope<'_>, mistakes: &mut Mistakes) {
    for_each_term(line, |term| {
        let told = !mistakes.are_counted_only();
        let found = match scope {
            Scope::One(edition) => meaning(edition, term, told).map(drop),
            Scope::Any => in_some(term, told),
        };
        if let Err(wrong) = found {
            mistakes.add(wrong, line.number, &line.text);
        }
    });
}

/// Whether one edition has all that the rules name, where each name is in some.
pub(super) fn check_together(lines: &[RuleLine], scope: Scope<'_>) -> Result<(), RuleErrors> {
    let has_all = |edition: &Edition| {
        let mut all = true;
        let mut has = |term: &Term| all = all && meaning(edition, term, false).is_ok();
        for line in lines {
            for_each_term(line, &mut has);
        }
        all
    };
    if matches!(scope, Scope::One(_)) || Edition::ALL.iter().any(|edition| has_all(edition)) {
        return Ok(());
    }
    let mut mistakes = Mistakes::default();
    for line in lines {
        for_each_term(line, |term| {
            let (mut having, mut lacks) = (Vec::new(), None);
            for edition in Edition::ALL {
                match meaning(edition, term, false) {
                    Ok(_) => having.push(edition.version),
                    Err(wrong) => lacks = Some(wrong.span),
                }
            }
            let Some(span) = lacks else { return };
            let having = match &having[..] {
                [one] => format!("edition {one} has"),
                several => format!("editions {} have", several.join(" and ")),
            };
            let why = format!(
                "found what only {having}, and no edition has all that these rules name; expected rules of one edition"
            );
            mistakes.add(SpannedError::new(span, why), line.number, &line.text);
        });
    }
    mistakes.finish()
}

fn for_each_term(line: &RuleLine, mut each: impl FnMut(&Term)) {
    line.form.predicates().for_each(|expression| expression.for_each_term(&mut each));
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
            Expression::Term(term) => {
                let (what, check) = meaning(self.edition, term, false)?;
                Predicate::Test(self.subject(what), check)
            }
        })
    }

    fn predicates(&mut self, all: &[Expression]) -> Result<Vec<Predicate>, SpannedError> {
        all.iter().map(|one| self.predicate(one)).collect()
    }

    fn subject(&mut self, what: SubjectKind) -> usize {
        let known = self.subjects.iter().position(|subject| subject.what == what);
        known.unwrap_or_else(|| {
            self.subjects.push(Subject::new(what));
            self.subjects.len() - 1
        })
    }
}

/// What a term is about in an edition, and what it asks; or what is wrong with it. What an unknown name is like is only looked for
/// where it is to be `told`.
fn meaning(edition: &Edition, term: &Term, told: bool) -> Result<(SubjectKind, Check), SpannedError> {
    let message = term.message.as_ref().map(|message| message.value.as_str());
    let name = term.name.value.as_str();
    if let Some(atom) = names::atom(name).filter(|_| message.is_none()) {
        let check = switched(term, &format!("{name:?} is a condition"))?;
        return Ok((SubjectKind::Atom(atom), check));
    }
    let place = names::signal(edition, message, name).map_err(|no_signal| {
        let why = match no_signal {
            NoSignal::Unknown if told => names::unknown(&[edition], message, name),
            NoSignal::Unknown => String::new(),
            NoSignal::Other(why) => why,
        };
        SpannedError::new(span(term), why)
    })?;
    Ok((SubjectKind::Signal(place), check(edition, place, term)?))
}

/// Whether a term means something in some edition; or what is wrong with it in all of them.
fn in_some(term: &Term, told: bool) -> Result<(), SpannedError> {
    let each: Vec<_> = Edition::ALL.iter().map(|edition| meaning(edition, term, false)).collect();
    if each.iter().any(Result::is_ok) {
        return Ok(());
    }
    let message = term.message.as_ref().map(|message| message.value.as_str());
    let name = term.name.value.as_str();
    // The edition with most words of the signal says best which are right.
    let words =
        |edition: &Edition| names::signal(edition, message, name).map(|place| place.signal.values.len());
    let found = Edition::ALL.iter().zip(each).map(|(edition, wrong)| (words(edition), wrong.err()));
    match found.max_by_key(|(words, _)| words.as_ref().ok().copied()) {
        Some((Err(NoSignal::Unknown), _)) => {
            let why = if told { names::unknown(Edition::ALL, message, name) } else { String::new() };
            Err(SpannedError::new(span(term), why))
        }
        Some((_, Some(wrong))) => Err(wrong),
        _ => Ok(()),
    }
}

/// Where a name is, with its message.
fn span(term: &Term) -> Span {
    term.message.as_ref().map_or(term.name.span, |message| message.span.to(term.name.span))
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
