//! Traceability: from the short citations in the sources to the report of `duvet`, and the gate behind it.
//!
//! ```text
//! sources --scan--> citations --requirements--> duvet's annotations --(duvet report)--> report.json --gate--> what is missing
//! ```
//!
//! Sources cite requirements by identifier alone, as in `//= HS-4, HS-6` ([`scan`]). duvet wants each sentence quoted
//! in full, which would bury the code, so this program writes those quotes into files of their own ([`annotate`]).
//! What a citation stands for, an implementation, a proof or a test, follows from where it is ([`kind`]).
//!
//! `scripts/trace.sh` runs all of it.

mod annotate;
mod gate;
mod kind;
mod mistake;
mod requirements;
mod scan;
mod sources;

use std::io;
use std::path::Path;
use std::process::ExitCode;

use annotate::{Citation, annotations};
use gate::Verdict;
use mistake::Mistake;
use requirements::Requirements;
use scan::Written;
use sources::Source;

const USAGE: &str = "\
Usage: citations write | check | count

write  finds every citation in the sources below the current folder, and writes them as annotations for duvet
       into target/duvet/annotations
check  reads duvet's report, target/duvet/report.json, and names every requirement that lacks an
       implementation, a proof or a test
count  names the same from the sources alone, where there is no duvet

Exit status: 0 all is well, 1 a citation is wrong or a requirement lacks something, 2 wrong usage or a file
cannot be read or written.";

/// The requirements, as duvet is told to read them.
const REQUIREMENTS: &str = "spec/REQUIREMENTS.md";
/// Where the annotations go: `.duvet/config.toml` names this folder to duvet.
const ANNOTATIONS: &str = "target/duvet/annotations";
/// Where duvet writes its report: `.duvet/config.toml` says so.
const REPORT: &str = "target/duvet/report.json";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let done = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["write"] => write(),
        ["check"] => check(),
        ["count"] => count(),
        ["-h" | "--help"] => {
            println!("{USAGE}");
            return ExitCode::SUCCESS;
        }
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    done.unwrap_or_else(|error| {
        eprintln!("citations: {error}");
        ExitCode::from(2)
    })
}

fn write() -> io::Result<ExitCode> {
    let requirements = requirements()?;
    let Some(citations) = all_cited(&requirements)? else { return Ok(ExitCode::FAILURE) };
    sources::write_anew(Path::new(ANNOTATIONS), &annotations(&citations, REQUIREMENTS))?;
    println!("{} citations of {} requirements", citations.len(), requirements.in_force().count());
    Ok(ExitCode::SUCCESS)
}

fn check() -> io::Result<ExitCode> {
    let verdict = Verdict::of_report(&sources::read(Path::new(REPORT))?, &requirements()?)
        .map_err(|error| io::Error::new(io::ErrorKind::InvalidData, format!("{REPORT}: {error}")))?;
    Ok(printed(&verdict))
}

fn count() -> io::Result<ExitCode> {
    let requirements = requirements()?;
    let Some(citations) = all_cited(&requirements)? else { return Ok(ExitCode::FAILURE) };
    Ok(printed(&Verdict::of_citations(&citations, &requirements)))
}

fn printed(verdict: &Verdict) -> ExitCode {
    println!("{verdict}");
    if verdict.is_complete() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The citations of all sources. `None` if some are wrong: it has been said what.
fn all_cited(requirements: &Requirements) -> io::Result<Option<Vec<Citation<'_>>>> {
    let mut citations = Vec::new();
    let mut all_is_well = true;
    for source in sources::all(Path::new("."))? {
        match cited(&source, requirements) {
            Ok(found) => citations.extend(found),
            Err(troubles) => {
                all_is_well = false;
                for trouble in troubles {
                    eprintln!("{trouble}");
                }
            }
        }
    }
    Ok(all_is_well.then_some(citations))
}

/// The citations of one source, or all that is wrong with them.
fn cited<'a>(source: &Source, requirements: &'a Requirements) -> Result<Vec<Citation<'a>>, Vec<Mistake>> {
    let mut troubles = Vec::new();
    let mut citations = Vec::new();
    for written in scan::citations(&source.text) {
        match written.and_then(|written| meant(source, &written, requirements)) {
            Ok(found) => citations.extend(found),
            Err(trouble) => troubles.push(trouble.at(&source.path)),
        }
    }
    if troubles.is_empty() { Ok(citations) } else { Err(troubles) }
}

/// What is meant by a citation: one for each requirement.
fn meant<'a>(
    source: &Source,
    written: &Written,
    requirements: &'a Requirements,
) -> Result<Vec<Citation<'a>>, Mistake> {
    let here = |trouble: Mistake| trouble.in_line(written.line);
    let kind = kind::of(&source.path, written.form, written.in_tests).map_err(here)?;
    let cited = requirements.list(&written.ids).map_err(here)?;
    let citation =
        |requirement| Citation { kind, requirement, path: source.path.clone(), line: written.line };
    Ok(cited.into_iter().map(citation).collect())
}

fn requirements() -> io::Result<Requirements> {
    let text = sources::read(Path::new(REQUIREMENTS))?;
    Requirements::parse(&text)
        .map_err(|trouble| io::Error::new(io::ErrorKind::InvalidData, trouble.at(REQUIREMENTS).to_string()))
}

#[cfg(test)]
mod tests {
    use super::cited;
    use super::kind::Kind::{Implementation, Proof, Test};
    use super::requirements::{Requirements, tests::SMALL};
    use super::sources::Source;

    fn cited_in(path: &str, text: &str) -> Result<Vec<String>, Vec<String>> {
        let requirements = Requirements::parse(SMALL).expect("well written");
        let source = Source { path: path.to_owned(), text: text.to_owned() };
        let cited = cited(&source, &requirements);
        cited
            .map(|found| {
                found.iter().map(|c| format!("{:?} {} {}", c.kind, c.requirement.id, c.line)).collect()
            })
            .map_err(|troubles| troubles.iter().map(ToString::to_string).collect())
    }

    #[test]
    fn what_a_citation_stands_for_follows_from_where_it_is() {
        for (path, text, kind) in [
            ("spec/src/handshake.rs", "//= HS-4\n", Implementation),
            ("proofs/src/kani/handshake.rs", "/// Requirements: HS-4.\n", Proof),
            ("model/src/properties.rs", "requirements: &[\"HS-4\"],\n", Proof),
            ("tests/tests/judge/conforming.rs", "    //= HS-4\n", Test),
        ] {
            assert_eq!(cited_in(path, text), Ok(vec![format!("{kind:?} HS-4 1")]), "{path}");
        }
    }

    #[test]
    fn every_mistake_is_reported_with_its_place() {
        let wrong = cited_in("spec/src/a.rs", "//= HS-4\n//= HS-99\n\n//= HS-6 to HS-4\n");
        assert_eq!(
            wrong,
            Err(vec![
                "spec/src/a.rs:2: \"HS-99\" is no requirement; expected an identifier of spec/REQUIREMENTS.md, \
                 such as HS-4"
                    .to_owned(),
                "spec/src/a.rs:4: \"HS-6 to HS-4\" runs backwards; expected HS-4 to HS-6".to_owned(),
            ])
        );
    }

    #[test]
    fn a_citation_where_none_counts_is_wrong() {
        let wrong = cited_in("oracle/benches/check.rs", "//= HS-4\n").expect_err("benches prove nothing");
        assert!(wrong[0].starts_with("oracle/benches/check.rs:1: `//=` does not count here;"), "{wrong:?}");
    }
}
