#!/usr/bin/env bash
# Runs a command in a small virtual machine whose kernel has CAN and virtual buses (vcan), as the kernels of build machines
# and containers have not. qemu emulates every instruction (TCG): that needs nothing of the processor or the kernel here, and is slow.
# Its clock counts its instructions, so that what else runs here delays nothing in it.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: scripts/vm/run.sh [-t SECONDS] [-f FILE]... [-o FOLDER] [-e NAME[=VALUE]]... COMMAND [ARGUMENT...]

Boots the machine, runs the command in it as root, and passes on its output and exit status. Files have the same path in
the machine as here, so that a program finds what it was built to find, and the command begins in the same folder. The
modules can, can-raw, can-dev, vcan and dummy are loaded; there is no interface but lo. The machine has no network, no
disk and nothing of this one but what is named, and is gone afterwards.

It has one processor, and its time is its own: one instruction takes one nanosecond, and where it has nothing to do, its
clock goes on at once. A second in it is as long as that work takes here, and a program in it is as late on a busy machine
as on an idle one.

  -t SECONDS  the command is ended after so long, by the machine's clock (default 300)
  -f FILE     a file or folder to bring; a program comes with its shared libraries. COMMAND comes too, if it is a file
  -o FOLDER   a folder that is empty in the machine, and of which the content is brought back
  -e NAME     a variable of the environment to pass on, or to set with =VALUE; those whose names begin with ADSDV_, RUST_
              or CARGO_BIN_EXE_, and CARGO_MANIFEST_DIR, are passed on anyway
  -h, --help  this text

There are busybox, candump, cangen, canplayer, cansend, and ip and tc of iproute2. busybox's shell has an ip and tc of its
own: in its scripts, write iproute2 and iproute2-tc, or /sbin/ip and /sbin/tc.

cargo runs tests in it as any program: set CARGO_TARGET_X86_64_UNKNOWN_LINUX_GNU_RUNNER to this script with its options.

Exit status: that of the command, or 2 wrong usage, 77 there can be no machine here (it says why, and what would help),
124 the command took too long, 125 the machine failed (its console is printed).
USAGE
}

fail() {
  code=$1
  shift
  printf 'vm: %s\n' "$*" >&2
  exit "$code"
}

here=$(cd "$(dirname "$0")" && pwd)
seconds=300
out=
files=()
environment=()
for name in $(compgen -e); do
  case $name in
    ADSDV_* | RUST_* | CARGO_BIN_EXE_* | CARGO_MANIFEST_DIR) environment+=("$name=${!name}") ;;
  esac
done

[ "${1-}" != --help ] || { usage; exit 0; }
while getopts t:f:o:e:h option; do
  case $option in
    t) seconds=$OPTARG ;;
    f) files+=("$OPTARG") ;;
    o) out=$OPTARG ;;
    e)
      name=${OPTARG%%=*}
      [[ $name =~ ^[A-Za-z_][A-Za-z0-9_]*$ ]] || fail 2 "'$name' is no name of a variable"
      case $OPTARG in
        *=*) environment+=("$OPTARG") ;;
        *) [ -z "${!name+set}" ] || environment+=("$name=${!name}") ;;
      esac
      ;;
    h) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done
shift $((OPTIND - 1))
[ $# -gt 0 ] || { usage >&2; exit 2; }
case $seconds in
  '' | 0* | *[!0-9]*) fail 2 "'$seconds' is no number of seconds; give one of at least 1" ;;
esac

