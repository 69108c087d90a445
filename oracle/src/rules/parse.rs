//! From text to rules: a rule in each line.

use std::collections::BTreeMap;

use super::error::{Span, SpannedError};
use super::lex::{self, Token};
use super::limits::{CHARACTERS, LINES, LONGEST_NS};
use super::mistakes::{Mistakes, RuleErrors};
use super::number;
use super::resolve::{self, Scope};
use super::syntax::{Expression, Form, RuleLine, Spanned};

/// What a rule can begin with.
const FORMS: &str = "always, never, after, or a condition with until or for at most behind it";

/// The rules of a text, whose names are to be there in this scope; or all its mistakes.
pub(super) fn file(text: &str, scope: Scope<'_>) -> Result<Vec<RuleLine>, RuleErrors> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let (mut rules, mut names, mut mistakes) = (Vec::new(), BTreeMap::new(), Mistakes::default());
    let (mut last, mut is_blank) = (1, true);
    for (number, line) in (1..).zip(text.lines()) {
        last = number;
        if number > LINES {
            let why = format!("found a further line; expected at most {LINES}");
            mistakes.add(SpannedError::new(Span { start: 0, width: 1 }, why), number, line);
            break;
        }
        match one(number, line, &mut names, &mut mistakes) {
            Ok(Some(rule)) => {
                resolve::check_line(&rule, scope, &mut mistakes);
                rules.push(rule);
            }
            Ok(None) => continue,
            Err(wrong) => mistakes.add(wrong, number, line),
        }
        is_blank = false;
    }
    if is_blank {
        let why = "found no rule; expected a line such as \"calm: never VEH_SPEED_ACTUAL > 20 km/h\"";
        mistakes.add(SpannedError::new(Span { start: 0, width: 1 }, why), last, "");
    }
    mistakes.finish()?;
    resolve::check_together(&rules, scope)?;
    Ok(rules)
}

/// The rule of a line, if it has one. The names are those before, with their lines; that one of them is taken is a mistake, and the
/// rest of the line may have others.
fn one(
    number: usize,
    text: &str,
    names: &mut BTreeMap<String, usize>,
    mistakes: &mut Mistakes,
) -> Result<Option<RuleLine>, SpannedError> {
    if text.chars().nth(CHARACTERS).is_some() {
        let why = format!("found a longer line; expected at most {CHARACTERS} characters");
        return Err(SpannedError::new(Span { start: CHARACTERS - 1, width: 1 }, why));
    }
    let mut parser = Parser { tokens: lex::line(text)?, place: 0, depth: 0 };
    if matches!(parser.token(), Token::End) {
        return Ok(None);
    }
    let name = parser.word("the name of a rule")?;
    parser.sign(":", "a colon behind the name of the rule")?;
    let before = *names.entry(name.value.clone()).or_insert(number);
    if before != number {
        let why = format!("line {before} has a rule of this name; expected another one");
        mistakes.add(SpannedError::new(name.span, why), number, text);
    }
    let start = parser.span().start;
    let form = parser.form()?;
    let end = parser.span().start;
    let note = parser.note();
    if !matches!(parser.token(), Token::End) {
        return Err(parser.expected("and, or, a text in quotes, or the end of the line"));
    }
    let rule: String = text.chars().skip(start).take(end.saturating_sub(start)).collect();
    let rule = rule.trim().to_owned();
    Ok(Some(RuleLine { number, text: text.to_owned(), name: name.value, rule, note, form }))
}

/// Reads the tokens of a line, one after the other.
#[derive(Debug)]
pub(super) struct Parser {
    tokens: Vec<(Token, Span)>,
    place: usize,
    /// How deep parentheses and `not` are at present.
    pub(super) depth: usize,
}

impl Parser {
    /// The token that is next; at the end, that.
    pub(super) fn token(&self) -> &Token {
        self.tokens.get(self.place).map_or(&Token::End, |(token, _)| token)
    }

    /// Where it is.
    pub(super) fn span(&self) -> Span {
        let nowhere = Span { start: 0, width: 1 };
        self.tokens.get(self.place).or_else(|| self.tokens.last()).map_or(nowhere, |(_, span)| *span)
    }

    pub(super) fn advance(&mut self) {
        self.place += 1;
    }

