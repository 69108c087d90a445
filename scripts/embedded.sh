#!/usr/bin/env bash
# The specification as firmware for a Cortex-M4: its size, and its stack and instructions as QEMU counts them.
#
#   scripts/embedded.sh            optimised for size, and for speed
#
# Needs QEMU (Debian's qemu-system-arm) and Rust's target thumbv7em-none-eabi: of rustup, or built from the sources that Debian has
# (rustc-web, rust-web-src, lld). Ends with 77 where one of them is missing.
set -euo pipefail
cd "$(dirname "$0")/../embedded"

if [ $# -gt 0 ]; then
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' ../scripts/embedded.sh
  case $1 in -h | --help) exit 0 ;; *) exit 2 ;; esac
fi
missing() {
  echo "scripts/embedded.sh: $1" >&2
  exit 77
}
command -v qemu-system-arm >/dev/null || missing "there is no QEMU for ARM (Debian's qemu-system-arm)"

target=thumbv7em-none-eabi
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-../target}/embedded
build() {
  local build=(cargo build --quiet --locked --profile "$1" --target "$target")
  if rustup target list --installed 2>/dev/null | grep -qx "$target"; then
    RUSTFLAGS="-C link-arg=-Tlink.x" "${build[@]}"
  elif [ -x /usr/bin/rustc ] && [ -e /usr/lib/rustlib/src/rust/library/core/Cargo.toml ] && command -v ld.lld >/dev/null; then
    RUSTFLAGS="-C link-arg=-Tlink.x -C linker=ld.lld" RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1 "${build[@]}" -Z build-std=core
  else
    missing "Rust's target $target is not there (rustup target add $target, or Debian's rustc-web, rust-web-src and lld)"
  fi
}

for profile in release fast; do
  build "$profile"
  program=$CARGO_TARGET_DIR/$target/$profile/adsdv-embedded
  echo "== opt-level $(sed -n "/^\[profile.$profile\]/,/^\[/s/^opt-level = //p" Cargo.toml)"
  # Code and tables of all editions, with what measures.
  readelf -SW "$program" | awk '$2 ~ /^\.(text|rodata|data|bss)$/ { print $2, $6 } $3 ~ /^\.(text|rodata|data|bss)$/ { print $3, $7 }' |
    while read -r section size; do echo "$section $((16#$size)) bytes"; done
  # An instruction takes a nanosecond of the board's time; src/measure.rs reads its timer.
  timeout 300 qemu-system-arm -M mps2-an386 -nographic -icount shift=0 -semihosting-config enable=on,target=native -kernel "$program"
done
