//! A scenario of the exam as text: what the operator does, as in a scenario of `adsdv demo`, and lines about all else.
//!
//! ```text
//! start ai 3                                    # the AI Computer is switched on after 3 s; so with vcu
//! brakes weak                                   # they take long, and do little
//! disturb AS_DRIVING +2 for 0.03 silences       # from when, then how long after it, for how long, and what
//! disturb start +0 for 600 loses 3
//! 0 ebs ARMED, ami TRACK_DRIVE
//! 0.5 tsms on, asms on
//! AS_READY +5.5 go on
//! AS_FINISHED +1 go off, asms off
//! +0.5 end
//! ```

use std::fmt;

use adsdv_can::car::Physics;
use adsdv_can::scenario::{LineError, Scenario, Unreadable, When};

use crate::disturbance::{Disturbance, Effect, Onset};
use crate::scenario::ExamScenario;
use crate::scenarios::{WEAK_BRAKES, completes};
use crate::seconds::Seconds;

/// The words with which the lines begin that are not about the operator.
const DISTURB: &str = "disturb";
const START: &str = "start";
const BRAKES: &str = "brakes";

impl fmt::Display for ExamScenario {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (who, ms) in [("vcu", self.vcu_starts_ms), ("ai", self.ai_starts_ms)] {
            if ms > 0 {
                writeln!(f, "{START} {who} {}", Seconds(ms))?;
            }
        }
        if self.physics != Physics::DEFAULT {
            writeln!(f, "{BRAKES} weak")?;
        }
        for disturbance in &self.disturbances {
            writeln!(f, "{disturbance}")?;
        }
        f.write_str(&self.operator)
    }
}

impl ExamScenario {
    /// Reads a scenario, of which all is expected that is expected of an AI Computer that drives missions to their end.
    ///
    /// ```
    /// use adsdv_exam::ExamScenario;
    ///
    /// let text = "disturb AS_READY +1 for 0.03 silences\n0 ebs ARMED, ami SKIDPAD\nAS_READY +2 end\n";
    /// assert_eq!(ExamScenario::read("mine", text)?.to_string(), text);
    /// let wrong = ExamScenario::read("mine", "disturb AS_READY +1 for 0.03 explodes\n").unwrap_err();
    /// assert!(wrong.to_string().starts_with("line 1, column 30: found \"explodes\", expected silences, "));
    /// # Ok::<(), adsdv_can::scenario::Unreadable>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Fails if a line is wrong; says of every such line what was found and expected.
    pub fn read(name: &str, text: &str) -> Result<Self, Unreadable> {
        let mut scenario = Self {
            name: name.to_owned(),
            about: "a scenario of a file".to_owned(),
            operator: String::new(),
            disturbances: Vec::new(),
            expects: completes(),
            vcu_starts_ms: 0,
            ai_starts_ms: 0,
            physics: Physics::DEFAULT,
        };
        let mut errors = Vec::new();
        let mut operator = String::new();
        for (number, line) in (1..).zip(text.lines()) {
            match scenario.line(line) {
                Ok(true) => {}
                Ok(false) => operator.push_str(line),
                Err((column, found, expected)) => {
                    errors.push(LineError { line: number, column, found: found.into(), expected });
                }
            }
            // What is not about the operator leaves an empty line, so that the numbers of lines stay.
            operator.push('\n');
        }
        let read: Result<Scenario, Unreadable> = operator.parse();
        match (read, errors.is_empty()) {
            (Ok(read), true) if read.lines().iter().any(|line| line.ends) => {
                scenario.operator = read.to_string();
                Ok(scenario)
            }
            (Ok(read), true) => {
                let line = read.lines().last().map_or(1, |line| line.number);
                let expected = "end, as in \"+1 end\": without it the exam would never come to its end";
                errors.push(LineError { line, column: 1, found: Vec::new(), expected: expected.to_owned() });
                Err(Unreadable::Lines { errors, more: 0 })
            }
            (Err(Unreadable::Lines { errors: others, more }), false) => {
                errors.extend(others);
                errors.sort_by_key(|error| (error.line, error.column));
                Err(Unreadable::Lines { errors, more })
            }
            (Err(unreadable), _) => Err(unreadable),
            (Ok(_), false) => Err(Unreadable::Lines { errors, more: 0 }),
        }
    }

