#!/usr/bin/env bash
# An archive of the program to give away: with its licences, completions for shells and manual pages, and no more that it needs.
#
#   scripts/release.sh             of target/dist/adsdv, for this machine
#   scripts/release.sh TARGET      of target/TARGET/dist/adsdv, such as x86_64-unknown-linux-musl
#
# The program has to be built. The archive is target/release-files/adsdv-VERSION-TARGET.tar.gz, or .zip for Windows. The licences of what it
# is made of are those of scripts/licences.sh, which is run where it was not; this ends with 77 where that cannot be had.
set -euo pipefail
cd "$(dirname "$0")/.."

case ${1-} in
-*)
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  case $1 in -h | --help) exit 0 ;; *) exit 2 ;; esac
  ;;
esac
target=${1-$(rustc -vV | sed -n 's/^host: //p')}
built=${CARGO_TARGET_DIR:-target}
folder=$built/${1:+$1/}dist
program=$folder/adsdv
[ ! -e "$program.exe" ] || program=$program.exe
[ -x "$program" ] || { echo "scripts/release.sh: $program is not built (cargo build --profile dist -p adsdv --features mcap,parquet)" >&2; exit 2; }

[ -e "$built/licences/crates.html" ] || scripts/licences.sh
# `adsdv 0.1.0`
version=$("$program" --version)
name=adsdv-${version#adsdv }-$target
files=$built/release-files
rm -rf "$files/$name"
mkdir -p "$files/$name/completions" "$files/$name/man"
cp "$program" README.md CHANGELOG.md LICENSE-MIT LICENSE-APACHE "$files/$name/"
cp -r "$built/licences" "$files/$name/licences"
[[ $target == *musl ]] || rm -f "$files/$name/licences/musl.txt"
for shell in bash elvish fish powershell zsh; do
  "$program" completions "$shell" >"$files/$name/completions/adsdv.$shell"
done
"$program" man >"$files/$name/man/adsdv.1"
"$program" --help | awk '/^Commands:/ { on = 1; next } !/^ / { on = 0 } on && /^  [a-z]/ && $1 != "help" { print $1 }' |
  while read -r command; do
    "$program" man "$command" >"$files/$name/man/adsdv-$command.1"
  done
cd "$files"
# GNU's and BSD's say it differently.
owner=(--owner=0 --group=0)
[[ $(tar --version) == *GNU* ]] || owner=(--uid 0 --gid 0)
case $target in
*windows*) 7z a -bso0 "$name.zip" "$name" && archive=$name.zip ;;
*) tar "${owner[@]}" --numeric-owner -czf "$name.tar.gz" "$name" && archive=$name.tar.gz ;;
esac
rm -r "$name"
echo "$files/$archive"
