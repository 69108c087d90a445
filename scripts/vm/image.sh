#!/usr/bin/env bash
# What the small virtual machine boots: Debian's kernel and a folder of files for its memory (an initramfs), both made from
# Debian's packages. Nothing is made anew that has not changed. run.sh calls this; there is no need to.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: scripts/vm/image.sh

Makes target/vm/vmlinuz and target/vm/base.cpio and prints the folder they are in. The kernel is the newest installed one
of Debian with the module vcan, else Debian's linux-image-amd64 is downloaded and unpacked, once, without being installed.
Remove target/vm to take a newer one.

Exit status: 0 made, 2 wrong usage, 77 it cannot be made here: it says what is missing, and how to get it.
USAGE
}

case ${1-} in
  '') ;;
  -h | --help) usage; exit 0 ;;
  *) usage >&2; exit 2 ;;
esac

cannot() {
  printf 'vm: cannot run here: %s\n' "$*" >&2
  exit 77
}

here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
target=${CARGO_TARGET_DIR:-target}
case $target in
  /*) ;;
  *) target=$root/$target ;;
esac
vm=$target/vm
# ip, depmod and modinfo are there for everyone, and not in everyone's PATH.
PATH=$PATH:/usr/sbin:/sbin

# What the guest has: programs, and modules with all they depend on. virtio_console is how run.sh hears from it, and
# sch_netem makes a full queue of a virtual bus.
programs=(ip tc candump cangen canplayer cansend)
modules=(can can-raw can-dev vcan dummy sch_netem virtio_pci virtio_console)

[ "$(uname -sm)" = "Linux x86_64" ] || cannot "the machine is one of Linux on x86_64, and this is $(uname -sm)"
missing=()
need() {
  command -v "$1" >/dev/null || missing+=("$2")
}
need qemu-system-x86_64 qemu-system-x86
need cpio cpio
need modinfo kmod
need ip iproute2
need candump can-utils
need xz xz-utils
busybox=
for candidate in /bin/busybox /usr/bin/busybox; do
  # A shared busybox would ask for libraries before there is anything that could tell of it.
  if [ -x "$candidate" ] && ! ldd "$candidate" >/dev/null 2>&1; then
    busybox=$candidate
    break
  fi
done
[ -n "$busybox" ] || missing+=(busybox-static)
[ ${#missing[@]} -eq 0 ] ||
  cannot "not installed: ${missing[*]}; try: apt-get install --no-install-recommends ${missing[*]}"

mkdir -p "$vm"
exec 9>"$vm/lock"
flock 9
work=$(mktemp -d "$vm/work.XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

# take_kernel FOLDER: takes the newest kernel that is in FOLDER as packages lay it out, and the modules of the list with all
# they depend on, unpacked. Fails where there is none with all of them.
take_kernel() {
  local image version names name file depends
  for image in $(printf '%s\n' "$1"/boot/vmlinuz-* | sort -rV); do
    version=${image##*/vmlinuz-}
    if [ ! -r "$image" ] || [ ! -d "$1/lib/modules/$version/kernel" ]; then continue; fi
    rm -rf "$work/kernel"
    mkdir -p "$work/kernel/lib/modules/$version"
    find "$1/lib/modules/$version/kernel" -name '*.ko*' >"$work/modules"
    names=("${modules[@]}")
    while [ ${#names[@]} -gt 0 ]; do
      name=${names[0]}
      names=("${names[@]:1}")
      # A module's name has _ where its file may have -.
      file=$(grep -E "/${name//[-_]/[-_]}\.ko(\.xz|\.gz|\.zst)?$" "$work/modules" | head -n 1) || true
      [ -n "$file" ] || continue 2
      case $file in
        *.xz) xz -dc "$file" ;;
        *.gz) gzip -dc "$file" ;;
        *.zst) zstd -dc "$file" ;;
        *) cat "$file" ;;
      esac >"$work/kernel/lib/modules/$version/$name.ko" || return 1
      depends=$(modinfo -F depends "$work/kernel/lib/modules/$version/$name.ko") || return 1
      for name in ${depends//,/ }; do
        [ -e "$work/kernel/lib/modules/$version/$name.ko" ] || names+=("$name")
      done
    done
    for file in order builtin builtin.modinfo; do
      [ ! -r "$1/lib/modules/$version/modules.$file" ] || cp "$1/lib/modules/$version/modules.$file" "$work/kernel/lib/modules/$version/"
    done
    depmod -b "$work/kernel" "$version" || return 1
    cp "$image" "$work/kernel/vmlinuz"
    return 0
  done
  return 1
}

