//! What happened, the latest at the bottom, and what the scenario does next.

use adsdv_can::bus::Disturbance;
use adsdv_can::socket::RECEIVE_BUFFER;
use adsdv_can::status::{Happening, HappeningKind, Status};
use adsdv_oracle::recognise::Recognised;
use adsdv_spec::messages::{AsState, Node};
use ratatui::style::Style;
use ratatui::text::{Line, Span};

use crate::layout::{Seconds, counted, wrapped};
use crate::report::{FACTS, first};
use crate::screen::theme::{QUIET, STRONG, Theme};

/// The column of the times.
const TIME: usize = 11;

/// How much of what happened is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::screen) struct Room {
    /// So many lines are seen at once.
    pub(in crate::screen) seen: usize,
    /// By so many lines it can be scrolled back.
    pub(in crate::screen) most_back: usize,
}

/// The title, with what comes next and how far it is scrolled back.
pub(in crate::screen) fn title(status: &Status, theme: Theme, back: usize) -> Line<'static> {
    let mut title = Line::from(" What happened ");
    if back > 0 {
        title.push_span(Span::styled(
            format!("({} further down) ", counted(to_u64(back), "line")),
            theme.care(),
        ));
    }
    if let Some(next) = &status.next {
        title.push_span(Span::styled(format!("── next: {next} "), QUIET));
    }
    title
}

/// The lines that are seen, and how much there is.
pub(in crate::screen) fn lines(
    status: &Status,
    theme: Theme,
    width: usize,
    height: usize,
    back: usize,
) -> (Vec<Line<'static>>, Room) {
    let mut lines: Vec<Line<'static>> =
        status.happened.iter().flat_map(|happening| in_words(happening, theme, width)).collect();
    let room = Room { seen: height, most_back: lines.len().saturating_sub(height) };
    let end = lines.len().saturating_sub(back.min(room.most_back));
    lines.truncate(end);
    lines.drain(..end.saturating_sub(height));
    (lines, room)
}

/// A happening, on as many lines as it takes.
fn in_words(happening: &Happening, theme: Theme, width: usize) -> Vec<Line<'static>> {
    let mut text = String::new();
    wrapped(&mut text, words(&happening.what).split_whitespace(), 0, width.saturating_sub(TIME));
    let time = i64::try_from(happening.time_ms).unwrap_or(i64::MAX).saturating_mul(1_000_000);
    let mut time = format!("{:>8} s ", Seconds(time));
    let style = style(&happening.what, theme);
    text.lines()
        .map(|line| {
            let time = std::mem::replace(&mut time, " ".repeat(TIME));
            Line::from(vec![Span::styled(time, QUIET), Span::styled(line.to_owned(), style)])
        })
        .collect()
}

/// What happened, in words.
pub(crate) fn words(what: &HappeningKind) -> String {
    match what {
        HappeningKind::State { from, to, section, why } => {
            let name = |state: &Option<AsState>| state.map_or("no power", AsState::name);
            let section = if section.is_empty() { String::new() } else { format!(" ({section})") };
            let why = if why.is_empty() { String::new() } else { format!(": {why}") };
            format!("{} -> {}{section}{why}", name(from), name(to))
        }
        HappeningKind::Did(action) => format!("operator: {action}"),
        HappeningKind::Refused(why) => format!("frame refused: {why}"),
        HappeningKind::OtherVcu(what) | HappeningKind::OtherAi(what) => what.clone(),
        HappeningKind::OtherEdition { node, spoken, own } => other_edition(*node, spoken, own),
        HappeningKind::ErrorFrame(what) => format!("error frame: {what}"),
        HappeningKind::Disturbance(Disturbance::Full) => {
            format!("{}; a longer queue: ip link set IFACE txqueuelen 1000", Disturbance::Full)
        }
        HappeningKind::Disturbance(trouble) => trouble.to_string(),
        HappeningKind::Up => "the bus is there again".to_owned(),
        HappeningKind::Dropped { frames, small_buffer } => {
            let mut lost = format!("{} lost, not taken in time", counted(*frames, "frame"));
            if *small_buffer {
                lost += "; for more room: sysctl -w net.core.rmem_max=";
                lost += &RECEIVE_BUFFER.to_string();
            }
            lost
        }
        HappeningKind::Late(cycles) => format!("late: {} left out", counted(*cycles, "cycle")),
        HappeningKind::AiHeard => "the AI Computer is heard".to_owned(),
        HappeningKind::AiSilent => "the AI Computer has fallen silent".to_owned(),
    }
}

/// The partner speaks another edition, by what, and what to do.
fn other_edition(node: Node, spoken: &Recognised, own: &str) -> String {
    let who = if node == Node::Vcu { "the VCU" } else { "the AI Computer" };
    let fitting = std::iter::once(&spoken.edition).chain(&spoken.alike);
    let versions: Vec<&str> = fitting.map(|edition| edition.version).collect();
    let (versions, by) = (versions.join(" or "), first(&spoken.evidence, FACTS).unwrap_or_default());
    format!("{who} speaks edition {versions}, and not {own}: {by}; --edition {versions} speaks it as well")
}

