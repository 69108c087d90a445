#!/usr/bin/env bash
# Proves every theorem with Kani: cargo kani -p adsdv-proofs.
#
# usage: scripts/kani.sh [--limits] [ARGUMENT ...]
#        scripts/kani.sh [--limits] --since REV
#   --limits     a theorem that takes longer than 30 s is a failure, and an edition whose theorems take longer than 10 minutes; without
#                it the script only says so, for it depends on the machine and the solver
#   ARGUMENT     for cargo kani, such as --harness time:: ; then only what they choose has to be verified
#   --since REV  only the theorems of the files of proofs/src that differ from REV, for daily work; where what all stand on differs,
#                spec or the words, it says so and proves all
#
# Kani fails when a theorem does not hold. An interesting case that cannot be reached does not make it fail, so its output is
# read for those (tests/src/bin/kani_output): a theorem that holds for want of a case proves nothing. It has to be the regular
# output, of one harness after the other: the terse one, which -j needs, does not tell the cases.
#
# All that Kani writes is in target/kani.log.
# Exit status: 0 all is verified and every case reached, 1 something is not, 2 Kani is not installed.
set -euo pipefail
cd "$(dirname "$0")/.."

if [ "${1-}" = -h ] || [ "${1-}" = --help ]; then
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' scripts/kani.sh
  exit
fi
# The modules of proofs whose files differ, as --harness chooses them; nothing if what all of them stand on does.
since() {
  local file module shared=
  while IFS= read -r file; do
    case $file in
      spec/src/* | proofs/src/words.rs | proofs/src/prelude.rs | proofs/src/subject.rs | proofs/src/steps.rs | proofs/src/document.rs | proofs/src/coded.rs)
        shared=$file ;;
      proofs/src/lib.rs | proofs/src/theorems.rs | proofs/src/seed.rs | proofs/src/kani/* | */mod.rs) ;;
      proofs/src/*.rs)
        module=${file#proofs/src/}
        module=${module%.rs}
        echo "${module//\//::}::" ;;
    esac
  done < <(git diff --name-only "$1" -- spec/src proofs/src && git ls-files --others --exclude-standard -- proofs/src)
  [ -z "$shared" ] || echo "all: $shared"
}
limits=()
if [ "${1-}" = --limits ]; then
  limits=(--limits)
  shift
fi
if [ "${1-}" = --since ]; then
  [ $# = 2 ] && git rev-parse --quiet --verify "$2^{commit}" >/dev/null || { echo "kani.sh: --since takes a revision of this repository" >&2; exit 2; }
  modules=$(since "$2")
  set --
  case $modules in
    '') echo "kani.sh: no file with theorems differs"; exit 0 ;;
    *all:*) echo "kani.sh: ${modules##*all: } differs, on which all theorems stand: all are proven" ;;
    *) for module in $modules; do set -- "$@" --harness "$module"; done; echo "kani.sh: $*" ;;
  esac
fi
if ! cargo kani --version >/dev/null 2>&1; then
  echo "kani.sh: Kani is not installed; install it with: cargo install --locked kani-verifier && cargo kani setup" >&2
  exit 2
fi

log=${CARGO_TARGET_DIR:-target}/kani.log
mkdir -p "$(dirname "$log")"
some=()
[ $# = 0 ] || some=(--some)

# To follow it: each harness and its answer. The checks are many thousand lines.
kani=0
cargo kani -p adsdv-proofs "$@" 2>&1 | tee "$log" \
  | { grep --line-buffered -E '^(Checking harness|Failed Checks|CBMC failed|VERIFICATION|Verification Time|Complete|error|warning)' || true; } \
  || kani=${PIPESTATUS[0]}

read=0
cargo run --quiet --locked -p adsdv-tests --bin kani_output -- "${some[@]}" "${limits[@]}" "$log" || read=$?
if [ "$kani" != 0 ] && [ "$read" = 0 ]; then
  tail -n 20 "$log" >&2
  echo "kani.sh: cargo kani ended with $kani; all that it wrote is in $log" >&2
fi
[ "$kani" = 0 ] && [ "$read" = 0 ] || exit 1
