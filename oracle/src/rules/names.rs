//! Which signal or condition a name means in an edition.
//!
//! The tables of the editions have all names. A signal is known by its name in the CAN database, by the field that carries it,
//! which is the same in all editions, and by what another edition calls it.

use adsdv_spec::messages::{MessageDef, SignalDef};
use adsdv_spec::{Atom, Edition};

/// The error lists so many names where one is not known.
const NEAR: usize = 6;

/// A signal in its message.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SignalPlace {
    pub(super) message: &'static MessageDef,
    pub(super) signal: &'static SignalDef,
}

/// Why a name is that of no signal.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum NoSignal {
    /// No edition has it: [`unknown`] says what is like it.
    Unknown,
    Other(String),
}

/// Whether a word means on or off.
pub(super) fn switch(word: &str) -> Option<bool> {
    let is = |words: [&str; 2]| words.iter().any(|one| one.eq_ignore_ascii_case(word));
    if is(["on", "true"]) {
        Some(true)
    } else if is(["off", "false"]) {
        Some(false)
    } else {
        None
    }
}

/// The condition of this name. One whose name ends in `-on` goes without that, too.
pub(super) fn atom(name: &str) -> Option<Atom> {
    let is = |atom: &&Atom| {
        let id = atom.id();
        let short = id.strip_suffix("-on").unwrap_or(id);
        [id, short].iter().any(|known| known.eq_ignore_ascii_case(name))
    };
    Atom::ALL.iter().find(is).copied()
}

/// The signal of this name, in this message if one is named; or what is wrong.
pub(super) fn signal(edition: &Edition, message: Option<&str>, name: &str) -> Result<SignalPlace, NoSignal> {
    let mut found: Vec<SignalPlace> = of_name(edition, message, name).collect();
    let mut elsewhere = Vec::new();
    if found.is_empty() {
        for other in Edition::ALL.iter().filter(|other| other.version != edition.version) {
            for place in of_name(other, message, name) {
                elsewhere.push(other.version);
                found.extend(same(edition, place).filter(|own| !found.contains(own)));
            }
        }
    }
    match (&found[..], &elsewhere[..]) {
        ([place], _) => Ok(*place),
        ([], []) => Err(NoSignal::Unknown),
        ([], _) => {
            elsewhere.dedup();
            let version = edition.version;
            Err(NoSignal::Other(format!(
                "found {name:?}, and edition {version} has no such signal; expected one that it has, or the edition that has this: {}",
                elsewhere.join(", ")
            )))
        }
        (several, _) => {
            let all = several.iter().map(|place| format!("{}.{}", place.message.name, place.signal.name));
            let all: Vec<String> = all.collect();
            Err(NoSignal::Other(format!(
                "found {name:?}, which is a signal of several messages; expected one of {}",
                all.join(", ")
            )))
        }
    }
}

/// The signals of an edition that a name may mean.
fn of_name<'a>(
    edition: &'a Edition,
    message: Option<&'a str>,
    name: &'a str,
) -> impl Iterator<Item = SignalPlace> + 'a {
    let messages = edition.bus.messages.iter().copied();
    let messages = messages.filter(move |known| message.is_none_or(|message| is_message(known, message)));
    messages.flat_map(move |message| {
        let meant = |signal: &&SignalDef| {
            [signal.name, signal.field].iter().any(|known| known.eq_ignore_ascii_case(name))
        };
        message.signals.iter().filter(meant).map(move |signal| SignalPlace { message, signal })
    })
}

/// Whether a message is known by this name, or by this identifier, such as `510h`; in any edition.
fn is_message(message: &MessageDef, name: &str) -> bool {
    let named = |edition: &Edition| {
        edition.bus.message(message.id).is_some_and(|known| known.name.eq_ignore_ascii_case(name))
    };
    format!("{:03X}h", message.id).eq_ignore_ascii_case(name)
        || Edition::ALL.iter().any(|edition| named(edition))
}

/// What an edition calls a signal of another one.
fn same(edition: &Edition, place: SignalPlace) -> Option<SignalPlace> {
    let message = edition.bus.message(place.message.id)?;
    Some(SignalPlace { message, signal: message.signal_of(place.signal.field)? })
}

/// Nothing in these editions has this name: what is wrong, with the names that are most like it. That takes its time.
pub(super) fn unknown(editions: &[&Edition], message: Option<&str>, name: &str) -> String {
    let of = match editions {
        [one] => format!("edition {}", one.version),
        _ => "any edition".to_owned(),
    };
    let messages = editions.iter().flat_map(|edition| edition.bus.messages).copied();
    let in_message = |known: &&MessageDef| message.is_none_or(|message| is_message(known, message));
    let within: Vec<&MessageDef> = messages.clone().filter(in_message).collect();
    if let (Some(message), true) = (message, within.is_empty()) {
        let near = nearest(message, messages.map(|message| message.name).collect());
        return format!("found {message:?}, which is no message of {of}; expected {near}");
    }
    let signals = within.iter().flat_map(|message| message.signals).map(|signal| signal.name);
    let conditions = Atom::ALL.iter().map(|atom| atom.id()).filter(|_| message.is_none());
    let near = nearest(name, signals.chain(conditions).collect());
    format!("found {name:?}, which is no signal and no condition of {of}; expected {near}")
}

/// Those of the names that are most like this one, for an error.
pub(super) fn nearest(given: &str, mut names: Vec<&str>) -> String {
    let given = given.to_ascii_lowercase();
    let unlike = |name: &str| {
        let name = name.to_ascii_lowercase();
        // Somebody who leaves a part of a name out means it.
        let part = given.len() > 2 && name.contains(&given);
        (!part && distance(&given, &name) > 2, distance(&given, &name))
    };
    names.sort_unstable();
    names.dedup();
    names.sort_by_key(|name| unlike(name));
    let alike = names.iter().filter(|name| !unlike(name).0).count();
    let shown: Vec<&str> = names.into_iter().take(alike.clamp(3, NEAR)).collect();
    match &shown[..] {
        [] => "another".to_owned(),
        [one] => (*one).to_owned(),
        [first @ .., last] => format!("{} or {last}, or another", first.join(", ")),
    }
}

/// How many characters have to be put in, left out or changed.
fn distance(one: &str, other: &str) -> usize {
    let other: Vec<char> = other.chars().take(super::limits::CHARACTERS).collect();
    let mut row: Vec<usize> = (0..=other.len()).collect();
    for (place, character) in one.chars().enumerate() {
        let mut before = std::mem::replace(&mut row[0], place + 1);
        for (column, there) in other.iter().enumerate() {
            let above = row[column + 1];
            let least = before + usize::from(character != *there);
            row[column + 1] = least.min(above + 1).min(row[column] + 1);
            before = above;
        }
    }
    row.last().copied().unwrap_or_default()
}
