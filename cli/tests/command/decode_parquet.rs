//! `adsdv decode --format parquet`: where tables are written, and when they are not.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::run::{MISSION, adsdv, run, temporary};

/// How a Parquet file begins and ends.
const MAGIC: &[u8] = b"PAR1";

/// A folder that is not there. The name has to be the test's own.
fn nothing(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    folder
}

fn text(path: &Path) -> &str {
    path.to_str().expect("text")
}

#[test]
fn a_file_and_a_pipe_have_the_same_table() {
    for table in ["signals", "frames"] {
        let args = ["decode", "--format", "parquet", "--table", table, MISSION];
        let file = temporary(&format!("{table}.parquet"), b"what was there before");
        let written = run(&[&args[..], &["-o", text(&file)]].concat());
        assert_eq!((written.status, written.stdout.as_str()), (Some(0), ""));
        let file = fs::read(&file).expect("the file is there");
        for output in [&[][..], &["-o", "-"]] {
            let piped = adsdv(&[&args[..], output].concat()).output().expect("the command starts");
            assert!(piped.status.success() && piped.stdout == file, "{table} {output:?}");
        }
        assert!(file.starts_with(MAGIC) && file.ends_with(MAGIC));
    }
}

#[test]
fn messages_are_files_in_a_directory_that_is_new_or_empty() {
    let folder = nothing("decode-messages");
    let args = ["decode", "--format", "parquet", "--table", "messages", "-o", text(&folder), MISSION];
    fs::create_dir_all(&folder).expect("the folder for tests can be written");
    let names = || {
        let files = fs::read_dir(&folder).expect("a folder").map(|file| file.expect("a file").file_name());
        files.collect::<BTreeSet<_>>()
    };
    assert_eq!(run(&args).status, Some(0));
    let status = fs::read(folder.join("VCU2AI_Status.parquet")).expect("the file is there");
    assert!(status.starts_with(MAGIC) && status.ends_with(MAGIC));
    let files = names();
    fs::remove_dir_all(&folder).expect("it can be removed");
    assert_eq!(run(&args).status, Some(0));
    assert_eq!((names(), files.len()), (files.clone(), 14), "new or empty, it is the same");
    let again = run(&args);
    let said = format!(
        "adsdv: {}: is not empty, and what is in it would be taken for a part of this log\nhint: name a directory that is new or empty with --output\n",
        text(&folder)
    );
    assert_eq!((again.status, again.stderr), (Some(2), said));
    assert_eq!(names(), files);
}

#[cfg(unix)]
#[test]
fn a_table_has_the_permissions_of_any_other_file() {
    use std::os::unix::fs::PermissionsExt as _;

    let folder = nothing("decode-permissions");
    let mode = |path: &Path| fs::metadata(path).expect("it is there").permissions().mode() & 0o777;
    fs::create_dir_all(&folder).expect("the folder for tests can be written");
    let (csv, table, messages) =
        (folder.join("run.csv"), folder.join("run.parquet"), folder.join("messages"));
    assert_eq!(run(&["decode", "--format", "csv", "-o", text(&csv), MISSION]).status, Some(0));
    let parquet = ["decode", "--format", "parquet", MISSION, "-o"];
    assert_eq!(run(&[&parquet[..], &[text(&table)]].concat()).status, Some(0));
    assert_eq!(run(&[&parquet[..], &[text(&messages), "--table", "messages"]].concat()).status, Some(0));
    assert_eq!((mode(&table), mode(&messages)), (mode(&csv), mode(&folder)));
    assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 3, "nothing else is left");
}

/// Where a link is named, what it stands for is replaced; and where nothing was decoded, nothing is.
#[cfg(unix)]
#[test]
fn what_was_there_is_replaced_by_a_whole_table_alone() {
    let folder = nothing("decode-replaced");
    fs::create_dir_all(&folder).expect("the folder for tests can be written");
    let (file, link) = (folder.join("run.parquet"), folder.join("link.parquet"));
    fs::write(&file, b"before").expect("the folder for tests can be written");
    std::os::unix::fs::symlink(&file, &link).expect("a link");
    let args = ["decode", "--format", "parquet", "-o", text(&link), MISSION];
    let refused = run(&[&args[..], &["--interface", "can7"]].concat());
    assert_eq!((refused.status, fs::read(&file).expect("it is there")), (Some(2), b"before".to_vec()));
    assert_eq!(run(&args).status, Some(0));
    assert!(fs::read(&file).expect("it is there").starts_with(MAGIC));
    assert!(fs::symlink_metadata(&link).expect("it is there").is_symlink());
    let names = fs::read_dir(&folder).expect("a folder").count();
    assert_eq!(names, 2, "nothing else is left");
}

/// Each with what it says, exactly.
#[test]
fn what_cannot_be_written_is_refused_in_words() {
    let folder = nothing("decode-folder");
    fs::create_dir_all(&folder).expect("the folder for tests can be written");
    let (folder, file) = (text(&folder), temporary("decode-no-folder", b""));
    let file = text(&file);
    let parquet = ["decode", "--format", "parquet", MISSION];
    let cases: [(&[&str], String); 6] = [
        (&["decode", "--format", "csv", "--table", "frames", MISSION], "--table: is for Parquet, and --format does not ask for that\nhint: add --format parquet, or leave --table out\n".to_owned()),
        (&[&parquet[..], &["--table", "messages"]].concat(), "--table messages: writes a file for each message, and there is no directory for them\nhint: name one that is new or empty with --output\n".to_owned()),
        (&[&parquet[..], &["-o", folder]].concat(), format!("{folder}: cannot write what was decoded: Is a directory (os error 21)\nhint: name a file in it with --output\n")),
        (&[&parquet[..], &["-o", "nowhere/run.parquet"]].concat(), "nowhere/run.parquet: cannot write what was decoded: No such file or directory (os error 2)\nhint: make the directory first, or name another file with --output\n".to_owned()),
        (&[&parquet[..], &["--table", "messages", "-o", "nowhere/run"]].concat(), "nowhere/run: cannot write what was decoded: No such file or directory (os error 2)\nhint: make the directory first, or name another file with --output\n".to_owned()),
        (&[&parquet[..], &["--table", "messages", "-o", file]].concat(), format!("{file}: cannot write what was decoded: Not a directory (os error 20)\nhint: it is no directory; name one that is new or empty with --output\n")),
    ];
    for (args, expected) in cases {
        let outcome = run(args);
        assert_eq!((outcome.status, outcome.stderr), (Some(2), format!("adsdv: {expected}")), "{args:?}");
    }
}

/// With `script` of util-linux the command writes to a terminal.
#[cfg(target_os = "linux")]
#[test]
fn a_terminal_is_spared_what_is_no_text() {
    use std::process::{Command, Stdio};

    let line = format!("{} decode --format parquet {MISSION}", env!("CARGO_BIN_EXE_adsdv"));
    let mut script = Command::new("script");
    script.args(["-qec", &line, "/dev/null"]).current_dir(crate::run::workspace()).stdin(Stdio::null());
    let Ok(output) = script.output() else { return }; // There is no script on this machine.
    let said = "adsdv: --format: asks for what is no text, and standard output is a terminal\nhint: write it to a file with --output, or into a pipe\n";
    assert_eq!(String::from_utf8_lossy(&output.stdout).replace('\r', ""), said);
    assert_eq!(output.status.code(), Some(2));
}