fn style(what: &HappeningKind, theme: Theme) -> Style {
    match what {
        HappeningKind::State { to: Some(AsState::EmergencyBrake), .. } | HappeningKind::Disturbance(_) => {
            theme.bad()
        }
        HappeningKind::State { .. } => STRONG,
        HappeningKind::Did(_) => Style::new(),
        HappeningKind::Up | HappeningKind::AiHeard => theme.good(),
        HappeningKind::Refused(_)
        | HappeningKind::OtherVcu(_)
        | HappeningKind::OtherAi(_)
        | HappeningKind::OtherEdition { .. }
        | HappeningKind::ErrorFrame(_)
        | HappeningKind::Dropped { .. }
        | HappeningKind::Late(_)
        | HappeningKind::AiSilent => theme.care(),
    }
}

fn to_u64(count: usize) -> u64 {
    u64::try_from(count).unwrap_or(u64::MAX)
}

#[cfg(test)]
mod tests {
    use adsdv_oracle::recognise::Recogniser;
    use adsdv_spec::Edition;

    use super::*;

    fn status(happened: impl IntoIterator<Item = HappeningKind>) -> Status {
        let happened = (0..).zip(happened).map(|(place, what)| Happening { time_ms: place * 1500, what });
        Status { happened: happened.collect(), ..Status::default() }
    }

    fn seen(status: &Status, height: usize, back: usize) -> (Vec<String>, Room) {
        let (lines, room) = lines(status, Theme::new(true), 40, height, back);
        (lines.iter().map(ToString::to_string).collect(), room)
    }

    #[test]
    fn the_latest_is_seen_and_the_rest_can_be_scrolled_to() {
        let status = status((0..5).map(|place| HappeningKind::Did(format!("action {place}"))));
        let (latest, room) = seen(&status, 2, 0);
        assert_eq!(latest, ["   4.500 s operator: action 3", "   6.000 s operator: action 4"]);
        assert_eq!(room, Room { seen: 2, most_back: 3 });
        assert_eq!(seen(&status, 2, 1).0[0], "   3.000 s operator: action 2");
        assert_eq!(seen(&status, 2, 99).0[0], "   0.000 s operator: action 0");
        assert_eq!(seen(&status, 9, 0).0.len(), 5);
        assert_eq!(seen(&status, 0, 0).0.len(), 0);
    }

    #[test]
    fn what_is_long_is_wrapped() {
        let why = "0x513 cannot be 24.1 deg (raw 241), allowed: -24.0 to 24.0 deg";
        let (lines, _) = seen(&status([HappeningKind::Refused(why.to_owned())]), 9, 0);
        assert!(lines.len() > 2 && lines.iter().all(|line| line.chars().count() <= 40), "{lines:#?}");
        let text: Vec<&str> = lines.iter().flat_map(|line| line.split_whitespace()).skip(2).collect();
        assert_eq!(text.join(" "), format!("frame refused: {why}"));
    }

    /// A VCU of 4.0, as one of 3.0 notices it.
    fn other(ids: &[u32], node: Node) -> HappeningKind {
        const EDITIONS: &[&Edition] = &[&Edition::V3_0, &Edition::V4_0];
        let mut recogniser = Recogniser::among(EDITIONS, &Edition::V3_0);
        for &id in ids {
            assert!(recogniser.frame(0, id, &[0; 6]));
        }
        let spoken = recogniser.fits_better().expect("another length");
        HappeningKind::OtherEdition { node, spoken, own: Edition::V3_0.version }
    }

    #[test]
    fn each_happening_has_its_words() {
        let state =
            |from, to, section, why: &str| HappeningKind::State { from, to, section, why: why.to_owned() };
        let (off, ready) = (Some(AsState::Off), Some(AsState::Ready));
        for (what, expected) in [
            (state(None, off, "", ""), "no power -> AS_OFF"),
            (state(off, ready, "3.1", "SDC closed"), "AS_OFF -> AS_READY (3.1): SDC closed"),
            (state(ready, None, "", ""), "AS_READY -> no power"),
            (HappeningKind::Did("asms on".to_owned()), "operator: asms on"),
            (HappeningKind::OtherVcu("somebody else sends 520h".to_owned()), "somebody else sends 520h"),
            (
                other(&[0x521, 0x522, 0x523], Node::Vcu),
                "the VCU speaks edition 4.0, and not 3.0: 521h has 6 bytes (3.0: 8); 522h has 6 bytes (3.0: 8); 1 more such; --edition 4.0 speaks it as well",
            ),
            (
                HappeningKind::OtherEdition {
                    node: Node::Ai,
                    spoken: Recognised { alike: vec![&Edition::V3_0], ..Recognised::named(&Edition::V4_0) },
                    own: "2.0",
                },
                "the AI Computer speaks edition 4.0 or 3.0, and not 2.0: ; --edition 4.0 or 3.0 speaks it as well",
            ),
            (HappeningKind::ErrorFrame("bus-off".to_owned()), "error frame: bus-off"),
            (HappeningKind::Disturbance(Disturbance::Down), "the interface is down"),
            (
                HappeningKind::Disturbance(Disturbance::Full),
                "the bus does not take frames: the queue is full; a longer queue: ip link set IFACE txqueuelen 1000",
            ),
            (HappeningKind::Up, "the bus is there again"),
            (HappeningKind::Dropped { frames: 1, small_buffer: false }, "1 frame lost, not taken in time"),
            (
                HappeningKind::Dropped { frames: 7, small_buffer: true },
                "7 frames lost, not taken in time; for more room: sysctl -w net.core.rmem_max=8388608",
            ),
            (HappeningKind::Late(1), "late: 1 cycle left out"),
        ] {
            assert_eq!(words(&what), expected);
        }
    }
}
