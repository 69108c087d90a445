//! The protocol of `conform`: each sort of line, read and written.

use std::fmt::{Debug, Display};
use std::str::FromStr;

use adsdv_oracle::conform::{LineBuffer, ProgramError, ProgramErrorKind, Reply, SentLine, TooLong};
use adsdv_oracle::protocol::{Answer, BadLine, INPUTS, InputsAsJson, Protocol, Request, SHOWN, Shown};
use adsdv_spec::{AiSilence, Control, Edition, Inputs, Machine};

use super::Bytes;
use crate::world::Chance;

/// The choice that makes the rest of the bytes lines.
pub const AS_TEXT: [u8; 1] = [1];

/// The body.
pub fn body(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    if bytes.one_in(4) {
        any_step(&mut bytes);
    } else {
        let written = bytes.rest();
        of_a_program(written);
        let text = String::from_utf8_lossy(written);
        // A program's answer ends with its line.
        text.split('\n').for_each(line);
    }
}

/// What a program writes comes as the same lines in whatever pieces; each is an answer, or reported as what it is.
fn of_a_program(written: &[u8]) {
    let mut lines = LineBuffer::default();
    let mut left = written;
    let mut expected = written.split(|&byte| byte == b'\n');
    while let Some(&first) = left.first() {
        let (piece, others) = left.split_at(left.len().min(1 + usize::from(first % 97)));
        lines.push(piece);
        left = others;
        loop {
            let line = match lines.take() {
                Ok(Some(line)) => lines.get(line),
                Ok(None) => break,
                Err(TooLong) => {
                    assert!(expected.next().is_some_and(|line| line.len() > LineBuffer::LONGEST));
                    return;
                }
            };
            assert_eq!(Some(line), expected.next(), "in pieces");
            answered(line);
        }
    }
    assert_eq!(Some(lines.rest()), expected.next(), "what has no end");
    assert_eq!(expected.next(), None);
    // A program that goes on like this, and never ends its line.
    let rest = lines.rest().to_vec();
    if rest.len() > 64 {
        while lines.rest().len() <= LineBuffer::LONGEST {
            assert_eq!(lines.take(), Ok(None));
            lines.push(&rest);
        }
        assert_eq!(lines.take(), Err(TooLong));
    }
}

/// An answer to a step, to a reset, or neither.
fn answered(line: &[u8]) {
    let given = |what: ProgramErrorKind| {
        let place = SentLine { scenario: "any".to_owned(), step: 1, sent: "{}".to_owned() };
        let trouble = ProgramError { place: Some(Box::new(place)), what, stderr: Vec::new() };
        for text in [trouble.to_string(), trouble.hint().to_string()] {
            assert!(!text.contains(|c: char| c.is_control() && c != '\n'), "{text:?}");
        }
    };
    let protocol = Protocol::of(Edition::DEFAULT);
    let late = Reply::to_step(line, true, &protocol);
    if !matches!(late, Ok(Reply::Nothing)) {
        assert_eq!(Reply::to_step(line, false, &protocol).is_ok(), late.is_ok());
    }
    let reset = Reply::to_reset(line);
    assert!(reset.is_err() || !matches!(late, Ok(Reply::Answer(_))));
    let hello = Reply::to_hello(line, Edition::DEFAULT);
    late.err().into_iter().chain(reset.err()).chain(hello.err()).for_each(given);
}

/// A line is each of the sorts or not, and what is one is written as it was read.
fn line(line: &str) {
    same_again::<Request>(line);
    same_again::<InputsAsJson>(line);
    match line.parse::<Answer>() {
        Ok(answer) => {
            assert!(answer.has("as_state") && answer.keys().count() <= SHOWN.len());
            for field in SHOWN {
                assert_eq!(answer.has(field.key), answer.keys().any(|key| key == field.key));
                if let Some(value) = answer.get(field.key) {
                    assert!(!value.to_string().is_empty());
                }
            }
            // What is an answer to a step is none to a reset.
            assert_eq!(Answer::is_reset(line), Ok(false));
        }
        Err(error) => is_readable(&error),
    }
    if let Err(error) = Answer::is_reset(line) {
        is_readable(&error);
    }
}

/// What is wrong is printed in one line.
fn is_readable(error: &BadLine) {
    let text = error.to_string();
    assert!(!text.is_empty() && !text.contains(|c: char| c.is_control()), "{text:?}");
}

fn same_again<T: FromStr<Err = BadLine> + Display + PartialEq + Debug>(line: &str) {
    match line.parse::<T>() {
        Ok(read) => {
            let written = read.to_string();
            assert!(!written.contains('\n'));
            assert_eq!(written.parse(), Ok(read), "{written}");
        }
        Err(error) => is_readable(&error),
    }
}

/// Any step that is sent to a program is the step that it gets; and what it shows is read as it was shown.
fn any_step(bytes: &mut Bytes<'_>) {
    let readings = bytes.readings();
    let machine = Machine::new(*Edition::DEFAULT, readings);
    let (inputs, dt_ms): (Inputs, u32) = (bytes.any(), bytes.any());
    // This edition has no key for a silence.
    let inputs = Inputs { ai_silence: AiSilence::default(), ..inputs.held_by(&machine.edition().bus) };
    let given = Request::Step { dt_ms, inputs }.to_string();
    // What a VCU measures itself, and the protocol has no key for, is left at its default.
    let Ok(Request::Step { dt_ms: again, inputs: read }) = given.parse() else { panic!("{given} is a step") };
    assert_eq!(again, dt_ms);
    for field in INPUTS.iter().filter(|field| field.is_in(machine.edition())) {
        assert_eq!((field.get)(&read), (field.get)(&inputs), "{}", field.key);
    }
    let (_, outputs) = machine.step(&Control::INITIAL, &read, dt_ms);
    let shown = Shown::of(machine.edition(), &outputs, &read);
    let answer: Answer = shown.to_string().parse().expect("what is shown is an answer");
    assert_eq!(answer, Answer::from(shown));
    assert!(answer.agrees(&shown) && answer.differences(&shown).next().is_none());
    // What it sees of the rest of the car is no condition of the document.
    assert_eq!(
        shown,
        Shown::of(machine.edition(), &machine.step(&Control::INITIAL, &inputs, dt_ms).1, &read)
    );
}
