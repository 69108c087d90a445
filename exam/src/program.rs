//! A program that is examined through its standard input and output, in simulated time.

use std::ffi::OsString;
use std::fmt::Write as _;
use std::time::Duration;

use adsdv_conform::{LineProgram, excerpt};
use adsdv_spec::Edition;
use adsdv_spec::messages::Frame;
use serde::Deserialize;

use crate::program_error::{StackError, StackErrorKind, StackErrorPlace};
use crate::stack::Stack;

/// No line of a program has more frames: ten times what a bus carries in 10 ms.
pub const MAX_FRAMES: usize = 1000;

/// A child process that speaks the protocol of `exam/PROTOCOL.md`. It is killed, with everything that it started, when it is
/// dropped.
#[derive(Debug)]
pub struct StdioStack(LineProgram);

impl StdioStack {
    /// Starts a program that has `timeout` for each answer, and `limit` for all of them.
    ///
    /// # Errors
    ///
    /// Fails if it cannot be started.
    pub fn start(
        program: &OsString,
        args: &[OsString],
        timeout: Duration,
        limit: Duration,
    ) -> Result<Self, StackError> {
        let started = LineProgram::start(program, args, timeout).map_err(StackError::new)?;
        Ok(Self(started.within(limit)))
    }

    /// Writes a line, and reads what is answered.
    fn ask<T>(
        &mut self,
        to: &'static str,
        line: String,
        read: impl FnOnce(Answer) -> Result<T, Wrong>,
    ) -> Result<T, StackError> {
        let mut bytes = line.clone().into_bytes();
        bytes.push(b'\n');
        self.0.write(bytes);
        let what = match self.0.line() {
            Err(what) => what.into(),
            Ok(answer) => match parse(answer, example(to)).and_then(read) {
                Ok(read) => return Ok(read),
                Err(Wrong::Says(why)) => StackErrorKind::NoAnswer { to, line: excerpt(answer), why },
                Err(Wrong::Edition { asked, said }) => StackErrorKind::OtherEdition { asked, said },
            },
        };
        let place = Some(Box::new(StackErrorPlace { sent: line, ..StackErrorPlace::default() }));
        Err(StackError { place, what, stderr: self.0.last_words() })
    }
}

impl Stack for StdioStack {
    fn hello(&mut self, edition: &Edition) -> Result<(), StackError> {
        let asked = edition.version;
        self.ask("hello", format!("{{\"op\":\"hello\",\"edition\":\"{asked}\"}}"), |answer| {
            answer.no_frames()?;
            match answer.edition {
                Some(said) if said == asked => Ok(()),
                said => Err(Wrong::Edition { asked: asked.to_owned(), said }),
            }
        })
    }

    fn reset(&mut self) -> Result<(), StackError> {
        self.ask("reset", "{\"op\":\"reset\"}".to_owned(), |answer| answer.no_frames())
    }

    fn step(&mut self, time_ms: u64, frames: &[Frame]) -> Result<Vec<Frame>, StackError> {
        let mut line = format!("{{\"op\":\"step\",\"t_ms\":{time_ms},\"frames\":[");
        for (place, frame) in frames.iter().enumerate() {
            // Writing to a string does not fail.
            let _ = write!(line, "{}\"{frame}\"", if place == 0 { "" } else { "," });
        }
        line.push_str("]}");
        self.ask("step", line, Answer::frames)
    }

    fn end(&mut self) -> Result<Vec<String>, StackError> {
        self.0.end().map_err(|what| StackError { stderr: self.0.last_words(), ..StackError::new(what) })
    }
}

/// What is wrong with an answer.
pub(crate) enum Wrong {
    Says(String),
    Edition { asked: String, said: Option<String> },
}

impl Wrong {
    pub(crate) fn why(self) -> String {
        match self {
            Self::Says(why) => why,
            Self::Edition { asked, .. } => format!("another edition than {asked}"),
        }
    }
}

/// What a program may answer.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Answer {
    edition: Option<String>,
    frames: Option<Vec<String>>,
}

/// An answer to a line that asks for this.
fn example(to: &str) -> &'static str {
    match to {
        "hello" => "{\"edition\":\"4.0\"}",
        "reset" => "{}",
        _ => "{\"frames\":[]}",
    }
}

fn parse(line: &[u8], example: &str) -> Result<Answer, Wrong> {
    let text = std::str::from_utf8(line)
        .map_err(|_| Wrong::Says("it is not UTF-8; expected a JSON object".to_owned()))?;
    serde_json::from_str(text)
        .map_err(|error| Wrong::Says(format!("{error}; expected a JSON object such as {example}")))
}

