//! A line, read.

use adsdv_spec::messages::AsState;

use super::error::LineError;
use super::seconds::Seconds;
use super::{Line, When};
use crate::car::{Action, Expected};

/// The word that stops the program.
pub(super) const END: &str = "end";

/// Reads one line after the other, and knows what the lines before say.
#[derive(Default)]
pub(super) struct Lines {
    /// The line that ended the scenario, and whether an error says that there are lines behind it.
    ended: Option<u64>,
    reported_more: bool,
    /// The line whose error names every switch.
    named: Option<u64>,
    /// When the line before takes place at the earliest, in milliseconds since the start, and its number.
    earliest: Option<(u64, u64)>,
}

/// A piece of the line, with where it stands.
#[derive(Clone, Copy)]
struct Piece<'a> {
    at: usize,
    text: &'a str,
}

impl Piece<'_> {
    /// Without the white space around it.
    fn trimmed(self) -> Self {
        let begun = self.text.trim_start();
        Self { at: self.at + self.text.len() - begun.len(), text: begun.trim_end() }
    }

    /// The first word, and what follows it.
    fn split_word(self) -> (Self, Self) {
        let Self { at, text } = self.trimmed();
        let end = text.find(char::is_whitespace).unwrap_or(text.len());
        let (word, rest) = text.split_at_checked(end).unwrap_or((text, ""));
        (Self { at, text: word }, Self { at: at + end, text: rest }.trimmed())
    }

    /// The pieces between the commas.
    fn split_commas(self) -> impl Iterator<Item = Self> {
        let mut at = self.at;
        self.text.split(',').map(move |text| {
            let piece = Piece { at, text };
            at += text.len() + 1;
            piece.trimmed()
        })
    }

    fn wrong(self, expected: impl Into<String>) -> Wrong {
        Wrong { at: self.at, found: self.text.into(), expected: expected.into() }
    }

    fn is_time(self) -> bool {
        Seconds::parse(self.text).is_ok()
    }

    /// Whether it looks like a time, right or wrong.
    fn is_like_time(self) -> bool {
        self.text.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '.'))
    }
}

/// Something wrong with a line, before its number is known.
struct Wrong {
    at: usize,
    found: Vec<u8>,
    expected: String,
}

impl Lines {
    /// Reads a line; `None` if it says nothing.
    pub(super) fn line(&mut self, number: u64, text: &[u8]) -> Result<Option<Line>, Vec<LineError>> {
        // A comment may have any bytes.
        let text = text.split(|&byte| byte == b'#').next().unwrap_or_default();
        let mut wrong = Vec::new();
        let line = match std::str::from_utf8(text) {
            Ok(text) => self.read(number, Piece { at: 0, text }.trimmed(), &mut wrong),
            Err(error) => {
                let found = text.get(error.valid_up_to()..).unwrap_or_default().iter().take(4);
                wrong.push(Wrong {
                    at: error.valid_up_to(),
                    found: found.copied().collect(),
                    expected: "text in UTF-8".to_owned(),
                });
                None
            }
        };
        if wrong.is_empty() {
            return Ok(line);
        }
        let error =
            |Wrong { at, found, expected }| LineError { line: number, column: at + 1, found, expected };
        Err(wrong.into_iter().map(error).collect())
    }

    fn read(&mut self, number: u64, text: Piece<'_>, wrong: &mut Vec<Wrong>) -> Option<Line> {
        if text.text.is_empty() {
            return None;
        }
        if let Some(ended) = self.ended.filter(|_| !self.reported_more) {
            self.reported_more = true;
            wrong.push(text.wrong(format!("nothing more: {END} stands in line {ended}")));
        }
        let (when, doings) = match when(text) {
            Ok(read) => read,
            Err((error, doings)) => {
                wrong.push(error);
                (When::After(0), doings)
            }
        };
        if wrong.is_empty() {
            self.in_order(number, when, text, wrong);
        }
        // A line of which nothing is right has one mistake, and not two.
        if doings.text.is_empty() && !wrong.is_empty() {
            return None;
        }
        let (actions, ends) = self.doings(number, doings, wrong);
        if ends && self.ended.is_none() {
            self.ended = Some(number);
        }
        Some(Line { number, when, actions, ends })
    }

    /// A time since the start cannot come before the line before.
    fn in_order(&mut self, number: u64, when: When, text: Piece<'_>, wrong: &mut Vec<Wrong>) {
        let (before, line) = self.earliest.unwrap_or_default();
        let earliest = match when {
            When::At(ms) if u64::from(ms) < before => {
                let (word, _) = text.split_word();
                let before = Seconds(before);
                wrong.push(
                    word.wrong(format!("{before} or later: line {line} does not take place before that")),
                );
                return;
            }
            When::At(ms) => ms.into(),
            When::After(ms) => before + u64::from(ms),
            When::State(_, ms) => before.max(ms.into()),
        };
        self.earliest = Some((earliest, number));
    }
}

