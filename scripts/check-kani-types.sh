#!/usr/bin/env bash
# Type-checks what only Kani compiles (cfg(kani)), against the signatures in proofs/types, as Kani would: without
# anything that stands in for it. It proves nothing; `cargo kani -p adsdv-proofs` does.
set -euo pipefail
cd "$(dirname "$0")/.."

target=${CARGO_TARGET_DIR:-target}/kani-types
# cargo does not notice when what RUSTFLAGS name has changed.
rm -rf "$target"
mkdir -p "$target"
target=$(cd "$target" && pwd)
rustc --edition 2024 --crate-name kani_macros --crate-type proc-macro --extern proc_macro --out-dir "$target" proofs/types/kani_macros.rs
rustc --edition 2024 --crate-name kani --crate-type rlib -L "$target" \
  --extern kani_macros="$target/libkani_macros.so" --out-dir "$target" proofs/types/kani.rs
RUSTFLAGS="--cfg kani --extern kani=$target/libkani.rlib -L $target" \
  cargo clippy -p adsdv-proofs --locked --target-dir "$target" "$@" -- -D warnings
