#!/usr/bin/env bash
# Proves every theorem with Kani: cargo kani -p adsdv-proofs.
#
# usage: scripts/kani.sh [ARGUMENT ...]
#   ARGUMENT  for cargo kani, such as --harness time:: ; then only what they choose has to be verified
#
# Kani fails when a theorem does not hold. An interesting case that cannot be reached does not make it fail, so its output is
# read for those (tests/src/bin/kani_output): a theorem that holds for want of a case proves nothing. It has to be the regular
# output, of one harness after the other: the terse one, which -j needs, does not tell the cases.
#
# All that Kani writes is in target/kani.log.
# Exit status: 0 all is verified and every case reached, 1 something is not, 2 Kani is not installed.
set -euo pipefail
cd "$(dirname "$0")/.."

if [ "${1-}" = -h ] || [ "${1-}" = --help ]; then
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' scripts/kani.sh
  exit
fi
if ! cargo kani --version >/dev/null 2>&1; then
  echo "kani.sh: Kani is not installed; install it with: cargo install --locked kani-verifier && cargo kani setup" >&2
  exit 2
fi

log=${CARGO_TARGET_DIR:-target}/kani.log
mkdir -p "$(dirname "$log")"
some=()
[ $# = 0 ] || some=(--some)

# To follow it: each harness and its answer. The checks are many thousand lines.
kani=0
cargo kani -p adsdv-proofs "$@" 2>&1 | tee "$log" \
  | { grep --line-buffered -E '^(Checking harness|Failed Checks|CBMC failed|VERIFICATION|Verification Time|Complete|error|warning)' || true; } \
  || kani=${PIPESTATUS[0]}

read=0
cargo run --quiet --locked -p adsdv-tests --bin kani_output -- "${some[@]}" "$log" || read=$?
if [ "$kani" != 0 ] && [ "$read" = 0 ]; then
  tail -n 20 "$log" >&2
  echo "kani.sh: cargo kani ended with $kani; all that it wrote is in $log" >&2
fi
[ "$kani" = 0 ] && [ "$read" = 0 ] || exit 1
