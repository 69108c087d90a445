#!/usr/bin/env bash
# Advisories, licences, duplicates and sources of what the project stands on, in each of its workspaces, by deny.toml.
#
#   scripts/deny.sh                all of it
#   scripts/deny.sh CHECK ...      some of it, such as: licenses bans sources (advisories are fetched)
#
# Needs cargo-deny (cargo install --locked cargo-deny). Ends with 77 where it is missing.
set -euo pipefail
cd "$(dirname "$0")/.."

case ${1-} in
-*)
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  case $1 in -h | --help) exit 0 ;; *) exit 2 ;; esac
  ;;
esac
command -v cargo-deny >/dev/null || {
  echo "scripts/deny.sh: there is no cargo-deny (cargo install --locked cargo-deny)" >&2
  exit 77
}
for workspace in . python fuzz embedded; do
  echo "== $workspace"
  # What only one of them has is not missed in the others.
  cargo-deny --locked --manifest-path "$workspace/Cargo.toml" --config deny.toml check \
    -A license-not-encountered -A license-exception-not-encountered -A unmatched-skip "$@"
done
