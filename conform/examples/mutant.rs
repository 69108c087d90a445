//! A program under test that does not conform, or does not behave: for the tests of `adsdv conform`.
//!
//! ```text
//! mutant --mutation '3.6: dropped'
//! mutant --reading fault-trigger=edge --latency 2
//! mutant --edition 4.0 --mutation '3.7 term 5: dropped'
//! mutant --hang-at 10
//! ```
//!
//! What happens "at N" happens at the Nth line, counted from 1, resets included.

use std::collections::VecDeque;
use std::error::Error;
use std::fs;
use std::io::{self, BufRead, BufReader, BufWriter, Write};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use adsdv_conform::protocol::{Protocol, Request, SHOWN, Shown};
use adsdv_spec::{AsState, Choice, Control, Edition, Inputs, Machine, Mutation, Outputs};

/// What the program was asked to do wrong.
#[derive(Default)]
struct Wrong {
    /// What to do at which line.
    at: Vec<(String, u64)>,
    latency: usize,
    slow_ms: u64,
    no_eof: bool,
    no_success: bool,
    /// The outputs that are shown; none: all.
    only: Vec<String>,
    /// An output that is shown as another value.
    lie: Option<String>,
    /// Whether each request has another output shown as another value.
    scramble: bool,
    /// Whether AS_READY is entered only once between resets.
    once: bool,
    /// Whether its handshake bit turns only in each second step in which it is answered.
    slow_bit: bool,
    reset: Option<String>,
    /// What it says of itself before anything else.
    about: Option<String>,
    /// Whether a step takes the time that it says, by a clock.
    clock: bool,
    /// What a hello is answered with.
    hello: Option<String>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut wrong = Wrong::default();
    let (mut edition, mut readings) = (*Edition::DEFAULT, Edition::DEFAULT.readings);
    let mut args = std::env::args().skip(1);
    while let Some(arg) = args.next() {
        let mut value = || args.next().ok_or(format!("{arg} needs a value"));
        match arg.as_str() {
            // Before all that is about it.
            "--edition" => {
                let version = value()?;
                edition = *Edition::find(&version).ok_or(format!("no such edition: {version}"))?;
                readings = edition.readings;
                wrong.hello = Some(format!("{{\"edition\":{version:?}}}"));
            }
            "--mutation" => {
                let name = value()?;
                let mutation = Mutation::all(&edition).find(|mutation| mutation.to_string() == name);
                edition = mutation.ok_or(format!("no such mutation: {name}"))?.apply(&edition);
            }
            "--reading" => readings = readings.with(value()?.parse::<Choice>()?),
            "--latency" => wrong.latency = value()?.parse()?,
            "--slow" => wrong.slow_ms = value()?.parse()?,
            "--no-eof" => wrong.no_eof = true,
            "--no-success" => wrong.no_success = true,
            "--no-read" => forever(),
            "--grandchild" => {
                let child = Command::new("sleep").arg("600").stdin(Stdio::inherit()).spawn()?;
                fs::write(value()?, child.id().to_string())?;
            }
            "--leave" => return Ok(()),
            "--once" => wrong.once = true,
            "--slow-bit" => wrong.slow_bit = true,
            "--pid" => fs::write(value()?, std::process::id().to_string())?,
            "--only" => wrong.only = value()?.split(',').map(str::to_owned).collect(),
            "--lie" => wrong.lie = Some(value()?),
            "--about" => wrong.about = Some(value()?),
            "--clock" => wrong.clock = true,
            "--scramble" => wrong.scramble = true,
            "--reset" => wrong.reset = Some(value()?),
            "--hello" => wrong.hello = Some(value()?),
            at if at.ends_with("-at") => wrong.at.push((at.to_owned(), value()?.parse()?)),
            other => return Err(format!("what is {other}?").into()),
        }
    }
    speak(&Machine::new(edition, readings), wrong)
}

/// What the program remembers between two steps.
#[derive(Default)]
struct Memory {
    control: Control,
    times_ready: u32,
    /// The handshake bit, where that is its own.
    bit: bool,
    steps: u32,
}

impl Memory {
    /// One step, as wrong as was asked for. The inputs become those that the machine behind it sees.
    fn step(&mut self, vcu: &Machine, wrong: &Wrong, inputs: &mut Inputs, dt_ms: u32) -> Outputs {
        let answered = inputs.ai.status.handshake == self.bit;
        if wrong.slow_bit {
            inputs.ai.status.handshake = self.control.handshake.bit == answered;
        }
        let (after, mut outputs) = vcu.step(&self.control, inputs, dt_ms);
        if wrong.slow_bit {
            self.steps += 1;
            self.bit = inputs.tsms && self.bit ^ (answered && self.steps.is_multiple_of(2));
            outputs.handshake = self.bit;
        }
        let again = (self.control.state, after.state) == (AsState::Off, AsState::Ready);
        self.times_ready += u32::from(again);
        if wrong.once && again && self.times_ready > 1 {
            self.times_ready = 1;
            return Outputs { state: AsState::Off, ..outputs };
        }
        self.control = after;
        outputs
    }
}