# Without a slash it is one of the machine's own.
if [[ $1 == */* ]] && [ -f "$1" ]; then
  files+=("$1")
fi
for file in ${files[@]+"${files[@]}"}; do
  [ -e "$file" ] || fail 2 "there is no file or folder '$file' to bring"
done
if [ -n "$out" ]; then
  mkdir -p "$out"
  out=$(cd "$out" && pwd)
fi

vm=$("$here/image.sh")

dir=$(mktemp -d)
running=()
cleanup() {
  # The readers too: where qemu never opened its end, they wait for it.
  [ ${#running[@]} -eq 0 ] || kill "${running[@]}" 2>/dev/null || true
  rm -rf "$dir"
}
trap cleanup EXIT
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM

# quote WORD: WORD as every shell reads it back.
quote() {
  printf "'%s' " "${1//\'/\'\\\'\'}"
}

# bring FILE: copies it to where the machine has it, and the libraries that a program needs.
bring() {
  local path library
  path=$(realpath -s "$1")
  mkdir -p "$dir/files$(dirname "$path")"
  cp -rL --preserve=mode,timestamps "$path" "$dir/files$(dirname "$path")/"
  [ -f "$path" ] || return 0
  # ldd fails on what is no program, and on one that needs nothing.
  ldd "$path" >"$dir/ldd" 2>/dev/null || return 0
  ! grep 'not found' "$dir/ldd" >&2 || fail 2 "'$1' needs a library that is not here"
  sed -n 's/.*=> \(\/[^ ]*\) (.*/\1/p; s/^\t\(\/[^ ]*\) (.*/\1/p' "$dir/ldd" | while read -r library; do
    mkdir -p "$dir/files$(dirname "$library")"
    cp -L "$library" "$dir/files$library"
  done
}

for file in ${files[@]+"${files[@]}"}; do
  bring "$file"
done
# The last is where cargo lets tests write.
mkdir -p "$dir/files/vm" "$dir/files$PWD" "$dir/files$out" "$dir/files${vm%/vm}/tmp"
{
  printf 'seconds=%s\nout=' "$seconds"
  quote "$out"
  echo
} >"$dir/files/vm/settings"
{
  printf 'cd '
  quote "$PWD"
  printf '|| exit\nexec env '
  for word in "${environment[@]}" "$@"; do
    quote "$word"
  done
  echo
} >"$dir/files/vm/command"
# The kernel unpacks one archive after the other.
cp "$vm/base.cpio" "$dir/initramfs"
(cd "$dir/files" && find . | cpio --quiet -o -H newc -R 0:0) >>"$dir/initramfs"
rm -rf "$dir/files"

# The archive is in memory twice while it is unpacked.
memory=$((512 + 2 * $(stat -c %s "$dir/initramfs") / 1048576))
mkfifo "$dir/stdout" "$dir/stderr"
# Where nobody takes the output any more, as with `| head`, it is thrown away: the machine would stand still otherwise.
{ cat || cat >/dev/null; } <"$dir/stdout" &
running+=($!)
{ cat >&2 || cat >/dev/null; } <"$dir/stderr" &
running+=($!)

# shellcheck disable=SC2054 # The commas are qemu's.
qemu=(
  qemu-system-x86_64 -nodefaults -no-user-config -display none -monitor none -no-reboot
  -accel tcg,thread=single -icount shift=0,sleep=off -cpu max -m "$memory"
  -kernel "$vm/vmlinuz" -initrd "$dir/initramfs" -append "console=ttyS0 quiet panic=-1 tsc=reliable"
  -serial "file:$dir/console" -device virtio-serial-pci
)
for port in stdout stderr status files; do
  qemu+=(-chardev "file,id=$port,path=$dir/$port" -device "virtserialport,chardev=$port,name=$port")
done

# A second of the machine may be several here. Besides, it has two minutes to boot and to send back what there is. It is in
# the background for a signal to be heeded meanwhile.
code=0
limit=$((5 * seconds + 120))
timeout --foreground -k 5 "$limit" "${qemu[@]}" </dev/null >"$dir/qemu.log" 2>&1 &
running+=($!)
wait $! || code=$?
if [ ! -s "$dir/status" ]; then
  cat "$dir/qemu.log" >&2
  [ ! -s "$dir/console" ] || tail -n 40 "$dir/console" >&2
  [ "$code" != 124 ] || fail 125 "the machine did not end within $limit s"
  fail 125 "the machine ended before the command did (qemu's exit status is $code)"
fi
wait
running=()
if [ -n "$out" ]; then
  tar -C / -xf "$dir/files" --no-same-owner || fail 125 "not all of '$out' came back"
fi
code=$(cat "$dir/status")
[ "$code" != late ] || fail 124 "the command took more than $seconds s and was ended"
exit "$code"
