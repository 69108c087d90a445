//! A difference for people: sections of groups of lines. Text and Markdown print the same of them.

use super::change::{Change, Sides};
use super::devices::DeviceOutline;
use super::difference::{Changed, Difference};
use super::figure2::{Alternative, ArrowChange, ArrowOutline, in_words};
use super::messages::{MessageChange, MessageOutline};
use super::questions::Question;
use super::reserved::Range;

/// A part of the interface of which something differs.
pub(super) struct Section {
    pub(super) title: &'static str,
    /// What the groups are, and what the subjects of their lines are.
    pub(super) kinds: [&'static str; 2],
    pub(super) groups: Vec<Group>,
}

/// A thing of which something differs; without a title where the section is about one thing.
#[derive(Default)]
pub(super) struct Group {
    pub(super) title: String,
    /// What it is, in a sentence.
    pub(super) about: &'static str,
    pub(super) lines: Vec<Line>,
}

/// One difference. What is new has nothing before, and what is gone nothing after.
pub(super) struct Line {
    /// The part of the thing that it is about; empty where it is the thing itself.
    pub(super) subject: String,
    /// The property.
    pub(super) property: String,
    pub(super) from: String,
    pub(super) to: String,
}

/// The sections that have something to say.
pub(super) fn of(difference: &Difference) -> Vec<Section> {
    // Without `..`: a further part has to be printed before this compiles.
    let Changed {
        messages,
        arrows,
        order,
        priorities,
        timing,
        thresholds,
        faults,
        causes,
        reserved,
        devices,
        readings,
    } = &difference.changed;

    let mut by_id: Vec<_> = messages.sides.new.iter().map(|one| (one.id, message(one, Line::new))).collect();
    by_id.extend(messages.sides.gone.iter().map(|one| (one.id, message(one, Line::gone))));
    by_id.extend(messages.changed.iter().map(|one| (one.id, changed_message(one))));
    by_id.sort_by_key(|(id, _)| *id);

    let mut figure: Vec<_> = arrows.sides.new.iter().map(|one| arrow(one, Line::new)).collect();
    figure.extend(arrows.sides.gone.iter().map(|one| arrow(one, Line::gone)));
    figure.extend(arrows.changed.iter().map(changed_arrow));
    figure.extend(order.iter().map(|one| {
        let line = Line::changed(String::new(), "order", one.from.join(", "), one.to.join(", "));
        Group { title: one.state.to_owned(), lines: vec![line], ..Group::default() }
    }));

    let first = sides(priorities, |one| {
        ("evaluated first", format!("{} in {}, if {}", one.first, one.state, one.choice))
    });
    let mut shown = sides(faults, |one| ("fault", format!("{} (cause {})", one.flag, one.cause)));
    shown.extend(sides(causes, |one| ("cause", format!("{} = {}", one.value, one.name))));

    let questions = [("new", &readings.new), ("settled", &readings.settled), ("changed", &readings.changed)];
    let questions = questions.iter().flat_map(|(how, list)| list.iter().map(|one| question(one, how)));

    let sections = [
        Section {
            title: "MESSAGES",
            kinds: ["message", "signal"],
            groups: by_id.into_iter().map(|(_, group)| group).collect(),
        },
        Section { title: "FIGURE 2", kinds: ["arrow", "alternative"], groups: figure },
        Section { title: "PRIORITIES", kinds: ["", "what"], groups: one_group(first) },
        Section { title: "TIMES", kinds: ["", "time"], groups: one_group(numbers(timing)) },
        Section { title: "THRESHOLDS", kinds: ["", "threshold"], groups: one_group(numbers(thresholds)) },
        Section { title: "FAULTS", kinds: ["", "what"], groups: one_group(shown) },
        Section {
            title: "RESERVED IDENTIFIERS",
            kinds: ["", "what"],
            groups: one_group(identifiers(reserved)),
        },
        Section {
            title: "MESSAGES OF THE DEVICES",
            kinds: ["", "message"],
            groups: one_group(of_devices(devices)),
        },
        Section { title: "READINGS", kinds: ["question", ""], groups: questions.collect() },
    ];
    sections.into_iter().filter(|section| !section.groups.is_empty()).collect()
}

impl Line {
    fn new(subject: &str, property: &str, words: String) -> Self {
        Self::changed(subject.to_owned(), property, String::new(), words)
    }

    fn gone(subject: &str, property: &str, words: String) -> Self {
        Self::changed(subject.to_owned(), property, words, String::new())
    }

    fn changed(subject: String, property: &str, from: String, to: String) -> Self {
        Self { subject, property: property.to_owned(), from, to }
    }