fn speak(vcu: &Machine, mut wrong: Wrong) -> Result<(), Box<dyn Error>> {
    let mut requests = BufReader::new(io::stdin().lock());
    let mut answers = BufWriter::new(io::stdout().lock());
    let protocol = Protocol::of(vcu.edition());
    let mut memory = Memory::default();
    let (mut line, mut delayed) = (String::new(), VecDeque::new());
    if let Some(about) = &wrong.about {
        writeln!(answers, "{about}")?;
    }
    let mut last = Instant::now();
    for count in 1.. {
        if requests.buffer().is_empty() {
            answers.flush()?;
        }
        line.clear();
        if requests.read_line(&mut line)? == 0 {
            break;
        }
        sleep(Duration::from_millis(wrong.slow_ms));
        if wrong.at.contains(&("--pause-at".to_owned(), count)) {
            // As if the computer had let it wait before it took the line.
            sleep(Duration::from_millis(40));
        }
        let mut answer = match protocol.request(&line)? {
            Request::Hello { .. } => wrong.hello.clone().unwrap_or_else(|| "{}".to_owned()),
            Request::Reset => {
                memory = Memory::default();
                last = Instant::now();
                delayed = VecDeque::from(vec!["{}".to_owned(); wrong.latency]);
                wrong.reset.clone().unwrap_or_else(|| "{}".to_owned())
            }
            Request::Step { mut dt_ms, mut inputs } => {
                if wrong.clock {
                    dt_ms = u32::try_from(last.elapsed().as_millis())?;
                    last += Duration::from_millis(dt_ms.into());
                }
                if wrong.scramble {
                    // Never the state, which comes first.
                    let place = 1 + line.len() % (protocol.shown().count() - 1);
                    wrong.lie = protocol.shown().nth(place).map(|(field, _)| field.key.to_owned());
                }
                let outputs = memory.step(vcu, &wrong, &mut inputs, dt_ms);
                delayed.push_back(wrong.shown(&Shown::of(vcu.edition(), &outputs, &inputs)));
                delayed.pop_front().unwrap_or_default()
            }
        };
        for (what, _) in wrong.at.iter().filter(|(_, at)| *at == count) {
            match what.as_str() {
                "--hang-at" => {
                    answers.flush()?;
                    forever();
                }
                "--pause-at" => {}
                "--crash-at" => std::process::abort(),
                "--exit-at" => {
                    answers.flush()?;
                    eprintln!("first words\nthe battery is empty\x1b[2J");
                    std::process::exit(3);
                }
                "--garbage-at" => "engine started".clone_into(&mut answer),
                "--list-at" => "[1, 2]".clone_into(&mut answer),
                "--unknown-at" => r#"{"as_state":"AS_OFF","speed":3}"#.clone_into(&mut answer),
                "--value-at" => r#"{"as_state":"AS_OFF","handshake":"maybe"}"#.clone_into(&mut answer),
                "--no-state-at" => r#"{"handshake":true}"#.clone_into(&mut answer),
                "--chatty-at" => answer = format!("{answer}\n{answer}"),
                "--lie-at" => r#"{"as_state":"AS_FINISHED"}"#.clone_into(&mut answer),
                "--skip-at" => answer.clear(),
                "--binary-at" => {
                    answers.write_all(&[0xff, 0xfe, b'\n'])?;
                    answer.clear();
                }
                "--stall-at" => {
                    write!(answers, "{}", answer.get(..20).unwrap_or_default())?;
                    answers.flush()?;
                    forever();
                }
                "--long-at" => loop {
                    answers.write_all(&[b'x'; 4096])?;
                },
                "--flood-at" => (0..100_000).for_each(|_| eprintln!("noise noise noise noise noise noise")),
                other => return Err(format!("what is {other}?").into()),
            }
        }
        if !answer.is_empty() {
            writeln!(answers, "{answer}")?;
        }
    }
    answers.flush()?;
    if wrong.no_eof {
        forever();
    }
    if wrong.no_success {
        std::process::exit(3);
    }
    Ok(())
}

impl Wrong {
    fn shown(&self, shown: &Shown) -> String {
        if self.only.is_empty() && self.lie.is_none() {
            return shown.to_string();
        }
        let is_shown = |key: &str| self.only.is_empty() || self.only.iter().any(|only| only == key);
        let all = SHOWN.iter().filter(|field| is_shown(field.key));
        let fields = all.filter_map(|field| {
            let raw = shown.get(field.key)?.raw?;
            // Every output can be 1, and every one but `as_state` 0.
            let lie = if field.key == "as_state" { 1 + i32::from(raw == 1) } else { i32::from(raw == 0) };
            Some((field.key, if self.lie.as_deref() == Some(field.key) { lie } else { raw }))
        });
        let fields: Vec<String> = fields.map(|(key, raw)| format!("\"{key}\":{raw}")).collect();
        format!("{{{}}}", fields.join(","))
    }
}

fn forever() -> ! {
    loop {
        sleep(Duration::from_hours(1));
    }
}
