#!/usr/bin/env bash
# The program for Linux as one file that needs nothing else: static, with musl, and with every format.
#
#   scripts/static.sh              builds it for this machine, runs it in an empty root, and makes an archive of it (scripts/release.sh)
#   scripts/static.sh --build      builds and runs it, without the archive
#
# Needs Rust's target x86_64-unknown-linux-musl, or aarch64, of rustup; where that is not there it is built from the sources that Debian has
# (rustc-web, rust-web-src) and linked by Zig (PyPI's cargo-zigbuild and ziglang). Ends with 77 where neither is there.
set -euo pipefail
cd "$(dirname "$0")/.."

case ${1-} in
'' | --build) ;;
*)
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  case $1 in -h | --help) exit 0 ;; *) exit 2 ;; esac
  ;;
esac
missing() {
  echo "scripts/static.sh: $1" >&2
  exit 77
}

export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-target}
target=$(uname -m)-unknown-linux-musl
what=(--profile dist --locked -p adsdv --features mcap,parquet --target "$target")
if rustup target list --installed 2>/dev/null | grep -qx "$target"; then
  cargo build "${what[@]}"
elif [ -e /usr/lib/rustlib/src/rust/library/std/Cargo.toml ] && [ -x /usr/bin/rustc ]; then
  tools=$CARGO_TARGET_DIR/static-tools
  if ! command -v cargo-zigbuild >/dev/null; then
    [ -x "$tools/bin/cargo-zigbuild" ] ||
      { python3 -m venv "$tools" && "$tools/bin/pip" --disable-pip-version-check --quiet install cargo-zigbuild ziglang; } ||
      missing "cargo-zigbuild and ziglang cannot be installed (python3 with venv, and PyPI)"
    PATH=$PWD/$tools/bin:$PATH
  fi
  # The standard library is built as well, with the compiler that it belongs to; what a C program begins with is Zig's.
  RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1 cargo-zigbuild rustc "${what[@]}" --bin adsdv -Z build-std=std,panic_unwind -- -C link-self-contained=no
else
  missing "Rust's target $target is not there (rustup target add $target, or Debian's rustc-web and rust-web-src)"
fi

program=$CARGO_TARGET_DIR/$target/dist/adsdv
if readelf -lW "$program" | grep -q INTERP || readelf -dW "$program" | grep -q NEEDED; then
  echo "scripts/static.sh: $program is not static" >&2
  exit 1
fi

# With nothing beside it but a log, where it can be given a root of its own.
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
cp "$program" tests/logs/mission.log "$root/"
if unshare --map-root-user true 2>/dev/null; then
  alone=(unshare --map-root-user --root "$root" /adsdv) log=/mission.log
elif [ "$(id -u)" = 0 ]; then
  alone=(chroot "$root" /adsdv) log=/mission.log
else
  alone=("$root/adsdv") log=$root/mission.log
fi
"${alone[@]}" --version
"${alone[@]}" check "$log" | tail -n 1

[ "${1-}" = --build ] || exec scripts/release.sh "$target"