impl Answer {
    fn no_frames(&self) -> Result<(), Wrong> {
        match &self.frames {
            Some(frames) if !frames.is_empty() => Err(Wrong::Says(format!(
                "{} frames; expected none: was a line before it answered twice?",
                frames.len()
            ))),
            _ => Ok(()),
        }
    }

    fn frames(self) -> Result<Vec<Frame>, Wrong> {
        let Some(texts) = self.frames else {
            return Err(Wrong::Says(
                "no key \"frames\"; expected it, as in {\"frames\":[]} where nothing is sent".to_owned(),
            ));
        };
        if texts.len() > MAX_FRAMES {
            let count = texts.len();
            return Err(Wrong::Says(format!("{count} frames; expected at most {MAX_FRAMES} in 10 ms")));
        }
        texts.iter().map(|text| frame(text)).collect()
    }
}

/// A frame as candump writes it.
pub(crate) fn frame(text: &str) -> Result<Frame, Wrong> {
    const EXPECTED: &str =
        "expected an identifier from 000 to 7FF, # and up to 8 bytes in hex digits, such as \"510#0100\"";
    let wrong = || Wrong::Says(format!("the frame {:?}; {EXPECTED}", excerpt(text.as_bytes())));
    let hex = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_hexdigit());
    let (id, data) = text.split_once('#').ok_or_else(wrong)?;
    let id = Some(id).filter(|id| id.len() <= 3 && hex(id)).ok_or_else(wrong)?;
    let id = u16::from_str_radix(id, 16).map_err(|_| wrong())?;
    if !data.is_empty() && !hex(data) {
        return Err(wrong());
    }
    let pairs = data.as_bytes().chunks(2);
    let byte = |pair: &[u8]| {
        let text = std::str::from_utf8(pair).ok().filter(|text| text.len() == 2)?;
        u8::from_str_radix(text, 16).ok()
    };
    let bytes: Option<Vec<u8>> = pairs.map(byte).collect();
    bytes.and_then(|bytes| Frame::new(id, &bytes)).ok_or_else(wrong)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answer(line: &str) -> Result<Vec<String>, String> {
        let frames = parse(line.as_bytes(), example("step")).and_then(Answer::frames);
        frames.map(|frames| frames.iter().map(Frame::to_string).collect()).map_err(Wrong::why)
    }

    #[test]
    fn frames_are_read_as_candump_writes_them() {
        let read = answer(r#"{"frames":["510#0110","7ff#","0#00","511#0102030405060708"]}"#);
        assert_eq!(
            read.expect("frames").iter().map(String::as_str).collect::<Vec<_>>(),
            ["510#0110", "7FF#", "000#00", "511#0102030405060708"]
        );
        assert_eq!(answer("{\"frames\":[]}"), Ok(Vec::new()));
    }

    #[test]
    fn what_is_no_json_says_what_an_answer_to_that_line_looks_like() {
        for (to, looks) in [("hello", "{\"edition\":\"4.0\"}"), ("reset", "{}"), ("step", "{\"frames\":[]}")]
        {
            let why = parse(b"started", example(to)).err().map(Wrong::why).unwrap_or_default();
            assert!(why.ends_with(&format!("expected a JSON object such as {looks}")), "{to}: {why}");
            assert!(parse(looks.as_bytes(), "").is_ok(), "{looks} is one");
        }
    }

    #[test]
    fn what_is_no_answer_says_what_was_expected() {
        let long = format!("{{\"frames\":[{}]}}", vec!["\"510#\""; MAX_FRAMES + 1].join(","));
        for (line, why) in [
            ("", "EOF while parsing"),
            ("[]", "such as {\"frames\":[]}"),
            ("{}", "no key \"frames\""),
            ("{\"frame\":[]}", "unknown field `frame`"),
            ("{\"frames\":[5]}", "invalid type"),
            ("{\"frames\":[\"510\"]}", "the frame \"510\"; expected an identifier"),
            ("{\"frames\":[\"800#\"]}", "from 000 to 7FF"),
            ("{\"frames\":[\"#00\"]}", "expected an identifier"),
            ("{\"frames\":[\"510#0\"]}", "expected an identifier"),
            ("{\"frames\":[\"510#0g\"]}", "expected an identifier"),
            ("{\"frames\":[\"510#\u{661}1\"]}", "expected an identifier"),
            ("{\"frames\":[\"510#010203040506070809\"]}", "up to 8 bytes"),
            ("{\"frames\":[\"00000510#00\"]}", "expected an identifier"),
            (&long, "at most 1000 in 10 ms"),
        ] {
            let error = answer(line).expect_err(line);
            assert!(error.contains(why), "{line}: {error}");
        }
    }
}
