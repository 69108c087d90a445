#!/bin/sh
# How fast `adsdv check` judges a log, next to log2asc of can-utils, which only reformats it, and next to wc, which only
# finds the ends of its lines; and whether its memory grows with the log.
set -eu

usage() {
    cat <<'USAGE'
Usage: scripts/compare-log2asc.sh [-c COPIES] [-n RUNS] [-l LOG]

Measures `adsdv check` and `log2asc` on the same long log, in turn, each pinned to one core, and prints for
each the best run in frames per second, their ratio, and the memory that adsdv takes for one copy of the log
and for all of them. `wc -l` beside them finds the ends of the lines and nothing else.

  -c COPIES   how often the log is repeated, its time going on (default 60)
  -n RUNS     runs of each program, of which the best counts (default 5)
  -l LOG      the log to repeat, of candump -L (default tests/logs/mission.log)
  -h, --help  this text

Environment:
  ADSDV       the program to measure instead of a release build of this checkout

Exit status: 0 measured, 1 a program failed, 2 wrong usage or something is not installed.
USAGE
}

fail() {
    status=$1
    shift
    printf 'compare-log2asc: %s\n' "$*" >&2
    exit "$status"
}

root=$(cd "$(dirname "$0")/.." && pwd)
copies=60
runs=5
log=$root/tests/logs/mission.log

[ "${1-}" != --help ] || { usage; exit 0; }
while getopts c:n:l:h option; do
    case $option in
        c) copies=$OPTARG ;;
        n) runs=$OPTARG ;;
        l) log=$OPTARG ;;
        h) usage; exit 0 ;;
        *) usage >&2; exit 2 ;;
    esac
done
shift $((OPTIND - 1))
[ $# -eq 0 ] || { usage >&2; exit 2; }
for number in "$copies" "$runs"; do
    case $number in
        '' | 0* | *[!0-9]*) fail 2 "'$number' is no number of copies or runs; give one of at least 1" ;;
    esac
done
[ -s "$log" ] || fail 2 "there is no log '$log'; name one with -l"
command -v log2asc >/dev/null || fail 2 "log2asc is not installed; try: apt-get install can-utils"

# shellcheck source=scripts/compare-common.sh
. "$root/scripts/compare-common.sh"

# The first copy is the log itself. Each further one begins a second after the end of the one before it; whole
# seconds are added, so that no digit of the fraction is lost.
awk -v copies="$copies" '
    match($0, /^\([0-9]+/) {
        second[++count] = substr($0, 2, RLENGTH - 1) + 0
        rest[count] = substr($0, RLENGTH + 1)
    }
    END {
        length_s = second[count] - second[1] + 2
        for (copy = 0; copy < copies; copy++)
            for (line = 1; line <= count; line++)
                printf "(%010.0f%s\n", second[line] + copy * length_s, rest[line]
    }' "$log" >"$dir/big.log"
frames=$(wc -l <"$dir/big.log")
[ "$frames" -gt 0 ] || fail 2 "'$log' holds no frame; a line begins with a time, such as (1436509052.249713)"
head -n $((frames / copies)) "$dir/big.log" >"$dir/small.log"
interface=$(awk '{ print $2; exit }' "$dir/small.log")

# check LOG: 1 says that the log has findings, which a log put together from copies has.
check() {
    status=0
    # shellcheck disable=SC2086 # $pin is several words, or none.
    $pin "$adsdv" check "$1" >/dev/null 2>"$dir/stderr" || status=$?
    [ "$status" -le 1 ] || fail 1 "adsdv check failed with status $status: $(head -n 3 "$dir/stderr")"
}

reformat() {
    # shellcheck disable=SC2086 # $pin is several words, or none.
    $pin log2asc -I "$1" "$interface" >/dev/null || fail 1 "log2asc failed with status $?"
}

lines() {
    # shellcheck disable=SC2086 # $pin is several words, or none.
    $pin wc -l "$1" >/dev/null || fail 1 "wc failed with status $?"
}

# ns COMMAND LOG: sets $took to the time it takes, in nanoseconds.
ns() {
    begin=$(date +%s%N)
    "$@"
    took=$(($(date +%s%N) - begin))
}

# peak LOG: prints the most memory that adsdv held resident, in KiB.
peak() {
    if [ -x /usr/bin/time ] && /usr/bin/time -f %M -o "$dir/peak" true 2>/dev/null; then
        /usr/bin/time -f %M -o "$dir/peak" "$adsdv" check "$1" >/dev/null 2>&1 || :
        tail -n 1 "$dir/peak"
    elif command -v python3 >/dev/null; then
        python3 - "$adsdv" "$1" <<'PYTHON'
import resource, subprocess, sys
quiet = subprocess.DEVNULL
subprocess.run([sys.argv[1], "check", sys.argv[2]], stdout=quiet, stderr=quiet)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
PYTHON
    else
        echo unknown
    fi
}

# Once each beforehand, for the file and the programs to be in memory.
check "$dir/big.log"
reformat "$dir/big.log"

best_adsdv=
best_log2asc=
best_lines=
run=0
while [ "$run" -lt "$runs" ]; do
    run=$((run + 1))
    ns check "$dir/big.log"
    [ -n "$best_adsdv" ] && [ "$best_adsdv" -le "$took" ] || best_adsdv=$took
    ns reformat "$dir/big.log"
    [ -n "$best_log2asc" ] && [ "$best_log2asc" -le "$took" ] || best_log2asc=$took
    ns lines "$dir/big.log"
    [ -n "$best_lines" ] && [ "$best_lines" -le "$took" ] || best_lines=$took
done

echo "$frames frames ($copies copies of $(basename "$log")), best of $runs runs each, on $core"
awk -v frames="$frames" -v adsdv="$best_adsdv" -v log2asc="$best_log2asc" -v lines="$best_lines" 'BEGIN {
    shape = "%-12s %12.0f frames/s %8.3f s\n"
    printf shape, "adsdv check", frames / adsdv * 1e9, adsdv / 1e9
    printf shape, "log2asc", frames / log2asc * 1e9, log2asc / 1e9
    printf shape, "wc -l", frames / lines * 1e9, lines / 1e9
    printf "%-12s %12.1f times as fast as log2asc\n", "adsdv check", log2asc / adsdv
}'
echo "memory       $(peak "$dir/small.log") KiB for 1 copy, $(peak "$dir/big.log") KiB for $copies"
