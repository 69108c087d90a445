//! A node on a bus without a screen: what happens, line by line, until it is stopped.

use std::fmt::Write as _;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use adsdv_can::live::{Handle, Runner};
use adsdv_can::status::{Happening, HappeningKind, Status};
use clap::ColorChoice;

use crate::args::ChosenEdition;
use crate::error::Error;
use crate::layout::{Seconds, counted};
use crate::report::style::{self, Styled};
use crate::screen::happened::words;
use crate::{interrupt, output};

/// Between two looks at what has happened.
const PACE: Duration = Duration::from_millis(20);

/// Lets the node take its turns until Ctrl-C, SIGTERM, the end of its scenario, or the end of the program that reads the output. Tells
/// how everything stood in the end.
pub(crate) fn run(
    runner: impl Runner + Send + 'static,
    chosen: ChosenEdition,
    color: ColorChoice,
) -> Result<Arc<Status>, Error> {
    let stop = interrupt::flag().map_err(|error| Error::system("signals", &error))?;
    let bus = runner.status().bus.clone();
    let handle = Handle::start(runner).map_err(|error| Error::system("threads", &error))?;
    let mut seen = 0;
    let mut read = output::follow(&format!("{chosen}\non {bus}; Ctrl-C stops\n"), color)?;
    while read && handle.is_running() && !stop.load(Ordering::Relaxed) {
        std::thread::sleep(PACE);
        read = show(&handle.status(), &mut seen, color)?;
    }
    let status = handle.join().map_err(|error| Error::mistake(&bus, error))?;
    if read && show(&status, &mut seen, color)? {
        output::follow(&summary(&status), color)?;
    }
    Ok(status)
}

/// Prints how it went.
pub(crate) fn conclude(status: &Status, chosen: ChosenEdition, color: ColorChoice) -> Result<(), Error> {
    output::styled(&format!("{chosen}{}", summary(status)), color)
}

/// Prints what is new. Tells whether anybody still reads.
fn show(status: &Status, seen: &mut u64, color: ColorChoice) -> Result<bool, Error> {
    let missed = status.happenings.saturating_sub(*seen);
    let (news, now) = status.since(*seen);
    *seen = now;
    let mut text = String::new();
    let mut kept = 0;
    for happening in news {
        kept += 1;
        text.push_str(&line(happening));
    }
    if missed > kept {
        let _ = writeln!(text, "{:>10}    {} more, not kept", "", missed - kept);
    }
    if text.is_empty() { Ok(true) } else { output::follow(&text, color) }
}

fn line(happening: &Happening) -> String {
    let ns = i64::try_from(happening.time_ms).unwrap_or(i64::MAX).saturating_mul(1_000_000);
    let style = match happening.what {
        HappeningKind::State { .. } => style::HEADING,
        HappeningKind::Up | HappeningKind::AiHeard => style::GOOD,
        HappeningKind::Disturbance(_) => style::BAD,
        HappeningKind::Did(_) => style::QUIET,
        _ => style::CARE,
    };
    format!("{:>10} s  {}\n", Seconds(ns), Styled(style, words(&happening.what)))
}

