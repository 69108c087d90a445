#!/usr/bin/env bash
# The licences and notices of all that is compiled into what is given away, which most of them want to go with it.
#
#   scripts/licences.sh            of the program, as target/licences/
#   scripts/licences.sh --python   of the Python module, as python/licences/, from where a wheel takes them
#
# crates.html has those of the crates, rust.html those of Rust's standard library, musl.txt those of the C library that a static program has.
# Needs cargo-about (cargo install --locked cargo-about@0.9.3 --features cli). Ends with 77 where it is missing.
set -euo pipefail
cd "$(dirname "$0")/.."

manifest=cli/Cargo.toml folder=${CARGO_TARGET_DIR:-target}/licences
case ${1-} in
'') ;;
--python) manifest=python/Cargo.toml folder=python/licences ;;
*)
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  case $1 in -h | --help) exit 0 ;; *) exit 2 ;; esac
  ;;
esac
cargo about --version >/dev/null 2>&1 || {
  echo "scripts/licences.sh: there is no cargo-about (cargo install --locked cargo-about@0.9.3 --features cli)" >&2
  exit 77
}

rm -rf "$folder"
mkdir -p "$folder"
[ "${1-}" != --python ] || cp LICENSE-MIT LICENSE-APACHE "$folder/"
# Those that may come are those of deny.toml.
config=$(mktemp)
trap 'rm -f "$config"' EXIT
{ sed -n 's/^allow = /accepted = /; /^accepted/,/^\]/p' deny.toml && cat about.toml; } >"$config"
cargo about generate --locked --all-features --fail --config "$config" --manifest-path "$manifest" --output-file "$folder/crates.html" scripts/licences.hbs

# Each by the first of the places where those who hand it on put it.
first() {
  local name=$1 file
  shift
  for file in "$@"; do
    [ ! -e "$file" ] || { cp "$file" "$folder/$name" && return; }
  done
  echo "scripts/licences.sh: no $name, for there is none of $*" >&2
}
first rust.html "$("${RUSTC:-rustc}" --print sysroot)/share/doc/rust/COPYRIGHT-library.html" "$(rustc --print sysroot)/share/doc/rust/COPYRIGHT-library.html"
[ "${1-}" = --python ] || first musl.txt /usr/share/doc/musl/copyright
echo "$folder"
