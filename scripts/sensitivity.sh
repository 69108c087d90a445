#!/usr/bin/env bash
# How much the judge sees, and that it blames nobody who is right: every mutation of an edition's table, times and thresholds, and
# every VCU that remembers something otherwise or whose flag in 520h is stuck, drives missions on a simulated bus, whose recordings are late or lose frames; the judge says of each what it can, and two observers what could be told: by all that was decided, and by the documents' words alone. Behind that, the VCU of
# the specification does anything at all, and the judge must not blame it.
#
# usage: scripts/sensitivity.sh [-s | -k KIND [-m PART]] [-e EDITION] [-n RUNS]
#   -s          the specification only, which takes much less time
#   -k KIND     the mutants of one kind only: table, time, memory or flag
#   -m PART     of these only the mutants whose names contain this, with what is said of each
#   -e EDITION  3.0, 4.0 or 2026; 3.0 if nothing is said
#   -n RUNS     how many runs of the specification are judged; 20000 if nothing is said
# A recording in which the specification is blamed is kept in target/sensitivity, for adsdv check.
# SENSITIVITY names a built program; without it one is built, optimised.
# Exit status: 0 the specification was never blamed, 1 it was, 2 wrong usage.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() { sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' scripts/sensitivity.sh; }
edition=3.0 runs=20000 only= part=
[ "${1-}" != --help ] || { usage; exit 0; }
while getopts sk:m:e:n:h option; do
  case $option in
    s) only=soundness ;;
    k) only=$OPTARG ;;
    m) part=$OPTARG ;;
    e) edition=$OPTARG ;;
    n) runs=$OPTARG ;;
    h) usage; exit 0 ;;
    *) echo "sensitivity.sh: see scripts/sensitivity.sh -h" >&2; exit 2 ;;
  esac
done
[[ $runs =~ ^[0-9]{1,12}$ ]] || { echo "sensitivity.sh: '$runs' is no number of runs" >&2; exit 2; }
# Of the specification alone there are no mutants to choose from.
[ -z "$part" ] || [[ -n $only && $only != soundness ]] || { echo "sensitivity.sh: -m goes with -k" >&2; exit 2; }
program=(cargo run --release --locked -q -p adsdv-tests --bin sensitivity --)
[ -z "${SENSITIVITY-}" ] || program=("$SENSITIVITY")
exec "${program[@]}" "$edition" "$runs" $only ${part:+"$part"}
