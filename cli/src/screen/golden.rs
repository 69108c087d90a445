//! What people see, against the files in `golden/`: a change of the screen shows as a change of a file that people read.
//! `UPDATE_EXPECT=1 cargo test -p adsdv --bin adsdv screen` writes them anew.

use std::path::Path;

use adsdv_can::status::Status;
use expect_test::expect_file;
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;

use super::render::render;
use super::{Screen, panel, sample};

/// What a terminal of this size shows.
pub(super) fn drawn(status: &Status, screen: &Screen, width: u16, height: u16) -> (Buffer, panel::Room) {
    let Ok(mut terminal) = Terminal::new(TestBackend::new(width, height));
    let mut room = panel::Room::default();
    let Ok(_) = terminal.draw(|frame| room = render(status, screen, frame.area(), frame.buffer_mut()));
    (terminal.backend().buffer().clone(), room)
}

/// Its text, without what is blank at the ends of lines.
fn text(buffer: &Buffer) -> String {
    let width = usize::from(buffer.area.width).max(1);
    let lines = buffer.content().chunks(width).map(|row| {
        let line: String = row.iter().map(ratatui::buffer::Cell::symbol).collect();
        line.trim_end().to_owned() + "\n"
    });
    lines.collect()
}

/// Compares a text with a file of the project.
pub(super) fn compare(file: &str, text: &str) {
    expect_file![Path::new(env!("CARGO_MANIFEST_DIR")).join(file)].assert_eq(text);
}

fn golden(name: &str, status: &Status, screen: &Screen, sizes: &[(u16, u16)]) {
    for &(width, height) in sizes {
        let (buffer, _) = drawn(status, screen, width, height);
        compare(&format!("src/screen/golden/{name}-{width}x{height}.txt"), &text(&buffer));
    }
}

const SIZES: [(u16, u16); 3] = [(80, 24), (100, 30), (120, 40)];

#[test]
fn off() {
    golden("off", &sample::off(), &Screen::new(true), &SIZES);
}

#[test]
fn ready() {
    golden("ready", &sample::ready(), &Screen::new(true), &SIZES);
}

#[test]
fn driving() {
    golden("driving", &sample::driving(), &Screen::new(true), &SIZES);
}

#[test]
fn emergency() {
    golden("emergency", &sample::emergency(), &Screen::new(true), &SIZES);
}

#[test]
fn without_power() {
    golden("dark", &sample::dark(), &Screen::new(true), &[(100, 30)]);
}

#[test]
fn help() {
    let screen = Screen { help: true, ..Screen::new(true) };
    golden("help", &sample::driving(), &screen, &[(80, 24), (100, 30)]);
}

#[test]
fn figure_2() {
    let screen = Screen { figure: true, ..Screen::new(true) };
    golden("figure", &sample::driving(), &screen, &[(80, 24), (100, 30)]);
}

#[test]
fn scrolled_back() {
    let screen = Screen { back: 4, ..Screen::new(true) };
    golden("scrolled", &sample::emergency(), &screen, &[(100, 30)]);
}

/// As far as there is room: what is wrong with the bus is more urgent.
#[test]
fn the_first_line_says_how_the_edition_was_chosen() {
    let chosen = "edition 3.0 (default; --edition 9.9 for today's car)";
    let long = format!("VCU of {chosen} on vcan0 ");
    let short = "VCU of edition 3.0 on vcan0  ";
    let screen = Screen::new(true).of(&chosen);
    for (status, screen, width, begins) in [
        (sample::off(), &screen, 120, long.as_str()),
        (sample::off(), &screen, 100, &long),
        (sample::off(), &screen, 80, short),
        (sample::emergency(), &screen, 120, &(long.clone() + " the interface is down")),
        (sample::emergency(), &screen, 100, &(short.to_owned() + "the interface is down")),
        (sample::off(), &Screen::new(true), 120, short),
    ] {
        let text = text(&drawn(&status, screen, width, 40).0);
        let line = text.lines().next().unwrap_or_default();
        assert!(line.starts_with(begins) && line.ends_with("q quit"), "{width}: {line}");
    }
}

#[test]
fn the_screen_reports_a_terminal_that_is_too_small() {
    let (buffer, room) = drawn(&sample::driving(), &Screen::new(true), 20, 5);
    assert_eq!(text(&buffer), "AS_DRIVING\ntoo small: 20x5\nneeded: 80x24\nq quits\n\n");
    assert_eq!(room, panel::Room::default());
}

#[test]
fn no_size_is_too_small_or_too_large_to_be_drawn() {
    let heights = [0, 1, 5, 23, 24, 29, 30, 31, 36, 90];
    let widths = [0, 1, 2, 20, 79, 80, 81, 99, 100, 101, 250];
    for status in [sample::off(), sample::emergency(), sample::dark(), Status::default()] {
        for (width, height) in widths.iter().flat_map(|&width| heights.map(|height| (width, height))) {
            for (help, figure) in [(false, false), (true, false), (false, true)] {
                let screen = Screen { help, figure, back: 1000, ..Screen::new(true) };
                drawn(&status, &screen, width, height);
            }
        }
    }
}

#[test]
fn every_switch_can_be_seen_in_every_size() {
    for (width, height) in SIZES {
        let (buffer, _) = drawn(&sample::emergency(), &Screen::new(true), width, height);
        let text = text(&buffer);
        for key in super::keys::KEYS {
            let line = format!("{} {}", key.stroke, key.name);
            assert!(
                text.lines().any(|found| found.starts_with(&line)),
                "{line:?} in {width}x{height}:\n{text}"
            );
        }
    }
}

#[test]
fn without_color_there_is_none_and_the_words_are_the_same() {
    for status in [sample::driving(), sample::emergency()] {
        let [with, without] = [true, false].map(|color| drawn(&status, &Screen::new(color), 100, 30).0);
        assert_eq!(text(&with), text(&without));
        let reset = ratatui::style::Color::Reset;
        assert!(with.content().iter().any(|cell| cell.fg != reset));
        assert!(without.content().iter().all(|cell| cell.fg == reset && cell.bg == reset));
    }
}

#[test]
fn a_flashing_light_changes_its_style_and_no_word() {
    for color in [true, false] {
        let [lit, dark] = [true, false]
            .map(|lit| drawn(&sample::driving(), &Screen { lit, ..Screen::new(color) }, 100, 30).0);
        assert_eq!(text(&lit), text(&dark));
        assert_ne!(lit, dark);
    }
}
