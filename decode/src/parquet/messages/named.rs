//! Names that tell one thing from another.

use std::collections::HashSet;

/// The names that are taken.
pub(super) struct Names {
    taken: HashSet<String>,
    has_case: bool,
}

impl Names {
    /// Names of which `a` and `A` are two.
    pub(super) fn with_case<const N: usize>(taken: [&str; N]) -> Self {
        Self { taken: taken.map(str::to_owned).into(), has_case: true }
    }

    /// Names of which `a` and `A` are one.
    pub(super) fn without_case<const N: usize>(taken: [&str; N]) -> Self {
        Self { taken: taken.map(str::to_owned).into(), has_case: false }
    }

    /// A name for a column: this one, or with a number behind it.
    pub(super) fn column(&mut self, name: &str) -> String {
        self.first([name.to_owned()].into_iter(), name)
    }

    /// A name for a file: this one, or with the identifier behind it, or a number.
    pub(super) fn file(&mut self, name: &str, id: &str) -> String {
        let safe = |c: char| if c.is_alphanumeric() || matches!(c, '_' | '-') { c } else { '_' };
        let name: String = name.chars().map(safe).collect();
        let with_id = format!("{name}_{id}");
        self.first([name, with_id.clone()].into_iter(), &with_id)
    }

    fn first(&mut self, names: impl Iterator<Item = String>, name: &str) -> String {
        let key = |name: &str| if self.has_case { name.to_owned() } else { name.to_lowercase() };
        let mut all = names.chain((2_u64..).map(|number| format!("{name}_{number}")));
        let Some(free) = all.find(|name| !self.taken.contains(&key(name))) else { return name.to_owned() };
        self.taken.insert(key(&free));
        free
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_is_given_twice() {
        let mut columns = Names::with_case(["time"]);
        assert_eq!(
            ["A", "time", "A", "a", "A_2"].map(|name| columns.column(name)),
            ["A", "time_2", "A_2", "a", "A_2_2"]
        );
        let mut files = Names::without_case(["unknown_frames"]);
        let pairs = [("A", "001"), ("a", "002"), ("a", "002"), ("../b", "003"), ("Unknown_frames", "004")];
        assert_eq!(
            pairs.map(|(name, id)| files.file(name, id)),
            ["A", "a_002", "a_002_2", "___b", "Unknown_frames_004"]
        );
    }
}
