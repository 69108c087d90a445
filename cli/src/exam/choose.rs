//! The scenarios of an exam: those that are written, those by chance, or that of a file.

use std::fs::File;
use std::io::{self, Read as _};
use std::path::Path;

use adsdv_can::scenario::{MAX_BYTES, Unreadable};
use adsdv_exam::{ExamScenario, NoScenario, random_scenarios, scenarios};

use crate::args::ExamArgs;
use crate::error::Error;

/// Where to read what a scenario is.
const HELP: &str = "exam/README.md says what may stand in a scenario of the exam";

/// Those that somebody asks for: by the beginning of the name, if by any.
pub(super) fn chosen(args: &ExamArgs) -> Result<Vec<ExamScenario>, Error> {
    if let Some(file) = &args.scenario {
        return Ok(vec![read(file)?]);
    }
    let mut all = scenarios();
    all.extend(random_scenarios(args.seed, args.runs));
    adsdv_exam::chosen(all, &args.only, args.quick).map_err(|NoScenario(unknown)| {
        let names: Vec<String> = scenarios().into_iter().map(|scenario| scenario.name).collect();
        Error {
            what: format!("--only {}", unknown.escape_default()),
            why: format!("no scenario begins so; expected one of {}", names.join(", ")),
            hint: "adsdv exam --list says what each is about; random-0 and on are those of --runs".to_owned(),
        }
    })
}

fn read(file: &Path) -> Result<ExamScenario, Error> {
    let error =
        |why: String, hint: &str| Error { what: file.display().to_string(), why, hint: hint.to_owned() };
    let mut bytes = Vec::new();
    File::open(file).and_then(|source| source.take(MAX_BYTES + 1).read_to_end(&mut bytes)).map_err(
        |wrong| match wrong.kind() {
            io::ErrorKind::IsADirectory => error("is a directory; expected a scenario".to_owned(), HELP),
            _ => error(
                format!("cannot read the scenario: {wrong}"),
                "check the path, and that this user may read it",
            ),
        },
    )?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(error(Unreadable::Long { bytes: MAX_BYTES }.to_string(), HELP));
    }
    // What is no text is no word of the language, and is refused with its place.
    let text = String::from_utf8_lossy(&bytes);
    let name = file.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    ExamScenario::read(&name, &text).map_err(|wrong| error(format!("is no scenario\n{wrong}"), HELP))
}
