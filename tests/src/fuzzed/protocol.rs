//! The protocol of `conform`, as any edition has it: each sort of line, read and written.

use std::fmt::Debug;

use adsdv_conform::protocol::{
    Answer, BadLine, INPUTS, InputsAsJson, Protocol, Request, SHOWN, Shown, UNSAID,
};
use adsdv_conform::{LineBuffer, ProgramError, ProgramErrorKind, Reply, SentLine, TooLong};
use adsdv_spec::{AiSilence, Control, Edition, Inputs, Machine};

use super::Bytes;
use crate::world::Chance;

/// The choices that make the rest of the bytes lines of the edition at this place in [`Edition::ALL`].
pub const fn as_text(edition: u8) -> [u8; 2] {
    [edition, 1]
}

/// The body.
pub fn body(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let edition = bytes.edition();
    if bytes.one_in(4) {
        any_step(edition, &mut bytes);
    } else {
        let written = bytes.rest();
        of_a_program(edition, written);
        let text = String::from_utf8_lossy(written);
        let protocol = Protocol::of(edition);
        // A program's answer ends with its line.
        text.split('\n').for_each(|text| {
            line(text, &protocol);
            without_an_edition(text);
        });
    }
}

/// What a program writes comes as the same lines in whatever pieces; each is an answer, or reported as what it is.
fn of_a_program(edition: &'static Edition, written: &[u8]) {
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
            answered(edition, line);
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
fn answered(edition: &'static Edition, line: &[u8]) {
    let given = |what: ProgramErrorKind| {
        let place = SentLine { scenario: "any".to_owned(), step: 1, sent: "{}".to_owned() };
        let trouble = ProgramError { place: Some(Box::new(place)), what, stderr: Vec::new() };
        for text in [trouble.to_string(), trouble.hint().to_string()] {
            assert!(!text.contains(|c: char| c.is_control() && c != '\n'), "{text:?}");
        }
    };
    let protocol = Protocol::of(edition);
    let late = Reply::to_step(line, true, &protocol);
    if !matches!(late, Ok(Reply::Nothing)) {
        assert_eq!(Reply::to_step(line, false, &protocol).is_ok(), late.is_ok());
    }
    let reset = Reply::to_reset(line);
    assert!(reset.is_err() || !matches!(late, Ok(Reply::Answer(_))));
    let hello = Reply::to_hello(line, edition);
    late.err().into_iter().chain(reset.err()).chain(hello.err()).for_each(given);
}

/// A line that is read by itself is one of the edition that holds where nobody says which.
fn without_an_edition(line: &str) {
    let protocol = Protocol::of(UNSAID);
    assert_eq!(line.parse::<Request>(), protocol.request(line));
    assert_eq!(line.parse::<InputsAsJson>(), protocol.inputs_as_json(line));
    assert_eq!(line.parse::<Answer>(), protocol.answer(line));
    if let Ok(request) = line.parse::<Request>() {
        assert_eq!(request.to_string(), protocol.line(&request).to_string());
    }
    if let Ok(inputs) = line.parse::<InputsAsJson>() {
        assert_eq!(inputs.to_string(), protocol.object(&inputs).to_string());
    }
}

/// A line is each of the sorts or not, and what is one is written as it was read.
fn line(line: &str, protocol: &Protocol) {
    same_again(line, |line| protocol.request(line), |request| protocol.line(request).to_string());
    same_again(line, |line| protocol.inputs_as_json(line), |inputs| protocol.object(inputs).to_string());
    match protocol.answer(line) {
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

fn same_again<T: PartialEq + Debug>(
    line: &str,
    read: impl Fn(&str) -> Result<T, BadLine>,
    write: impl Fn(&T) -> String,
) {
    match read(line) {
        Ok(one) => {
            let written = write(&one);
            assert!(!written.contains('\n'));
            assert_eq!(read(&written), Ok(one), "{written}");
        }
        Err(error) => is_readable(&error),
    }
}

/// Any step that is sent to a program is the step that it gets; and what it shows is read as it was shown.
fn any_step(edition: &Edition, bytes: &mut Bytes<'_>) {
    let protocol = Protocol::of(edition);
    let machine = Machine::new(*edition, bytes.readings(edition));
    let (inputs, dt_ms): (Inputs, u32) = (bytes.any(), bytes.any());
    let mut inputs = inputs.held_by(&edition.bus);
    if edition.rules.thresholds.missed_ms.is_none() {
        // The edition has no key for a silence.
        inputs.ai_silence = AiSilence::default();
    }
    let given = protocol.line(&Request::Step { dt_ms, inputs }).to_string();
    // What a VCU measures itself, and the protocol has no key for, is left at its default.
    let Ok(Request::Step { dt_ms: again, inputs: read }) = protocol.request(&given) else {
        panic!("{given} is a step of {}", edition.version)
    };
    assert_eq!(again, dt_ms);
    for field in INPUTS.iter().filter(|field| field.is_in(edition)) {
        assert_eq!((field.get)(&read), (field.get)(&inputs), "{}: {}", edition.version, field.key);
    }
    let (_, outputs) = machine.step(&Control::INITIAL, &read, dt_ms);
    let shown = Shown::of(edition, &outputs, &read);
    let answer = protocol.answer(&shown.to_string()).expect("what is shown is an answer");
    assert_eq!(answer, Answer::from(shown));
    assert!(answer.agrees(&shown) && answer.differences(&shown).next().is_none());
    // What it sees of the rest of the car is no condition of the document.
    assert_eq!(shown, Shown::of(edition, &machine.step(&Control::INITIAL, &inputs, dt_ms).1, &read));
}
