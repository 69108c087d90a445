#!/usr/bin/env bash
# The pages that --html writes: that what is checked in is what their sources build, and that they do in a browser what they should.
#
#   scripts/page.sh             types, the build, and the tests in Chromium
#   scripts/page.sh --build     builds report/page/dist anew, after a change of its sources
#   scripts/page.sh --measure   file size, time to the first picture, and time of a frame while an hour is zoomed
#   scripts/page.sh --shots     the pictures of docs/report.md and docs/outcomes.md
#
# Needs Node 20 with npm and, but for --build, Chromium (Debian's chromium) or the browser that CHROMIUM names. Ends with 77 where one of
# them is missing. ADSDV names the program whose pages are tested; without it target/debug/adsdv is built.
# EXAMPLES names the folder of the examples, programs with mistakes; without it they are built.
set -euo pipefail
cd "$(dirname "$0")/.."

missing() {
  echo "scripts/page.sh: $1" >&2
  exit 77
}
command -v npm >/dev/null || missing "there is no npm (Debian's nodejs and npm)"
node -e 'process.exit(process.versions.node.split(".")[0] < 20 ? 1 : 0)' || missing "Node is older than 20"

packages() {
  # As the lock file has them; nothing is downloaded where they are there.
  local wanted=report/page/package-lock.json there=report/page/node_modules/.package-lock.json
  [ "$there" -nt "$wanted" ] || npm --prefix report/page ci --no-audit --no-fund --loglevel error || missing "the packages cannot be installed"
}

packages
case ${1-} in
--build)
  npm --prefix report/page run --silent build
  exit
  ;;
'' | --measure | --shots) ;;
*)
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  exit 2
  ;;
esac

if [ -z "${CHROMIUM-}" ]; then
  CHROMIUM=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || missing "there is no Chromium (Debian's chromium)"
  export CHROMIUM
fi
if [ -z "${ADSDV-}" ]; then
  cargo build --quiet --locked -p adsdv
  export ADSDV="$PWD/target/debug/adsdv"
fi
# For the pages about programs.
if [ -z "${EXAMPLES-}" ]; then
  cargo build --quiet --locked -p adsdv-conform -p adsdv-exam --example mutant --example ai_mutant
  export EXAMPLES="${CARGO_TARGET_DIR:-$PWD/target}/debug/examples"
fi
case ${1-} in
--measure) exec node report/page/measure.mjs ;;
--shots) exec node report/page/shots.mjs ;;
esac
npm --prefix report/page run --silent check
cd report/page
exec node --test --test-reporter=spec --test-concurrency=2 tests/
