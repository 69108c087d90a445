#!/usr/bin/env bash
# Runs everything that draws from a seed, again and again, each time from a seed that nobody has tried: the property tests, the
# bodies of the fuzzers on small random inputs, the random recordings of the judge's tests, and the theorems without Kani.
# `cargo test` runs the same, and always from the same seed.
#
# usage: scripts/fresh-seeds.sh [-t SECONDS] [-s SEED] [-c CASES]
#   -t SECONDS  for how long, 1800 if nothing is said; the round that is running then is run to its end
#   -s SEED     the seed of the first round; the next ones follow it, number by number. Any number if nothing is said
#   -c CASES    how many values each property tries, if more than usual (PROPTEST_CASES)
#
# What a property test finds is kept, shrunk, in a file of regressions beside the tests, which a run of `cargo test` tries first
# from then on: commit it with what mends it. Of the others the command that repeats it is printed.
# Exit status: 0 nothing was found, 1 something was, 2 wrong usage, or the tests do not build.
set -euo pipefail
cd "$(dirname "$0")/.."

fail() { echo "fresh-seeds.sh: $2" >&2; exit "$1"; }
usage() { sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' scripts/fresh-seeds.sh; }

seconds=1800 seed=$(od -An -N4 -tu4 /dev/urandom | tr -d ' ') cases=
[ "${1-}" != --help ] || { usage; exit 0; }
while getopts t:s:c:h option; do
  case $option in
    t) seconds=$OPTARG ;;
    s) seed=$OPTARG ;;
    c) cases=$OPTARG ;;
    h) usage; exit 0 ;;
    *) fail 2 "see scripts/fresh-seeds.sh -h" ;;
  esac
done
shift $((OPTIND - 1))
[ $# = 0 ] || fail 2 "'$1' is not expected; see scripts/fresh-seeds.sh -h"
for number in "$seconds" "$seed" ${cases:+"$cases"}; do
  [[ $number =~ ^[0-9]{1,18}$ ]] || fail 2 "'$number' is no number; expected a whole number"
done
[ -z "$cases" ] || export PROPTEST_CASES=$cases

# The package, its program of tests, and which of them; nothing is all of them.
tests=(
  "adsdv-tests properties"
  "adsdv-tests judge conforming:: a_log_that_begins_or_ends_anywhere"
  "adsdv-tests fuzzed small_random"
  "adsdv-ffi fuzzed small_random"
  "adsdv round_trip"
  "adsdv-proofs theorems"
  "adsdv-model run random::"
)

log=${CARGO_TARGET_DIR:-target}/fresh-seeds.log
mkdir -p "$(dirname "$log")"
for test in "${tests[@]}"; do
  read -r package program _ <<<"$test"
  cargo test --locked -q -p "$package" --test "$program" --no-run || fail 2 "the tests of $package do not build"
done

rounds=0
while [ "$rounds" = 0 ] || [ "$SECONDS" -lt "$seconds" ]; do
  export ADSDV_SEED=$seed
  for test in "${tests[@]}"; do
    read -r package program names <<<"$test"
    # shellcheck disable=SC2086 # Names are words.
    if ! cargo test --locked -q -p "$package" --test "$program" -- $names >"$log" 2>&1; then
      cat "$log" >&2
      fail 1 "$package, $program: something is wrong with the seed $seed, after $rounds rounds. Again:
  ADSDV_SEED=$seed cargo test -p $package --test $program${names:+ -- $names}
What a property test has found is in its file of regressions: git status"
    fi
    # None of them is there any more, or it has another name.
    ! grep -q '^running 0 tests$' "$log" || fail 2 "$package, $program has no test '$names'"
  done
  rounds=$((rounds + 1))
  echo "seed $seed: nothing wrong, after $SECONDS s"
  seed=$((seed + 1))
done
