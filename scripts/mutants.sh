#!/usr/bin/env bash
# How well the tests test: cargo mutants, group by group.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  cat <<'USAGE'
Usage: scripts/mutants.sh [--resume | --reasons] [--without-snapshots] [GROUP...] [-- ARGUMENT...]

Changes the sources in every way that cargo mutants knows, one change at a time, and runs the tests: a change that no test
notices is a survivor. First the tests run that find most in little time; what they let pass goes through all others of
the crates that use it.

With cargo-nextest the tests of a change end at the first that fails, which takes half the time.

Groups: spec, log (the readers of logs), judge, suite (with the protocol), conform, model; without any, all of them, in
that order. Arguments after -- go to cargo mutants, such as -j 2 or --shard 0/8.

--resume goes on where the last run ended: what was caught is not tried again.
--without-snapshots leaves out the tests that compare a whole text with one that is written down. It is for log, judge, suite
and conform: of the model such tests are a target of their own.
--reasons only tells how many changes each exclusion in .cargo/mutants.toml excludes; one that excludes none is an error.

target/mutation/GROUP has the lists: caught.txt, unviable.txt (does not compile) and survived.txt; its mutants.out has the
output of the last tests. The last lines tell the numbers of each group.

Exit status: 0 no survivor, 1 a survivor, 2 it could not run.
USAGE
}

# Parts of the names of tests that compare texts: those of the judge, of conform and the suite, and of the command.
snapshots=(
  as_written golden:: cut_before_as_ready go_too_early a_silent_ai_computer a_locked_wheel the_two_recordings
  go_that_a_vcu_in_a_late_recording_does_not_hear one_that_ends_before_as_ready one_that_begins_later
  other_requests_and_another_cycle
)
groups=() arguments=() reasons= resume= skipped=
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) usage; exit 0 ;;
    --reasons) reasons=1 ;;
    --resume) resume=1 ;;
    --without-snapshots) skipped=" ${snapshots[*]/#/--skip }" ;;
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

# nextest ends with the first test that fails, cargo test with the last.
if cargo nextest --version >/dev/null 2>&1; then
  tool=nextest run=(cargo nextest run --cargo-quiet --cargo-profile mutants)
  export NEXTEST_PROFILE=mutants
else
  tool=cargo run=(cargo test --quiet --profile mutants)
fi

# Each exclusion is a line of its own in the list, a TOML literal string.
stale=0
all=$(cargo mutants --list --no-config -p adsdv-spec -p adsdv-oracle -p adsdv-conform -p adsdv-model)
while IFS= read -r pattern; do
  found=$(grep -Ec -- "$pattern" <<<"$all" || true)
  [ -z "$reasons" ] || printf '%4d %s\n' "$found" "$pattern"
  [ "$found" -gt 0 ] || { stale=1; echo "mutants.sh: .cargo/mutants.toml excludes nothing by $pattern" >&2; }
done < <(sed -n "/^exclude_re = \[/,/^\]/s/^ *'\(.*\)',\$/\1/p" .cargo/mutants.toml)
[ -z "$reasons" ] && [ "$stale" = 0 ] || exit "$stale"

# The files of a group, the package they are in, and the tests that run on them, round by round: packages, then what
# cargo test gets, then after a bar what the tests get. Where all tests take long, those go first that catch much
# and take little.
describe() {
  features=()
  # Doc tests take as long as all other tests together.
  local every='--lib --bins --tests'
  case $1 in
    spec)
      files=('spec/src/**') package=adsdv-spec features=(--all-features)
      rounds=("adsdv-spec $every" "adsdv-proofs $every")
      ;;
    log)
      files=('oracle/src/candump/**' 'oracle/src/log/**') package=adsdv-oracle
      rounds=('adsdv-oracle --lib --test=log' "adsdv-oracle,adsdv-tests,adsdv $every")
      ;;
    judge)
      files=('oracle/src/judge/**') package=adsdv-oracle
      rounds=(
        'adsdv-tests --test=judge'
        'adsdv-oracle --lib --test=log'
        "adsdv-oracle,adsdv-tests,adsdv-can,adsdv $every"
      )
      ;;
    suite)
      files=('conform/src/suite/**' 'conform/src/protocol/**') package=adsdv-conform
      rounds=('adsdv-conform --test=suite --test=protocol' "adsdv-conform,adsdv-tests,adsdv $every")
      ;;
    conform)
      files=('conform/src/conform/**') package=adsdv-conform
      rounds=(
        'adsdv-conform --lib --test=conform | tests:: written::'
        'adsdv-conform --test=conform'
        "adsdv-conform,adsdv $every"
      )
      ;;
    model)
      files=('model/src/**') package=adsdv-model
      rounds=(
        'adsdv-model --lib --test=printed | --skip the_properties --skip well_behaved'
        'adsdv-model --test=printed --test=closed --test=operator --test=run --test=open --test=mutants | --skip all_input_vectors'
        "adsdv-model $every"
        "adsdv-tests,adsdv $every"
      )
      ;;
  esac
}

