//! The other end of the protocol, for a stack that is written in Rust.

use std::io::{self, BufRead, Write};

use adsdv_spec::Edition;
use adsdv_spec::messages::Frame;
use serde::Deserialize;

use crate::program::frame;
use crate::stack::Stack;

/// Answers the lines of `exam/PROTOCOL.md` for a stack, until the input ends.
///
/// A hello about an edition that this crate does not know is answered with `{}`, and so is one that the stack refuses.
///
/// ```
/// let lines = b"{\"op\":\"hello\",\"edition\":\"4.0\"}\n{\"op\":\"reset\"}\n{\"op\":\"step\",\"t_ms\":4,\"frames\":[]}\n";
/// let mut answers = Vec::new();
/// adsdv_exam::serve(&mut adsdv_exam::Reference::default(), &lines[..], &mut answers)?;
/// assert_eq!(answers, b"{\"edition\":\"4.0\"}\n{}\n{\"frames\":[]}\n");
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
///
/// Fails if what was asked is no line of the protocol, the stack fails, or the answers cannot be written.
pub fn serve(stack: &mut dyn Stack, lines: impl BufRead, mut answers: impl Write) -> io::Result<()> {
    for line in lines.lines() {
        let answer = answer(stack, &serde_json::from_str(&line?)?)?;
        writeln!(answers, "{answer}")?;
        answers.flush()?;
    }
    Ok(())
}

/// What is asked.
#[derive(Deserialize)]
#[serde(tag = "op", rename_all = "lowercase")]
enum Asked {
    Hello { edition: String },
    Reset,
    Step { t_ms: u64, frames: Vec<String> },
}

fn answer(stack: &mut dyn Stack, asked: &Asked) -> io::Result<String> {
    match asked {
        Asked::Hello { edition } => {
            let known = Edition::ALL.iter().find(|one| one.version == edition);
            let is_its_own = known.is_some_and(|known| stack.hello(known).is_ok());
            Ok(if is_its_own { format!("{{\"edition\":\"{edition}\"}}") } else { "{}".to_owned() })
        }
        Asked::Reset => {
            stack.reset().map_err(io::Error::other)?;
            Ok("{}".to_owned())
        }
        Asked::Step { t_ms, frames } => {
            let read = frames.iter().map(|text| frame(text).map_err(|wrong| io::Error::other(wrong.why())));
            let frames: Vec<Frame> = read.collect::<io::Result<_>>()?;
            let sent = stack.step(*t_ms, &frames).map_err(io::Error::other)?;
            let sent: Vec<String> = sent.iter().map(|frame| format!("\"{frame}\"")).collect();
            Ok(format!("{{\"frames\":[{}]}}", sent.join(",")))
        }
    }
}
