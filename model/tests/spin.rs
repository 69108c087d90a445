//! Spin, which shares no code with stateright, explores the same machine, written as a Promela model, and finds the same:
//! the same control states, the same steps, the same properties violated, the same goals reached.
//!
//! Where Spin or a C compiler is not installed, the tests say so and pass. With `ADSDV_REQUIRE_SPIN` set they fail there.

use std::collections::{BTreeSet, HashSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::thread;

use adsdv_model::{Options, Promela, Vectors, explore_quietly, goals, properties, reachable, state_machines};
use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::mutation::Change;
use adsdv_spec::{
    AsState, Atoms, Choice, Control, Edition, Fault, Faults, Handshake, Machine, Mutation, Observation,
    Readings, Timing,
};

/// Timers short enough for dozens of explorations, and longer than the handshake's, so that everything that can happen
/// while the real ones run can happen while these do.
fn short(edition: &Edition) -> Edition {
    let Timing { handshake_ms, cycle_ms, .. } = edition.rules.timing;
    let (ready_dwell_ms, ebs_timer_ms) = (handshake_ms + cycle_ms, handshake_ms + 2 * cycle_ms);
    edition.with_timing(Timing { ready_dwell_ms, ebs_timer_ms, ..edition.rules.timing })
}

/// A step of both.
const CYCLE_MS: u32 = Edition::DEFAULT.rules.timing.cycle_ms as u32;

/// What is explored.
struct Subject {
    name: String,
    machine: Machine,
    document: Timing,
    vectors: Vectors,
}

/// What an exploration found.
#[derive(Debug, PartialEq, Eq)]
struct Found {
    /// The control states, each as its fields.
    states: HashSet<[u16; 10]>,
    /// How many there are.
    stored: u64,
    /// How many steps lead out of them.
    steps: u64,
    /// The properties that are violated and the goals that are reached.
    results: BTreeSet<String>,
}

/// An edition with short timers and a choice.
fn subject(edition: &Edition, choice: Option<Choice>, vectors: Vectors) -> Subject {
    let readings = choice.into_iter().fold(edition.readings, Readings::with);
    let (short, choice) = (short(edition), choice.map_or(String::new(), |choice| format!(", {choice}")));
    Subject {
        name: format!("{}{choice}, with {vectors:?}", edition.version),
        machine: Machine::new(short, readings),
        document: short.rules.timing,
        vectors,
    }
}

#[test]
fn spin_finds_the_same_in_the_reference() {
    let vectors = [Vectors::Every, Vectors::Read, Vectors::Few];
    check(vectors.map(|vectors| subject(Edition::DEFAULT, None, vectors)));
}

/// That all vectors are the same is tried of the default edition, and takes longest.
#[test]
fn spin_finds_the_same_in_each_edition() {
    let others = state_machines().filter(|edition| edition.version != Edition::DEFAULT.version);
    check(
        others
            .flat_map(|edition| [Vectors::Read, Vectors::Few].map(|vectors| subject(edition, None, vectors))),
    );
}

#[test]
fn spin_finds_the_same_with_the_times_of_the_document() {
    check(state_machines().map(|edition| Subject {
        name: format!("{} with its own times", edition.version),
        machine: Machine::new(*edition, edition.readings),
        document: edition.rules.timing,
        vectors: Vectors::Read,
    }));
}

/// Of a later edition, those that the default does not have, or has otherwise.
#[test]
fn spin_finds_the_same_in_every_reading() {
    let news = |edition: &Edition, choice: &Choice| {
        edition.version == Edition::DEFAULT.version || !Edition::DEFAULT.alternatives().has(*choice)
    };
    check(state_machines().flat_map(|edition| {
        let alternatives = edition.alternatives();
        let choices: Vec<Choice> = alternatives.iter().filter(|choice| news(edition, choice)).collect();
        choices
            .into_iter()
            .map(move |choice| subject(edition, Some(choice), thorough(Vectors::Read, Vectors::Few)))
    }));
}

/// Set where everything here is tried of more: the nightly workflow does. Each mutant and each reading is a program to compile,
/// and minutes of `cargo test` would go by with them.
const THOROUGH: &str = "ADSDV_THOROUGH_SPIN";

fn thorough<T>(more: T, usual: T) -> T {
    if std::env::var_os(THOROUGH).is_some() { more } else { usual }
}

/// Only one mutant of so many is tried, and all that concern the order or a time; of a later edition, fewer.
fn one_mutant_in() -> usize {
    thorough(12, 60)
}

#[test]
fn spin_finds_the_same_in_mutants() {
    check(state_machines().flat_map(|edition| {
        let (short, default) = (short(edition), edition.version == Edition::DEFAULT.version);
        let is_tried = move |&(place, mutation): &(usize, Mutation)| {
            let all = default && matches!(mutation.change, Change::RowFirst(_) | Change::Time(..));
            all || place % (if default { one_mutant_in() } else { 4 * one_mutant_in() }) == 0
        };
        let tried: Vec<_> = Mutation::all(&short).enumerate().filter(is_tried).collect();
        tried.into_iter().map(move |(_, mutation)| Subject {
            name: format!("{}: {mutation}", edition.version),
            machine: Machine::new(mutation.apply(&short), edition.readings),
            document: short.rules.timing,
            vectors: Vectors::Read,
        })
    }));
}

#[test]
fn promela_names_everything_that_it_prints() {
    for edition in Edition::ALL {
        let violated = properties(edition).map(|property| format!("violated: {}", property.name));
        let reached = goals(edition).iter().map(|goal| format!("reached: {}", goal.name));
        let machine = Machine::new(**edition, edition.readings);
        let promela = Promela { machine: &machine, document: edition.rules.timing, vectors: Vectors::Read };
        let text = promela.to_string();
        let checks = text.split("FOUND(").skip(1);
        let results = checks.filter_map(|check| check.lines().next()?.split('"').nth(1)).map(String::from);
        let (results, names): (BTreeSet<_>, BTreeSet<_>) =
            (results.collect(), violated.chain(reached).collect());
        assert_eq!(results, names, "{}", edition.version);
    }
}

/// Lets both explore all of these, as many at a time as there are cores.
fn check(subjects: impl IntoIterator<Item = Subject>) {
    let Some(tools) = Tools::find() else { return };
    let queue = Mutex::new(subjects.into_iter().enumerate().collect::<Vec<_>>());
    let workers = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().unwrap().pop();
                    let Some((place, subject)) = next else { break };
                    subject.compare(&tools, place);
                }
            });
        }
    });
}

