#!/bin/sh
# How fast recordings are read, decoded and judged, next to cantools, python-can and the reader of MCAP in Python, and next to gzip and
# Zstandard in front of a pipe; and what features of the build cost.
set -eu

usage() {
    cat <<'USAGE'
Usage: scripts/compare-decode.sh [-q] [-b] [-c COPIES] [-n RUNS]

Measures, on the same frames in every format, and prints one table of it with the aim of each ratio:

  decode   `adsdv decode` to text, next to `cantools decode`
  read     the readers of adsdv-formats, next to python-can and to the reader of MCAP that decodes ROS messages, as ours does; the
           one that only walks over the records stands below it
  unpack   `adsdv check` of .gz and .zst, next to `zcat | adsdv check -` and `zstdcat | adsdv check -`
  cores    `adsdv check` of 200 copies of a recording, on one core and on two
  build    how large `adsdv` is and how long a clean build takes, without features and with each (-b)

All but `cores` are seconds of processor time, of all processes and threads of the command, the least of several runs: what else the
machine does matters little. `cores` is the clock's: on a machine that does something else it is too low. The time that a program needs
to start, and Python to import a library, is not counted where readers are compared.

  -q          quick: few frames, two runs
  -b          `build` as well, some minutes for each feature
  -c COPIES   how often the log is repeated (default 10, with -q 5)
  -n RUNS     runs of each, of which the least counts (default 3, with -q 2)
  -h, --help  this text

Environment:
  ADSDV       the program to measure instead of a release build of this checkout
  PYTHON      the Python of which the virtual environment is made (default python3)

Exit status: 0 all aims are met, 1 one is not, or a program failed, 2 wrong usage or something is not installed.
USAGE
}

fail() {
    status=$1
    shift
    printf 'compare-decode: %s\n' "$*" >&2
    exit "$status"
}

root=$(cd "$(dirname "$0")/.." && pwd)
copies=10
runs=3
many=200
build=
quick=

[ "${1-}" != --help ] || { usage; exit 0; }
while getopts qbc:n:h option; do
    case $option in
        q) quick=yes copies=5 runs=2 ;;
        b) build=yes ;;
        c) copies=$OPTARG ;;
        n) runs=$OPTARG ;;
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
command -v "${PYTHON:-python3}" >/dev/null || fail 2 "there is no '${PYTHON:-python3}'; set PYTHON"
command -v cargo >/dev/null || fail 2 "cargo is not installed; see https://rustup.rs"

# What has to be built, with the features that read: MCAP is one.
target=${CARGO_TARGET_DIR:-$root/target}
if [ -z "${ADSDV-}" ]; then
    cargo build --quiet --release --manifest-path "$root/Cargo.toml" -p adsdv --features mcap || fail 1 "adsdv does not build"
    ADSDV=$target/release/adsdv
fi
# shellcheck source=scripts/compare-common.sh
. "$root/scripts/compare-common.sh"
cargo build --quiet --release --manifest-path "$root/Cargo.toml" -p adsdv-formats --all-features --example speed ||
    fail 1 "the reader does not build"
speed=$target/release/examples/speed

venv=$root/target/compare-decode
python=$venv/bin/python
if ! [ -x "$python" ] || ! "$python" -c 'import can, cantools, mcap_ros2, zstandard, lz4' 2>/dev/null; then
    "${PYTHON:-python3}" -m venv "$venv" || fail 2 "a virtual environment cannot be made in $venv"
    "$python" -m pip --disable-pip-version-check --quiet install python-can cantools mcap mcap-ros2-support zstandard lz4 ||
        fail 2 "python-can, cantools and mcap cannot be installed"
fi
measure() { "$python" "$root/scripts/compare_decode.py" "$@"; }

log=$root/tests/logs/mission.log
frames=$(measure write "$dir" "$log" "$copies") || fail 1 "the recordings cannot be written"
missed=0

# row WHAT OURS THEIRS AIM: the ratio of the two, and whether it is what it should be: at least AIM, or with a - before it, at most.
row() {
    verdict=$(awk -v ours="$2" -v theirs="$3" -v aim="$4" -v what="$1" 'BEGIN {
        if (aim == "") { ratio = theirs / ours; met = 1; words = "" }
        else if (aim + 0 < 0) { ratio = ours / theirs; met = ratio <= -aim; words = sprintf("at most %s", -aim) }
        else { ratio = theirs / ours; met = ratio >= aim + 0; words = sprintf("at least %s", aim) }
        printf "%-34s %9.3f s %9.3f s %7.1f  %-12s %s\n", what, ours, theirs, ratio, words, met ? "" : "MISSED"
    }')
    printf '%s\n' "$verdict"
    case $verdict in *MISSED) missed=1 ;; esac
}

