//! Every message that is known: those of the edition, and those of the user's own databases beside them.

use std::collections::HashMap;

use adsdv_oracle::candump::FrameKind;
use adsdv_spec::Edition;

use crate::dbc::Database;
use crate::{Message, Origin, edition};

/// The identifiers of 11 bits.
const STANDARD: usize = 0x800;

/// Every message that is known, found by what a frame has.
#[derive(Clone, Debug)]
pub struct Catalog {
    edition: &'static Edition,
    messages: Vec<Message>,
    /// Where the message of each identifier of 11 bits is.
    standard: Box<[Option<u16>]>,
    /// Where those of 29 bits are.
    extended: HashMap<u32, u16>,
    notes: Vec<String>,
}

impl Catalog {
    /// The messages of an edition.
    pub fn of(edition: &'static Edition) -> Self {
        Self::with(edition, &[])
    }

    /// The messages of an edition, and beside them those of other databases. An identifier that the edition has is the edition's, and
    /// one that several databases have is that of the first; [`Catalog::notes`] say where that was so.
    pub fn with(edition: &'static Edition, databases: &[Database]) -> Self {
        let mut catalog = Self {
            edition,
            messages: Vec::new(),
            standard: vec![None; STANDARD].into(),
            extended: HashMap::new(),
            notes: Vec::new(),
        };
        for message in edition::messages(edition) {
            catalog.add(message);
        }
        for (place, database) in databases.iter().enumerate() {
            let (mut of_edition, mut of_another) = (Vec::new(), Vec::new());
            for message in &database.messages {
                let message = Message { origin: Origin::Database(place), ..message.clone() };
                match catalog.taken(&message).map(|other| other.origin) {
                    None => catalog.add(message),
                    Some(Origin::Edition) => of_edition.push(message),
                    Some(Origin::Database(_)) => of_another.push(message),
                }
            }
            let whose = format!("of the edition {}", edition.version);
            catalog.note(&database.name, &of_edition, &whose);
            catalog.note(&database.name, &of_another, "of another database, or stand there twice");
        }
        catalog
    }

    fn add(&mut self, message: Message) {
        // A database of more messages than this is refused when it is read.
        let Ok(place) = u16::try_from(self.messages.len()) else { return };
        if message.extended {
            self.extended.insert(message.id, place);
        } else if let Some(entry) = self.standard.get_mut(message.id as usize) {
            *entry = Some(place);
        }
        self.messages.push(message);
    }

    /// The message that has the same identifier.
    fn taken(&self, message: &Message) -> Option<&Message> {
        self.at(message.extended, message.id)
    }

    fn at(&self, extended: bool, id: u32) -> Option<&Message> {
        let place = if extended { self.extended.get(&id) } else { self.standard.get(id as usize)?.as_ref() };
        self.messages.get(usize::from(*place?))
    }

    fn note(&mut self, database: &str, left_out: &[Message], whose: &str) {
        const LISTED: usize = 5;
        if left_out.is_empty() {
            return;
        }
        let listed: Vec<_> = left_out.iter().take(LISTED).map(Message::id_text).collect();
        let more = left_out.len().saturating_sub(LISTED);
        let more = if more == 0 { String::new() } else { format!(" and {more} more") };
        self.notes.push(format!(
            "{database}: these identifiers are {whose}, which counts: {}{more}",
            listed.join(", ")
        ));
    }

    /// The edition.
    pub const fn edition(&self) -> &'static Edition {
        self.edition
    }

    /// Every message, those of the edition first.
    pub fn messages(&self) -> &[Message] {
        &self.messages
    }

    /// The message with this name; the edition's, if another database has one of that name as well.
    pub fn named(&self, name: &str) -> Option<&Message> {
        self.messages.iter().find(|message| &*message.name == name)
    }

    /// The place among the messages of the one that a frame of this kind and identifier is of.
    #[inline]
    pub fn place(&self, kind: FrameKind, id: u32) -> Option<usize> {
        let place = match kind {
            FrameKind::Standard | FrameKind::Fd { extended: false, .. } => {
                (*self.standard.get(id as usize)?)?
            }
            FrameKind::Extended | FrameKind::Fd { extended: true, .. } => *self.extended.get(&id)?,
            FrameKind::Remote { .. } | FrameKind::Error | FrameKind::Xl => return None,
        };
        let place = usize::from(place);
        self.messages.get(place).filter(|message| message.is_of(kind, id)).map(|_| place)
    }

    /// What was left out of other databases, and why, a sentence each.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }
}
