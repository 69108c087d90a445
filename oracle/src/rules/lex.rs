//! A line as words, numbers and signs.

use std::fmt;
use std::iter::Peekable;

use super::error::{Span, SpannedError};

/// A piece of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Token {
    /// A name, a keyword, or a unit such as km/h.
    Word(String),
    /// A number, as it is written.
    Number(String),
    /// What stands in quotes.
    Text(String),
    /// A sign, such as `>=` or a comma.
    Sign(&'static str),
    /// The end of the line, or of what is in front of its comment.
    End,
}

/// As an error tells what was found.
impl fmt::Display for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Word(word) => write!(f, "{word:?}"),
            Self::Number(number) => write!(f, "{number}"),
            Self::Text(_) => f.write_str("a text in quotes"),
            Self::Sign(sign) => write!(f, "\"{sign}\""),
            Self::End => f.write_str("the end of the line"),
        }
    }
}

/// The signs, those that others begin with first.
const SIGNS: [&str; 12] = [">=", "<=", "==", "!=", ">", "<", "=", "(", ")", ",", ":", "."];

/// The pieces of a line; the last of them is its end.
pub(super) fn line(text: &str) -> Result<Vec<(Token, Span)>, SpannedError> {
    let characters: Vec<char> = text.chars().collect();
    let mut tokens = Vec::new();
    let mut start = 0;
    while let Some((token, width)) = next(characters.get(start..).unwrap_or_default(), start)? {
        if let Some(token) = token {
            tokens.push((token, Span { start, width }));
        }
        start += width;
    }
    let end = tokens.last().map_or(0, |(_, last): &(Token, Span)| last.start + last.width);
    tokens.push((Token::End, Span { start: end, width: 1 }));
    Ok(tokens)
}

/// The piece at the beginning, unless it is a blank, and how long it is; `None` at the end.
fn next(rest: &[char], at: usize) -> Result<Option<(Option<Token>, usize)>, SpannedError> {
    let Some(&first) = rest.first() else { return Ok(None) };
    let second = rest.get(1).copied();
    let is = |c: Option<char>, digit: fn(&char) -> bool| c.is_some_and(|c| digit(&c));
    Ok(match first {
        '#' => None,
        _ if first.is_whitespace() => Some((None, 1)),
        '"' => Some(quoted(rest, at)?),
        _ if identifier(rest) => Some((Some(Token::Word(taken(rest, 4))), 4)),
        _ if first.is_ascii_digit() || first == '-' && is(second, char::is_ascii_digit) => {
            let number = number(rest);
            let width = number.chars().count();
            Some((Some(Token::Number(number)), width))
        }
        _ if begins_word(first) => {
            let width = rest.iter().take_while(|&&c| is_in_word(c)).count();
            Some((Some(Token::Word(taken(rest, width))), width))
        }
        _ => {
            let pair: String = taken(rest, 2);
            let sign = SIGNS.iter().find(|sign| pair.starts_with(*sign));
            let sign = sign.ok_or_else(|| {
                let why =
                    format!("found {first:?}; expected a word, a number, a comparison or a parenthesis");
                SpannedError::new(Span { start: at, width: 1 }, why)
            })?;
            Some((Some(Token::Sign(sign)), sign.len()))
        }
    })
}

fn taken(rest: &[char], width: usize) -> String {
    rest.iter().take(width).collect()
}

/// Whether it is a message by its identifier, such as `510h` in front of a point.
fn identifier(rest: &[char]) -> bool {
    matches!(rest, [a, b, c, 'h', '.', ..] if a.is_ascii_digit() && b.is_ascii_hexdigit() && c.is_ascii_hexdigit())
}

fn begins_word(c: char) -> bool {
    c.is_alphabetic() || matches!(c, '_' | '%' | '°')
}

fn is_in_word(c: char) -> bool {
    begins_word(c) || c.is_ascii_digit() || matches!(c, '-' | '/' | '^')
}

/// The number at the beginning: a sign, digits, and digits behind a point.
fn number(rest: &[char]) -> String {
    let mut number = String::new();
    let mut rest = rest.iter().copied().peekable();
    number.extend(rest.next());
    digits(&mut rest, &mut number);
    let mut behind = rest.clone();
    if behind.next_if_eq(&'.').is_some() && behind.peek().is_some_and(char::is_ascii_digit) {
        number.push('.');
        digits(&mut behind, &mut number);
    }
    number
}

fn digits(rest: &mut Peekable<impl Iterator<Item = char>>, number: &mut String) {
    while let Some(digit) = rest.next_if(char::is_ascii_digit) {
        number.push(digit);
    }
}

fn quoted(rest: &[char], at: usize) -> Result<(Option<Token>, usize), SpannedError> {
    let inside: String = rest.iter().skip(1).take_while(|&&c| c != '"').collect();
    let width = inside.chars().count() + 2;
    if width > rest.len() {
        let span = Span { start: at, width: rest.len() };
        return Err(SpannedError::new(span, "a text in quotes does not end; expected \" at its end"));
    }
    Ok((Some(Token::Text(inside)), width))
}
