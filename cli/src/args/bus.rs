//! The arguments of the commands that are on a bus, or make one of their own: `demo`, `vcu`, `ai`, `watch`.

use std::path::PathBuf;

use adsdv_oracle::judge::JudgeOptions;
use adsdv_spec::Choice;
use clap::{Args, ColorChoice};

use super::{EditionArgs, RecognisedArgs};

/// Drive a whole mission without any CAN, and have it judged.
///
/// The first thing to run: it needs no car, no CAN interface and no file. The reference VCU with a plain car, and a small AI
/// Computer, are on a bus of 500 kbit/s within this program. They drive a mission in simulated time, which takes much less than
/// a second, and the judge of `adsdv check` says what it saw.
///
/// What the operator does comes from a scenario, a few lines of text: which switch, and when. What may stand in one is below, and
/// some come with adsdv.
#[derive(Args, Debug)]
#[command(after_long_help = crate::demo::help::after())]
pub(crate) struct DemoArgs {
    /// What the operator does: a file, - for standard input, or one that comes with adsdv; by default a whole mission.
    #[arg(long, value_name = "FILE")]
    pub(crate) scenario: Option<PathBuf>,

    /// Write the frames to this file, as a log of `candump -L`. What it held before is lost.
    #[arg(long, value_name = "FILE")]
    pub(crate) log: Option<PathBuf>,

    /// Print one JSON object instead of text: that of `adsdv check --json`.
    #[arg(long)]
    pub(crate) json: bool,

    /// Drive in real time on a terminal screen, with the switches as keys.
    ///
    /// The operator is the person who sits there: ? explains the keys, and q leaves. --scenario works the switches as well; without it,
    /// nothing is done by itself. Nothing is judged, and no log is written.
    #[arg(long, conflicts_with_all = ["json", "log"])]
    pub(crate) screen: bool,

    #[command(flatten)]
    pub(crate) edition: EditionArgs,

    /// When to color the text; auto: on a terminal, unless NO_COLOR is set.
    #[arg(long, value_name = "WHEN", default_value_t = ColorChoice::Auto, value_enum)]
    pub(crate) color: ColorChoice,
}

/// Be the VCU, and the car around it, on a CAN interface.
///
/// The reference VCU runs the state machine of Figure 2 every 10 ms and sends 500h, 502h and 520h to 526h; a plain vehicle
/// obeys the torque, brake and steering requests that reach the actuators. An AI Computer on the same bus sees a car: a team's
/// whole stack can be run on a laptop.
///
/// The operator's side (master switches, mission, "Go", the shutdown circuit, faults, power) comes from a scenario, a few lines of
/// text, or from the keys of the terminal screen. `adsdv demo --help` says what may stand in a scenario, and names those that come
/// with adsdv.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  Make a virtual bus, and be the car on it:
      sudo ip link add vcan0 type vcan && sudo ip link set vcan0 up
      adsdv vcu vcan0

  In other terminals: the AI stack, or the one that comes with adsdv, and the judge of both:
      adsdv ai vcan0
      adsdv watch vcan0

  Without a screen, in a script; `end` in the scenario ends the command:
      adsdv vcu vcan0 --plain --scenario mission

  On a real bus of 500 kbit/s, in place of a VCU:
      sudo ip link set can0 up type can bitrate 500000
      adsdv vcu can0

OUTPUT
  With --plain a line for each thing that happens: the AS state with the section and the
  conditions that decided, what the operator does, frames that were refused, another VCU
  on the bus, error frames, the bus going down and coming back, cycles that were late, the
  AI Computer falling silent and being heard again, once that it speaks another edition and
  which --edition speaks that, frames that were lost. What comes again
  and again it prints once a second. In the end the frames, how well the cycle of 10 ms was
  held, and how fast the AI Computer answered the handshake. The kernel tells of lost
  frames with the next one that comes: the count is as of the last frame.

ENVIRONMENT
  ADSDV_EDITION  the edition where --edition names none
  NO_COLOR       if set and not empty, --color auto means never

EXIT STATUS
  0  it was stopped (Ctrl-C, SIGTERM), or the scenario came to its end
  2  the interface could not be opened or the scenario not be read, the scenario waited in
     vain for a state, the output could not be written, or the arguments are wrong")]
pub(crate) struct VcuArgs {
    /// The CAN interface, such as vcan0.
    #[arg(value_name = "IFACE")]
    pub(crate) interface: String,

