#!/bin/sh
# Whether every requirement of each edition that the code has is implemented, proven and tested, and the report that shows which.
set -eu

usage() {
    cat <<'USAGE'
Usage: scripts/trace.sh

Collects the citations of requirements in the sources, lets duvet hold them against spec/REQUIREMENTS.md, and
names every requirement that lacks an implementation, a proof or a test. The report is target/duvet/report.html.
What holds only in an edition that the code does not have yet is counted, and may lack anything.

Where duvet is not installed there is no report, and what is missing is named all the same. Where the environment
variable CI is set, .duvet/snapshot.txt has to be up to date; elsewhere duvet brings it up to date.

Environment:
  CITATIONS  the built program that collects the citations; without it one is built
  DUVET      the duvet to run instead of the one in the PATH

Exit status: 0 nothing is missing, 1 something is, or the snapshot is not up to date, 2 wrong usage.
USAGE
}

case ${1-} in
    '') ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
esac

cd "$(dirname "$0")/.."
duvet=${DUVET:-duvet}
citations() {
    if [ -n "${CITATIONS-}" ]; then
        "$CITATIONS" "$1"
    else
        cargo run --quiet --locked -p adsdv-tests --bin citations -- "$1"
    fi
}

if ! command -v "$duvet" >/dev/null; then
    echo "trace: no report, for duvet is not installed; try: cargo install --locked duvet" >&2
    failed=0
    citations count || failed=1
    [ -z "${CI-}" ] || citations snapshot || failed=1
    exit "$failed"
fi
citations write
# Neither an old report nor requirements that are no more must be taken for new ones.
rm -rf target/duvet/report.json target/duvet/report.html .duvet/requirements
failed=0
"$duvet" report || {
    failed=1
    [ -z "${CI-}" ] || echo "trace: where the snapshot differs: run scripts/trace.sh with CI unset, and commit it" >&2
}
citations check || failed=1
exit "$failed"
