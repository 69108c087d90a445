//! Where everything stands on the screen.
//!
//! ```text
//! 100 x 30 and more               80 x 24 and more
//! +----------------------------+  +--------------------+
//! | bus, time, help            |  | bus, time, help    |
//! | switches | state | missing |  | switches | state   |
//! |          | AI Computer     |  |          | AI      |
//! |          | handshake | bus |  |          | the bus |
//! |          | faults    |     |  |          | missing |
//! | what happened              |  |          | what    |
//! +----------------------------+  +--------------------+
//! ```

use adsdv_can::status::Status;
use ratatui::buffer::Buffer;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::text::{Line, Span, Text};
use ratatui::widgets::Widget as _;

use super::Screen;
use super::figure;
use super::help;
use super::panel::{
    self, bus, faults, flow, handshake, happened, missing, requests, seconds, state, switches, title,
};
use super::theme::{STRONG, Theme};

/// In less than this nothing fits.
const SMALLEST: (u16, u16) = (80, 24);
/// From this on there is room for everything.
const ROOMY: (u16, u16) = (100, 30);
/// The width of the switches.
const SWITCHES: u16 = 28;
/// The height of the light.
const LIGHT: u16 = 3;
/// The height of the state with its rule.
const STATE: u16 = LIGHT + 4;
/// What happened has so many lines at least, with its rule.
const SMALLEST_LOG: u16 = 2;
/// What happened has so many lines before anything is drawn with more room than it needs.
const ROOMY_LOG: u16 = 10;

/// Draws the screen, and tells how much of what happened is seen.
pub(super) fn render(status: &Status, screen: &Screen, area: Rect, buffer: &mut Buffer) -> panel::Room {
    let theme = Theme::new(screen.color);
    if !has(area, SMALLEST) {
        too_small(status, area, buffer);
        return panel::Room::default();
    }
    let [head, body] = area.layout(&Layout::vertical([Constraint::Length(1), Constraint::Fill(1)]));
    header(status, screen, theme, head, buffer);
    let drawing = Drawing { status, screen, theme };
    let room = if has(area, ROOMY) { drawing.roomy(body, buffer) } else { drawing.compact(body, buffer) };
    if screen.figure {
        figure::draw(status, screen.lit, theme, body, buffer);
    }
    if screen.help {
        help::draw(theme, area, buffer);
    }
    room
}

fn has(area: Rect, (width, height): (u16, u16)) -> bool {
    area.width >= width && area.height >= height
}

/// What fits in next to no room: the state, and why there is no more.
fn too_small(status: &Status, area: Rect, buffer: &mut Buffer) {
    let (width, height) = SMALLEST;
    let state = status.outputs.map_or("no power", |outputs| outputs.state.name());
    let lines = [
        Line::styled(state, STRONG),
        Line::raw(format!("too small: {}x{}", area.width, area.height)),
        Line::raw(format!("needed: {width}x{height}")),
        Line::raw("q quits"),
    ];
    Text::from_iter(lines).render(area, buffer);
}

/// The edition and, where there is room, how it was chosen; the bus and what is wrong with it; the time; how to get help.
fn header(status: &Status, screen: &Screen, theme: Theme, area: Rect, buffer: &mut Buffer) {
    let right = Line::from(vec![
        Span::raw(seconds(status.time_ms)),
        Span::styled("   ?", theme.key()),
        Span::raw(" help "),
        Span::styled(" q", theme.key()),
        Span::raw(" quit"),
    ]);
    let width = u16::try_from(right.width()).unwrap_or(u16::MAX);
    let parts = Layout::horizontal([Constraint::Fill(1), Constraint::Length(width)]).spacing(2);
    let [left_area, right_area] = area.layout(&parts);
    let short = format!("edition {}", status.edition);
    let left = [&screen.edition, &short].map(|edition| vcu_on_bus(status, edition, theme));
    let fits = |line: &Line<'_>| line.width() <= usize::from(left_area.width);
    let [long, short] = left;
    if fits(&long) && !screen.edition.is_empty() { long } else { short }.render(left_area, buffer);
    right.render(right_area, buffer);
}

/// The left of the first line.
fn vcu_on_bus(status: &Status, edition: &str, theme: Theme) -> Line<'static> {
    let mut line = Line::from(vec![
        Span::raw(format!("VCU of {edition} on ")),
        Span::styled(status.bus.clone(), STRONG),
    ]);
    if let Some(trouble) = &status.trouble {
        line.push_span(Span::styled(format!("  {trouble}"), theme.bad()));
    }
    line
}

struct Drawing<'a> {
    status: &'a Status,
    screen: &'a Screen,
    theme: Theme,
}

