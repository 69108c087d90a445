//! Where the messages and signals of a database stand, and the identifiers as they are written: the parser keeps neither.

/// The messages of a database, in its order.
#[derive(Debug)]
pub(super) struct Lines<'a> {
    messages: Vec<MessageLines<'a>>,
}

/// The lines of a message.
#[derive(Clone, Debug, Default)]
pub(super) struct MessageLines<'a> {
    /// The number of its own line, from 1; `None` where it was not found.
    pub(super) line: Option<usize>,
    /// The identifier as it is written.
    pub(super) id: Option<u64>,
    signals: Vec<(usize, &'a str)>,
}

impl<'a> Lines<'a> {
    pub(super) fn of(text: &'a str) -> Self {
        let mut messages: Vec<MessageLines<'a>> = Vec::new();
        let mut inside = false;
        for (line, number) in text.lines().zip(1..) {
            // A comment may go over several lines, and have anything in it.
            let (was_inside, escaped) = (inside, line.matches("\\\"").count());
            inside ^= (line.matches('"').count() - escaped) % 2 == 1;
            if was_inside {
                continue;
            }
            let mut words = line.split_ascii_whitespace();
            match (words.next(), words.next()) {
                (Some("BO_"), id) => {
                    let id = id.and_then(|id| id.parse().ok());
                    messages.push(MessageLines { line: Some(number), id, signals: Vec::new() });
                }
                (Some("SG_"), Some(name)) => {
                    if let Some(message) = messages.last_mut() {
                        message.signals.push((number, name.trim_end_matches(':')));
                    }
                }
                _ => {}
            }
        }
        Self { messages }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.messages.is_empty()
    }

    pub(super) fn len(&self) -> usize {
        self.messages.len()
    }

    /// The lines of the message at this place.
    pub(super) fn of_message(&self, place: usize) -> MessageLines<'a> {
        self.messages.get(place).cloned().unwrap_or_default()
    }
}

impl MessageLines<'_> {
    /// The line of a signal, or else of the message.
    pub(super) fn of_signal(&self, name: &str) -> Option<usize> {
        let signal = self.signals.iter().find(|(_, other)| *other == name);
        signal.map(|(line, _)| *line).or(self.line)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_inside_a_comment_are_none() {
        let text = "CM_ \"BO_ 1 no\nBO_ 2 no\n\\\" BO_ 3 no\n\";\n\nBO_ 4 M: 8 X\n SG_ A: 0|1@1+\n SG_ B m0 : 1|1@1+\n";
        let lines = Lines::of(text);
        assert_eq!(lines.len(), 1);
        let message = lines.of_message(0);
        assert_eq!((message.line, message.id), (Some(6), Some(4)));
        assert_eq!(["A", "B", "C"].map(|name| message.of_signal(name)), [Some(7), Some(8), Some(6)]);
        assert_eq!(lines.of_message(1).line, None);
    }
}