/// When a line takes place, and the rest of it; or what is wrong, and what is most likely the rest.
fn when(text: Piece<'_>) -> Result<(When, Piece<'_>), (Wrong, Piece<'_>)> {
    let (word, rest) = text.split_word();
    let seconds = |piece: Piece<'_>| Seconds::parse(piece.text);
    // The time behind a plus sign, which may stand alone.
    let plus = |plus: Piece<'_>| match plus.text.strip_prefix('+') {
        Some(text) => {
            let time = Piece { at: plus.at + 1, text };
            Some(seconds(time).map_err(|expected| plus.wrong(format!("+ and {expected}"))))
        }
        None => None,
    };
    if let Some(error) = parted(word, rest) {
        return Err(error);
    }
    if let Some(time) = plus(word) {
        return time.map(|ms| (When::After(ms), rest)).map_err(|error| (error, rest));
    }
    if word.is_like_time() {
        return seconds(word).map(|ms| (When::At(ms), rest)).map_err(|expected| (word.wrong(expected), rest));
    }
    // The plus sign may follow the state without a space.
    let end = word.text.find('+').unwrap_or(word.text.len());
    let name = word.text.get(..end).unwrap_or_default();
    let Some(state) = AsState::ALL.into_iter().find(|state| state.name() == name) else {
        let names: Vec<&str> = AsState::ALL.iter().map(|state| state.name()).collect();
        let expected = format!("a time such as 12.5 or +0.5, or one of {}", names.join(", "));
        // Somebody may have left out the time.
        let is_action = text.split_commas().next().is_some_and(|first| is_doing(first.text));
        return Err((word.wrong(expected), if is_action { text } else { after_time(rest) }));
    };
    let (next, behind) = if end < word.text.len() {
        (Piece { at: word.at + end, text: word.text.get(end..).unwrap_or_default() }, rest)
    } else {
        rest.split_word()
    };
    if let Some(error) = parted(next, behind) {
        return Err(error);
    }
    match plus(next) {
        None if next.is_like_time() => {
            let expected = match seconds(next) {
                Ok(ms) => format!("+{}: a time behind a state begins with +", Seconds(ms.into())),
                Err(expected) => format!("+ and {expected}"),
            };
            Err((next.wrong(expected), behind))
        }
        None => Ok((When::State(state, 0), rest)),
        Some(time) => time.map(|ms| (When::State(state, ms), behind)).map_err(|error| (error, behind)),
    }
}

/// A plus sign, and the time that belongs to it behind a space: what is wrong, and the rest.
fn parted<'a>(plus: Piece<'a>, behind: Piece<'a>) -> Option<(Wrong, Piece<'a>)> {
    let (time, rest) = behind.split_word();
    (plus.text == "+" && time.is_time()).then(|| {
        let found = format!("+ {}", time.text).into();
        (Wrong { at: plus.at, found, expected: format!("+{} without a space", time.text) }, rest)
    })
}

/// What follows a time that belongs to a state, if there is one.
fn after_time(text: Piece<'_>) -> Piece<'_> {
    let (word, rest) = text.split_word();
    match word.text {
        "+" if rest.split_word().0.is_like_time() => rest.split_word().1,
        plus if plus.starts_with('+') => rest,
        _ if word.is_like_time() => rest,
        _ => text,
    }
}

impl Lines {
    /// What is done, and whether the program stops then.
    fn doings(&mut self, number: u64, text: Piece<'_>, wrong: &mut Vec<Wrong>) -> (Vec<Action>, bool) {
        let mut actions: Vec<Action> = Vec::new();
        let mut ends = false;
        for piece in text.split_commas() {
            if ends {
                wrong.push(piece.wrong(format!("nothing behind {END}")));
                continue;
            }
            if piece.text == END {
                ends = true;
                continue;
            }
            match piece.text.parse::<Action>() {
                Ok(action) if actions.iter().any(|before| same_switch(*before, action)) => {
                    wrong.push(piece.wrong("each switch once in a line: what is done at once has no order"));
                }
                Ok(action) => actions.push(action),
                Err(error) => wrong.push(Wrong {
                    at: piece.at + error.at,
                    expected: self.expected(number, piece, &error.expected),
                    found: error.found.into(),
                }),
            }
        }
        (actions, ends)
    }

    /// What was expected instead of an action, in words. The switches are named once in a file.
    fn expected(&mut self, number: u64, piece: Piece<'_>, expected: &Expected) -> String {
        let is_word = piece.split_word().1.text.is_empty();
        match (expected, self.named) {
            (Expected::Name(_), _) if piece.text.eq_ignore_ascii_case(END) => {
                format!("an action; did you mean {END}?")
            }
            (Expected::Name(None), Some(named)) if named != number => {
                format!("the name of a switch: line {named} has them all")
            }
            (Expected::Name(None), Some(_)) => "the name of a switch".to_owned(),
            (Expected::Name(None), None) => {
                self.named = Some(number);
                let end = if is_word { format!("{END}, ") } else { String::new() };
                format!("{end}{expected}")
            }
            _ => expected.to_string(),
        }
    }
}

fn is_doing(text: &str) -> bool {
    text == END || text.parse::<Action>().is_ok()
}

fn same_switch(a: Action, b: Action) -> bool {
    match (a, b) {
        (Action::Set(a, _), Action::Set(b, _)) => a == b,
        (Action::PowerCycle, Action::PowerCycle) => true,
        _ => false,
    }
}
