#!/bin/sh
# How much of one core `adsdv watch` takes to judge a bus as it runs, and whether it loses frames.
set -eu

usage() {
    cat <<'USAGE'
Usage: scripts/watch-load.sh [-r RATE]... [-t SECONDS] [-l LOG]

Sends the frames of a log to the standard input of `adsdv watch -` at a rate, with the times at which they are sent, and
prints which part of one core it took and how many frames it counted. The log is repeated as often as needed.

  -r RATE     frames a second; may be given several times (default 4000 and 40000)
  -t SECONDS  for how long (default 10)
  -l LOG      the log whose frames are sent, of candump -L (default tests/logs/mission.log)
  -h, --help  this text

Environment:
  ADSDV       the program to measure instead of a release build of this checkout

Exit status: 0 measured, 1 frames got lost or a program failed, 2 wrong usage or something is not installed.
USAGE
}

fail() {
    status=$1
    shift
    printf 'watch-load: %s\n' "$*" >&2
    exit "$status"
}

root=$(cd "$(dirname "$0")/.." && pwd)
rates=
seconds=10
log=$root/tests/logs/mission.log

[ "${1-}" != --help ] || { usage; exit 0; }
while getopts r:t:l:h option; do
    case $option in
        r) rates="$rates $OPTARG" ;;
        t) seconds=$OPTARG ;;
        l) log=$OPTARG ;;
        h) usage; exit 0 ;;
        *) usage >&2; exit 2 ;;
    esac
done
shift $((OPTIND - 1))
[ $# -eq 0 ] || { usage >&2; exit 2; }
rates=${rates:-4000 40000}
for number in $rates "$seconds"; do
    case $number in
        '' | 0* | *[!0-9]*) fail 2 "'$number' is no rate or time; give a whole number of at least 1" ;;
    esac
done
[ -s "$log" ] || fail 2 "there is no log '$log'; name one with -l"
command -v python3 >/dev/null || fail 2 "python3 is not installed, which sends the frames"

# shellcheck source=scripts/compare-common.sh
. "$root/scripts/compare-common.sh"

for rate in $rates; do
    python3 - "$adsdv" "$rate" "$seconds" "$log" <<'PYTHON' || exit 1
import re, resource, subprocess, sys, tempfile, time

adsdv, rate, seconds, log = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
frames = [line.split(" ", 1)[1] for line in open(log) if line.startswith("(")]
total = rate * seconds
said = tempfile.TemporaryFile("w+")
watch = subprocess.Popen([adsdv, "watch", "-"], stdin=subprocess.PIPE, stdout=said, text=True)
start, sent = time.time(), 0
while sent < total:
    due = min(total, int((time.time() - start) * rate))
    lines = [f"({start + place / rate:.6f}) {frames[place % len(frames)]}" for place in range(sent, due)]
    watch.stdin.write("".join(lines))
    watch.stdin.flush()
    sent = max(sent, due)
    time.sleep(0.001)
took = time.time() - start
watch.communicate()
said.seek(0)
text = said.read()
used = resource.getrusage(resource.RUSAGE_CHILDREN)
counted = re.search(r": (\d+) frames in ", text)
dropped = re.search(r"(\d+) frames dropped", text)
print(
    f"{rate} frames/s for {took:.1f} s: {100 * (used.ru_utime + used.ru_stime) / took:.1f} % of one core,"
    f" {counted[1] if counted else '?'} of {total} frames counted, {dropped[1] if dropped else '?'} dropped"
)
sys.exit(counted is None or int(counted[1]) != total)
PYTHON
done
