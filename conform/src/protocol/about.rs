//! What a program says of itself, in a line before its first answer or beside the edition that it is of.

use super::bad_line::{BadLine, Given, Object};
use super::spoken::Protocol;

/// The longest cycle that makes sense, in milliseconds.
const LONGEST_CYCLE: i64 = 1000;

/// What a program says of itself. All of it may be left out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct About {
    /// The keys of the inputs that it reads; `None`: all.
    pub inputs: Option<Vec<&'static str>>,
    /// The keys of the outputs that it shows; `None`: it is seen what they are.
    pub outputs: Option<Vec<&'static str>>,
    /// The cycle at which it steps, in milliseconds; `None`: any time may pass between two steps.
    pub cycle_ms: Option<u32>,
    /// Whether its time is that of a clock on the wall, and not what a step says.
    pub wall_clock: bool,
}

/// The keys of such a line.
const KEYS: [&str; 4] = ["inputs", "outputs", "cycle_ms", "clock"];

impl About {
    /// Reads a line; `None` if it says nothing of the program itself.
    ///
    /// ```
    /// use adsdv_conform::protocol::{About, Protocol};
    /// use adsdv_spec::Edition;
    ///
    /// let protocol = Protocol::of(&Edition::V3_0);
    /// let about = About::read(r#"{"inputs":["asms","tsms"],"cycle_ms":10,"clock":"wall"}"#, &protocol)?;
    /// let about = about.expect("it says something");
    /// assert_eq!((about.inputs, about.cycle_ms, about.wall_clock), (Some(vec!["asms", "tsms"]), Some(10), true));
    /// assert_eq!(About::read(r#"{"as_state":"AS_OFF"}"#, &protocol)?, None);
    /// # Ok::<(), adsdv_conform::protocol::BadLine>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Fails if a key has a value that it cannot have.
    pub fn read(line: &str, protocol: &Protocol) -> Result<Option<Self>, BadLine> {
        let Ok(Object(entries)) = Object::read(line) else { return Ok(None) };
        if !entries.iter().any(|(key, _)| KEYS.contains(&key.as_ref())) {
            return Ok(None);
        }
        let mut about = Self::default();
        let inputs: Vec<&str> = protocol.inputs().map(|(field, _)| field.key).collect();
        let outputs: Vec<&str> = protocol.shown().map(|(field, _)| field.key).collect();
        for (key, found) in &entries {
            match (key.as_ref(), found) {
                ("inputs", found) => about.inputs = Some(keys(key, found, &inputs)?),
                ("outputs", found) => about.outputs = Some(keys(key, found, &outputs)?),
                ("cycle_ms", Given::Number(cycle)) if (1..=LONGEST_CYCLE).contains(cycle) => {
                    about.cycle_ms = u32::try_from(*cycle).ok();
                }
                ("cycle_ms", found) => {
                    return Err(BadLine::value(
                        key,
                        found,
                        format!("a whole number from 1 to {LONGEST_CYCLE}"),
                    ));
                }
                ("clock", Given::Text(clock)) if clock == "wall" => about.wall_clock = true,
                ("clock", Given::Text(clock)) if clock == "steps" => about.wall_clock = false,
                ("clock", found) => return Err(BadLine::value(key, found, "\"wall\" or \"steps\"")),
                _ => {}
            }
        }
        Ok(Some(about))
    }
}

/// A list of keys that there are.
fn keys(key: &str, found: &Given<'_>, known: &[&'static str]) -> Result<Vec<&'static str>, BadLine> {
    let Given::List(names) = found else { return Err(BadLine::value(key, found, "a list of keys")) };
    let find = |name: &String| known.iter().find(|known| *known == name).copied();
    let unknown = |name: &str| BadLine::unknown(name, known.iter().copied());
    names.iter().map(|name| find(name).ok_or_else(|| unknown(name))).collect()
}

#[cfg(test)]
mod tests {
    use adsdv_spec::Edition;

    use super::*;

    #[test]
    fn what_cannot_be_so_is_refused_with_what_is_expected() {
        for (line, error) in [
            (r#"{"inputs":["gas"]}"#, "there is no key \"gas\"; expected one of asms"),
            (r#"{"outputs":"as_state"}"#, "\"outputs\" is \"as_state\"; expected a list of keys"),
            (r#"{"outputs":[1]}"#, "\"outputs\" is a list; expected a list of keys"),
            (r#"{"cycle_ms":0}"#, "\"cycle_ms\" is 0; expected a whole number from 1 to 1000"),
            (r#"{"clock":"sun"}"#, "\"clock\" is \"sun\"; expected \"wall\" or \"steps\""),
        ] {
            let said = About::read(line, &Protocol::of(&Edition::V3_0)).expect_err(line).to_string();
            assert!(said.starts_with(error), "{said}");
        }
    }

    #[test]
    fn what_is_no_such_line_says_nothing() {
        for line in ["{}", "ready", r#"{"edition":"4.0"}"#, "[1]"] {
            assert_eq!(About::read(line, &Protocol::of(&Edition::V3_0)), Ok(None), "{line}");
        }
    }
}
