#!/usr/bin/env bash
# The crates as a registry would have them: packaged, and the command installed from these packages alone.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  cat <<'USAGE'
Usage: scripts/packages.sh [LOG]

Packages every crate that may be published into target/package, and does in an empty folder what `cargo install adsdv` will do once
they are: a registry of these packages, and of the crates of others that Cargo.lock names, takes the place of crates.io. The program
that comes of it judges LOG, by default tests/logs/mission.log.

What is packaged is what is committed. Takes some minutes, and half a gigabyte in the folder for temporary files.

Needs Python 3, to write down what each package sums to.

Exit status: 0 if the command was installed and judges the log; 1 if not; 2 if it could not be tried.
USAGE
}

case ${1-} in
-h | --help) usage; exit 0 ;;
-*) usage >&2; exit 2 ;;
esac
[ $# -le 1 ] || { usage >&2; exit 2; }
log=$(realpath -e -- "${1-tests/logs/mission.log}") || exit 2
python3 --version >/dev/null || exit 2

target=${CARGO_TARGET_DIR:-$PWD/target}
rm -rf "$target/package"
mapfile -t kept < <(grep -l '^publish = false' -- */Cargo.toml | sed 's,/.*,,')
mapfile -t left_out < <(for folder in "${kept[@]}"; do
  grep -q "\"$folder\"" Cargo.toml && sed -n 's/^name = "\(.*\)"/--exclude=\1/p' "$folder/Cargo.toml" | head -1
done)
cargo package --workspace "${left_out[@]}" --no-verify --locked --quiet || exit 2

empty=$(mktemp -d)
trap 'rm -rf "$empty"' EXIT
cargo vendor --locked --quiet "$empty/registry" >/dev/null || exit 2
for package in "$target"/package/*.crate; do
  tar -xzf "$package" -C "$empty/registry"
done
# A directory in a registry's place says of each package what it sums to, as Cargo.lock does.
python3 - "$empty/registry" "$target"/package/*.crate <<'SUMS'
import hashlib, json, pathlib, sys

registry, *packages = map(pathlib.Path, sys.argv[1:])
for package in packages:
    sums = {"files": {}, "package": hashlib.sha256(package.read_bytes()).hexdigest()}
    (registry / package.stem / ".cargo-checksum.json").write_text(json.dumps(sums))
SUMS

mkdir "$empty/folder"
cd "$empty/folder"
cat >config.toml <<CONFIG
[source.crates-io]
replace-with = "packages"
[source.packages]
directory = "$empty/registry"
CONFIG
cargo install adsdv --locked --offline --config config.toml --root "$empty/installed" --target-dir "$empty/target" || exit 1
"$empty/installed/bin/adsdv" check "$log" || exit 1
# What the command does not stand on.
cargo build --release --locked --offline --config config.toml --target-dir "$empty/target" \
  --manifest-path "$empty"/registry/adsdv-ffi-*/Cargo.toml || exit 1
echo "scripts/packages.sh: $(find "$target/package" -maxdepth 1 -name '*.crate' | wc -l) packages, and the command installed from them"
