//! What the environment chooses in a cycle.

use std::fmt;

use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Atoms, Choice, Control, Fault, Faults, Machine, Observation, Reads};

use super::Promela;
use super::words::{inputs_of, name, one_of};
use crate::vectors::{Vectors, subsets, varied};

/// Writes the cycles that begin in a state: one for each set of inputs that what is remembered lets it read.
pub(super) fn cycles(f: &mut fmt::Formatter<'_>, promela: &Promela<'_>, from: AsState) -> fmt::Result {
    let vectors = promela.vectors;
    let flags = Flag::of(promela.machine);
    let all: Vec<Vec<Flag>> = subsets(&flags).collect();
    let reads = |in_state_ms: u16, set: &[Flag]| {
        let mut control = Control { state: from, in_state_ms, ..Control::INITIAL };
        for flag in set {
            flag.set(&mut control);
        }
        varied(promela.machine, &promela.document, &control, vectors)
    };
    for Span { begin, end } in
        spans(promela, from, |ms| all.iter().map(|set| reads(ms, set)).collect::<Vec<_>>())
    {
        // Only what makes a difference is asked.
        let matters = |flag: &Flag| {
            let without =
                |set: &[Flag]| set.iter().copied().filter(|other| other != flag).collect::<Vec<_>>();
            all.iter().any(|set| reads(begin, set) != reads(begin, &without(set)))
        };
        let asked: Vec<Flag> = flags.iter().copied().filter(matters).collect();
        for set in subsets(&asked) {
            write!(f, "    :: atomic {{\n        state == {from}")?;
            if begin > 0 {
                write!(f, " && in_state_ms >= {begin}")?;
            }
            if let Some(end) = end {
                write!(f, " && in_state_ms < {end}")?;
            }
            for flag in &asked {
                write!(f, " && {}{flag}", if set.contains(flag) { "" } else { "!" })?;
            }
            f.write_str(" ->\n        SHOW_STATE\n")?;
            choices(f, &Chosen::of(promela, reads(begin, &set)))?;
            writeln!(f, "        step_{from}()\n    }}")?;
        }
    }
    Ok(())
}

/// Times in a state between which nothing changes; the last span has no end.
struct Span {
    begin: u16,
    end: Option<u16>,
}

/// The spans of the times in a state in which the same is read.
fn spans<T: PartialEq>(promela: &Promela<'_>, from: AsState, reads: impl Fn(u16) -> T) -> Vec<Span> {
    let timing = &promela.machine.edition().rules.timing;
    let limit = timing.in_state_limit(from);
    let times = (0..limit).step_by(timing.cycle_ms.max(1).into()).chain([limit]);
    let mut spans: Vec<Span> = Vec::new();
    let mut last = None;
    for ms in times {
        let read = reads(ms);
        if last.as_ref() != Some(&read) {
            if let Some(span) = spans.last_mut() {
                span.end = Some(ms);
            }
            spans.push(Span { begin: ms, end: None });
        }
        last = Some(read);
    }
    spans
}

/// A yes or no that a step remembers and that decides what the next one reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Flag {
    GoSeenLow,
    WasRunning,
    WasForward,
    PowerCycleNeeded,
}

impl Flag {
    /// Those that a machine may set.
    fn of(machine: &Machine) -> Vec<Self> {
        let mut flags = vec![Self::GoSeenLow, Self::WasRunning, Self::WasForward];
        if machine.readings().is(Choice::PowerCycleLatched) {
            flags.push(Self::PowerCycleNeeded);
        }
        flags
    }

    fn set(self, control: &mut Control) {
        match self {
            Self::GoSeenLow => control.go_seen_low = true,
            Self::WasRunning => control.was_running = true,
            Self::WasForward => control.was_forward = true,
            Self::PowerCycleNeeded => control.power_cycle_needed = true,
        }
    }
}

impl fmt::Display for Flag {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::GoSeenLow => "go_seen_low",
            Self::WasRunning => "was_running",
            Self::WasForward => "was_forward",
            Self::PowerCycleNeeded => "power_cycle_needed",
        })
    }
}

/// An input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Input {
    Atom(Atom),
    Fault(Fault),
}

impl fmt::Display for Input {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Atom(atom) => f.write_str(&name(*atom)),
            Self::Fault(fault) => f.write_str(fault.flag()),
        }
    }
}

/// Inputs as an observation.
fn observation<'a>(inputs: impl Iterator<Item = &'a Input>) -> Observation {
    let (atoms, faults) = inputs.fold((Atoms::NONE, Faults::NONE), |(atoms, faults), input| match *input {
        Input::Atom(atom) => (atoms.with(atom), faults),
        Input::Fault(fault) => (atoms, faults.with(fault)),
    });
    Observation::new(atoms, faults)
}

/// What is chosen in a cycle.
struct Chosen {
    /// The inputs that there are.
    inputs: Atoms,
    /// What is read.
    reads: Reads,
    vectors: Vectors,
}

impl Chosen {
    fn of(promela: &Promela<'_>, reads: Reads) -> Self {
        Self { inputs: inputs_of(promela.machine), reads, vectors: promela.vectors }
    }

    /// The inputs of which one must be on for this one to be possible; none if it is possible alone.
    fn needs(&self, input: Input) -> Vec<Input> {
        let alone = observation([input].iter()).is_possible();
        let helps = |helper: &Input| !alone && observation([input, *helper].iter()).is_possible();
        self.inputs.iter().map(Input::Atom).filter(helps).collect()
    }

