#!/usr/bin/env bash
# The page that judges in a browser: builds it, and tests that it does in a browser what it should.
#
#   scripts/web.sh             a fresh build, its types, and the tests of it and of the one that is checked in, in Chromium
#   scripts/web.sh --build     builds site/dist/adsdv.html anew, after a change of anything that it is made of
#   scripts/web.sh --measure   sizes, and how fast it judges against the program beside it
#   scripts/web.sh --shots     the pictures of docs/web.md
#
# Needs Node 20 with npm, and Rust's target wasm32-unknown-unknown: of rustup, or built from the sources that Debian has (rustc-web,
# rust-web-src, lld). All but --build need Chromium (Debian's chromium) or the browser that CHROMIUM names. Ends with 77 where one of them
# is missing. ADSDV names the program that is compared with; without it target/debug/adsdv is built.
set -euo pipefail
cd "$(dirname "$0")/.."

missing() {
  echo "scripts/web.sh: $1" >&2
  exit 77
}
command -v npm >/dev/null || missing "there is no npm (Debian's nodejs and npm)"
node -e 'process.exit(process.versions.node.split(".")[0] < 20 ? 1 : 0)' || missing "Node is older than 20"

case ${1-} in
'' | --build | --measure | --shots) ;;
*)
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  exit 2
  ;;
esac

target=wasm32-unknown-unknown
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-target}
# To be tried once it need not be small and fast; what is checked in, which is, is tried as well.
profile=web
[ -n "${1-}" ] || profile=web-trial
built=$CARGO_TARGET_DIR/web/$target/$profile/adsdv_web.wasm

# Whether a compiler is as new as the crates ask for.
is_new() {
  local minor
  minor=$("$1" --version 2>/dev/null | sed -n 's/^rustc 1\.\([0-9]*\)\..*/\1/p')
  [ "${minor:-0}" -ge 88 ]
}

# The module, with whichever compiler has the target, and without a path of this machine in it.
module() {
  local flags="--remap-path-prefix=$PWD= --remap-path-prefix=${CARGO_HOME:-$HOME/.cargo}= -C link-arg=-zstack-size=1048576" registry
  # Of two that fit the last counts.
  for registry in "${CARGO_HOME:-$HOME/.cargo}"/registry/src/*; do flags+=" --remap-path-prefix=$registry="; done
  local build=(cargo rustc --quiet --locked -p adsdv-web --profile "$profile" --target "$target" --target-dir "$CARGO_TARGET_DIR/web" --crate-type cdylib)
  if rustup target list --installed 2>/dev/null | grep -qx "$target"; then
    RUSTFLAGS=$flags "${build[@]}"
  elif [ -e /usr/lib/rustlib/src/rust/library/std/Cargo.toml ] && is_new /usr/bin/rustc && command -v wasm-ld >/dev/null; then
    CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=wasm-ld RUSTFLAGS=$flags RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1 \
      "${build[@]}" -Z build-std=std,panic_abort
  else
    missing "Rust's target $target is not there (rustup target add $target, or Debian's rustc-web, rust-web-src and lld)"
  fi
}

packages() {
  # As the lock files have them; nothing is downloaded where they are there.
  local folder=$1
  [ "$folder/node_modules/.package-lock.json" -nt "$folder/package-lock.json" ] ||
    npm --prefix "$folder" ci --no-audit --no-fund --loglevel error || missing "the packages cannot be installed"
}

packages report/page
module
if [ "${1-}" = --build ]; then
  exec node web/page/build.mjs "$built" site/dist/adsdv.html
fi

if [ -z "${CHROMIUM-}" ]; then
  CHROMIUM=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || missing "there is no Chromium (Debian's chromium)"
  export CHROMIUM
fi
if [ -z "${ADSDV-}" ]; then
  cargo build --quiet --locked -p adsdv
  export ADSDV="$CARGO_TARGET_DIR/debug/adsdv"
fi
fresh=$CARGO_TARGET_DIR/web/adsdv.html
node web/page/build.mjs "$built" "$fresh"
export FRESH="$fresh"
case ${1-} in
--measure) exec node web/page/measure.mjs "$built" ;;
--shots) exec node web/page/shots.mjs ;;
esac
report/page/node_modules/.bin/tsc --noEmit -p web/page
exec node --test --test-reporter=spec --test-concurrency=2 web/page/tests/
