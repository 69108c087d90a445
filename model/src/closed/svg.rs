//! A run as an SVG: Figure 2 with the state that it led to, and below it a sequence diagram: a lifeline for each party, an arrow for
//! each event, and the VCU's state as a band in the colours of the ASSI.
//!
//! The picture is self-contained: it brings its colours, and is shown as it is by the Explorer and by any browser.

use std::fmt::{self, Write};

use adsdv_spec::export::{Background, Paint};
use adsdv_spec::messages::AsState;
use adsdv_spec::{Assi, Machine};

use super::figure;
use super::sequence::{Event, Party, Sequence};
use super::words::seconds;

/// All sizes are in pixels.
const WIDTH: u32 = 890;
const TOP: u32 = 44;
/// The height of an event whose words take a line above the arrow, or two, one above and one below.
const ROW: u32 = 36;
/// The height of each line more.
const LINE: u32 = 12;
/// How many letters fit on a line between two lifelines.
const LETTERS: usize = 36;
/// Half the width of the band on the VCU's lifeline.
const BAND: u32 = 9;
/// How far an event of one party with itself reaches out.
const LOOP: u32 = 30;

const BACKGROUND: &str = "#142b46";
const TEXT: &str = "#e7ecef";
const LIFELINE: &str = "#5b7f9b";
const ARROW: &str = "#f2e27a";
const MUTED: &str = "#9fb3c4";
/// Blue light is too dark for letters on this background.
const LIGHT_BLUE: &str = "#8db8ff";

impl Party {
    const ALL: [Self; 4] = [Self::Operator, Self::Ai, Self::Vcu, Self::Vehicle];

    const fn name(self) -> &'static str {
        match self {
            Self::Operator => "Operator",
            Self::Ai => "AI Computer",
            Self::Vcu => "VCU",
            Self::Vehicle => "Vehicle",
        }
    }

    const fn x(self) -> u32 {
        match self {
            Self::Operator => 105,
            Self::Ai => 280,
            Self::Vcu => 550,
            Self::Vehicle => 830,
        }
    }

    /// Where arrows to and from the party end, on the side of another one.
    const fn edge(self, other: Self) -> u32 {
        match (self, other) {
            (Self::Vcu, Self::Operator | Self::Ai) => self.x() - BAND,
            (Self::Vcu, _) => self.x() + BAND,
            _ => self.x(),
        }
    }
}

/// Draws a run of a machine.
pub(super) fn draw(machine: &Machine, sequence: &Sequence) -> String {
    let mut svg = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut svg, machine, sequence);
    svg
}

