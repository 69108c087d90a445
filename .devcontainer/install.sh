#!/usr/bin/env bash
# What the project's checks use beside Rust. Each is optional: .ci/run says what it skips.
set -euo pipefail

sudo apt-get update
sudo apt-get install -y --no-install-recommends can-utils chromium gcc g++ iproute2 lld musl-tools qemu-system-x86 spin valgrind
rustup component add clippy rustfmt
rustup target add wasm32-unknown-unknown
rustup toolchain install 1.85 nightly --profile minimal
cargo install --locked cargo-deny cargo-fuzz cargo-mutants cargo-tarpaulin duvet kani-verifier mdbook
cargo kani setup