impl Subject {
    fn compare(&self, tools: &Tools, place: usize) {
        let (spin, stateright) = (self.spin(tools, place), self.stateright());
        let name = &self.name;
        assert_eq!(
            spin.results, stateright.results,
            "{name}: what is violated and reached, by Spin and by stateright"
        );
        assert_eq!(spin.stored, stateright.stored, "{name}: the number of control states");
        assert_eq!(spin.steps, stateright.steps, "{name}: the number of steps");
        let only_spin: Vec<_> = spin.states.difference(&stateright.states).take(3).collect();
        let only_stateright: Vec<_> = stateright.states.difference(&spin.states).take(3).collect();
        assert!(only_spin.is_empty(), "{name}: only Spin reaches {only_spin:?}");
        assert!(only_stateright.is_empty(), "{name}: only stateright reaches {only_stateright:?}");
        assert_eq!(
            spin.states.len() as u64,
            spin.stored,
            "{name}: Spin stores control states and nothing else"
        );
    }

    /// Whether each step is compared by itself, which only so many allow.
    fn shows_steps(&self) -> bool {
        self.vectors != Vectors::Every && self.machine.edition().rules.timing.ebs_timer_ms < 1000
    }

    /// What Spin makes of one step is what the machine makes of it.
    fn compare_step(&self, shown: &str) {
        let numbers: Vec<u32> = shown.split(' ').map(|number| number.parse().unwrap()).collect();
        let (before, rest) = numbers.split_first_chunk::<10>().unwrap();
        let ([atoms, faults], after) = rest.split_first_chunk::<2>().unwrap();
        let atoms = Atoms::from_bits(*atoms).unwrap();
        let faults = Faults::from_bits(u16::try_from(*faults).unwrap()).unwrap();
        let seen = Observation::new(atoms, faults);
        let reaction = self.machine.react(&control(*before), seen, CYCLE_MS);
        assert_eq!(
            fields(&reaction.control).map(u32::from),
            after,
            "{}: {before:?} sees {seen:?}",
            self.name
        );
    }

    fn stateright(&self) -> Found {
        let options =
            Options { vectors: self.vectors, threads: 1, document: self.document, ..Options::default() };
        let exploration = explore_quietly(&self.machine, &options);
        assert!(exploration.complete, "{}", self.name);
        let violated = exploration.broken.iter().map(|property| format!("violated: {}", property.name));
        let reached = goals(self.machine.edition()).iter().filter(|goal| !exploration.missed.contains(goal));
        Found {
            states: self.states(),
            stored: exploration.states,
            steps: exploration.transitions,
            results: violated.chain(reached.map(|goal| format!("reached: {}", goal.name))).collect(),
        }
    }

    /// Every control state that can be reached.
    fn states(&self) -> HashSet<[u16; 10]> {
        reachable(&self.machine, self.document, self.vectors).iter().map(fields).collect()
    }