    /// What the operator does: a file, - for standard input, or one that comes with adsdv: see `adsdv demo --help`.
    #[arg(long, value_name = "FILE")]
    pub(crate) scenario: Option<PathBuf>,

    /// Give the scenario up when it has waited for a state for so long.
    ///
    /// Without it, ten minutes; with the terminal screen, whose keys can do what is missing, no end.
    #[arg(long, value_name = "SECONDS", requires = "scenario", value_parser = clap::value_parser!(u32).range(1..),
        allow_negative_numbers = true)]
    pub(crate) patience: Option<u32>,

    /// Follow another answer to a question that the document leaves open; may be repeated.
    ///
    /// Without it, the default. `adsdv readings` lists the ids and their choices.
    #[arg(long = "reading", value_name = "ID=CHOICE")]
    pub(crate) readings: Vec<Choice>,

    /// Print what happens, line by line, instead of the terminal screen.
    #[arg(long)]
    pub(crate) plain: bool,

    #[command(flatten)]
    pub(crate) edition: EditionArgs,

    /// When to color the text; auto: on a terminal, unless NO_COLOR is set.
    #[arg(long, value_name = "WHEN", default_value_t = ColorChoice::Auto, value_enum)]
    pub(crate) color: ColorChoice,
}

/// Be a small AI Computer on a CAN interface.
///
/// It answers the handshake, confirms the mission that is selected, drives forty metres when it may, stops and says so: all that
/// the document asks of an AI Computer, and no more. To try a VCU or a simulator with, where there is no AI stack at hand.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  A whole mission on a virtual bus, judged while it is driven:
      sudo ip link add vcan0 type vcan && sudo ip link set vcan0 up
      adsdv ai vcan0 &
      adsdv watch vcan0 &
      adsdv vcu vcan0 --plain --scenario mission

OUTPUT
  A line for each thing that happens: the AS state that the VCU shows, frames that were
  refused, another AI Computer on the bus, once that the VCU speaks another edition and
  which --edition speaks that, error frames, the bus going down and coming back. In the
  end the frames, and how well the cycle of 10 ms was held.

ENVIRONMENT
  ADSDV_EDITION  the edition where --edition names none
  NO_COLOR       if set and not empty, --color auto means never

EXIT STATUS
  0  it was stopped (Ctrl-C, SIGTERM)
  2  the interface could not be opened, the output could not be written, or the arguments
     are wrong")]
pub(crate) struct AiArgs {
    /// The CAN interface, such as vcan0.
    #[arg(value_name = "IFACE")]
    pub(crate) interface: String,

    #[command(flatten)]
    pub(crate) edition: EditionArgs,

    /// When to color the text; auto: on a terminal, unless NO_COLOR is set.
    #[arg(long, value_name = "WHEN", default_value_t = ColorChoice::Auto, value_enum)]
    pub(crate) color: ColorChoice,
}

/// Judge a live bus.
///
/// The judge of `adsdv check`, while the car drives: each transition and finding is printed as soon as it is certain, which is a
/// window after it happened. It ends with the same report, on Ctrl-C. It only listens: it never sends a frame.
///
/// Frames that the kernel had to drop, because they were not taken in time, are counted, reported and noted in the log; what they said
/// is unknown, and nobody is blamed for it, by this command or by `adsdv check` of the log.
///
/// Which edition of the interface the bus speaks is recognised by its frames, as `adsdv check` does it: within a second of the
/// first frame, or within ten where they tell too little, as those of an AI Computer alone may. A line then says which it is and by
/// what, and all that came before is judged as well. --edition overrides.
///
/// With - instead of an interface the frames come from standard input, as text of candump or python-can or in any format that
/// `adsdv check` reads, on every system. Their times are those of the lines: what a pipe holds back for a while is not late. Silence
/// is judged as soon as a later line shows it.
#[derive(Args, Debug)]
#[command(after_long_help = "\
EXAMPLES
  adsdv watch can0

  By an edition that is known, from the first frame on:
      adsdv watch --edition 4.0 can0

  Record the run at the same time, and judge it again later:
      adsdv watch can0 --log run.log
      adsdv check run.log

  In a web browser as well, for who stands beside the laptop:
      adsdv watch can0 --web

  A team's own rules beside the document:
      adsdv watch can0 --rules team.rules

  Two minutes, for a program:
      timeout --signal INT 120 adsdv watch can0 --json > run.json

  Frames that another program hears, on any system: python-can's logger, candump on a car:
      can_logger -i pcan -c PCAN_USBBUS1 -b 500000 | adsdv watch -
      ssh car candump -L can0 | adsdv watch -

  A virtual bus to try it on; `adsdv vcu` and `adsdv ai` make the traffic:
      sudo ip link add vcan0 type vcan && sudo ip link set vcan0 up
      adsdv watch vcan0

