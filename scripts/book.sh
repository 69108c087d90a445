#!/usr/bin/env bash
# The book as a site: the pages of docs/SUMMARY.md, those of other folders among them, and what they link to.
#
#   scripts/book.sh             builds it into target/book/site
#   scripts/book.sh --serve     the same, and serves it on this machine while pages change
#
# Needs mdBook (cargo install --locked mdbook). Ends with 77 where it is missing.
set -euo pipefail
cd "$(dirname "$0")/.."

case ${1-} in
'' | --serve) ;;
*)
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  case $1 in -h | --help) exit 0 ;; *) exit 2 ;; esac
  ;;
esac
command -v mdbook >/dev/null || { echo "scripts/book.sh: there is no mdbook (cargo install --locked mdbook)" >&2; exit 77; }

# mdBook takes pages of one folder only. So all that git has, but for recordings and corpora, is laid out as it is here, with the
# contents at its top, where their links are those from there.
book=target/book
rm -rf "$book"
mkdir -p "$book/src"
git ls-files -z --cached --others --exclude-standard -- . ':!fuzz/corpus' ':!fuzz/regressions' ':!tests/logs' ':!report/page/dist' |
  while IFS= read -r -d '' file; do [ ! -f "$file" ] || printf '%s\0' "$file"; done |
  xargs -0 cp --parents -t "$book/src"
sed -E 's#\]\(\.\./#](#; t; s#\]\(([^)]*)\)#](docs/\1)#' docs/SUMMARY.md >"$book/src/SUMMARY.md"
cp docs/book.toml "$book/book.toml"
if [ "${1-}" = --serve ]; then
  exec mdbook serve "$book"
fi
mdbook build "$book"
echo "$book/site/index.html"