    /// Reads a line that is not about the operator; whether it is one.
    fn line<'a>(&mut self, line: &'a str) -> Result<bool, WrongLine<'a>> {
        let line = line.split('#').next().unwrap_or_default();
        let mut words = Words { line, at: 0 };
        match words.next() {
            DISTURB => {
                let disturbance = words.disturbance()?;
                self.disturbances.push(disturbance);
            }
            START => match words.next() {
                "vcu" => self.vcu_starts_ms = words.seconds("")?,
                "ai" => self.ai_starts_ms = words.seconds("")?,
                who => return Err(words.wrong(who, "vcu or ai")),
            },
            BRAKES => match words.next() {
                "weak" => self.physics = WEAK_BRAKES,
                how => return Err(words.wrong(how, "weak")),
            },
            _ => return Ok(false),
        }
        match words.next() {
            "" => Ok(true),
            more => Err(words.wrong(more, "nothing more")),
        }
    }
}

/// The column, what was found there, and what was expected.
type WrongLine<'a> = (usize, &'a str, String);

/// The words of a line, one after the other; empty behind the last.
struct Words<'a> {
    line: &'a str,
    at: usize,
}

impl<'a> Words<'a> {
    fn next(&mut self) -> &'a str {
        let rest = self.line.get(self.at..).unwrap_or_default();
        let word = rest.trim_start();
        self.at += rest.len() - word.len();
        let word = word.split_whitespace().next().unwrap_or_default();
        self.at += word.len();
        word
    }

    /// The last word is not what was expected.
    fn wrong(&self, found: &'a str, expected: &str) -> WrongLine<'a> {
        (self.at - found.len() + 1, found, expected.to_owned())
    }

    /// A time behind this sign, in milliseconds.
    fn seconds(&mut self, sign: &str) -> Result<u64, WrongLine<'a>> {
        let word = self.next();
        let time = word.strip_prefix(sign).and_then(|time| format!("{time} end").parse::<Scenario>().ok());
        match time.and_then(|scenario| scenario.lines().first().map(|line| line.when)) {
            Some(When::At(ms)) => Ok(ms.into()),
            _ => Err(self.wrong(word, &format!("seconds such as {sign}3 or {sign}0.25"))),
        }
    }

    fn disturbance(&mut self) -> Result<Disturbance, WrongLine<'a>> {
        let word = self.next();
        let Some(from) = Onset::all().into_iter().find(|onset| onset.name() == word) else {
            let names: Vec<&str> = Onset::all().into_iter().map(Onset::name).collect();
            return Err(self.wrong(word, &format!("one of {}", names.join(", "))));
        };
        let after_ms = self.seconds("+")?;
        match self.next() {
            "for" => {}
            word => return Err(self.wrong(word, "for, and a time")),
        }
        let for_ms = self.seconds("")?;
        Ok(Disturbance { from, after_ms, for_ms, effect: self.effect()? })
    }

    fn effect(&mut self) -> Result<Effect, WrongLine<'a>> {
        let word = self.next();
        if let Some((_, effect)) = Effect::PLAIN.iter().find(|(name, _)| *name == word) {
            return Ok(*effect);
        }
        let Some((_, of)) = Effect::COUNTED.iter().find(|(name, _)| *name == word) else {
            let plain = Effect::PLAIN.iter().map(|(name, _)| (*name).to_owned());
            let counted = Effect::COUNTED.iter().map(|(name, _)| format!("{name} and a number"));
            let names: Vec<String> = plain.chain(counted).collect();
            return Err(self.wrong(word, &names.join(", ")));
        };
        let word = self.next();
        match word.parse() {
            Ok(number @ 1..=1000) => Ok(of(number)),
            _ => Err(self.wrong(word, "a number from 1 to 1000")),
        }
    }
}
