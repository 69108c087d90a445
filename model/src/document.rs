//! The document that a machine is checked against: the edition of its version, as it was published.
//!
//! Properties and goals never look at the rules of the machine that is checked: a table with a mistake in it must not be able
//! to excuse itself.

use std::sync::LazyLock;

use adsdv_spec::{Atoms, Edition, Machine, Timing};

/// A published edition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Document {
    /// The edition.
    pub edition: &'static Edition,
    /// The conditions that it has: [`Edition::scope`], worked out once.
    pub scope: Atoms,
    /// Its place in [`Edition::ALL`].
    pub(crate) place: usize,
}

static DOCUMENTS: LazyLock<Vec<Document>> = LazyLock::new(|| {
    let all = Edition::ALL.iter().enumerate();
    all.map(|(place, edition)| Document { edition, scope: edition.scope(), place }).collect()
});

impl Document {
    /// The published edition of this version; the default for a version that nobody has published.
    pub fn of(edition: &Edition) -> &'static Self {
        let named = |version| DOCUMENTS.iter().find(|document| document.edition.version == version);
        let document = named(edition.version).or_else(|| named(Edition::DEFAULT.version));
        document.expect("the default is one of all editions")
    }

    /// The times that the AI Computer, the operator and the properties go by.
    pub(crate) const fn timing(&self) -> &'static Timing {
        &self.edition.rules.timing
    }

    /// That of a machine's version.
    pub fn of_machine(machine: &Machine) -> &'static Self {
        Self::of(machine.edition())
    }
}

/// The default edition.
impl Default for &'static Document {
    fn default() -> Self {
        Document::of(Edition::DEFAULT)
    }
}