# least SECONDS...: the least of several lines' first words.
least() { awk 'NR == 1 || $1 < least { least = $1 } END { print least }'; }
# theirs ARGUMENTS: the least that Python took.
theirs() {
    run=0
    while [ "$run" -lt "$runs" ]; do
        run=$((run + 1))
        measure "$@" || fail 1 "$* failed"
    done | least
}
# ours COMMAND: the least seconds of processor time.
ours() { measure time "$runs" "$1" | cut -d ' ' -f 1; }
# running COMMAND START: the same without what its program takes to start, which START alone does.
running() { echo "$(ours "$1") $(ours "$2")" | awk '{ printf "%.6f", ($1 > $2) ? $1 - $2 : 0.000001 }'; }
# clock COMMAND: the least seconds of the clock.
clock() { measure time "$runs" "$1" | cut -d ' ' -f 2; }

echo "$frames frames ($copies copies of $(basename "$log")), the least of $runs runs, seconds of processor time"
printf '%-34s %11s %11s %7s  %s\n' '' adsdv other ratio aim

"$adsdv" dbc --edition 4.0 >"$dir/interface.dbc" || fail 1 "adsdv dbc failed"
awk '{ print $1, $2, $3 }' "$dir/run.log" | head -n 40000 >"$dir/decode.log"
row 'decode to text; cantools' "$(running "$adsdv decode $dir/decode.log --single-line" "$adsdv --version")" "$(theirs dump "$dir/interface.dbc" "$dir/decode.log")" 30
for file in asc blf trc csv log; do
    row "read $file; python-can" "$(running "$speed --once $dir/run.$file" "$speed --once")" "$(theirs read "$dir/run.$file")" 20
done
for pack in none lz4 zstd; do
    took=$(running "$speed --once $dir/run-$pack.mcap" "$speed --once")
    row "read MCAP, $pack; mcap-ros2-support" "$took" "$(theirs read "$dir/run-$pack.mcap")" 20
    row '  its records alone; mcap' "$took" "$(theirs read "$dir/run-$pack.records")" ''
done

if command -v gzip >/dev/null; then
    gzip -k "$dir/run.log"
    row 'check .gz; zcat | adsdv check -' "$(ours "$adsdv check $dir/run.log.gz")" "$(ours "zcat $dir/run.log.gz | $adsdv check -")" -1.5
fi
if command -v zstd >/dev/null; then
    zstd -q -k "$dir/run.log"
    row 'check .zst; zstdcat | adsdv check -' "$(ours "$adsdv check $dir/run.log.zst")" "$(ours "zstdcat $dir/run.log.zst | $adsdv check -")" -1.5
else
    echo "check .zst: zstd is not installed; try: apt-get install zstd"
fi

if [ "$(nproc)" -ge 2 ]; then
    mkdir "$dir/season"
    copy=0
    while [ "$copy" -lt "$many" ]; do
        copy=$((copy + 1))
        cp "$log" "$dir/season/$copy.log"
    done
    one=$(clock "RAYON_NUM_THREADS=1 $adsdv check $dir/season")
    two=$(clock "RAYON_NUM_THREADS=2 $adsdv check $dir/season")
    row "check $many logs: 2 cores; 1 core" "$two" "$one" 1.7
else
    echo "check $many logs: there is one core"
fi

if [ -n "$build" ]; then
    printf '\n%-34s %11s %11s\n' 'clean build of adsdv' bytes 'clock'
    features=$(sed -n '/^\[features\]/,/^\[/s/^\([a-z][a-z0-9-]*\) *=.*/\1/p' "$root/cli/Cargo.toml" | grep -v '^default$' || :)
    for feature in none $features; do
        with=
        [ "$feature" = none ] || with="--features $feature"
        begin=$(date +%s)
        # shellcheck disable=SC2086 # It is two words, or none.
        cargo build --quiet --release --manifest-path "$root/Cargo.toml" --target-dir "$dir/build-$feature" -p adsdv --no-default-features $with ||
            fail 1 "adsdv does not build with $feature"
        printf '%-34s %11s %9s s\n' "$feature" "$(wc -c <"$dir/build-$feature/release/adsdv")" "$(($(date +%s) - begin))"
        rm -rf "$dir/build-$feature"
    done
fi
[ -z "$quick" ] || echo "A quick run: the figures are rough."
exit "$missed"
