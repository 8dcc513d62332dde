# shellcheck shell=bash
# The two disks of the virtual board: the image with a user's files on its boot partition, and the
# observer's, which carries what only the test needs. Uses $work and what kernel_debs.sh has.
# shellcheck disable=SC2154

readonly observer_mb=96
readonly guest_folder=toolchain/virtual_board/guest

# make_observer OUT.img MODULES HARDWARE_TEST
make_observer() {
  local out=$1 modules=$2 hardware_test=$3 tree
  tree=$(mktemp -d -p "$work" observer.XXXXXX)
  unpack "$tree/debs" can-utils:arm64
  mkdir -p "$tree/disk/bin"
  cp "$tree/debs/usr/bin/candump" "$tree/disk/bin/"
  aarch64-linux-gnu-strip -o "$tree/disk/bin/hardware_test" "$hardware_test"
  cp "$modules"/*.ko "$tree/disk/"
  cp "$guest_folder/set_up.sh" "$tree/disk/"
  rm -f "$out"
  mke2fs -q -t ext4 -O ^has_journal -d "$tree/disk" "$out" "${observer_mb}M"
  rm -rf "$tree"
}

# make_card IMAGE OUT.img RIG_FOLDER: what a user with the card in hand could do: copy the rig's
# files onto the boot partition, and ask for a root shell on a serial port.
make_card() {
  local image=$1 out=$2 rig=$3 entry=$work/dottrack.conf
  local boot=$out@@1M
  cp --sparse=always "$image" "$out"
  mcopy -o -i "$boot" "$rig"/* ::/dottrack/
  mcopy -n -o -i "$boot" ::/loader/entries/dottrack.conf "$entry"
  sed -i '/^options /s/$/ systemd.debug_shell=ttyS0/' "$entry"
  mcopy -o -i "$boot" "$entry" ::/loader/entries/dottrack.conf
}
