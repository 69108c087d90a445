//! What a property says in an edition: its statement with the edition's times, and the requirements that it covers there.

use adsdv_spec::Edition;

use crate::closed::ClosedProperty;
use crate::property::Property;

impl Property {
    /// What it says, with the times of an edition.
    pub fn statement_in(&self, edition: &Edition) -> String {
        statement(self.statement, edition)
    }

    /// The requirements that it covers, of those that an edition asks for.
    pub fn requirements_in(&self, edition: &Edition) -> Vec<&'static str> {
        asked_for(self.requirements, edition)
    }
}

impl ClosedProperty {
    /// What it says, with the times of an edition.
    pub fn statement_in(&self, edition: &Edition) -> String {
        statement(self.statement, edition)
    }

    /// The requirements that it covers, of those that an edition asks for.
    pub fn requirements_in(&self, edition: &Edition) -> Vec<&'static str> {
        asked_for(self.requirements, edition)
    }
}

/// Puts the times of an edition in the place of what stands in braces.
fn statement(words: &str, edition: &Edition) -> String {
    let timing = &edition.rules.timing;
    words
        .replace("{ready_dwell}", &time(timing.ready_dwell_ms))
        .replace("{ebs_timer}", &time(timing.ebs_timer_ms))
        .replace("{handshake}", &time(timing.handshake_ms))
}

/// A time in whole seconds where it is one, else in milliseconds.
fn time(ms: u16) -> String {
    if ms.is_multiple_of(1000) { format!("{} s", ms / 1000) } else { format!("{ms} ms") }
}

fn asked_for(requirements: &'static [&'static str], edition: &Edition) -> Vec<&'static str> {
    requirements.iter().copied().filter(|id| edition.requirements.has(id)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_statement_has_the_times_of_the_edition() {
        let words = "{ready_dwell}, {ebs_timer}, {handshake}";
        assert_eq!(statement(words, &Edition::V3_0), "5 s, 15 s, 50 ms");
        assert_eq!(statement(words, &Edition::V4_0), "5 s, 15 s, 100 ms");
        for property in crate::PROPERTIES {
            let text = property.statement_in(&Edition::V4_0);
            assert!(!text.contains(['{', '}']), "{text}");
        }
    }
}
