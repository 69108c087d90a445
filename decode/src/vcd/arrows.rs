//! The waves of Figure 2: of each arrow whether it is blocked, and by which conditions.

use std::io::{self, Write};

use ::vcd::{IdCode, Value as Level, Writer};
use adsdv_oracle::why::{Condition, Stay};
use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Edition};

use crate::watch;

/// The waves of every arrow.
pub(super) struct Arrows(Vec<Arrow>);

struct Arrow {
    from: AsState,
    to: AsState,
    blocked: Wave,
    conditions: Vec<(Atom, bool, Wave)>,
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

    fn show<W: Write>(&mut self, writer: &mut Writer<W>, level: Level) -> io::Result<()> {
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
        for row in edition.rules.table.rows() {
            writer.add_module(&format!("{}_to_{}", row.from.name(), row.to.name()))?;
            let blocked = Wave::new(writer, "blocked")?;
            let mut literals: Vec<(Atom, bool)> =
                row.terms().iter().flat_map(adsdv_spec::Term::literals).collect();
            literals.sort_unstable();
            literals.dedup();
            let mut conditions = Vec::new();
            for (atom, needed) in literals {
                let not = if needed { "" } else { "not_" };
                let name = format!("{not}{}", atom.id().replace('-', "_"));
                conditions.push((atom, needed, Wave::new(writer, &name)?));
            }
            writer.upscope()?;
            arrows.push(Arrow { from: row.from, to: row.to, blocked, conditions });
        }
        writer.upscope()?;
        Ok(Self(arrows))
    }

    /// Nothing is known yet.
    pub(super) fn dump<W: Write>(&self, writer: &mut Writer<W>) -> io::Result<()> {
        for arrow in &self.0 {
            let conditions = arrow.conditions.iter().map(|(_, _, wave)| wave);
            for wave in conditions.chain([&arrow.blocked]) {
                writer.change_scalar(wave.id, Level::X)?;
            }
        }
        Ok(())
    }

    /// This is the state now, and these are its arrows.
    pub(super) fn show<W: Write>(&mut self, writer: &mut Writer<W>, stay: Option<&Stay>) -> io::Result<()> {
        for Arrow { from, to, blocked, conditions } in &mut self.0 {
            let stay = stay.filter(|stay| stay.state == *from);
            let untaken = stay.and_then(|stay| stay.arrows.iter().find(|untaken| untaken.to == *to));
            let Some(untaken) = untaken else {
                blocked.show(writer, Level::X)?;
                conditions.iter_mut().try_for_each(|(_, _, wave)| wave.show(writer, Level::X))?;
                continue;
            };
            let now = watch::now(untaken);
            blocked.show(writer, Level::from(now.is_some()))?;
            for place in 0..conditions.len() {
                // What holds is named without what it has to be, which counts where the guard asks for both.
                let both = |atom: Atom| conditions.iter().filter(|(other, _, _)| *other == atom).count() > 1;
                let is_both = conditions.get(place).is_some_and(|(atom, _, _)| both(*atom));
                let Some((atom, needed, wave)) = conditions.get_mut(place) else { continue };
                let is_this = |one: &Condition| (one.atom, one.needed) == (*atom, *needed);
                let level = match now {
                    Some(now) if now.failed.iter().any(is_this) => Level::V0,
                    Some(now) if now.holding.has(*atom) && !is_both => Level::V1,
                    _ => Level::X,
                };
                wave.show(writer, level)?;
            }
        }
        Ok(())
    }
}
