#!/usr/bin/env bash
# Proves every theorem with Kani: cargo kani -p adsdv-proofs, with any arguments given here.
# Kani itself fails when a theorem does not hold. An interesting case that cannot be reached does not make it fail, so its
# output is read for those: a theorem that holds for want of a case proves nothing.
set -euo pipefail
cd "$(dirname "$0")/.."

if ! cargo kani --version >/dev/null 2>&1; then
  echo "kani.sh: Kani is not installed; install it with: cargo install --locked kani-verifier && cargo kani setup" >&2
  exit 2
fi

log=${CARGO_TARGET_DIR:-target}/kani.log
mkdir -p "$(dirname "$log")"
cargo kani -p adsdv-proofs "$@" 2>&1 | tee "$log"

awk '
  /^Checking harness /           { name = $3; sub(/\.+$/, "", name); harnesses++ }
  /cover properties satisfied/   { covered++; if ($2 != $4) { print name ": " $2 " of " $4 " cases reached"; bad++ } }
  /^Verification Time: /         { seconds = $3 + 0; total += seconds; if (seconds > most) { most = seconds; slowest = name } }
  END {
    if (harnesses == 0)        { print "no harness was checked"; exit 1 }
    if (covered != harnesses)  { print harnesses - covered " harnesses reach no case at all"; bad++ }
    printf "%d theorems, %.0f s in all, at most %.1f s (%s)\n", harnesses, total, most, slowest
    if (bad) { print "not every interesting case is reached"; exit 1 }
    if (most > 60 || total > 600) { print "that is too slow: a theorem may take a minute, and all of them ten"; exit 1 }
  }
' "$log"
