#!/usr/bin/env bash
# The tests on SocketCAN as a kernel has it: on this machine's own where it has vcan, else in the small virtual machine of
# scripts/vm, else not at all, and then it says so.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  cat <<'USAGE'
Usage: scripts/socketcan.sh [TEST ARGUMENT...]

Builds the command and the tests, and runs these with the arguments: the name of a test, --nocapture.

Exit status: that of the tests; 77 if there is neither vcan here, for which one has to be root, nor a virtual machine.
USAGE
}

case ${1-} in
  -h | --help) usage; exit 0 ;;
esac

target=${CARGO_TARGET_DIR:-target}
case $target in
  /*) ;;
  *) target=$PWD/$target ;;
esac
PATH=$PATH:/usr/sbin:/sbin

# With the features that the tests of the workspace have: behind these, nothing is built a second time.
cargo build --locked --workspace --bin adsdv --examples
export ADSDV="$target/debug/adsdv" ADSDV_REQUIRE_VCAN=1
# The stack that is examined, with nothing of ours in it: static, so that it needs nothing in the virtual machine either.
brought=()
if command -v cc >/dev/null; then
  export ADSDV_SOCKETCAN_C="$target/debug/socketcan-c"
  cc -O1 -Wall -Wextra -Werror -std=gnu99 -static -o "$ADSDV_SOCKETCAN_C" exam/examples/socketcan.c
  brought=(-f "$ADSDV_SOCKETCAN_C")
fi
# What the tests ask of the machine, asked once before.
probe=vcan-$$
if ip link add "$probe" type vcan 2>/dev/null; then
  ip link del "$probe"
  echo "SocketCAN: on this machine's own kernel"
else
  scripts/vm/image.sh >/dev/null || exit
  echo "SocketCAN: in a virtual machine, for this kernel has no vcan, or this user may not make one"
  host=$(rustc -vV | sed -n 's/^host: //p')
  variable=CARGO_TARGET_$(tr 'a-z-' 'A-Z_' <<<"$host")_RUNNER
  export "$variable=$PWD/scripts/vm/run.sh -t 900 -e ADSDV=$ADSDV -f $ADSDV -f $PWD/can -f $PWD/tests/logs ${brought[*]-}"
fi
cargo test --locked --workspace --test socket -- "$@"
