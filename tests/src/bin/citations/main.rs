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
//! A requirement holds in one edition of the document or in several. The gate is for the editions that the code has; what holds
//! only in others waits, and is counted ([`gate`]).
//!
//! `scripts/trace.sh` runs all of it. What `cargo doc` renders of the sources gets the sentences as well ([`rendered`]); `scripts/docs.sh`
//! does both.

mod annotate;
mod gate;
mod kind;
mod mistake;
mod rendered;
mod requirements;
mod scan;
mod snapshot;
mod sources;

use std::io;
use std::path::Path;
use std::process::ExitCode;

use adsdv_spec::Edition;
use annotate::{Citation, annotations, folder_of_edition};
use gate::Verdict;
use mistake::Mistake;
use requirements::Requirements;
use scan::Written;
use sources::Source;

const USAGE: &str = "\
Usage: citations write | check | count | snapshot | render

write  finds every citation in the sources below the current folder, and writes them as annotations for duvet
       into target/duvet/annotations
check  reads duvet's report, target/duvet/report.json, and names every requirement that lacks an
       implementation, a proof or a test; then as count
count  names the same from the sources alone
snapshot
       names the lines of duvet's snapshot, .duvet/snapshot.txt, that are not what the sources say
render puts the sentence of each requirement beside its citations in the sources that cargo doc has rendered, in
       target/doc/src

What holds only in an edition that the code does not have yet is counted, and may lack anything.

Exit status: 0 all is well, 1 a citation is wrong, a requirement lacks something or the snapshot is not up to
date, 2 wrong usage or a file cannot be read or written.";

/// The requirements, as duvet reads them.
const REQUIREMENTS: &str = "spec/REQUIREMENTS.md";
/// Where the annotations go: `.duvet/config.toml` names this folder to duvet.
const ANNOTATIONS: &str = "target/duvet/annotations";
/// Where duvet writes its report: `.duvet/config.toml` says so.
const REPORT: &str = "target/duvet/report.json";
/// What duvet writes down of each requirement, for reviews.
const SNAPSHOT: &str = ".duvet/snapshot.txt";
/// Where `cargo doc` puts the sources.
const RENDERED: &str = "target/doc/src";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let done = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["write"] => write(),
        ["check"] => check(),
        ["count"] => count(),
        ["snapshot"] => snapshot(),
        ["render"] => render(),
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
    let requirements = requirements()?;
    let code = editions_of_the_code(&requirements)?;
    let verdict = Verdict::of_report(&sources::read(Path::new(REPORT))?, &requirements, &code)
        .map_err(|error| io::Error::new(io::ErrorKind::InvalidData, format!("{REPORT}: {error}")))?;
    // The sources tell more: in which edition a citation counts.
    if verdict.is_complete() { count() } else { Ok(printed(&verdict)) }
}

fn count() -> io::Result<ExitCode> {
    let requirements = requirements()?;
    let Some(citations) = all_cited(&requirements)? else { return Ok(ExitCode::FAILURE) };
    let code = editions_of_the_code(&requirements)?;
    Ok(printed(&Verdict::of_citations(&citations, &requirements, &code)))
}

fn snapshot() -> io::Result<ExitCode> {
    let requirements = requirements()?;
    let Some(citations) = all_cited(&requirements)? else { return Ok(ExitCode::FAILURE) };
    let differences = snapshot::differences(&sources::read(Path::new(SNAPSHOT))?, &citations, &requirements);
    for difference in &differences {
        println!("{SNAPSHOT}: {difference}");
    }
    if differences.is_empty() {
        return Ok(ExitCode::SUCCESS);
    }
    eprintln!("citations: {SNAPSHOT} is not up to date; try: scripts/trace.sh, with duvet, and commit it");
    Ok(ExitCode::FAILURE)
}

fn render() -> io::Result<ExitCode> {
    let cited = rendered::fill(Path::new(RENDERED), &requirements()?)?;
    println!("{cited} citations in {RENDERED} have what they cite beside them");
    Ok(if cited > 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// The editions that the code has, each of which has to have requirements.
fn editions_of_the_code(requirements: &Requirements) -> io::Result<Vec<&'static str>> {
    let code: Vec<_> = Edition::ALL.iter().map(|edition| edition.version).collect();
    match code.iter().find(|version| !requirements.editions().iter().any(|edition| edition == *version)) {
        Some(version) => Err(io::Error::new(
            io::ErrorKind::InvalidData,
            format!(
                "{REQUIREMENTS}: no edition {version}, which the code has; expected it under \"Editions\""
            ),
        )),
        None => Ok(code),
    }
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
    if let Some(edition) = folder_of_edition(&source.path)
        && let Some(other) = cited.iter().find(|requirement| !requirement.holds_in(&edition))
    {
        return Err(here(Mistake::new(
            format!("{} does not hold in {edition}", other.id),
            format!("what holds in {edition} in its folder"),
        )));
    }
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
    fn the_folder_of_an_edition_cites_what_holds_in_it() {
        let well = cited_in("spec/src/editions/v4_0/mod.rs", "//= HS-4, HS-17\n");
        assert_eq!(well, Ok(vec!["Implementation HS-4 1".to_owned(), "Implementation HS-17 1".to_owned()]));
        let wrong = cited_in("spec/src/editions/v4_0/mod.rs", "//= HS-4\n//= HS-4, HS-6\n");
        assert_eq!(
            wrong,
            Err(vec![
                "spec/src/editions/v4_0/mod.rs:2: HS-6 does not hold in 4.0; expected what holds in 4.0 in its folder"
                    .to_owned()
            ])
        );
    }

    #[test]
    fn a_citation_where_none_counts_is_wrong() {
        let wrong = cited_in("oracle/benches/check.rs", "//= HS-4\n").expect_err("benches prove nothing");
        assert!(wrong[0].starts_with("oracle/benches/check.rs:1: `//=` does not count here;"), "{wrong:?}");
    }
}
