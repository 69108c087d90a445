//! Where the document draws the states of Figure 2, and how arrows run between them: one picture for the pages, the Explorer, the
//! terminal and SVG.

use core::fmt;

use crate::messages::AsState;

/// The width and the height of the picture. All sizes are in its units, which are pixels where nothing scales it.
pub const SIZE: (f64, f64) = (WHOLE.0 as f64, WHOLE.1 as f64);
/// The same in whole numbers.
pub(super) const WHOLE: (u32, u32) = (800, 382);
/// The width and the height of a state's box.
pub const BOX: (f64, f64) = (170.0, 52.0);

/// How far the lines of two arrows are apart that lead to and fro.
const APART: f64 = 35.0;
/// How far the next arrow between the same states is from the one before.
const NEXT: f64 = 38.0;
/// How far an arrow goes around a box that is in its way.
const AROUND: f64 = 208.0;
/// From this length on an arrow crosses others: its label stands nearer to its beginning.
const LONG: f64 = 400.0;

/// A point, from the upper left corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// To the right.
    pub x: f64,
    /// Downwards.
    pub y: f64,
}

/// The middle of a state's box.
pub const fn place(state: AsState) -> Point {
    let (x, y) = match state {
        AsState::Off => (400.0, 50.0),
        AsState::Ready => (400.0, 190.0),
        AsState::Driving => (400.0, 330.0),
        AsState::EmergencyBrake => (120.0, 260.0),
        AsState::Finished => (680.0, 260.0),
    };
    Point { x, y }
}

/// How an arrow runs: a curve from the edge of a box to that of another. Displays as the path of an SVG.
///
/// ```
/// use adsdv_spec::AsState;
/// use adsdv_spec::export::Line;
///
/// let line = Line::among([(AsState::Off, AsState::Ready)].into_iter(), 0).expect("there is one");
/// assert_eq!(line.to_string(), "M400 76 Q400 120 400 164");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Where it begins.
    pub from: Point,
    /// Where it is bent to: the control point of a quadratic curve.
    pub bend: Point,
    /// Where it ends.
    pub to: Point,
    /// The middle of its label.
    pub label: Point,
    /// How far the states are apart.
    pub length: f64,
}

impl Line {
    /// The line of one of these arrows, by its place among them: what would lie on the line of another, or go through a box, is bent
    /// to its side. `None` where there is no such place.
    pub fn among(arrows: impl Iterator<Item = (AsState, AsState)> + Clone, which: usize) -> Option<Self> {
        let (from, to) = arrows.clone().nth(which)?;
        let (begin, end) = (place(from), place(to));
        let (dx, dy) = (end.x - begin.x, end.y - begin.y);
        let length = root(dx * dx + dy * dy);
        let back = arrows.clone().any(|one| one == (to, from));
        let in_the_way = AsState::ALL.into_iter().any(|state| {
            let (x, y) = (place(state).x - begin.x, place(state).y - begin.y);
            let along = (x * dx + y * dy) / length;
            state != from && state != to && along > 0.0 && along < length && {
                abs(x * dy - y * dx) / length < BOX.1 / 2.0
            }
        });
        let mut aside = if back { APART } else { 0.0 } + if in_the_way { AROUND } else { 0.0 };
        for _ in arrows.take(which).filter(|one| *one == (from, to)) {
            aside += NEXT;
        }
        let middle = |one: f64, other: f64| f64::midpoint(one, other);
        let bend = Point {
            x: middle(begin.x, end.x) - dy / length * aside,
            y: middle(begin.y, end.y) + dx / length * aside,
        };
        let line = Self { from: edge(begin, bend), bend, to: edge(end, bend), label: bend, length };
        Some(Self { label: line.at(if length > LONG { 0.28 } else { 0.5 }), ..line })
    }

