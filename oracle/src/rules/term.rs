//! Reads what is true or not at a moment: signals and conditions, joined by `and`, `or` and `not`.

use super::error::SpannedError;
use super::lex::Token;
use super::limits::DEPTH;
use super::parse::Parser;
use super::syntax::{Expression, Relation, Spanned, Term, TermTest};

/// The words that have a meaning of their own where a name may be.
const KEYWORDS: [&str; 10] = ["always", "never", "after", "within", "for", "until", "and", "or", "not", "is"];

impl Parser {
    pub(super) fn expression(&mut self) -> Result<Expression, SpannedError> {
        let mut all = vec![self.conjunction()?];
        while self.keyword("or") {
            all.push(self.conjunction()?);
        }
        Ok(single(all, Expression::Any))
    }

    fn conjunction(&mut self) -> Result<Expression, SpannedError> {
        let mut all = vec![self.unary()?];
        while self.keyword("and") {
            all.push(self.unary()?);
        }
        Ok(single(all, Expression::All))
    }

    fn unary(&mut self) -> Result<Expression, SpannedError> {
        let negated = self.is_next("not");
        if !negated && !matches!(self.token(), Token::Sign("(")) {
            return self.term().map(Expression::Term);
        }
        if self.depth == DEPTH {
            return Err(self.expected(&format!("at most {DEPTH} parentheses and nots in one another")));
        }
        self.depth += 1;
        self.advance();
        let inner = if negated {
            Expression::Not(Box::new(self.unary()?))
        } else {
            let inner = self.expression()?;
            self.sign(")", "and, or, or a closing parenthesis")?;
            inner
        };
        self.depth -= 1;
        Ok(inner)
    }

    fn term(&mut self) -> Result<Term, SpannedError> {
        let first = self.name()?;
        if first.value.eq_ignore_ascii_case("abs") && self.has_sign("(") {
            let first = self.name()?;
            let (message, name) = self.qualified(first)?;
            self.sign(")", "a closing parenthesis behind the signal")?;
            let Some(comparison) = self.comparison()? else {
                return Err(self.expected("a comparison with a number, such as > 5"));
            };
            let test = self.number(comparison)?;
            return Ok(Term { message, name, abs: true, test });
        }
        let (message, name) = self.qualified(first)?;
        let test = self.test()?;
        Ok(Term { message, name, abs: false, test })
    }

    fn name(&mut self) -> Result<Spanned<String>, SpannedError> {
        let what = "the name of a signal or a condition";
        if KEYWORDS.iter().any(|keyword| self.is_next(keyword)) {
            return Err(self.expected(what));
        }
        self.word(what)
    }

    /// A name, and in front of it the message, if that is said.
    fn qualified(
        &mut self,
        first: Spanned<String>,
    ) -> Result<(Option<Spanned<String>>, Spanned<String>), SpannedError> {
        if !self.has_sign(".") {
            return Ok((None, first));
        }
        let name = self.word("the name of a signal behind that of its message")?;
        Ok((Some(first), name))
    }

    fn comparison(&mut self) -> Result<Option<Relation>, SpannedError> {
        let Token::Sign(sign) = self.token() else { return Ok(None) };
        let comparison = match *sign {
            ">" => Relation::Greater,
            ">=" => Relation::GreaterOrEqual,
            "<" => Relation::Less,
            "<=" => Relation::LessOrEqual,
            "==" => Relation::Equal,
            "!=" => Relation::NotEqual,
            "=" => return Err(self.expected("==, or another comparison")),
            _ => return Ok(None),
        };
        self.advance();
        Ok(Some(comparison))
    }

    fn test(&mut self) -> Result<TermTest, SpannedError> {
        let comparison = match self.comparison()? {
            Some(comparison) => comparison,
            None if self.keyword("is") => {
                if self.keyword("not") {
                    Relation::NotEqual
                } else {
                    Relation::Equal
                }
            }
            None => return Ok(self.switch()),
        };
        let equal = match (self.token(), comparison) {
            (Token::Number(_), _) => return self.number(comparison),
            (_, Relation::Equal) => true,
            (_, Relation::NotEqual) => false,
            _ => return Err(self.expected("a number")),
        };
        let (Token::Word(word) | Token::Text(word)) = self.token() else {
            return Err(self.expected("a number, or a word that the signal has"));
        };
        let word = Spanned { value: word.clone(), span: self.span() };
        self.advance();
        Ok(TermTest::Word(equal, word))
    }

    /// `on` or `off`, if it is said.
    fn switch(&mut self) -> TermTest {
        match self.token() {
            Token::Word(word) if super::names::switch(word).is_some() => {
                let word = Spanned { value: word.clone(), span: self.span() };
                self.advance();
                TermTest::Word(true, word)
            }
            _ => TermTest::Bare,
        }
    }

    fn number(&mut self, comparison: Relation) -> Result<TermTest, SpannedError> {
        let Token::Number(number) = self.token() else { return Err(self.expected("a number")) };
        let number = Spanned { value: number.clone(), span: self.span() };
        self.advance();
        let keywords = KEYWORDS.iter().any(|keyword| self.is_next(keyword));
        let unit = match self.token() {
            Token::Word(unit) if !keywords => {
                let unit = Spanned { value: unit.clone(), span: self.span() };
                self.advance();
                Some(unit)
            }
            _ => None,
        };
        Ok(TermTest::Number(comparison, number, unit))
    }
}

/// What is alone needs no list.
fn single(mut all: Vec<Expression>, list: fn(Vec<Expression>) -> Expression) -> Expression {
    if all.len() > 1 {
        return list(all);
    }
    all.pop().unwrap_or_else(|| list(Vec::new()))
}
