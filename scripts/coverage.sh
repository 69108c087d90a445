#!/usr/bin/env bash
# Which lines the tests run.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  cat <<'USAGE'
Usage: scripts/coverage.sh [--missing] [CRATE...] [-- ARGUMENT...]

Runs all tests of the workspace, or those of some crates alone, and tells for each crate how many lines of its sources they
ran. It uses cargo llvm-cov where LLVM's tools are installed (rustup component add llvm-tools), else cargo tarpaulin.

Crates: spec, proofs, model, oracle, conform, can, ffi, cli, tests.

--missing tells the other lines as well, by file. Arguments after -- go to the tool.

Exit status: 0, 1 if a line of spec was not run, 2 if it could not run.
USAGE
}

missing=0 crates=
packages=()
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) usage; exit 0 ;;
    --missing) missing=1 ;;
    --) shift; break ;;
    cli) crates+=" $1 " packages+=(-p adsdv) ;;
    spec | proofs | model | oracle | conform | can | ffi | tests) crates+=" $1 " packages+=(-p "adsdv-$1") ;;
    *) usage >&2; exit 2 ;;
  esac
  shift
done

out=target/coverage
mkdir -p "$out"
features=adsdv-spec/serde,adsdv-spec/arbitrary,adsdv-spec/proptest
[ ${#packages[@]} -gt 0 ] || packages=(--workspace)
tools=$(rustc --print sysroot)/lib/rustlib/$(rustc -vV | sed -n 's/^host: //p')/bin
if cargo llvm-cov --version >/dev/null 2>&1 && [ -x "$tools/llvm-cov" ]; then
  cargo llvm-cov "${packages[@]}" --profile coverage --locked --features "$features" --lcov --output-path "$out/lcov.info" "$@"
elif cargo tarpaulin --version >/dev/null 2>&1; then
  # A test may take long when every line of it counts.
  cargo tarpaulin --engine llvm --follow-exec --profile coverage "${packages[@]}" --locked --features "$features" --timeout 3600 \
    --skip-clean --target-dir "$out/target" --out Lcov --output-dir "$out" "$@"
else
  echo "coverage.sh: neither cargo llvm-cov with llvm-tools nor cargo tarpaulin is installed;" \
    "install one with: cargo install --locked cargo-tarpaulin" >&2
  exit 2
fi

awk -v root="$PWD/" -v missing="$missing" -v crates="$crates" -F '[:,]' '
  $1 == "SF" {
    file = $2
    if (index(file, root) == 1) file = substr(file, length(root) + 1)
    split(file, parts, "/")
    crate = parts[2] == "src" ? parts[1] : ""
    if (crates != "" && !index(crates, " " crate " ")) crate = ""
  }
  $1 == "DA" && crate != "" {
    lines[crate]++
    if ($3 > 0) run[crate]++
    else left[file] = left[file] " " $2
  }
  END {
    printf "%-8s %7s %7s %8s\n", "CRATE", "LINES", "RUN", "OF 100"
    sorted = "sort"
    for (crate in lines) printf "%-8s %7d %7d %8.2f\n", crate, lines[crate], run[crate], 100 * run[crate] / lines[crate] | sorted
    close(sorted)
    if (missing) for (file in left) print file ":" left[file] | sorted
    close(sorted)
    if (crates != "" && !index(crates, " spec ")) exit 0
    if (!lines["spec"]) { print "no line of spec was seen"; exit 2 }
    exit run["spec"] < lines["spec"]
  }
' "$out/lcov.info"
