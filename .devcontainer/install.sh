#!/usr/bin/env bash
# What the project's checks use beside Rust. Each is optional: .ci/run says what it skips.
set -euo pipefail

sudo apt-get update
sudo apt-get install -y --no-install-recommends busybox-static can-utils chromium cpio gcc g++ iproute2 kmod lld musl-tools \
  qemu-system-arm qemu-system-x86 spin xz-utils
rustup component add clippy rustfmt
rustup target add wasm32-unknown-unknown thumbv7em-none-eabi "$(uname -m)-unknown-linux-musl"
rustup toolchain install 1.85 nightly --profile minimal
cargo install --locked cargo-deny cargo-fuzz cargo-mutants cargo-tarpaulin duvet kani-verifier mdbook
cargo install --locked cargo-about@0.9.3 --features cli
cargo install --locked cargo-public-api@0.52.0
cargo kani setup