/// How it went.
fn summary(status: &Status) -> String {
    let mut text = String::new();
    let Status { received, sent, unsent, dropped, refused, foreign, errors, .. } = status;
    let _ = writeln!(text, "\n{}: {} sent, {received} received", status.bus, counted(*sent, "frame"));
    for (count, what) in [
        (unsent, "not sent"),
        (dropped, "lost, not taken in time (as of the last that came)"),
        (refused, "refused"),
        (foreign, "from somebody else with identifiers of this node"),
        (errors, "of the error kind"),
    ] {
        if *count > 0 {
            let _ = writeln!(text, "  {} {what}", counted(*count, "frame"));
        }
    }
    let cycles = status.cycles;
    let _ = writeln!(
        text,
        "{}: {} late, {} left out; lateness p99 {:.2}, max {:.2} ms",
        counted(cycles.count, "cycle"),
        cycles.late,
        cycles.left_out,
        cycles.p99_ms,
        cycles.worst_ms
    );
    let times = &status.responses;
    if let (Some(min), Some(median), Some(p99), Some(max)) =
        (times.min_ms(), times.quantile_ms(0.5), times.quantile_ms(0.99), times.max_ms())
    {
        let _ = writeln!(
            text,
            "AI handshake: {}; min {min:.2}, median {median:.2}, p99 {p99:.2}, max {max:.2} ms",
            counted(times.count(), "answer")
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use adsdv_can::ai::{Ai, Plan};
    use adsdv_can::bus::Disturbance;
    use adsdv_can::demo::LocalBus;
    use adsdv_can::live::Vcu;
    use adsdv_can::status::KEPT;
    use adsdv_spec::{Edition, Machine};

    use super::*;

    #[test]
    fn a_happening_is_a_line_with_its_time() {
        let happening = Happening { time_ms: 12_345, what: HappeningKind::Disturbance(Disturbance::Down) };
        let text = anstream::adapter::strip_str(&line(&happening)).to_string();
        assert_eq!(text, "    12.345 s  the interface is down\n");
    }

    /// The lines about the partner's edition that a VCU prints within the first seconds.
    fn lines_about_editions(own: &'static Edition, partner: &'static Edition) -> Vec<String> {
        let bus = LocalBus::new(Ai::new(partner, Plan::DEFAULT));
        let mut vcu = Vcu::new(bus, Machine::new(*own, own.readings), None);
        while vcu.status().time_ms < 2200 {
            vcu.turn();
        }
        let lines = vcu.status().happened.iter().map(line);
        let lines = lines.map(|line| anstream::adapter::strip_str(&line).to_string());
        lines.filter(|line| line.contains(" speaks edition ")).collect()
    }

    #[test]
    fn a_vcu_prints_once_that_its_partner_speaks_another_edition_and_what_to_do() {
        let cases = [(&Edition::V3_0, &Edition::V4_0), (&Edition::V4_0, &Edition::V3_0)];
        std::thread::scope(|scope| {
            for (own, partner) in cases {
                scope.spawn(move || {
                    let lines = lines_about_editions(own, partner);
                    let [line] = &lines[..] else { panic!("{lines:?}") };
                    // An AI Computer may fit several editions.
                    let not = format!(", and not {}: 511h has ", own.version);
                    let (speaks, by) = line.split_once(&not).unwrap_or_else(|| panic!("{line}"));
                    let (_, option) = by.split_once("; --edition ").unwrap_or_else(|| panic!("{line}"));
                    assert!(
                        speaks.contains("  the AI Computer speaks edition ")
                            && speaks.contains(partner.version)
                    );
                    assert!(option.contains(partner.version), "{line}");
                });
                scope.spawn(move || assert_eq!(lines_about_editions(own, own), [""; 0]));
            }
        });
    }

    #[test]
    fn the_summary_has_what_there_is() {
        let mut status = Status {
            bus: "vcan0".to_owned(),
            sent: 9,
            received: 1,
            unsent: 2,
            dropped: 1,
            ..Status::default()
        };
        status.responses.add(4_000_000);
        assert_eq!(
            summary(&status),
            "\nvcan0: 9 frames sent, 1 received\n  2 frames not sent\n  1 frame lost, not taken in time (as of the last that came)\n\
             0 cycles: 0 late, 0 left out; lateness p99 0.00, max 0.00 ms\n\
             AI handshake: 1 answer; min 4.00, median 4.00, p99 4.00, max 4.00 ms\n"
        );
        let mut status = Status::default();
        (0..=KEPT).for_each(|_| status.happen(0, HappeningKind::Up));
        assert_eq!(status.since(0).0.count(), KEPT);
    }
}
