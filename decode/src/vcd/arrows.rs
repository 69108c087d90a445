//! The waves of Figure 2: of each arrow whether it is blocked, and by which conditions.

use std::io::{self, Write};

use ::vcd::{IdCode, Value as Level, Writer};
use adsdv_oracle::why::Stay;
use adsdv_spec::Edition;

use crate::arrows::{GuardedArrow, condition_name};

/// The waves of every arrow.
pub(super) struct Arrows(Vec<Arrow>);

struct Arrow {
    of: GuardedArrow,
    blocked: Wave,
    /// One of each condition.
    conditions: Vec<Wave>,
}

/// A wave of one bit, and what it showed last.
struct Wave {
    id: IdCode,
    level: Level,
}

impl Wave {
    fn new<W: Write>(writer: &mut Writer<W>, name: &str) -> io::Result<Self> {
        Ok(Self { id: writer.add_wire(1, name)?, level: Level::X })
    }

    fn show<W: Write>(&mut self, writer: &mut Writer<W>, known: Option<bool>) -> io::Result<()> {
        let level = known.map_or(Level::X, Level::from);
        if self.level == level {
            return Ok(());
        }
        self.level = level;
        writer.change_scalar(self.id, level)
    }
}

impl Arrows {
    pub(super) fn begin<W: Write>(writer: &mut Writer<W>, edition: &Edition) -> io::Result<Self> {
        writer.add_module("blocked")?;
        let mut arrows = Vec::new();
        for arrow in GuardedArrow::all(edition) {
            writer.add_module(&arrow.name())?;
            let blocked = Wave::new(writer, "blocked")?;
            let mut conditions = Vec::new();
            for condition in &arrow.conditions {
                conditions.push(Wave::new(writer, &condition_name(*condition))?);
            }
            writer.upscope()?;
            arrows.push(Arrow { of: arrow, blocked, conditions });
        }
        writer.upscope()?;
        Ok(Self(arrows))
    }

    /// Nothing is known yet.
    pub(super) fn dump<W: Write>(&self, writer: &mut Writer<W>) -> io::Result<()> {
        for arrow in &self.0 {
            for wave in arrow.conditions.iter().chain([&arrow.blocked]) {
                writer.change_scalar(wave.id, Level::X)?;
            }
        }
        Ok(())
    }

    /// This is the state now, and these are its arrows.
    pub(super) fn show<W: Write>(&mut self, writer: &mut Writer<W>, stay: Option<&Stay>) -> io::Result<()> {
        for Arrow { of: arrow, blocked, conditions } in &mut self.0 {
            let now = arrow.now(stay);
            blocked.show(writer, now.blocked)?;
            for (condition, wave) in arrow.conditions.iter().zip(conditions) {
                wave.show(writer, arrow.holds(*condition, now))?;
            }
        }
        Ok(())
    }
}
