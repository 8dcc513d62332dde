#!/bin/sh
# On the virtual board, as root, after every start: what a real board has soldered on and this one
# simulates, and the observers. What they see goes out on ports of their own.
set -eu
here=$(dirname "$(readlink -f "$0")")
tracing=/sys/kernel/tracing
configfs=/sys/kernel/config

is_mounted() { mountpoint -q "$1"; }

# port_of NAME: the device of a port, by the name that the emulator gives it.
port_of() {
  for port in /sys/class/virtio-ports/*; do
    [ "$(cat "$port/name" 2>/dev/null)" = "dottrack.$1" ] || continue
    echo "/dev/${port##*/}"
    return
  done
  echo "no port dottrack.$1" >&2
  return 1
}

# send PORT COMMAND...: its output goes out on a port, line by line, until the board is reset.
send() {
  port=$(port_of "$1")
  shift
  setsid "$@" </dev/null >"$port" 2>&1 &
}

trace_gpio() {
  is_mounted "$tracing" || mount -t tracefs none "$tracing"
  echo mono >"$tracing/trace_clock"
  echo 1 >"$tracing/events/gpio/gpio_value/enable"
  send gpio cat "$tracing/trace_pipe"
}

# add_chip LABEL: a chip of 64 lines, to everyone's use.
add_chip() {
  chip=$configfs/gpio-sim/$1
  mkdir -p "$chip/bank0"
  echo 64 >"$chip/bank0/num_lines"
  echo "$1" >"$chip/bank0/label"
  echo 1 >"$chip/live"
}

# The first of the chip's lines, in the trace itself: it counts lines over all chips.
tell_base() {
  for chip in /sys/class/gpio/gpiochip*; do
    [ "$(cat "$chip/label")" = "$1" ] || continue
    echo "gpio-base $(cat "$chip/base")" >"$tracing/trace_marker"
    return
  done
  echo "no GPIO chip $1"
  exit 1
}

# wait_for INTERFACE STATE...: until its state is one of these.
wait_for() {
  tries=0
  until echo " $2 " | grep -q " $(cat "/sys/class/net/$1/operstate" 2>/dev/null) "; do
    tries=$((tries + 1))
    [ "$tries" -le 300 ] || { echo "the CAN interface $1 does not get $2"; exit 1; }
    sleep 0.2
  done
}

# The unit's controller is can0, since its driver comes first; the listener's is can1.
listen_on_can() {
  modprobe -a can_raw can_dev kvaser_pci vcan
  ip link show vcan0 >/dev/null 2>&1 || ip link add vcan0 type vcan
  ip link set vcan0 up
  wait_for can0 "down up"
  insmod "$here/ctucanfd.ko"
  wait_for can1 up
  send can "$here/bin/candump" -L can1
}

modprobe -q virtio_console || true
is_mounted "$configfs" || mount -t configfs none "$configfs"
trace_gpio
insmod "$here/gpio-sim.ko"
add_chip dottrack-test
listen_on_can
add_chip iris
tell_base iris
# Only the journal on disk is followed for as long as the board runs.
journalctl --flush
send journal journalctl -f -b -n all -o short-monotonic --no-hostname
