//! What the frames show, and which editions it fits.

use adsdv_spec::messages::{MessageDef, Node};

use super::devices::Devices;
use super::fact::{Fact, weight};
use super::seen::{EditionFit, FrameStats, LONGEST};

/// A message is missed after so many of its cycles.
const CYCLES: i64 = 10;

/// Cycles that differ by less than this factor are the same to a sender that is late, and to a recorder that loses frames.
const CYCLE_FACTOR: i64 = 3;

/// Everything that was seen and does not fit every edition.
pub(super) fn facts(seen: &[(u16, FrameStats)], devices: &Devices) -> Vec<Fact> {
    let mut facts: Vec<Fact> = devices.fact().into_iter().collect();
    for (id, one) in seen {
        if one.count() == 0 {
            facts.extend(absent(*id, one, seen));
            continue;
        }
        facts.push(present(*id, one));
        lengths(*id, one, &mut facts);
        facts.extend(bits(*id, one));
        facts.extend(values(*id, one));
        facts.extend(cycle(*id, one));
    }
    facts.retain(|fact| fact.instead.iter().any(Option::is_some));
    facts
}

impl Fact {
    /// Whether some edition fits and another does not.
    pub(super) fn tells(&self) -> bool {
        self.instead.iter().any(Option::is_some) && self.instead.iter().any(Option::is_none)
    }

    /// Whether it does not fit the edition at this place.
    pub(super) fn is_against(&self, place: usize) -> bool {
        matches!(self.instead.get(place), Some(Some(_)))
    }
}

/// What each edition that has the message says of it instead.
fn instead(seen: &FrameStats, of: impl Fn(&'static MessageDef) -> Option<String>) -> Vec<Option<String>> {
    seen.editions.iter().map(|said| said.message.and_then(&of)).collect()
}

fn sender(seen: &FrameStats) -> Option<Node> {
    seen.editions.iter().find_map(|said| said.message.map(|message| message.sender))
}

fn present(id: u16, seen: &FrameStats) -> Fact {
    let no = |said: &EditionFit| said.message.is_none().then(|| "no such message".to_owned());
    let instead = seen.editions.iter().map(no).collect();
    Fact { text: format!("{id:03X}h is there"), instead, weight: weight::PRESENT }
}

/// A message that only some editions have, and that should have come: others of its sender did.
fn absent(id: u16, one: &FrameStats, seen: &[(u16, FrameStats)]) -> Option<Fact> {
    let node = sender(one)?;
    let heard_ms = seen
        .iter()
        .filter(|(_, other)| sender(other) == Some(node))
        .map(|(_, other)| other.lasted_ms())
        .max()
        .unwrap_or(0);
    let missed = instead(one, |message| {
        let cycle = i64::from(message.cycle_ms);
        (heard_ms >= cycle * CYCLES).then(|| format!("every {cycle} ms"))
    });
    let fact = Fact { text: format!("{id:03X}h is absent"), instead: missed, weight: weight::ABSENT };
    fact.tells().then_some(fact)
}

/// The length of most frames, and those of others.
fn lengths(id: u16, seen: &FrameStats, facts: &mut Vec<Fact>) {
    let other_than = |len: usize| {
        instead(seen, move |message| (usize::from(message.len) != len).then(|| message.len.to_string()))
    };
    let Some(most) = (0..=LONGEST).max_by_key(|&len| seen.lens.get(len)) else { return };
    let weight = if sender(seen) == Some(Node::Vcu) { weight::LENGTH_OF_VCU } else { weight::LENGTH_OF_AI };
    facts.push(Fact { text: format!("{id:03X}h has {most} bytes"), instead: other_than(most), weight });
    for (len, count) in (0..).zip(seen.lens).filter(|&(len, count)| len != most && count > 0) {
        let text = format!("{count} of {} frames {id:03X}h have {len} bytes", seen.count());
        facts.push(Fact { text, instead: other_than(len), weight: weight::ALSO });
    }
}

/// Bits that are used, and that only some editions have signals for.
fn bits(id: u16, seen: &FrameStats) -> Option<Fact> {
    let used = |message: &'static MessageDef| {
        message.signals.iter().filter(|signal| mask(signal.start, signal.width) & seen.bits != 0)
    };
    let known = |message: &'static MessageDef| {
        used(message).fold(0, |known, signal| known | mask(signal.start, signal.width) & seen.bits)
    };
    let all = seen.editions.iter().filter_map(|said| said.message).fold(0, |all, one| all | known(one));
    let instead = instead(seen, |message| (known(message) != all).then(|| "no signal there".to_owned()));
    let place = instead.iter().position(Option::is_some)?;
    let lacking = seen.editions.get(place)?;
    let new = all & !lacking.message.map_or(0, known);
    let names: Vec<&str> = seen
        .editions
        .iter()
        .filter_map(|said| said.message)
        .find(|message| known(message) & new != 0)
        .map(|message| {
            used(message).filter(|signal| mask(signal.start, signal.width) & new != 0).map(|s| s.name)
        })?
        .collect();
    let text = format!("{id:03X}h uses {}", names.join(" and "));
    Some(Fact { text, instead, weight: weight::BITS })
}

const fn mask(start: u8, width: u8) -> u64 {
    if width == 0 || start >= 64 {
        0
    } else {
        (u64::MAX >> (64 - if width > 64 { 64 } else { width })) << start
    }
}

/// A value that some editions allow and others do not.
fn values(id: u16, seen: &FrameStats) -> Option<Fact> {
    let (signal, raw) = seen.editions.iter().find_map(|said| said.refused)?;
    let refused = |said: &EditionFit| {
        let same = said.message?.signal_of(signal.field)?;
        (!same.allows(raw)).then(|| format!("{} to {}", same.min, same.max))
    };
    let instead: Vec<Option<String>> = seen.editions.iter().map(refused).collect();
    let allows = |said: &EditionFit| {
        said.message.and_then(|message| message.signal_of(signal.field)).is_some_and(|same| same.allows(raw))
    };
    let text = format!("{} of {id:03X}h is {raw}", signal.name);
    // Where no edition allows it, it tells nothing.
    seen.editions.iter().any(allows).then_some(Fact { text, instead, weight: weight::VALUE })
}

fn cycle(id: u16, seen: &FrameStats) -> Option<Fact> {
    let ms = seen.cycle_ms()?;
    let instead = instead(seen, |message| {
        let expected = i64::from(message.cycle_ms);
        let same = ms < expected * CYCLE_FACTOR && expected < ms.saturating_mul(CYCLE_FACTOR);
        (!same).then(|| format!("every {expected} ms"))
    });
    let fact = Fact { text: format!("{id:03X}h comes every {ms} ms"), instead, weight: weight::CYCLE };
    fact.tells().then_some(fact)
}
