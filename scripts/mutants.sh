#!/usr/bin/env bash
# How well the tests test: cargo mutants, group by group.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  cat <<'USAGE'
Usage: scripts/mutants.sh [--reasons] [GROUP...] [-- ARGUMENT...]

Changes the sources in every way that cargo mutants knows, one change at a time, and runs the tests: a change that no test
notices is a survivor. First the tests of the changed crate run; what they let pass goes through those of the crates
that use it.

Groups: spec, log (the readers of logs and of the protocol), judge, suite, conform, model; without any, all of them, in
that order. Arguments after -- go to cargo mutants, such as -j 2 or --shard 0/8.

--reasons only tells how many changes each exclusion in .cargo/mutants.toml excludes; one that excludes none is an error.

What was done is in target/mutation/GROUP/mutants.out; the last lines tell the numbers of each group.

Exit status: 0 no survivor, 1 a survivor, 2 it could not run.
USAGE
}

groups=() arguments=() reasons=
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) usage; exit 0 ;;
    --reasons) reasons=1 ;;
    --) shift; arguments=("$@"); break ;;
    spec | log | judge | suite | conform | model) groups+=("$1") ;;
    *) usage >&2; exit 2 ;;
  esac
  shift
done
[ ${#groups[@]} -gt 0 ] || groups=(spec log judge suite conform model)

if ! cargo mutants --version >/dev/null 2>&1; then
  echo "mutants.sh: cargo mutants is not installed; install it with: cargo install --locked cargo-mutants" >&2
  exit 2
fi

# Each exclusion is a line of its own in the list, a TOML literal string.
stale=0
all=$(cargo mutants --list --no-config -p adsdv-spec -p adsdv-oracle -p adsdv-model)
while IFS= read -r pattern; do
  found=$(grep -Ec -- "$pattern" <<<"$all" || true)
  [ -z "$reasons" ] || printf '%4d %s\n' "$found" "$pattern"
  [ "$found" -gt 0 ] || { stale=1; echo "mutants.sh: .cargo/mutants.toml excludes nothing by $pattern" >&2; }
done < <(sed -n "/^exclude_re = \[/,/^\]/s/^ *'\(.*\)',\$/\1/p" .cargo/mutants.toml)
[ -z "$reasons" ] && [ "$stale" = 0 ] || exit "$stale"

# The files of a group, the package they are in, the tests that run first, and those that run on what these let pass.
describe() {
  features=()
  case $1 in
    spec)
      files=('spec/src/**') package=adsdv-spec features=(--all-features)
      first=adsdv-spec then=adsdv-proofs
      ;;
    log)
      files=('oracle/src/candump/**' 'oracle/src/log.rs' 'oracle/src/protocol/**') package=adsdv-oracle
      first=adsdv-oracle then=adsdv-oracle,adsdv-tests,adsdv
      ;;
    judge)
      files=('oracle/src/judge/**') package=adsdv-oracle first=adsdv-oracle,adsdv-tests then=adsdv-tests,adsdv-can,adsdv
      ;;
    suite)
      files=('oracle/src/suite/**') package=adsdv-oracle first=adsdv-oracle then=adsdv-oracle,adsdv-tests,adsdv
      ;;
    conform)
      files=('oracle/src/conform/**') package=adsdv-oracle first=adsdv-oracle then=adsdv-oracle,adsdv
      ;;
    model)
      files=('model/src/**') package=adsdv-model first=adsdv-model then=adsdv-model,adsdv-tests,adsdv
      ;;
  esac
}

lines() { if [ -f "$1" ]; then wc -l <"$1"; else echo 0; fi; }

survivors=0 summary=
for group in "${groups[@]}"; do
  describe "$group"
  out=target/mutation/$group
  selected=(-p "$package" "${features[@]}" --colors never -o "$out" "${arguments[@]}")
  for file in "${files[@]}"; do selected+=(-f "$file"); done
  mkdir -p "$out"
  # Its exit status tells of survivors, which are counted below, and of what went wrong.
  ran() { case $1 in 0 | 2 | 3) ;; *) echo "mutants.sh: cargo mutants ended with status $1" >&2; exit 2 ;; esac; }
  rm -rf "$out/mutants.out" "$out/mutants.out.old"
  status=0; cargo mutants "${selected[@]}" --test-package "$first" || status=$?
  ran $status
  unviable=$(lines "$out/mutants.out/unviable.txt")
  caught=$(($(lines "$out/mutants.out/caught.txt") + $(lines "$out/mutants.out/timeout.txt")))
  missed=$(lines "$out/mutants.out/missed.txt")
  if [ "$missed" -gt 0 ]; then
    status=0; cargo mutants "${selected[@]}" --iterate --test-package "$then" || status=$?
    ran $status
    caught=$((caught + $(lines "$out/mutants.out/caught.txt") + $(lines "$out/mutants.out/timeout.txt")))
    missed=$(lines "$out/mutants.out/missed.txt")
  fi
  survivors=$((survivors + missed))
  summary+=$(printf '%-8s %7d %7d %9d %9d' "$group" $((caught + missed + unviable)) "$caught" "$unviable" "$missed")$'\n'
done

printf '\n%-8s %7s %7s %9s %9s\n%s' GROUP MUTANTS CAUGHT UNVIABLE SURVIVED "$summary"
[ "$survivors" = 0 ]
