#!/bin/sh
# How fast `adsdv verify` explores the state machine, next to Spin, which explores the same one as a Promela model.
set -eu

usage() {
    cat <<'USAGE'
Usage: scripts/compare-spin.sh [-n RUNS] [-v VECTORS]

Writes the Promela model with `adsdv export`, compiles Spin's verifier from it, and lets the verifier and
`adsdv verify` explore it in turn, to the end. Prints what each has explored, which has to be the same, the
best run of each, and their ratio: once with both pinned to the same core, for Spin uses one, and once with
adsdv on all cores. What it takes to compile Spin's verifier is printed beside, and not counted.

  -n RUNS     runs of each program, of which the best counts (default 3)
  -v VECTORS  which input vectors are tried at each state: every (all combinations), read (those that can
              matter), or both, one after the other (default both)
  -h, --help  this text

Environment:
  ADSDV       the program to measure instead of a release build of this checkout
  ADSDV_EDITION
              the edition to explore, such as 4.0 (default: that of adsdv)
  CC          the C compiler for Spin's verifier (default cc)

Exit status: 0 measured, 1 a program failed or the two disagree, 2 wrong usage or something is not installed.
USAGE
}

fail() {
    status=$1
    shift
    printf 'compare-spin: %s\n' "$*" >&2
    exit "$status"
}

root=$(cd "$(dirname "$0")/.." && pwd)
runs=3
vectors=both

[ "${1-}" != --help ] || { usage; exit 0; }
while getopts n:v:h option; do
    case $option in
        n) runs=$OPTARG ;;
        v) vectors=$OPTARG ;;
        h) usage; exit 0 ;;
        *) usage >&2; exit 2 ;;
    esac
done
shift $((OPTIND - 1))
[ $# -eq 0 ] || { usage >&2; exit 2; }
case $runs in
    '' | 0* | *[!0-9]*) fail 2 "'$runs' is no number of runs; give one of at least 1" ;;
esac
case $vectors in
    every | read) ;;
    both) vectors='read every' ;;
    *) fail 2 "'$vectors' are no vectors; give every, read or both" ;;
esac
cc=${CC:-cc}
command -v spin >/dev/null || fail 2 "spin is not installed; try: apt-get install spin"
command -v "$cc" >/dev/null || fail 2 "there is no C compiler '$cc'; try: apt-get install gcc libc6-dev"

# shellcheck source=scripts/compare-common.sh
. "$root/scripts/compare-common.sh"
cores=$(nproc)

spin_explores() {
    # shellcheck disable=SC2086 # $pin is several words, or none.
    (cd "$dir" && $pin ./pan -m100000 -w20) >"$dir/pan.out" 2>&1 || fail 1 "Spin's verifier failed: $(tail -n 3 "$dir/pan.out")"
    ! grep -e '^error:' -e 'max search depth too small' "$dir/pan.out" || fail 1 "Spin's verifier stopped early"
}

# adsdv_explores PIN: sets $took to the time that the exploration takes, which adsdv says. It also looks for dead parts of
# the table meanwhile, which Spin does not, and for the shortest runs afterwards, which is not counted.
adsdv_explores() {
    # shellcheck disable=SC2086 # $1 is several words, or none.
    $1 "$adsdv" verify --model open --vectors "$vector" --json >"$dir/adsdv.out" 2>"$dir/stderr" ||
        fail 1 "adsdv verify failed with status $?: $(head -n 3 "$dir/stderr")"
    took=$(number seconds | awk '{ printf "%.0f", $1 * 1e9 }')
}

# number KEY: the first number of this name in the JSON that adsdv has printed.
number() {
    sed -n "s/.*\"models\":\[{[^[]*\"$1\":\([0-9.]*\).*/\1/p" "$dir/adsdv.out"
}

# ns COMMAND...: sets $took to the time it takes, in nanoseconds.
ns() {
    begin=$(date +%s%N)
    "$@"
    took=$(($(date +%s%N) - begin))
}

# best OLD: prints the lesser of $took and OLD, which may be empty.
best() {
    if [ -n "$1" ] && [ "$1" -le "$took" ]; then echo "$1"; else echo "$took"; fi
}

compile() {
    (cd "$dir" && spin -a vcu.pml && "$cc" -O2 -DSAFETY -DNOREDUCE -DNOCOMP -o pan pan.c) >"$dir/stderr" 2>&1 ||
        fail 1 "Spin's verifier does not compile: $(head -n 3 "$dir/stderr")"
}

# before WORDS FILE: prints the first number in front of these words, however its thousands are set apart.
before() {
    sed -n "s/.*\(^\|[^0-9.,_e+]\)\([0-9][0-9.,_e+]*\) $1.*/\2/p" "$2" | head -n 1 | tr -d ,_
}

compare() {
    "$adsdv" export --format promela --vectors "$vector" >"$dir/vcu.pml" || fail 1 "adsdv export failed with status $?"
    ns compile
    compiled=$took
    best_spin=
    best_one=
    best_all=
    run=0
    while [ "$run" -lt "$runs" ]; do
        run=$((run + 1))
        ns spin_explores
        best_spin=$(best "$best_spin")
        adsdv_explores "$pin"
        best_one=$(best "$best_one")
        adsdv_explores ""
        best_all=$(best "$best_all")
    done
    awk -v vector="$vector" -v runs="$runs" -v core="$core" -v cores="$cores" -v compiled="$compiled" \
        -v spin="$best_spin" -v one="$best_one" -v all="$best_all" \
        -v spin_states="$(before 'states, stored' "$dir/pan.out")" \
        -v spin_steps="$(before 'transitions (= stored+matched)' "$dir/pan.out")" \
        -v states="$(number states)" -v steps="$(number transitions)" 'BEGIN {
        # Spin counts the initial state, and a power cycle from each other one. It prints eight digits.
        spin_steps -= spin_states
        off = spin_steps - steps
        if (spin_states + 0 != states + 0 || off > steps / 1e7 || off < -steps / 1e7 || steps + 0 == 0) {
            printf "compare-spin: Spin explores %d states and %d steps, adsdv %d and %d\n", \
                spin_states, spin_steps, states, steps >"/dev/stderr"
            exit 1
        }
        printf "%s vectors: %d control states, %d steps, the same for both; best of %d runs each\n", \
            vector, states, steps, runs
        shape = "%-12s %12.0f steps/s %8.3f s  on %s\n"
        printf shape, "Spin", steps / spin * 1e9, spin / 1e9, core
        printf shape, "adsdv verify", steps / one * 1e9, one / 1e9, core
        printf shape, "adsdv verify", steps / all * 1e9, all / 1e9, cores " cores"
        printf "adsdv verify %12.2f times as fast as Spin on one core, %.2f times with all\n", spin / one, spin / all
        printf "             %12.3f s more before Spin can begin: its verifier is compiled\n", compiled / 1e9
    }' || exit 1
}

for vector in $vectors; do
    compare
done
