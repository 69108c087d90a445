//! Which of the properties of the open model an edition has, and which a state concerns.

use std::sync::LazyLock;

use adsdv_spec::Edition;
use adsdv_spec::messages::AsState;

use crate::document::Document;
use crate::properties::PROPERTIES;
use crate::property::Property;

/// Every property of an edition, in the order of the document.
pub fn properties(edition: &Edition) -> impl Iterator<Item = &'static Property> {
    Property::of_edition(edition).map(|(_, property)| property)
}

impl Property {
    /// The property of this name.
    pub fn find(name: &str) -> Option<&'static Self> {
        PROPERTIES.iter().find(|property| property.name == name)
    }

    /// The properties that an edition has, with their places in [`PROPERTIES`].
    pub(crate) fn of_edition(edition: &Edition) -> impl Iterator<Item = (usize, &'static Self)> {
        PROPERTIES.iter().enumerate().filter(move |(_, property)| (property.holds_in)(edition))
    }

    /// The properties of an edition to which steps from a state can matter, with their places in [`PROPERTIES`].
    pub(crate) fn of(edition: &Edition, state: AsState) -> &'static [(usize, &'static Self)] {
        type ByState = Vec<Vec<(usize, &'static Property)>>;

        static BY_STATE: LazyLock<Vec<ByState>> = LazyLock::new(|| {
            let of = |edition: &&Edition, state| {
                Property::of_edition(edition).filter(move |(_, property)| property.concerns(state)).collect()
            };
            let by_state = |edition| AsState::ALL.iter().map(|&state| of(edition, state)).collect();
            Edition::ALL.iter().map(by_state).collect()
        });
        let of_edition = BY_STATE.get(Document::of(edition).place);
        let place = AsState::ALL.iter().position(|&other| other == state);
        of_edition.and_then(|states| states.get(place?)).map_or(&[], Vec::as_slice)
    }
}