    /// Whether two inputs are never on at once.
    fn exclude(&self, one: Input, other: Input) -> bool {
        let helpers = [one, other].into_iter().flat_map(|input| self.needs(input));
        let both: Vec<Input> = [one, other].into_iter().chain(helpers).collect();
        let both = observation(both.iter());
        !both.is_possible() || self.vectors != Vectors::Every && self.has_several(both)
    }

    /// The faults that open the shutdown circuit and of which only the one with the lowest number counts. That of the battery
    /// counts for itself where it is a condition of its own.
    fn opening(&self) -> Faults {
        let battery = self.reads.atoms.has(Atom::BmsFault);
        if battery { Faults::OPENING.without(Fault::BmsFault) } else { Faults::OPENING }
    }

    /// Whether several of these are present.
    fn has_several(&self, seen: Observation) -> bool {
        seen.faults().intersection(self.opening()).iter().nth(1).is_some()
    }

    /// The inputs that are chosen together, because some exclude others.
    fn groups(&self) -> Vec<Vec<Input>> {
        let atoms = self.reads.atoms.intersection(self.inputs).iter().map(Input::Atom);
        let mut groups: Vec<Vec<Input>> = Vec::new();
        let faults = match self.vectors {
            Vectors::Every | Vectors::Read => self.reads.faults,
            Vectors::Few => self.reads.faults.difference(self.opening().without(Fault::HvilOpenFault)),
        };
        for input in atoms.chain(faults.iter().map(Input::Fault)) {
            let (joined, apart): (Vec<_>, Vec<_>) =
                groups.into_iter().partition(|group| group.iter().any(|&other| self.exclude(input, other)));
            groups = apart;
            groups.push(joined.into_iter().flatten().chain([input]).collect());
        }
        groups
    }

    /// The inputs of a group that can be on together, each such set once.
    fn combinations(&self, group: &[Input]) -> impl Iterator<Item = Vec<Input>> {
        let on = |bits: usize| group.iter().enumerate().filter(move |(place, _)| bits >> place & 1 == 1);
        let all = (0..1_usize << group.len())
            .map(move |bits| on(bits).map(|(_, &input)| input).collect::<Vec<_>>());
        all.filter(move |together| {
            together.iter().all(|&one| together.iter().all(|&other| !self.exclude(one, other)))
        })
    }

    /// One way to choose: these inputs are on.
    fn option(&self, together: &[Input]) -> String {
        let needs = together.iter().map(|&input| self.needs(input)).filter(|needs| !needs.is_empty());
        let guards = needs.map(|needs| format!("{} -> ", one_of(needs.iter().map(Input::to_string))));
        let on: Vec<String> = together.iter().map(|input| format!("{input} = 1")).collect();
        let on = if on.is_empty() { "skip".into() } else { on.join("; ") };
        guards.chain([on]).collect()
    }
}

/// Writes the choice of what is read; everything else is off.
fn choices(f: &mut fmt::Formatter<'_>, chosen: &Chosen) -> fmt::Result {
    let groups = chosen.groups();
    let needed: Vec<Input> = groups.iter().flatten().flat_map(|&input| chosen.needs(input)).collect();
    let is_free =
        |group: &Vec<Input>| group.len() == 1 && group.iter().all(|&input| chosen.needs(input).is_empty());
    let (free, bound): (Vec<_>, Vec<_>) = groups.into_iter().partition(is_free);
    // What others need is chosen before them.
    let (first, free): (Vec<Input>, Vec<Input>) =
        free.into_iter().flatten().partition(|input| needed.contains(input));
    f.write_str("        all_off();\n")?;
    any(f, &first)?;
    for group in bound {
        let options: Vec<String> =
            chosen.combinations(&group).map(|together| chosen.option(&together)).collect();
        writeln!(f, "        if :: {} fi;", options.join("\n           :: "))?;
    }
    any(f, &free)
}

/// Writes the choice of inputs that have nothing to do with each other.
fn any(f: &mut fmt::Formatter<'_>, free: &[Input]) -> fmt::Result {
    for some in free.rchunks(AT_ONCE).rev() {
        let names: Vec<String> = some.iter().map(Input::to_string).collect();
        writeln!(f, "        any_of_{}({});", some.len(), names.join(", "))?;
    }
    Ok(())
}

/// How many inputs are chosen at once.
const AT_ONCE: usize = 3;

/// Writes what choices are made of.
pub(super) fn inlines(f: &mut fmt::Formatter<'_>, machine: &Machine) -> fmt::Result {
    f.write_str("/* A choice: everything is off, but for what is chosen. */\ninline all_off() {\n")?;
    let inputs =
        inputs_of(machine).iter().map(Input::Atom).chain(Observation::FAULTS.iter().map(Input::Fault));
    let off: Vec<_> = inputs.map(|input| format!("{input} = 0")).collect();
    let lines: Vec<_> = off.chunks(PER_LINE).map(|some| format!("    {}", some.join("; "))).collect();
    writeln!(f, "{}\n}}\n{ANY_OF}", lines.join(";\n"))
}

/// How many assignments stand in a line.
const PER_LINE: usize = 5;

/// Of these, any: one choice of eight is faster than three choices of two.
const ANY_OF: &str = "#define any_of_1(a) if :: skip :: a = 1 fi
#define any_of_2(a, b) if :: skip :: a = 1 :: b = 1 :: a = 1; b = 1 fi
#define any_of_3(a, b, c) \\
    if :: skip :: a = 1 :: b = 1 :: c = 1 :: a = 1; b = 1 :: a = 1; c = 1 :: b = 1; c = 1 :: a = 1; b = 1; c = 1 fi
";
