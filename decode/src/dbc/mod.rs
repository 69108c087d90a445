//! Databases of the user's own (DBC), read by the crate `can-dbc`: what it gives is checked, and becomes messages.
//!
//! A team has devices of its own on the bus. What their database says is believed about their frames, and nothing of it is judged. It
//! may come from anywhere, so that it has limits, and what no frame can have is refused with its line.

mod convert;
mod error;
mod lines;

pub use error::DbcError;

use std::collections::HashSet;

use crate::Message;
use lines::Lines;

/// The longest database that is read, in bytes. Those of whole vehicles have a few megabytes.
pub const MAX_DBC: usize = 16 * 1024 * 1024;

/// The most messages of one.
const MAX_MESSAGES: usize = 20_000;

/// The message that holds the signals that are of none.
const NO_MESSAGE: &str = "VECTOR__INDEPENDENT_SIG_MSG";

/// A database of the user's own.
#[derive(Clone, Debug)]
pub struct Database {
    /// What notes call it: the name of its file.
    pub name: String,
    /// Its messages.
    pub messages: Vec<Message>,
}

impl Database {
    /// Reads one; `name` is what notes call it. Text that is not UTF-8 is read as Windows-1252, as Vector's tools write it.
    ///
    /// ```
    /// use adsdv_decode::Database;
    ///
    /// let text = b"BO_ 1536 Logger: 2 TEAM\n SG_ Volts : 0|16@1+ (0.01,0) [0|60] \"V\" AI\n";
    /// let database = Database::read("team.dbc", text)?;
    /// assert_eq!(database.messages[0].readings(&[0xB0, 0x04]).next().unwrap().value().to_f64(), 12.0);
    ///
    /// let error = Database::read("team.dbc", b"BO_ 1536 Logger 2 TEAM\n").unwrap_err();
    /// assert_eq!(error.line, Some(1));
    /// # Ok::<(), adsdv_decode::DbcError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Fails if the text is no database, and says in which line.
    pub fn read(name: &str, text: &[u8]) -> Result<Self, DbcError> {
        if text.len() > MAX_DBC {
            return Err(DbcError::of_all("it is longer than 16 MiB"));
        }
        let text = match str::from_utf8(text) {
            Ok(text) => text.strip_prefix('\u{feff}').unwrap_or(text).to_owned(),
            Err(_) => can_dbc::decode_cp1252(text)
                .ok_or_else(|| DbcError::of_all("it is neither UTF-8 nor Windows-1252"))?
                .into_owned(),
        };
        let lines = Lines::of(&text);
        if lines.is_empty() {
            return Err(DbcError::of_all("it has no message: no line begins with BO_"));
        }
        if lines.len() > MAX_MESSAGES {
            return Err(DbcError::of_all("it has more than 20000 messages"));
        }
        let parsed = can_dbc::Dbc::try_from(text.as_str()).map_err(|error| DbcError::parse(&text, &error))?;
        let tables = convert::Tables::of(&parsed);
        let mut messages = Vec::with_capacity(parsed.messages.len());
        for (message, place) in parsed.messages.iter().zip(0..) {
            if message.name != NO_MESSAGE {
                messages.push(convert::message(message, &tables, &lines.of_message(place))?);
            }
        }
        let mut names = HashSet::new();
        messages
            .retain(|message: &Message| names.insert((message.extended, message.id, message.name.clone())));
        Ok(Self { name: name.to_owned(), messages })
    }
}
