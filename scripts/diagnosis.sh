#!/usr/bin/env bash
# How exact a diagnosis is: random deviations around the specification, and which of them are named.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  cat <<'USAGE'
Usage: scripts/diagnosis.sh [-k COUNT] [-n RUNS] [-s SEED]

Puts COUNT random deviations, each of which can be observed by itself, around the specification in each of RUNS programs of every
edition, diagnoses each program, and prints how many of the deviations are named exactly, missed, or cannot be observed beside the others, and what is named that
is none of them. What is missed or invented is printed, too.

  -k COUNT    deviations in each program (default: 1, 2, 4 and 8 in turn)
  -n RUNS     programs of each edition (default 12)
  -s SEED     another number is other deviations (default 1)
  -h          this text

Exit status: 0 measured, 2 wrong usage.
USAGE
}

counts="1 2 4 8" runs=12 seed=1
[ "${1-}" != --help ] || { usage; exit 0; }
while getopts k:n:s:h option; do
  case $option in
    k) counts=$OPTARG ;;
    n) runs=$OPTARG ;;
    s) seed=$OPTARG ;;
    h) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done
for number in $counts $runs $seed; do
  case $number in
    '' | 0* | *[!0-9]*) echo "diagnosis: '$number' is no number from 1 on" >&2; exit 2 ;;
  esac
done
cargo build --release --quiet --locked -p adsdv-diagnosis --example measure
for count in $counts; do
  target/release/examples/measure "$count" "$runs" "$seed"
done
