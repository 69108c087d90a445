//! Programs that cannot be examined: they break the protocol, end, hang, or are none.

use std::time::{Duration, Instant};

use super::{refused, run};

/// What a program of the shell answers to the hello and to the first reset.
const BEGINS: &str = "read a; echo '{\"edition\":\"4.0\"}'; read a; echo '{}'; read a; ";

fn examined(script: &str) -> crate::run::Outcome {
    run(&["exam", "--stdio", "--edition", "4.0", "--timeout", "2", "--", "sh", "-c", script])
}

#[test]
pub(super) fn a_program_that_cannot_be_examined() {
    refused(
        &run(&["exam", "--stdio", "--", "no/such/stack"]),
        "no/such/stack: cannot start the program: ",
        "check the path",
    );
    refused(
        &run(&["exam", "--stdio", "--", "./tests"]),
        "./tests: is a directory; expected a program",
        "the program in it",
    );
    for (script, expected, hint) in [
        ("exit 3".to_owned(), "the program ended early (exit status 3)", "until its input ends"),
        ("exec 1>&-; sleep 60".to_owned(), "closed its standard output", "until its input ends"),
        ("sleep 60".to_owned(), "no answer within 2 s", "flush standard output"),
        (
            "read a; echo '{\"edition\":\"3.0\"}'; cat".to_owned(),
            "is of edition 3.0; expected 4.0",
            "--edition",
        ),
        ("read a; echo '{}'; cat".to_owned(), "does not say that it is of edition 4.0", "--edition"),
        (format!("{BEGINS} echo '{{\"fram'; sleep 60"), "not the answer to a step: EOF", "exam/PROTOCOL.md"),
        (format!("{BEGINS} echo '{{}}'; cat"), "no key \"frames\"", "exam/PROTOCOL.md"),
        (format!("{BEGINS} printf '{{\"frames\":'; sleep 60"), "no end of the line within 2 s", "flush"),
        (
            format!("{BEGINS} echo '{{\"frames\":[\"510#0\"]}}'; cat"),
            "the frame \"510#0\"",
            "exam/PROTOCOL.md",
        ),
        (format!("{BEGINS} printf '\\377\\n'; cat"), "it is not UTF-8", "exam/PROTOCOL.md"),
        (format!("{BEGINS} head -c 70000 /dev/zero; cat"), "a line of more than 65536 bytes", "line break"),
        (format!("{BEGINS} sh -c 'sleep 60' & sleep 60"), "no answer within 2 s", "flush"),
    ] {
        let start = Instant::now();
        let outcome = examined(&script);
        assert!(outcome.stderr.contains(expected), "{script}: {}", outcome.stderr);
        refused(&outcome, "", hint);
        assert!(start.elapsed() < Duration::from_secs(20), "{script}");
        if script.starts_with(BEGINS) {
            assert!(outcome.stderr.contains("\n  in        no-mission, at 0.000 s\n"), "{}", outcome.stderr);
            assert!(outcome.stderr.contains("\n  sent      {\"op\":\"step\","), "{}", outcome.stderr);
        }
    }
}

#[test]
pub(super) fn logs_of_an_exam_that_cannot_be_written() {
    let outcome = run(&["exam", "--stdio", "--logs", "README.md", "--", "cat"]);
    refused(&outcome, "README.md: cannot write the logs: ", "--logs");
}