# What has been caught, and what does not compile, is kept beside mutants.out, which has only the last run.
tally() {
  cat "$out"/mutants.out/{caught,timeout}.txt >>"$out/caught.txt" 2>/dev/null || true
  cat "$out"/mutants.out/unviable.txt >>"$out/unviable.txt" 2>/dev/null || true
}
count() { wc -l <"$out/$1.txt"; }

survivors=0 summary=
for group in "${groups[@]}"; do
  describe "$group"
  out=target/mutation/$group
  selected=(-p "$package" "${features[@]}")
  for file in "${files[@]}"; do selected+=(-f "$file"); done
  [ -n "$resume" ] || rm -rf "$out"
  mkdir -p "$out"
  tally
  touch "$out"/{caught,unviable}.txt
  # The first round is a glance, those behind it look closely.
  export ADSDV_RECORDINGS=1
  for round in "${rounds[@]}"; do
    status=0
    IFS='|' read -r building testing <<<"$round"
    testing+=$skipped
    read -r packages building <<<"$building"
    # Without any change they have to pass. cargo mutants would try the tests of the changed package alone.
    # shellcheck disable=SC2086 # Words.
    unchanged=("${run[@]}" --locked $(printf -- '-p %s ' ${packages//,/ }) $building)
    # shellcheck disable=SC2086
    "${unchanged[@]}" --no-run >"$out/unchanged.log" 2>&1 && begin=$SECONDS &&
      "${unchanged[@]}" -- $testing >>"$out/unchanged.log" 2>&1 || {
        echo "mutants.sh: the tests of $group fail without any change, see $out/unchanged.log" >&2
        exit 2
      }
    # shellcheck disable=SC2086
    cargo mutants "${selected[@]}" --colors never -o "$out" --iterate --test-tool "$tool" --test-package "$packages" \
      --baseline skip --timeout $((30 + 5 * (SECONDS - begin))) \
      $(printf -- '--cargo-arg=%s ' $building) "${arguments[@]}" ${testing:+-- -- $testing} || status=$?
    unset ADSDV_RECORDINGS
    tally
    # 2: some survived, 3: some ran too long; both are counted below.
    case $status in 0 | 2 | 3) ;; *) echo "mutants.sh: cargo mutants ended with status $status" >&2; exit 2 ;; esac
    [ -s "$out/mutants.out/missed.txt" ] || break
  done
  # Of these changes: the sources may have changed since some were caught.
  cargo mutants --list "${selected[@]}" "${arguments[@]}" | sort >"$out/all.txt"
  for kind in caught unviable; do
    sort -u "$out/$kind.txt" | comm -12 - "$out/all.txt" >"$out/$kind.now"
    mv "$out/$kind.now" "$out/$kind.txt"
  done
  sort -u "$out"/{caught,unviable}.txt | comm -13 - "$out/all.txt" >"$out/survived.txt"
  survivors=$((survivors + $(count survived)))
  summary+=$(printf '%-8s %7d %7d %9d %9d' "$group" "$(count all)" "$(count caught)" "$(count unviable)" "$(count survived)")$'\n'
done

printf '\n%-8s %7s %7s %9s %9s\n%s' GROUP MUTANTS CAUGHT UNVIABLE SURVIVED "$summary"
[ "$survivors" = 0 ]