    fn spin(&self, tools: &Tools, place: usize) -> Found {
        let dir = Scratch::new(place);
        let promela = Promela { machine: &self.machine, document: self.document, vectors: self.vectors };
        fs::write(dir.path("vcu.pml"), promela.to_string()).unwrap();
        let steps = if self.shows_steps() { "-DSTEPS" } else { "-DNO_STEPS" };
        run(Command::new(&tools.spin).args(["-DSTATES", steps, "-a", "vcu.pml"]), &dir);
        run(
            Command::new(&tools.cc).args(["-O0", "-DSAFETY", "-DNOREDUCE", "-DNOCOMP", "-o", "pan", "pan.c"]),
            &dir,
        );
        let output = run(Command::new(dir.path("pan")).args(["-m100000", "-w18"]), &dir);
        for stopped in ["error:", "max search depth too small", "Warning"] {
            assert!(!output.contains(stopped), "{}: pan stopped early:\n{}", self.name, tail(&output));
        }
        let stored = number(&output, " states, stored");
        // The initial state, and a power cycle from every other state.
        let steps = number(&output, " transitions (= stored+matched)") - stored;
        let lines = output.lines();
        let shown = lines.clone().filter_map(|line| line.strip_prefix("step: "));
        let as_many = shown.map(|step| self.compare_step(step)).count() as u64;
        assert!(
            !self.shows_steps() || as_many == steps,
            "{}: {as_many} of {steps} steps were shown",
            self.name
        );
        Found {
            states: lines.clone().filter_map(|line| line.strip_prefix("state: ")).map(parse).collect(),
            stored,
            steps,
            results: lines
                .filter(|line| line.starts_with("violated: ") || line.starts_with("reached: "))
                .map(String::from)
                .collect(),
        }
    }
}

/// The fields of a control state, in the order in which the Promela model prints them.
fn fields(control: &Control) -> [u16; 10] {
    let Control {
        state,
        in_state_ms,
        go_seen_low,
        was_running,
        was_forward,
        handshake,
        power_cycle_needed,
        shutdown_cause,
    } = *control;
    [
        state as u16,
        in_state_ms,
        go_seen_low.into(),
        was_running.into(),
        was_forward.into(),
        handshake.active.into(),
        handshake.bit.into(),
        handshake.unanswered_ms,
        power_cycle_needed.into(),
        shutdown_cause as u16,
    ]
}

/// The control state with these fields.
fn control(fields: [u32; 10]) -> Control {
    let [state, in_state_ms, go, running, forward, active, bit, unanswered_ms, needed, cause] = fields;
    let cause = Fault::ALL.iter().map(|fault| fault.cause()).find(|&named| named as u32 == cause);
    Control {
        state: AsState::ALL.into_iter().find(|&named| named as u32 == state).unwrap(),
        in_state_ms: in_state_ms.try_into().unwrap(),
        go_seen_low: go == 1,
        was_running: running == 1,
        was_forward: forward == 1,
        handshake: Handshake {
            active: active == 1,
            bit: bit == 1,
            unanswered_ms: unanswered_ms.try_into().unwrap(),
        },
        power_cycle_needed: needed == 1,
        shutdown_cause: cause.unwrap_or(ShutdownCause::NoShutdown),
    }
}

fn parse(state: &str) -> [u16; 10] {
    let fields: Vec<u16> = state.split(' ').map(|field| field.parse().unwrap()).collect();
    fields.try_into().unwrap()
}

/// The number before these words, of which pan prints eight digits.
fn number(output: &str, words: &str) -> u64 {
    let number = output.lines().find_map(|line| line.strip_suffix(words)).map(str::trim);
    let number = number.unwrap_or_else(|| panic!("no {words:?}:\n{}", tail(output)));
    number.parse().unwrap_or_else(|_| panic!("{number}{words}: more than pan prints exactly"))
}

fn tail(output: &str) -> String {
    let lines: Vec<&str> =
        output.lines().filter(|line| !line.starts_with("state: ") && !line.starts_with("step: ")).collect();
    lines.join("\n")
}

/// The programs that are needed.
struct Tools {
    spin: PathBuf,
    cc: PathBuf,
}

impl Tools {
    fn find() -> Option<Self> {
        let spin = installed("spin", "-V");
        let cc = std::env::var_os("CC").map(PathBuf::from).or_else(|| installed("cc", "--version"));
        if let (Some(spin), Some(cc)) = (spin, cc) {
            return Some(Self { spin, cc });
        }
        let missing = "Spin and a C compiler are not both installed; try: apt-get install spin gcc libc6-dev";
        assert!(std::env::var_os("ADSDV_REQUIRE_SPIN").is_none(), "{missing}");
        eprintln!("SKIPPED: {missing}");
        None
    }
}

fn installed(program: &str, version: &str) -> Option<PathBuf> {
    let output = Command::new(program).arg(version).output().ok()?;
    output.status.success().then(|| program.into())
}

fn run(command: &mut Command, dir: &Scratch) -> String {
    let output = command.current_dir(&dir.0).output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let stdout = String::from_utf8_lossy(&output.stdout).into_owned();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {}\n{}\n{stderr}", output.status, tail(&stdout));
    stdout
}

/// A directory that is gone when the test is over.
struct Scratch(PathBuf);

impl Scratch {
    fn new(place: usize) -> Self {
        let thread = format!("{:?}", thread::current().id()).replace(|c: char| !c.is_ascii_digit(), "");
        let dir = std::env::temp_dir().join(format!("adsdv-spin-{}-{thread}-{place}", std::process::id()));
        fs::create_dir_all(&dir).unwrap();
        Self(dir)
    }

    fn path(&self, file: impl AsRef<Path>) -> PathBuf {
        self.0.join(file)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // What cannot be removed stays; the test says what it has to say all the same.
        let _ = fs::remove_dir_all(&self.0);
    }
}
