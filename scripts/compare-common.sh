# What the comparisons share; they source it. Before: fail() is defined and $root is set. After: $adsdv is the program to
# measure, $dir a folder that is removed at the end, $pin the words that pin a command to one core and $core its name.

if [ -n "${ADSDV-}" ]; then
    adsdv=$ADSDV
else
    command -v cargo >/dev/null || fail 2 "cargo is not installed; see https://rustup.rs, or set ADSDV"
    cargo build --quiet --release --manifest-path "$root/Cargo.toml" -p adsdv || fail 1 "adsdv does not build"
    adsdv=${CARGO_TARGET_DIR:-$root/target}/release/adsdv
fi
command -v "$adsdv" >/dev/null || fail 2 "there is no program '$adsdv'"

dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM

# The first core that this process may use.
pin=
core='no core (taskset is not installed)'
if command -v taskset >/dev/null; then
    core=$(taskset -cp $$ | sed 's/.*: *//; s/[^0-9].*//')
    pin="taskset -c $core"
    core="core $core"
fi