    /// What comes next is something else than this.
    pub(super) fn expected(&self, what: &str) -> SpannedError {
        SpannedError::new(self.span(), format!("found {}; expected {what}", self.token()))
    }

    /// Whether this keyword is next, in upper or lower case.
    pub(super) fn is_next(&self, keyword: &str) -> bool {
        matches!(self.token(), Token::Word(word) if word.eq_ignore_ascii_case(keyword))
    }

    /// Passes over this keyword, if it is next.
    pub(super) fn keyword(&mut self, keyword: &str) -> bool {
        let next = self.is_next(keyword);
        self.place += usize::from(next);
        next
    }

    /// Passes over this sign, if it is next.
    pub(super) fn has_sign(&mut self, sign: &str) -> bool {
        let next = matches!(self.token(), Token::Sign(found) if *found == sign);
        self.place += usize::from(next);
        next
    }

    pub(super) fn sign(&mut self, sign: &str, what: &str) -> Result<(), SpannedError> {
        if self.has_sign(sign) { Ok(()) } else { Err(self.expected(what)) }
    }

    pub(super) fn word(&mut self, what: &str) -> Result<Spanned<String>, SpannedError> {
        let Token::Word(word) = self.token() else { return Err(self.expected(what)) };
        let word = Spanned { value: word.clone(), span: self.span() };
        self.advance();
        Ok(word)
    }

    fn note(&mut self) -> Option<String> {
        let Token::Text(note) = self.token() else { return None };
        let note = note.split_whitespace().collect::<Vec<_>>().join(" ");
        self.advance();
        Some(note)
    }

    fn form(&mut self) -> Result<Form<Expression>, SpannedError> {
        if self.keyword("always") {
            return self.expression().map(Form::Always);
        }
        if self.keyword("never") {
            let bad = self.expression()?;
            return Ok(if self.keyword("for") { Form::AtMost(bad, self.time()?) } else { Form::Never(bad) });
        }
        if self.keyword("after") {
            return self.response();
        }
        if !matches!(self.token(), Token::Word(_) | Token::Sign("(")) {
            return Err(self.expected(FORMS));
        }
        let first = self.expression()?;
        if self.keyword("until") {
            return Ok(Form::Until(None, first, self.expression()?, None));
        }
        if !(self.keyword("for") && self.keyword("at") && self.keyword("most")) {
            return Err(self.expected("until, or for at most; or always, never or after in front of it all"));
        }
        Ok(Form::AtMost(first, self.time()?))
    }

    /// What is behind `after`.
    fn response(&mut self) -> Result<Form<Expression>, SpannedError> {
        let premise = self.expression()?;
        self.sign(",", "a comma, and what is to be after that")?;
        let wanted = self.expression()?;
        if self.keyword("within") {
            return Ok(Form::Within(premise, wanted, self.time()?));
        }
        if self.keyword("for") {
            return Ok(Form::Throughout(premise, wanted, self.time()?));
        }
        if !self.keyword("until") {
            return Err(self.expected("within, for or until"));
        }
        let until = self.expression()?;
        let bound = if self.keyword("within") { Some(self.time()?) } else { None };
        Ok(Form::Until(Some(premise), wanted, until, bound))
    }

    /// A number of seconds or milliseconds.
    fn time(&mut self) -> Result<i64, SpannedError> {
        let Token::Number(number) = self.token() else { return Err(self.expected("a time, such as 3 s")) };
        let (number, start) = (number.clone(), self.span());
        self.advance();
        let unit = self.word("s or ms behind the number")?;
        let ns = match unit.value.as_str() {
            "s" => 1_000_000_000,
            "ms" => 1_000_000,
            _ => {
                return Err(SpannedError::new(
                    unit.span,
                    format!("found {:?}; expected s or ms", unit.value),
                ));
            }
        };
        let span = start.to(unit.span);
        let number = number::decimal(&number).map_err(|why| SpannedError::new(start, why))?;
        let time = i64::try_from(number.mantissa * ns / number.power).ok();
        time.filter(|time| (1_000_000..=LONGEST_NS).contains(time)).ok_or_else(|| {
            SpannedError::new(span, "found a time out of range; expected 1 ms to 3600 s".to_owned())
        })
    }
}
