#!/bin/busybox sh
# shellcheck shell=dash
# The first process of the small virtual machine: makes ready what a command expects, runs it as run.sh has written it to
# /vm/command, tells how it ended, sends back the folders asked for, and ends the machine.
export PATH=/sbin:/bin:/usr/sbin:/usr/bin

mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t devtmpfs dev /dev
mkdir -p /dev/pts /dev/shm
mount -t devpts devpts /dev/pts
mount -t tmpfs shm /dev/shm
modprobe -a virtio_pci virtio_console can can-raw can-dev vcan dummy
/sbin/ip link set lo up

# port NAME: prints the device of the port that qemu calls so. It may appear a moment after its driver.
port() {
  tries=0
  while [ $tries -lt 100 ]; do
    for folder in /sys/class/virtio-ports/*; do
      if [ "$(cat "$folder/name" 2>/dev/null)" = "$1" ]; then
        echo "/dev/${folder##*/}"
        return
      fi
    done
    usleep 50000
    tries=$((tries + 1))
  done
  echo "init: there is no port '$1'" >/dev/console
  reboot -f
}
stdout=$(port stdout)
stderr=$(port stderr)
status=$(port status)
files=$(port files)

# It sets $seconds and $out.
# shellcheck disable=SC1091,SC2154
. /vm/settings
# In a process group of its own, which is ended as a whole.
setsid sh /vm/command </dev/null >"$stdout" 2>"$stderr" &
command=$!
(
  sleep "$seconds"
  touch /vm/late
  kill -TERM -$command
  sleep 2
  kill -KILL -$command
) 2>/dev/null &
wait $command
code=$?
[ ! -e /vm/late ] || code=late
if [ -n "$out" ]; then
  # tar would warn of a name that begins with /.
  tar -C / -cf "$files" "${out#/}"
fi
echo "$code" >"$status"
reboot -f