impl Drawing<'_> {
    fn roomy(&self, area: Rect, buffer: &mut Buffer) -> panel::Room {
        let (status, theme) = (self.status, self.theme);
        let [_, right] = columns(area);
        let [left_half, right_half] = halves(right);
        let [left_width, right_width] = [left_half, right_half].map(|half| usize::from(half.width));
        let handshake = flow(handshake::pieces(status, theme, true), left_width);
        let faults = flow(faults::pieces(status, theme), left_width);
        let mut bus = flow(bus::frames(status, theme, true), right_width);
        bus.extend(flow(bus::cycles(status, theme), right_width));

        let last = panel::height(&handshake).saturating_add(panel::height(&faults)).max(panel::height(&bus));
        let first = panel::rows(missing::height(status)).max(STATE);
        let needed = (requests::HEIGHT + 1).saturating_add(first).saturating_add(last);
        let with_headings = switches_height(true);
        // The headings of the switches have to leave a good deal of what happened.
        let headings = area.height >= with_headings.saturating_add(ROOMY_LOG);
        let main = needed.max(switches_height(headings)).min(area.height.saturating_sub(SMALLEST_LOG));
        let [main, log] = area.layout(&Layout::vertical([Constraint::Length(main), Constraint::Fill(1)]));
        let [left, right] = columns(main);
        self.switches(left, headings, buffer);
        let rows =
            [Constraint::Min(STATE), Constraint::Length(requests::HEIGHT + 1), Constraint::Length(last)];
        let [top, middle, bottom] = right.layout(&Layout::vertical(rows));
        let [state, missing] = halves(top);
        self.state(state, buffer);
        self.missing(missing, buffer);
        self.requests(middle, buffer);
        let [left, right] = halves(bottom);
        let rows = [Constraint::Length(panel::height(&handshake)), Constraint::Fill(1)];
        let [left_top, left_bottom] = left.layout(&Layout::vertical(rows));
        panel::draw(title("Handshake"), handshake, left_top, buffer);
        panel::draw(title("Faults and warnings"), faults, left_bottom, buffer);
        panel::draw(title("Frames and cycles"), bus, right, buffer);
        self.happened(log, buffer)
    }

    fn compact(&self, area: Rect, buffer: &mut Buffer) -> panel::Room {
        let (status, theme) = (self.status, self.theme);
        let [left, right] = columns(area);
        self.switches(left, false, buffer);
        let width = usize::from(right.width);
        let labelled = |text: &'static str, mut pieces: Vec<Vec<Span<'static>>>| {
            pieces.insert(0, vec![Span::styled(text, STRONG)]);
            flow(pieces, width)
        };
        // The last ones give way if there is much to tell.
        let mut lines = labelled("Faults", faults::pieces(status, theme));
        lines.extend(missing::in_a_row(status, theme, width));
        lines.extend(labelled("Handshake", handshake::pieces(status, theme, false)));
        lines.extend(labelled("Frames", bus::frames(status, theme, false)));
        lines.extend(flow(bus::cycles(status, theme), width));
        let rows = [
            Constraint::Length(LIGHT),
            Constraint::Length(requests::HEIGHT + 1),
            Constraint::Max(panel::height(&lines)),
            Constraint::Min(SMALLEST_LOG),
        ];
        let [top, requests, others, log] = right.layout(&Layout::vertical(rows));
        self.light_and_words(top, buffer);
        self.requests(requests, buffer);
        panel::draw("", lines, others, buffer);
        self.happened(log, buffer)
    }

    /// The light, and beside it what it means.
    fn light_and_words(&self, area: Rect, buffer: &mut Buffer) {
        let parts = Layout::horizontal([Constraint::Length(20), Constraint::Fill(1)]).spacing(2);
        let [light, words] = area.layout(&parts);
        let width = usize::from(light.width);
        Text::from(state::light(self.status, self.screen.lit, self.theme, width)).render(light, buffer);
        let lines = state::words(self.status).into_iter().chain([state::motion(self.status)]);
        lines.collect::<Text<'_>>().render(words, buffer);
    }

    fn switches(&self, area: Rect, headings: bool, buffer: &mut Buffer) {
        let lines = switches::lines(self.status, self.theme, usize::from(area.width), headings);
        panel::draw(title("Switches"), lines, area, buffer);
    }

    fn state(&self, area: Rect, buffer: &mut Buffer) {
        let mut lines = state::light(self.status, self.screen.lit, self.theme, usize::from(area.width));
        let [light, mut time] = state::words(self.status);
        time.push_span("   ");
        time.extend(state::motion(self.status));
        lines.extend([light, time, state::wheels(&self.status.inputs)]);
        panel::draw(title("AS state"), lines, area, buffer);
    }

    fn missing(&self, area: Rect, buffer: &mut Buffer) {
        let inner = usize::from(area.height.saturating_sub(1));
        let lines = missing::lines(self.status, self.theme, usize::from(area.width), inner);
        panel::draw(title(&missing::title(self.status)), lines, area, buffer);
    }

    fn requests(&self, area: Rect, buffer: &mut Buffer) {
        let width = usize::from(area.width);
        let lines = requests::lines(self.status, self.theme, width);
        panel::draw(requests::title(width), lines, area, buffer);
    }

    fn happened(&self, area: Rect, buffer: &mut Buffer) -> panel::Room {
        let height = usize::from(area.height.saturating_sub(1));
        let back = self.screen.back;
        let (lines, room) = happened::lines(self.status, self.theme, usize::from(area.width), height, back);
        let title = happened::title(self.status, self.theme, back.min(room.most_back));
        panel::draw(title, lines, area, buffer);
        room
    }
}

/// The height of the switches with their rule.
fn switches_height(headings: bool) -> u16 {
    panel::height(&switches::lines(&Status::default(), Theme::new(false), 0, headings))
}

fn halves(area: Rect) -> [Rect; 2] {
    area.layout(&Layout::horizontal([Constraint::Fill(1), Constraint::Fill(1)]).spacing(1))
}

/// The switches, and the rest.
fn columns(area: Rect) -> [Rect; 2] {
    area.layout(&Layout::horizontal([Constraint::Length(SWITCHES), Constraint::Fill(1)]).spacing(2))
}
