//! Compilers, and the library that is linked.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

/// A language: what names its compiler, the usual compiler, and what the compiler calls it.
#[derive(Clone, Copy)]
pub(crate) struct Language {
    variable: &'static str,
    usual: &'static str,
    name: &'static str,
    standard: &'static str,
}

pub(crate) const C: Language = Language { variable: "CC", usual: "cc", name: "c", standard: "-std=c99" };
pub(crate) const CPP: Language =
    Language { variable: "CXX", usual: "c++", name: "c++", standard: "-std=c++17" };

/// How a program has the library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Linked {
    Statically,
    Dynamically,
}

const WARNINGS: [&str; 4] = ["-Wall", "-Wextra", "-Werror", "-pedantic"];

pub(crate) fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The compiler of a language; `None` where there is none, which is said.
pub(crate) fn compiler(language: Language) -> Option<String> {
    let compiler = std::env::var(language.variable).unwrap_or_else(|_| language.usual.to_owned());
    if Command::new(&compiler).arg("--version").output().is_ok_and(|output| output.status.success()) {
        return Some(compiler);
    }
    assert!(std::env::var_os("ADSDV_REQUIRE_CC").is_none(), "{compiler} is not installed");
    println!("not tested: {compiler} is not installed");
    None
}

/// A text compiles in a language without a warning.
pub(crate) fn syntax(compiler: &str, language: Language, standard: &str, text: &str) {
    let source =
        scratch().join(format!("syntax{standard}.{}", if language.name == "c" { "c" } else { "cpp" }));
    std::fs::write(&source, text).unwrap();
    let mut command = Command::new(compiler);
    command
        .args(WARNINGS)
        .arg(standard)
        .arg("-fsyntax-only")
        .arg("-I")
        .arg(folder().join("include"))
        .arg(source);
    succeeds(&mut command);
}

/// A test may build the same program twice.
static COUNT: AtomicU32 = AtomicU32::new(0);

/// The program of one source, compiled without a warning and linked to the library.
pub(crate) fn built(compiler: &str, language: Language, source: &Path, linked: Linked) -> PathBuf {
    let libraries = libraries();
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    // Tests run at the same time, in one process or each in its own.
    let test = std::thread::current().name().unwrap_or_default().replace("::", "-");
    let program = scratch().join(format!("{}-{test}-{number}", source.file_stem().unwrap().display()));
    let mut command = Command::new(compiler);
    command.args(WARNINGS).arg(language.standard).arg("-O2");
    command
        .arg("-I")
        .arg(folder().join("include"))
        .args(["-x", language.name])
        .arg(source)
        .args(["-x", "none"]);
    match linked {
        Linked::Statically => command.arg(&libraries.fixed).args(["-lpthread", "-ldl", "-lm"]),
        Linked::Dynamically => {
            let place = libraries.shared.parent().unwrap();
            command.arg(&libraries.shared).arg(format!("-Wl,-rpath,{}", place.display()))
        }
    };
    succeeds(command.arg("-o").arg(&program));
    program
}

struct Libraries {
    fixed: PathBuf,
    shared: PathBuf,
}

/// The library as `cargo build` makes it. These tests are built together with it, but cargo does not say where it is: who knows that
/// names the folder in `ADSDV_LIBRARY`, and saves a build with the features that the library has by itself.
fn libraries() -> &'static Libraries {
    static LIBRARIES: OnceLock<Libraries> = OnceLock::new();
    LIBRARIES.get_or_init(|| {
        let dynamic = format!("libadsdv{}", std::env::consts::DLL_SUFFIX);
        if let Some(folder) = std::env::var_os("ADSDV_LIBRARY").map(PathBuf::from) {
            return Libraries { fixed: folder.join("libadsdv.a"), shared: folder.join(dynamic) };
        }
        let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        cargo.args(["build", "--package", "adsdv-ffi", "--lib", "--quiet", "--message-format", "json"]);
        // Benchmarks link the library as it is meant to be used.
        if !cfg!(debug_assertions) {
            cargo.args(["--profile", "dist"]);
        }
        let said = succeeds(cargo.arg("--manifest-path").arg(folder().join("Cargo.toml")));
        let find = |ending: &str| {
            let path = said.split('"').rfind(|part| part.ends_with(ending));
            PathBuf::from(path.unwrap_or_else(|| panic!("cargo has made no {ending}")))
        };
        Libraries { fixed: find("libadsdv.a"), shared: find(&dynamic) }
    })
}

fn scratch() -> PathBuf {
    let scratch = Path::new(env!("CARGO_TARGET_TMPDIR")).join("c");
    std::fs::create_dir_all(&scratch).unwrap();
    scratch
}

/// Runs a command that must succeed, and returns what it printed.
fn succeeds(command: &mut Command) -> String {
    let Output { status, stdout, stderr } = command.output().unwrap();
    assert!(status.success(), "{command:?}\n{}", String::from_utf8_lossy(&stderr));
    String::from_utf8(stdout).unwrap()
}