    fn of(subject: &str, change: &Change) -> Self {
        let (from, to) = change.words.clone();
        Self::changed(subject.to_owned(), &change.label, from, to)
    }
}

/// A line that says that something is new, or that it is gone.
type OneSided = fn(&str, &str, String) -> Line;

fn title(id: u16, name: &str) -> String {
    format!("{id:03X}h {name}")
}

fn message(one: &MessageOutline, line: OneSided) -> Group {
    let itself = line("", "", one.words.clone());
    let signals = one.signals.iter().map(|signal| line(signal.name, "", signal.words.clone()));
    Group {
        title: title(one.id, one.name),
        lines: std::iter::once(itself).chain(signals).collect(),
        ..Group::default()
    }
}

fn changed_message(one: &MessageChange) -> Group {
    let mut lines: Vec<_> = one.changes.iter().map(|change| Line::of("", change)).collect();
    for signal in &one.signals.changed {
        lines.extend(signal.changes.iter().map(|change| Line::of(signal.name, change)));
    }
    let sides = &one.signals.sides;
    lines.extend(sides.new.iter().map(|signal| Line::new(signal.name, "", signal.words.clone())));
    lines.extend(sides.gone.iter().map(|signal| Line::gone(signal.name, "", signal.words.clone())));
    Group { title: title(one.id, one.name), lines, ..Group::default() }
}

fn arrow(one: &ArrowOutline, line: OneSided) -> Group {
    let section = line("", "section", one.section.to_owned());
    let alternatives = one.alternatives.iter().map(|alternative| line("", "guard", alternative.in_full()));
    Group {
        title: format!("{} -> {}", one.state, one.next),
        lines: std::iter::once(section).chain(alternatives).collect(),
        ..Group::default()
    }
}

fn changed_arrow(one: &ArrowChange) -> Group {
    let mut lines: Vec<_> = one.changes.iter().map(|change| Line::of("", change)).collect();
    let sides = &one.alternatives.sides;
    let in_full = |line: OneSided| move |alternative: &Alternative| line("", "guard", alternative.in_full());
    lines.extend(sides.new.iter().map(in_full(Line::new)));
    lines.extend(sides.gone.iter().map(in_full(Line::gone)));
    for alternative in &one.alternatives.changed {
        let conditions = in_words(&alternative.conditions);
        lines.extend(alternative.changes.iter().map(|change| Line::of(&conditions, change)));
    }
    Group { title: format!("{} -> {}", one.state, one.next), lines, ..Group::default() }
}

/// A line for each thing that is new or gone.
fn sides<T>(sides: &Sides<T>, words: impl Fn(&T) -> (&'static str, String)) -> Vec<Line> {
    let line = |line: OneSided| {
        let words = &words;
        move |one: &T| {
            let (subject, words) = words(one);
            line(subject, "", words)
        }
    };
    sides.new.iter().map(line(Line::new)).chain(sides.gone.iter().map(line(Line::gone))).collect()
}

fn numbers(changes: &[Change]) -> Vec<Line> {
    let line = |change: &Change| {
        let (from, to) = change.words.clone();
        Line::changed(change.label.clone(), "", from, to)
    };
    changes.iter().map(line).collect()
}

fn identifiers(reserved: &Sides<Range>) -> Vec<Line> {
    let line = |line: OneSided, ranges: &[Range]| {
        let words = ranges.iter().map(Range::to_string).collect::<Vec<_>>().join(", ");
        (!ranges.is_empty()).then(|| line("reserved", "", words))
    };
    [line(Line::new, &reserved.new), line(Line::gone, &reserved.gone)].into_iter().flatten().collect()
}

fn of_devices(devices: &Sides<DeviceOutline>) -> Vec<Line> {
    let line = |line: OneSided, one: &DeviceOutline| line(&title(one.id, one.name), "", one.words.clone());
    let new = devices.new.iter().map(|one| line(Line::new, one));
    new.chain(devices.gone.iter().map(|one| line(Line::gone, one))).collect()
}

fn question(one: &Question, how: &str) -> Group {
    let line = |property, from: String, to: String| {
        (from != to).then(|| Line::changed(String::new(), property, from, to))
    };
    let answers = line("answers", one.from.choices.join(", "), one.to.choices.join(", "));
    let default = line("default", one.from.default.to_owned(), one.to.default.to_owned());
    Group {
        title: format!("{} ({how})", one.id),
        about: one.words,
        lines: [answers, default].into_iter().flatten().collect(),
    }
}

fn one_group(lines: Vec<Line>) -> Vec<Group> {
    if lines.is_empty() { Vec::new() } else { vec![Group { lines, ..Group::default() }] }
}
