#!/usr/bin/env bash
# The documentation of all crates, with every requirement's sentence beside the lines of the sources that cite it.
#
#   scripts/docs.sh             builds it into target/doc; a warning of rustdoc is an error where RUSTDOCFLAGS says so
#
# CITATIONS names the built program that reads the citations; without it one is built.
set -euo pipefail
cd "$(dirname "$0")/.."

case ${1-} in
'') ;;
*)
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  case $1 in -h | --help) exit 0 ;; *) exit 2 ;; esac
  ;;
esac
cargo doc --workspace --no-deps --locked
citations=(cargo run --quiet --locked -p adsdv-tests --bin citations --)
[ -z "${CITATIONS-}" ] || citations=("$CITATIONS")
"${citations[@]}" render