    /// The point of it at a share of its way, from 0 to 1.
    pub fn at(&self, share: f64) -> Point {
        let rest = 1.0 - share;
        let on = |from: f64, bend: f64, to: f64| {
            rest * rest * from + 2.0 * share * rest * bend + share * share * to
        };
        Point { x: on(self.from.x, self.bend.x, self.to.x), y: on(self.from.y, self.bend.y, self.to.y) }
    }
}

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { from, bend, to, .. } = self;
        write!(f, "M{from} Q{bend} {to}")
    }
}

/// To a tenth: nobody sees less.
impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", Tenths(self.x), Tenths(self.y))
    }
}

/// Displays a number of the picture to a tenth.
pub(super) struct Tenths(pub(super) f64);

impl fmt::Display for Tenths {
    #[expect(clippy::cast_possible_truncation, reason = "what is in the picture has few digits")]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let tenths = (self.0 * 10.0 + 0.5) as i32;
        match (tenths / 10, tenths % 10) {
            (whole, 0) => write!(f, "{whole}"),
            (whole, tenth) => write!(f, "{whole}.{tenth}"),
        }
    }
}

/// A point on the edge of a box, on the way from its middle to another point.
fn edge(middle: Point, other: Point) -> Point {
    let (dx, dy) = (other.x - middle.x, other.y - middle.y);
    let near = |half: f64, distance: f64| half / abs(distance).max(0.01);
    let share = near(BOX.0 / 2.0, dx).min(near(BOX.1 / 2.0, dy)).min(1.0);
    Point { x: middle.x + dx * share, y: middle.y + dy * share }
}

/// What `f64::abs` is with `std`.
fn abs(number: f64) -> f64 {
    number.max(-number)
}

/// The square root, as far as a picture needs it; at least 1, so that it can be divided by.
fn root(square: f64) -> f64 {
    let mut root = square.max(1.0);
    for _ in 0..32 {
        root = f64::midpoint(root, square.max(1.0) / root);
    }
    root
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_of_a_square_is_its_side() {
        for side in [1.0, 35.0, 280.0, 640.0] {
            assert!(abs(root(side * side) - side) < 1e-9);
        }
        assert!(abs(root(0.0) - 1.0) < 1e-9);
    }

    /// All arrows that there could be, and each twice.
    fn arrows() -> impl Iterator<Item = (AsState, AsState)> + Clone {
        let pairs = AsState::ALL.into_iter().flat_map(|from| AsState::ALL.map(|to| (from, to)));
        pairs.clone().chain(pairs)
    }

    #[test]
    fn no_two_labels_stand_on_each_other_and_all_are_in_the_picture() {
        let table = crate::Edition::V3_0.rules.table;
        let arrows = || table.rows().iter().map(|row| (row.from, row.to));
        let lines = || (0..arrows().count()).filter_map(|which| Line::among(arrows(), which));
        for (place, one) in lines().enumerate() {
            assert!(one.label.x > 17.0 && one.label.x < SIZE.0 - 17.0, "{one:?}");
            assert!(one.label.y > 10.0 && one.label.y < SIZE.1 - 10.0, "{one:?}");
            for other in lines().skip(place + 1) {
                let (dx, dy) = (abs(one.label.x - other.label.x), abs(one.label.y - other.label.y));
                assert!(dx > 34.0 || dy > 20.0, "{one:?} {other:?}");
            }
        }
    }

    #[test]
    fn an_arrow_of_any_two_states_begins_and_ends_at_their_boxes() {
        for (which, (from, to)) in arrows().enumerate() {
            let line = Line::among(arrows(), which).expect("it is there");
            for (point, state) in [(line.from, from), (line.to, to)] {
                let (dx, dy) = (abs(point.x - place(state).x), abs(point.y - place(state).y));
                assert!(dx <= BOX.0 / 2.0 + 1e-9 && dy <= BOX.1 / 2.0 + 1e-9, "{from} {to}: {line:?}");
            }
        }
        assert_eq!(Line::among(arrows(), arrows().count()), None);
    }
}
