#!/usr/bin/env bash
# Builds every fuzzer of fuzz/ once, and runs each for a while: from the corpus and the inputs that went wrong once, with the
# dictionary of its format. fuzz/README.md tells about the fuzzers.
#
# usage: scripts/fuzz.sh [-t SECONDS] [-r RUNS] [-s SEED] [-j JOBS] [TARGET ...]
#   -t SECONDS  how long each fuzzer runs, 10 if nothing is said
#   -r RUNS     how many inputs each fuzzer runs at the most, as many as there is time for if nothing is said
#   -s SEED     the same inputs every time: drawn from this seed, a number from 1, and from what is committed alone. Less time
#               or fewer runs are fewer of the same inputs
#   -j JOBS     how many processes run one fuzzer at the same time, 1 if nothing is said; several fuzzers run beside each other
#               where there are more processors
#   TARGET      these alone, as in fuzz/Cargo.toml
#
# What it finds that is new goes to fuzz/target/corpus, where the next run without -s begins; the committed corpus stays as it is.
# Exit status: 0 nothing went wrong, 1 an input did, or a fuzzer does not build, 2 wrong usage, or a tool is missing.
set -euo pipefail
cd "$(dirname "$0")/.."

fail() { echo "fuzz.sh: $2" >&2; exit "$1"; }
usage() { sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' scripts/fuzz.sh; }

seconds=10 jobs=1 runs= seed=
[ "${1-}" != --help ] || { usage; exit 0; }
while getopts t:r:s:j:h option; do
  case $option in
    t) seconds=$OPTARG ;;
    r) runs=$OPTARG ;;
    s) seed=$OPTARG ;;
    j) jobs=$OPTARG ;;
    h) usage; exit 0 ;;
    *) fail 2 "see scripts/fuzz.sh -h" ;;
  esac
done
shift $((OPTIND - 1))
for number in "$seconds" "$jobs" ${runs:+"$runs"} ${seed:+"$seed"}; do
  [[ $number =~ ^[1-9][0-9]{0,8}$ ]] || fail 2 "'$number' is not expected; expected a whole number from 1 to 999999999"
done
[ -z "$seed" ] || [ "$jobs" = 1 ] || fail 2 "-s goes with one process: several change places by chance; leave out -j"

cargo +nightly --version >/dev/null 2>&1 \
  || fail 2 "there is no nightly toolchain; install it with: rustup toolchain install nightly"
cargo fuzz --version >/dev/null 2>&1 || fail 2 "cargo-fuzz is not installed; install it with: cargo install --locked cargo-fuzz"
# cargo-fuzz has no option to leave fuzz/Cargo.lock as it is.
cargo +nightly metadata --locked --format-version 1 --manifest-path fuzz/Cargo.toml >/dev/null \
  || fail 1 "fuzz/Cargo.lock is not up to date; write it with: cargo update --workspace --manifest-path fuzz/Cargo.toml"

all=$(cargo +nightly fuzz list)
for target in "$@"; do
  grep -qx -- "$target" <<<"$all" || fail 2 "there is no fuzzer '$target'; expected one of $(echo $all)"
done
targets=${*:-$all}

cargo +nightly fuzz build -O --debug-assertions || fail 1 "the fuzzers do not build"
# Longer than the longest line of a log or of a scenario: without it inputs are as long as the longest that is there already.
max_len=$(sed -n 's/^max_len = //p' fuzz/libfuzzer.options)
bin=fuzz/target/$(rustc +nightly -vV | sed -n 's/^host: //p')/release

# libFuzzer learns from what the program compares, addresses among it: the same inputs every time need the same addresses.
same=()
if [ -n "$seed" ]; then
  if setarch -R true 2>/dev/null; then
    same=(setarch -R)
  else
    echo "fuzz.sh: addresses change here from run to run, and so may the inputs: setarch -R does not work" >&2
  fi
fi

# one TARGET: runs it, and says what came of it.
one() {
  local target=$1 found artifacts log inputs options input test folder
  found=fuzz/target/${seed:+seed-}corpus/$target artifacts=fuzz/artifacts/$target log=fuzz/target/$target.log
  # What an earlier run has found is not among what is committed.
  [ -z "$seed" ] || rm -rf "$found"
  mkdir -p "$found" "$artifacts"
  inputs=("$found")
  for folder in corpus regressions; do
    [ ! -d "fuzz/$folder/$target" ] || inputs+=("fuzz/$folder/$target")
  done
  options=(-max_total_time="$seconds" -max_len="$max_len" -timeout=60 -rss_limit_mb=2048 -artifact_prefix="$artifacts/" -print_final_stats=1)
  [ -z "$runs" ] || options+=(-runs="$runs")
  [ -z "$seed" ] || options+=(-seed="$seed")
  [ ! -f "fuzz/dictionaries/$target.dict" ] || options+=(-dict="fuzz/dictionaries/$target.dict")
  # -fork goes on after an input that is slow or takes too much memory, unless options forbid it.
  [ "$jobs" = 1 ] || options+=(-fork="$jobs" -ignore_ooms=0 -ignore_timeouts=0)
  if "${same[@]}" "$bin/$target" "${options[@]}" "${inputs[@]}" >"$log" 2>&1; then
    awk -v target="$target" '
      /^#[0-9]+[ \t]/ { runs = $1; gsub(/[^0-9]/, "", runs); for (i = 2; i < NF; i++) if ($i == "cov:") cov = $(i + 1) }
      /^stat::number_of_executed_units/ { runs = $2 }
      END { printf "%-16s %10d runs, %6d edges, nothing went wrong\n", target, runs, cov }
    ' "$log"
    return
  fi
  input=$(sed -n 's/.*Test unit written to //p' "$log" | tail -n 1)
  printf '%-16s an input went wrong\n' "$target"
  {
    grep -E -A 8 'panicked at|ERROR: |SUMMARY: ' "$log" | head -n 40 || tail -n 20 "$log"
    echo
    echo "fuzz.sh: $target fails; all that it wrote is in $log"
    if [ -n "$input" ]; then
      echo "The input is $input. It fails again with"
      echo "  cargo +nightly fuzz run $target $input"
      echo "To make it smaller:"
      echo "  cargo +nightly fuzz tmin $target $input"
      echo "To make it a test of stable Rust, which fails until the program is mended, name it after what it is:"
      echo "  mkdir -p fuzz/regressions/$target && cp $input fuzz/regressions/$target/NAME"
      [ "$target" = c_border ] && test="-p adsdv-ffi" || test="-p adsdv-tests"
      echo "  cargo test $test --test fuzzed"
    fi
  } >&2
  return 1
}

# As many at once as there are processors for.
lanes=$(($(nproc) / jobs)) running=0 failed=0
for target in $targets; do
  if [ "$running" -gt 0 ] && [ "$running" -ge "$lanes" ]; then
    wait -n || failed=1
    running=$((running - 1))
  fi
  [ "$failed" = 0 ] || break
  one "$target" &
  running=$((running + 1))
done
while [ "$running" -gt 0 ]; do
  wait -n || failed=1
  running=$((running - 1))
done
exit "$failed"