fn write(svg: &mut String, machine: &Machine, sequence: &Sequence) -> fmt::Result {
    let events: Vec<Drawn> = drawn(sequence);
    let bottom = events.last().map_or(TOP, |drawn| drawn.bottom).saturating_add(ROW / 2);
    let height = bottom.saturating_add(10).saturating_add(figure::HEIGHT);
    write!(
        svg,
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" viewBox="0 0 {WIDTH} {height}" font-family="monospace" font-size="11" role="img"><title>Figure 2 and a sequence diagram of the run</title>"#
    )?;
    definitions(svg)?;
    write!(svg, r#"<rect width="{WIDTH}" height="{height}" fill="{BACKGROUND}"/>"#)?;
    figure::write(svg, machine, sequence, (125, 8))?;
    write!(svg, r#"<g transform="translate(0 {})">"#, figure::HEIGHT)?;
    for party in Party::ALL {
        let (x, name) = (party.x(), party.name());
        write!(
            svg,
            r#"<line class="lifeline" x1="{x}" y1="{TOP}" x2="{x}" y2="{bottom}" stroke="{LIFELINE}" stroke-dasharray="4 3"/><text x="{x}" y="26" fill="{TEXT}" font-size="14" font-weight="bold" text-anchor="middle">{name}</text>"#
        )?;
    }
    bands(svg, sequence.first, &events, bottom)?;
    let mut time = 0_u32;
    for drawn in &events {
        let Drawn { event, y, .. } = *drawn;
        if event.ms > 0 {
            time = time.saturating_add(event.ms);
            write!(svg, r#"<text x="6" y="{}" fill="{MUTED}">{}</text>"#, y + 4, seconds(time))?;
        }
        if event.from == event.to { own(svg, drawn)? } else { arrow(svg, drawn)? }
    }
    svg.write_str("</g></svg>")
}

/// An event with its place.
struct Drawn<'a> {
    event: &'a Event,
    /// Its words, in lines that fit.
    lines: Vec<String>,
    /// The height of the arrow.
    y: u32,
    /// Where the next event may begin.
    bottom: u32,
}

fn drawn(sequence: &Sequence) -> Vec<Drawn<'_>> {
    let mut bottom = TOP;
    sequence
        .events
        .iter()
        .map(|event| {
            let lines: Vec<String> = event.words.iter().flat_map(|words| wrapped(words)).collect();
            let more = u32::try_from(lines.len().saturating_sub(2)).unwrap_or(0);
            let y = bottom.saturating_add(ROW);
            bottom = y.saturating_add(more.saturating_mul(LINE));
            Drawn { event, lines, y, bottom }
        })
        .collect()
}

/// The words in lines that are broken after a comma.
fn wrapped(words: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for part in words.split_inclusive(", ") {
        match lines.last_mut() {
            Some(line) if line.len() + part.trim_end().len() <= LETTERS => line.push_str(part),
            _ => lines.push(part.to_owned()),
        }
    }
    lines
}

/// The arrow's head, and the flashing lights as stripes.
fn definitions(svg: &mut String) -> fmt::Result {
    write!(
        svg,
        r#"<defs><marker id="head" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="8" markerHeight="8" orient="auto"><path d="M0 0L8 4L0 8z" fill="{ARROW}"/></marker>"#
    )?;
    for light in AsState::ALL.map(Assi::of).into_iter().filter(|light| light.flashes()) {
        let (Paint { fill, .. }, Paint { fill: dark, .. }) = (shown(light), shown(Assi::Off));
        write!(
            svg,
            r#"<pattern id="{}" width="18" height="12" patternUnits="userSpaceOnUse"><rect width="18" height="12" fill="{fill}"/><rect width="18" height="4" fill="{dark}"/></pattern>"#,
            stripes(light)
        )?;
    }
    svg.write_str("</defs>")
}

/// The name of the stripes of a light that flashes.
fn stripes(light: Assi) -> String {
    light.to_string().replace(", ", "-")
}

const fn shown(light: Assi) -> Paint {
    Paint::of(light, Background::Dark)
}

/// What fills the band while the ASSI shows this.
fn fill(light: Assi) -> String {
    if light.flashes() { format!("url(#{})", stripes(light)) } else { shown(light).fill.to_owned() }
}

/// The colour of the name of a state on the background: that of its light, and a lighter blue.
const fn name_colour(light: Assi) -> &'static str {
    match light {
        Assi::Off => TEXT,
        Assi::YellowContinuous | Assi::YellowFlashing => shown(light).fill,
        Assi::BlueContinuous | Assi::BlueFlashing => LIGHT_BLUE,
    }
}

