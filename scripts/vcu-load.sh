#!/bin/sh
# How much of one core `adsdv vcu` takes on a bus that carries other frames as well.
set -eu

usage() {
    cat <<'USAGE'
Usage: scripts/vcu-load.sh [-r RATE]... [-t SECONDS]

Drives `adsdv vcu` and `adsdv ai` on a virtual bus, has cangen send frames beside them, and prints which part of one core
the virtual car took, and how many frames a second there really were. On this machine's own kernel where that has vcan and
you are root; else in the small virtual machine of scripts/vm, whose core carries out a billion instructions a second: what
it prints does not depend on what else runs here, and a core of today carries out several times as many.

  -r RATE     frames a second that cangen sends beside those two; 0: none. May be given several times (default 0, 3000 and
              40000)
  -t SECONDS  for how long (default 10)
  -h, --help  this text

Environment:
  ADSDV       the program to measure instead of a release build of this checkout

Exit status: 0 measured, 2 wrong usage or something is not installed, 77 there is neither vcan nor a virtual machine.
USAGE
}

fail() {
    status=$1
    shift
    printf 'vcu-load: %s\n' "$*" >&2
    exit "$status"
}

# Processor time of a process, in hundredths of a second.
ticks() {
    set -- $(sed 's/.*) //' "/proc/$1/stat")
    echo $((${12} + ${13}))
}

# One rate, on a bus of its own.
measure() {
    bus=vload$1
    ip link add "$bus" type vcan
    ip link set "$bus" up
    "$adsdv" vcu "$bus" --plain --scenario mission >/dev/null & car=$!
    "$adsdv" ai "$bus" >/dev/null & ai=$!
    # One cangen waits too long between two frames for more than some thousands a second.
    others= left=$1
    while [ "$left" -gt 0 ]; do
        one=$((left > 4000 ? 4000 : left)) left=$((left > 4000 ? left - 4000 : 0))
        cangen "$bus" -g "$(awk "BEGIN { print 1000 / $one }")" -I 123 -L 8 -i & others="$others $!"
    done
    sleep 2
    frames=$(cat "/sys/class/net/$bus/statistics/rx_packets") used=$(ticks $car) begin=$(cut -d' ' -f1 /proc/uptime)
    sleep "$seconds"
    frames=$(($(cat "/sys/class/net/$bus/statistics/rx_packets") - frames)) used=$(($(ticks $car) - used))
    end=$(cut -d' ' -f1 /proc/uptime)
    # shellcheck disable=SC2086 # Words.
    kill $car $ai $others
    wait 2>/dev/null || true
    ip link del "$bus"
    awk "BEGIN { t = $end - $begin; printf \"%d frames/s: %.1f %% of one core\n\", $frames / t, $used / t }"
}

root=$(cd "$(dirname "$0")/.." && pwd)
PATH=$PATH:/usr/sbin:/sbin
rates=
seconds=10
inside=

[ "${1-}" != --help ] || { usage; exit 0; }
# -i is how the virtual machine calls this.
while getopts r:t:ih option; do
    case $option in
        r) rates="$rates $OPTARG" ;;
        t) seconds=$OPTARG ;;
        i) inside=1 ;;
        h) usage; exit 0 ;;
        *) usage >&2; exit 2 ;;
    esac
done
shift $((OPTIND - 1))
[ $# -eq 0 ] || { usage >&2; exit 2; }
rates=${rates:-0 3000 40000}
for number in $rates "$seconds"; do
    case $number in
        '' | *[!0-9]*) fail 2 "'$number' is no rate or time; give a whole number" ;;
    esac
done

if [ -n "$inside" ]; then
    adsdv=$ADSDV
    # busybox's own ip knows no vcan.
    ip() { /sbin/ip "$@"; }
    for rate in $rates; do measure "$rate"; done
    exit
fi

# shellcheck source=scripts/compare-common.sh
. "$root/scripts/compare-common.sh"
command -v cangen >/dev/null || fail 2 "cangen is not installed (Debian's can-utils)"
if ip link add vload type vcan 2>/dev/null; then
    ip link del vload
    for rate in $rates; do measure "$rate"; done
    exit
fi
echo "in a virtual machine of a billion instructions a second, for this kernel has no vcan, or this user may not make one"
given=
for rate in $rates; do given="$given -r $rate"; done
# shellcheck disable=SC2086 # Words.
ADSDV=$adsdv "$root/scripts/vm/run.sh" -e ADSDV -f "$adsdv" -f "$root/scripts/vcu-load.sh" \
    sh "$root/scripts/vcu-load.sh" -i -t "$seconds" $given