OUTPUT
  Times are in seconds since the first frame, by the clock of the kernel. The report in
  the end is that of adsdv check; below it stand the frames in a second, on average and at
  most, and those that were dropped. With --log every frame is recorded as candump -L
  does it, remote, extended and error frames included, and lost ones as DROPCOUNT lines,
  as candump -d does it; the file has it within a fraction of a second. Of more than 200
  findings of one rule, the further ones are counted, and one in a second is printed.

ENVIRONMENT
  ADSDV_EDITION  the edition where --edition names none
  NO_COLOR       if set and not empty, --color auto means never

EXIT STATUS
  0  what was seen conforms: no violation was found
  1  it violates the document or a rule of --rules
  2  no verdict: the interface could not be opened, no frame came, or the arguments are
     wrong; or the report or the log could not be written")]
pub(crate) struct WatchArgs {
    /// The CAN interface, such as can0, or - for frames from standard input.
    #[arg(value_name = "IFACE")]
    pub(crate) interface: String,

    /// Record every frame to this file, as a log of `candump -L`. What it held before is lost.
    #[arg(long, value_name = "FILE")]
    pub(crate) log: Option<PathBuf>,

    /// Print one JSON object in the end instead of text: that of `adsdv check --json`, and what the bus was like.
    ///
    /// `adsdv schema watch` describes it.
    #[arg(long)]
    pub(crate) json: bool,

    /// Show the bus in a web browser as well, while it is watched.
    ///
    /// Serves the page of `adsdv web` on this machine only, and streams every frame into it, where the same judge hears them: the AS
    /// state with its light, what the car waits for, Figure 2, what is found, the frames. A page that is opened later begins with
    /// what was heard in the last minutes. With - it is served until the command is stopped, also when the frames have ended.
    #[arg(long)]
    pub(crate) web: bool,

    /// The port of the page on loopback; 0 for any that is free.
    #[arg(long, value_name = "N", default_value_t = 3024, requires = "web", value_parser = super::verify::port, allow_negative_numbers = true)]
    pub(crate) port: u16,

    /// Judge a team's own rules as well: a file with a rule in each line; see RULES.md.
    ///
    /// A rule that is broken is a violation of party OWN, and printed as it is. Where the edition is to be recognised, watching ends if
    /// that has not all that the rules name.
    #[arg(long, value_name = "FILE")]
    pub(crate) rules: Option<PathBuf>,

    /// The window W: how long after its cause an effect may be seen, in milliseconds.
    ///
    /// The cycle of the VCU and the delay of the bus. A wider window finds less, and is wrong less often.
    #[arg(long, value_name = "MS", default_value_t = JudgeOptions::default().window_ms, value_parser = super::milliseconds,
        allow_negative_numbers = true)]
    pub(crate) window: u32,

    /// The deadline D: how long a cause must last before its missing effect is a violation, in milliseconds.
    #[arg(long, value_name = "MS", default_value_t = JudgeOptions::default().deadline_ms, value_parser = super::milliseconds,
        allow_negative_numbers = true)]
    pub(crate) deadline: u32,

    /// Pin a question that the document leaves open; may be repeated.
    ///
    /// Without a pin, the judge allows for every choice. `adsdv readings` lists the ids and their choices.
    #[arg(long = "reading", value_name = "ID=CHOICE")]
    pub(crate) readings: Vec<Choice>,

    #[command(flatten)]
    pub(crate) edition: RecognisedArgs,

    /// When to color the text; auto: on a terminal, unless NO_COLOR is set.
    #[arg(long, value_name = "WHEN", default_value_t = ColorChoice::Auto, value_enum)]
    pub(crate) color: ColorChoice,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    #[test]
    fn the_help_has_the_bit_rate_of_the_bus() {
        let mut command = super::super::Cli::command();
        let vcu = command.find_subcommand_mut("vcu").expect("a command");
        let help = vcu.render_long_help().to_string();
        assert!(help.contains(&format!("bitrate {}\n", adsdv_can::BITRATE)), "{help}");
        assert!(help.contains(&format!("{} kbit/s", adsdv_can::BITRATE / 1000)), "{help}");
    }
}