/// The band on the VCU's lifeline, from one change of the AS state to the next. The event that changes it names it.
fn bands(svg: &mut String, first: AsState, events: &[Drawn<'_>], bottom: u32) -> fmt::Result {
    let (mut begin, mut state) = (TOP, first);
    for drawn in events {
        if let Some(next) = drawn.event.enters {
            band(svg, state, begin, drawn.y)?;
            (begin, state) = (drawn.y, next);
        }
    }
    band(svg, state, begin, bottom)?;
    let colour = name_colour(Assi::of(first));
    let (x, y) = (Party::Vcu.x() + BAND + 6, TOP + 10);
    write!(
        svg,
        r#"<text x="{x}" y="{y}" fill="{colour}" font-weight="bold">{}</text>"#,
        Escaped(first.name())
    )
}

fn band(svg: &mut String, state: AsState, from: u32, to: u32) -> fmt::Result {
    let fill = fill(Assi::of(state));
    let (x, width, height) = (Party::Vcu.x() - BAND, 2 * BAND, to.saturating_sub(from));
    write!(
        svg,
        r##"<rect class="band" x="{x}" y="{from}" width="{width}" height="{height}" fill="{fill}" stroke="#0c1a2b"><title>{}</title></rect>"##,
        Escaped(state.name()),
    )
}

/// From one party to another: the first line stands above the arrow, the others below.
fn arrow(svg: &mut String, drawn: &Drawn<'_>) -> fmt::Result {
    let Drawn { event, ref lines, y, .. } = *drawn;
    let (from, to) = (event.from, event.to);
    let (x1, x2) = (from.edge(to), to.edge(from));
    write!(
        svg,
        r#"<path class="arrow" d="M{x1} {y}H{x2}" stroke="{ARROW}" stroke-width="1.5" fill="none" marker-end="url(#head)"/>"#
    )?;
    // An arrow that crosses a lifeline says what it is before it does.
    let middle = match (from, to) {
        (Party::Operator, _) => u32::midpoint(from.x(), Party::Ai.x()),
        _ => u32::midpoint(x1, x2),
    };
    for (line, words) in (0_u32..).zip(lines) {
        let (y, fill) = if line == 0 { (y - 5, TEXT) } else { (y + LINE * line, MUTED) };
        let words = Escaped(words.trim_end());
        write!(svg, r#"<text x="{middle}" y="{y}" fill="{fill}" text-anchor="middle">{words}</text>"#)?;
    }
    Ok(())
}

/// What a party does by itself: an arrow back to its own lifeline.
fn own(svg: &mut String, drawn: &Drawn<'_>) -> fmt::Result {
    let Drawn { event, ref lines, y, .. } = *drawn;
    let x = event.from.edge(Party::Vehicle);
    let (top, out) = (y - 10, x + LOOP);
    write!(
        svg,
        r#"<path class="arrow" d="M{x} {top}H{out}V{y}H{x}" stroke="{ARROW}" stroke-width="1.5" fill="none" marker-end="url(#head)"/>"#
    )?;
    let last = lines.len().saturating_sub(1);
    for (line, words) in lines.iter().enumerate() {
        let (fill, weight) = match event.enters {
            Some(state) if line == last => (name_colour(Assi::of(state)), "bold"),
            _ if line == 0 => (TEXT, "normal"),
            _ => (MUTED, "normal"),
        };
        let y = (y - 5).saturating_add(u32::try_from(line).unwrap_or(0).saturating_mul(LINE));
        let (x, words) = (out + 6, Escaped(words.trim_end()));
        write!(svg, r#"<text x="{x}" y="{y}" fill="{fill}" font-weight="{weight}">{words}</text>"#)?;
    }
    Ok(())
}

/// Text, with what XML reads as markup escaped.
struct Escaped<'a>(&'a str);

impl fmt::Display for Escaped<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.chars().try_for_each(|c| match c {
            '&' => f.write_str("&amp;"),
            '<' => f.write_str("&lt;"),
            '>' => f.write_str("&gt;"),
            '"' => f.write_str("&quot;"),
            c => f.write_char(c),
        })
    }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::Machine;
    use adsdv_spec::messages::{AmiState, AsState};
    use stateright::{Model, Path};

    use super::super::sequence::{self, Event, Party, Sequence};
    use super::super::{Act, Closed, ClosedAction};
    use super::{LINE, draw, wrapped};

    /// A mission up to an emergency while driving.
    const RUN: [ClosedAction; 20] = [
        ClosedAction::Operator(Act::Mission(AmiState::TrackDrive)),
        ClosedAction::Operator(Act::Tsms(true)),
        ClosedAction::Operator(Act::Asms(true)),
        ClosedAction::Operator(Act::EbsArmed(true)),
        ClosedAction::VcuCycle,
        ClosedAction::FrameToAi,
        ClosedAction::AiCycle,
        ClosedAction::FrameToVcu,
        ClosedAction::VcuCycle,
        ClosedAction::TimePasses,
        ClosedAction::Operator(Act::Go(true)),
        ClosedAction::VcuCycle,
        ClosedAction::FrameToAi,
        ClosedAction::AiCycle,
        ClosedAction::FrameToVcu,
        ClosedAction::TimePasses,
        ClosedAction::Faster,
        ClosedAction::RemoteEstop(true),
        ClosedAction::VcuCycle,
        ClosedAction::FrameToAi,
    ];

    fn path(model: &Closed) -> Path<super::super::ClosedState, ClosedAction> {
        let first = model.init_states().remove(0);
        Path::from_actions(model, first, &RUN).expect("each action is possible")
    }

    /// Whether tags are closed in the order in which they are opened, and nothing else looks like one.
    fn is_well_formed(svg: &str) -> bool {
        let mut open = Vec::new();
        let mut rest = svg;
        while let Some((text, tag)) = rest.split_once('<') {
            let Some((tag, after)) = tag.split_once('>') else { return false };
            let entities = text
                .split('&')
                .skip(1)
                .all(|entity| ["amp;", "lt;", "gt;", "quot;"].iter().any(|name| entity.starts_with(name)));
            if !entities || text.contains('>') || tag.matches('"').count() % 2 != 0 {
                return false;
            }
            let name = tag.split(' ').next().unwrap_or_default();
            match name.strip_prefix('/') {
                Some(name) if open.pop() != Some(name) => return false,
                None if !tag.ends_with('/') => open.push(name),
                _ => {}
            }
            rest = after;
        }
        open.is_empty() && rest.is_empty()
    }

    /// The first line of an arrow's words stands above it, each other one lower than the one before.
    #[test]
    fn words_have_lines_of_their_own() {
        let words = ["one", "two", "three", "four"].map(str::to_owned).to_vec();
        let event = Event { from: Party::Ai, to: Party::Vcu, words, enters: None, ms: 0 };
        let svg = draw(&Machine::REFERENCE, &Sequence { first: AsState::Off, events: vec![event] });
        let y = |text: &str| {
            let (before, _) = svg.split_once(&format!(">{text}</text>")).expect("it is there");
            let (_, tag) = before.rsplit_once(" y=\"").expect("it has a place");
            tag.split('"').next().and_then(|y| y.parse::<u32>().ok()).expect("a number")
        };
        assert!(y("one") < y("two"), "{svg}");
        assert_eq!((y("three") - y("two"), y("four") - y("three")), (LINE, LINE), "{svg}");
    }

    #[test]
    fn a_run_is_drawn() {
        let model = Closed::explorer(Machine::REFERENCE);
        let svg = model.as_svg(path(&model)).expect("a picture");
        assert!(is_well_formed(&svg), "{svg}");
        assert_eq!(svg.matches(r#"<path class="arrow""#).count(), RUN.len(), "one arrow for each action");
        assert_eq!(svg.matches(r#"class="lifeline""#).count(), Party::ALL.len());
        assert_eq!(svg.matches(r#"class="band""#).count(), 4, "one band for each AS state that lasts");
        let words = [
            "AS_OFF to AS_READY (3.1)",
            "AS_READY to AS_DRIVING (3.2)",
            "AS_DRIVING to EMERGENCY_BRAKE (3.7)",
            "520#0106410000000000",
            "HANDSHAKE 1, AS_OFF, TRACK_DRIVE",
            "510#0110000000000000",
            "HANDSHAKE 1, SELECTED, NEUTRAL",
            "&quot;Go&quot; on",
            "5000 ms pass",
            "5.02 s",
            "Operator",
            "AI Computer",
            "VCU",
            "Vehicle",
        ];
        for words in words {
            assert!(svg.contains(words), "{words}");
        }
        let figure = svg.split("<title>Figure 2, and the state").nth(1).expect("Figure 2 stands above it");
        assert!(
            figure.contains("<title>AS_READY to AS_DRIVING: 3.2, 5 second timer elapsed and"),
            "{figure}"
        );
        let current = figure.split(r#"stroke-width="5""#).nth(1).expect("the state that the run led to");
        assert!(current.contains(r#"font-weight="bold">EMERGENCY_BRAKE</text>"#), "{current}");
        let spaces = svg.matches("http://").count();
        assert_eq!(
            spaces,
            svg.matches(r#"xmlns="http://www.w3.org/2000/svg""#).count(),
            "only the namespace"
        );
    }

    #[test]
    fn bands_have_the_colours_of_the_assi() {
        let colours = AsState::ALL.map(|first| {
            let svg = draw(&Machine::REFERENCE, &Sequence { first, events: Vec::new() });
            assert!(is_well_formed(&svg) && svg.contains(first.name()));
            let band = svg.split(r#"class="band""#).nth(1).expect("a band");
            band.split(r#"fill=""#).nth(1).expect("a colour").split('"').next().expect("its name").to_owned()
        });
        assert_eq!(
            colours,
            ["#3a424b", "#ffd400", "url(#yellow-flashing)", "url(#blue-flashing)", "#3f6ee8"]
        );
    }

    #[test]
    fn text_is_escaped() {
        let event = Event {
            from: Party::Ai,
            to: Party::Vcu,
            words: vec!["a < b & \"c\" > d".to_owned()],
            enters: None,
            ms: 0,
        };
        let svg = draw(&Machine::REFERENCE, &Sequence { first: AsState::Off, events: vec![event] });
        assert!(is_well_formed(&svg) && svg.contains("a &lt; b &amp; &quot;c&quot; &gt; d"));
        assert!(!is_well_formed("<svg><b></svg>") && !is_well_formed("<svg>a & b</svg>"));
    }

    #[test]
    fn long_words_are_broken_after_a_comma() {
        let words = "HANDSHAKE 1, EMERGENCY_BRAKE, TRACK_DRIVE, HVIL OPEN FAULT";
        assert_eq!(wrapped(words).len(), 2);
        assert_eq!(wrapped(words).concat(), words);
        assert_eq!(wrapped("short"), ["short"]);
    }

    #[test]
    fn a_step_is_put_into_words() {
        let model = Closed::explorer(Machine::REFERENCE);
        let run = path(&model).into_vec();
        let steps: Vec<String> =
            run.iter().filter_map(|(state, action)| model.format_step(state, (*action)?)).collect();
        assert!(steps[8].starts_with("cycle of 10 ms, AS_OFF to AS_READY (3.1)\n"), "{}", steps[8]);
        assert!(
            steps[9].contains("\n> VCU          AS_READY, 5 second timer elapsed (5000 ms)"),
            "{}",
            steps[9]
        );
        assert!(steps[9].contains("\n  operator     mission TRACK_DRIVE, TSMS on, ASMS on"), "{}", steps[9]);
        let state = format!("{:#?}", run[5].0);
        assert!(
            state.contains("bus to AI    520#0106410000000000 (HANDSHAKE 1, AS_OFF, TRACK_DRIVE)"),
            "{state}"
        );
        assert_eq!(model.format_action(&RUN[10]), "operator: \"Go\" on");
    }

    #[test]
    fn time_passes_until_something_but_a_timer_changes() {
        let model = Closed::explorer(Machine::REFERENCE);
        let run = path(&model).into_vec();
        let passed: Vec<u32> = run
            .windows(2)
            .filter(|pair| pair[0].1 == Some(ClosedAction::TimePasses))
            .map(|pair| sequence::event(&model, &pair[0].0, ClosedAction::TimePasses, &pair[1].0).ms)
            .collect();
        assert_eq!(passed, [5000, 10], "to the end of the dwell, and until the AI Computer drives");
    }
}
