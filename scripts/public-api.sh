#!/usr/bin/env bash
# What spec, oracle and conform offer to other crates, held against the listings that are checked in.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  cat <<'USAGE'
Usage: scripts/public-api.sh [--update]

Lists every public item of adsdv-spec, adsdv-oracle and adsdv-conform, as their default features have it, and compares that
with the public-api.txt of each. A line that is gone or reads otherwise breaks who uses it; a further one does not.
What traits give to every type, and what derive writes, is left out.

  --update    writes the listings anew: read the difference before you commit it

Needs a nightly toolchain and cargo-public-api:
  rustup toolchain install nightly --profile minimal
  cargo install --locked cargo-public-api@0.52.0

Exit status: 0 as checked in, or written; 1 if something differs; 2 if it could not be told.
USAGE
}

update=
case ${1-} in
'') ;;
--update) update=1 ;;
-h | --help) usage; exit 0 ;;
*) usage >&2; exit 2 ;;
esac
[ $# -le 1 ] || { usage >&2; exit 2; }

cannot() {
  echo "scripts/public-api.sh: $1" >&2
  exit 2
}
cargo +nightly --version >/dev/null 2>&1 || cannot "there is no nightly toolchain (rustup toolchain install nightly --profile minimal)"
cargo public-api --version >/dev/null 2>&1 || cannot "there is no cargo-public-api (cargo install --locked cargo-public-api@0.52.0)"

# Of its own: another compiler would build anew what the others have built.
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-target}/public-api
mkdir -p "$CARGO_TARGET_DIR"
status=0
for crate in spec oracle conform; do
  listing=$crate/public-api.txt now=$CARGO_TARGET_DIR/$crate.txt
  cargo +nightly public-api -p "adsdv-$crate" --omit blanket-impls,auto-trait-impls,auto-derived-impls \
    >"$now" 2>"$now.errors" || { cat "$now.errors" >&2; cannot "adsdv-$crate could not be listed"; }
  [ -s "$now" ] || cannot "adsdv-$crate has no public item, which cannot be"
  if [ -n "$update" ]; then
    cp "$now" "$listing"
  elif [ ! -e "$listing" ]; then
    cannot "there is no $listing (scripts/public-api.sh --update)"
  elif ! diff -u --label "$listing" --label "what adsdv-$crate has now" "$listing" "$now"; then
    status=1
  fi
done
if [ $status = 1 ]; then
  cat >&2 <<'WHY'
scripts/public-api.sh: the public items are not those that are checked in. If that is meant, run it with --update, and say in
CHANGELOG.md what is gone or reads otherwise; since 1.0 that takes another major version, before it another minor one.
WHY
fi
exit $status