download_kernel() {
  local package
  command -v apt-get >/dev/null ||
    cannot "no kernel with the module vcan is installed, and without apt-get none can be downloaded"
  # linux-image-amd64 is only the name of whichever is the newest.
  package=$(apt-cache depends linux-image-amd64 2>/dev/null | sed -n 's/^ *Depends: \(linux-image-[0-9][^ ]*\)$/\1/p' | head -n 1)
  [ -n "$package" ] || cannot "apt-get knows no linux-image-amd64; try: apt-get update"
  echo "vm: downloading $package" >&2
  (cd "$work" && apt-get -qq download "$package") >"$work/apt.log" 2>&1 ||
    cannot "apt-get download $package failed: $(tail -n 1 "$work/apt.log"); try: apt-get update"
  dpkg-deb -x "$work"/linux-image-*.deb "$work/package"
  # Newer packages leave it to the system that lib is usr/lib.
  [ -e "$work/package/lib" ] || ln -s usr/lib "$work/package/lib"
  take_kernel "$work/package" || cannot "$package lacks one of the modules ${modules[*]}"
}

# Which modules, and what takes them: whatever else changes here asks for no other kernel.
kernel=$({ declare -p modules; declare -f take_kernel download_kernel; } | sha256sum)
if [ ! -e "$vm/kernel/made-by" ] || [ "$(cat "$vm/kernel/made-by")" != "$kernel" ]; then
  take_kernel "" || download_kernel
  echo "$kernel" >"$work/kernel/made-by"
  rm -rf "$vm/kernel" "$vm/base.made-from"
  mv "$work/kernel" "$vm/kernel"
fi

# with_libraries FILE: FILE's path and those of the shared libraries it needs, if any.
with_libraries() {
  echo "$1"
  # A line is `name => path (address)`, or `path (address)` for the loader.
  ldd "$1" 2>/dev/null | sed -n 's/.*=> \(\/[^ ]*\) (.*/\1/p; s/^\t\(\/[^ ]*\) (.*/\1/p'
}

files=$(for program in "${programs[@]}"; do with_libraries "$(command -v "$program")"; done | sort -u)
made_from=$({ cat "$vm/kernel/made-by"; echo "$files"; xargs cat "$busybox" "$here/image.sh" "$here/init.sh" <<<"$files"; } | sha256sum)
if [ ! -e "$vm/base.cpio" ] || [ ! -e "$vm/base.made-from" ] || [ "$(cat "$vm/base.made-from")" != "$made_from" ]; then
  base=$work/base
  mkdir -p "$base"/{bin,dev,etc,lib/modules,proc,root,run,sbin,sys,tmp,usr/bin,usr/sbin,var}
  chmod 1777 "$base/tmp"
  cp "$busybox" "$base/bin/busybox"
  cp -r "$vm/kernel/lib/modules/." "$base/lib/modules/"
  for applet in $("$busybox" --list); do
    [ "$applet" = busybox ] || ln -s /bin/busybox "$base/bin/$applet"
  done
  # The path at which the kernel calls it.
  ln -s /bin/busybox "$base/sbin/modprobe"
  # What busybox has an applet of as well is found first in sbin; its shell alone would still take its own applet, so there
  # it has another name.
  for program in "${programs[@]}"; do
    cp -L "$(command -v "$program")" "$base/sbin/$program"
  done
  ln -s /sbin/ip "$base/sbin/iproute2"
  ln -s /sbin/tc "$base/sbin/iproute2-tc"
  while read -r file; do
    case $file in
      *.so | *.so.*)
        mkdir -p "$base/$(dirname "$file")"
        cp -L "$file" "$base/$file"
        ;;
    esac
  done <<<"$files"
  install -m 755 "$here/init.sh" "$base/init"
  printf '%s\n' root:x:0:0:root:/root:/bin/sh nobody:x:65534:65534:nobody:/:/bin/sh >"$base/etc/passwd"
  printf '%s\n' root:x:0: nogroup:x:65534: >"$base/etc/group"
  (cd "$base" && find . | cpio --quiet -o -H newc -R 0:0) >"$work/base.cpio"
  cp "$vm/kernel/vmlinuz" "$work/vmlinuz"
  mv "$work/vmlinuz" "$work/base.cpio" "$vm/"
  echo "$made_from" >"$vm/base.made-from"
fi
echo "$vm"
