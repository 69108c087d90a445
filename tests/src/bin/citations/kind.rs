//! What a citation stands for.

use crate::mistake::Mistake;
use crate::scan::Form;

/// What a requirement needs one of each of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Kind {
    /// Code that does what the requirement asks for.
    Implementation,
    /// A proof, or a property of the model, that it does so always.
    Proof,
    /// A test that would notice if it did not.
    Test,
}

impl Kind {
    pub(crate) const ALL: [Self; 3] = [Self::Implementation, Self::Proof, Self::Test];

    /// The type that duvet's annotations give it.
    pub(crate) const fn annotated(self) -> &'static str {
        match self {
            Self::Implementation => "implementation",
            Self::Proof => "implication",
            Self::Test => "test",
        }
    }

    /// Where duvet's report counts how much of a sentence has it.
    pub(crate) const fn reported(self) -> &'static str {
        match self {
            Self::Implementation => "citation",
            Self::Proof => "implication",
            Self::Test => "test",
        }
    }

    /// In words.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Implementation => "implementation",
            Self::Proof => "proof",
            Self::Test => "test",
        }
    }
}

/// What a citation of this form stands for in a file; `in_tests` says whether it is in its module of unit tests.
pub(crate) fn of(path: &str, form: Form, in_tests: bool) -> Result<Kind, Mistake> {
    let mut folders = path.split('/');
    match (folders.next(), folders.next(), form) {
        (_, Some("tests"), Form::Comment) => Ok(Kind::Test),
        (Some("proofs"), Some("src"), _) | (Some("model"), Some("src"), Form::Data) => Ok(Kind::Proof),
        // The tables of the editions cite what stands behind their rows.
        (Some("spec"), Some("src"), Form::Data) => Ok(Kind::Implementation),
        // The AI Computers of the closed model and of the virtual bus, and the operator, do what binds these.
        (
            Some("spec" | "ai" | "oracle" | "conform" | "can" | "cli" | "model"),
            Some("src"),
            Form::Comment,
        ) => {
            let only_tests = path.ends_with("/tests.rs");
            Ok(if in_tests || only_tests { Kind::Test } else { Kind::Implementation })
        }
        _ => Err(Mistake::new(
            format!("{} does not count here", form.name()),
            "//= in src of spec, ai, oracle, conform, can, cli or model, or in tests of any crate; `/// Requirements:` in src \
             of proofs; `requirements: &[..]` in src of spec, model or proofs",
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::{Kind, of};
    use crate::scan::Form::{Comment, Data, Doc};

    #[test]
    fn places_have_kinds() {
        for (path, form, in_tests, kind) in [
            ("spec/src/messages/ai.rs", Comment, false, Some(Kind::Implementation)),
            ("model/src/closed/ai.rs", Comment, false, Some(Kind::Implementation)),
            ("can/src/ai/mod.rs", Comment, false, Some(Kind::Implementation)),
            ("model/src/closed/ai.rs", Comment, true, Some(Kind::Test)),
            ("model/src/closed/properties.rs", Data, false, Some(Kind::Proof)),
            ("oracle/src/candump/tests.rs", Comment, false, Some(Kind::Test)),
            ("proofs/src/kani/codec.rs", Doc, false, Some(Kind::Proof)),
            ("proofs/tests/second_opinion/main.rs", Comment, false, Some(Kind::Test)),
            ("tests/tests/figure2.rs", Comment, false, Some(Kind::Test)),
            ("tests/src/world/mod.rs", Comment, false, None),
            ("spec/benches/spec.rs", Comment, false, None),
            ("spec/src/editions/v3_0/figure2.rs", Data, false, Some(Kind::Implementation)),
            ("spec/src/control.rs", Doc, false, None),
            ("tests/tests/figure2.rs", Data, false, None),
        ] {
            assert_eq!(of(path, form, in_tests).ok(), kind, "{path} {form:?}");
        }
    }
}
