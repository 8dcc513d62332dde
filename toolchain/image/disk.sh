# shellcheck shell=bash
# Three partitions in one file: FAT to start from and to configure, the root, the state.
# Uses $image_folder, $work and the names of the file systems of whoever sources it.
# shellcheck disable=SC2154

readonly boot_mb=128 state_mb=256

# make_disk TREE IMAGE: TREE/root and TREE/initrd.
make_disk() {
  local tree=$1 image=$2 root_mb
  mkdir -p "$tree/var"
  mv "$tree/root/var" "$tree/state"
  mkdir "$tree/root/var"
  root_mb=$(($(du -sm "$tree/root" | cut -f 1) * 11 / 10 + 16))
  make_boot "$tree"
  mke2fs -q -t ext4 -O ^has_journal -m 0 -L dottrack-root -U "$root_uuid" -d "$tree/root" \
    "$tree/root.fs" "${root_mb}M"
  mke2fs -q -t ext4 -m 1 -L dottrack-state -U "$state_uuid" -d "$tree/state" \
    "$tree/state.fs" "${state_mb}M"
  join_partitions "$tree" "$root_mb" "$image"
}

make_boot() {
  local tree=$1 fat=$1/boot.fs
  truncate -s "${boot_mb}M" "$fat"
  mformat -i "$fat" -F -v DOTTRACK -N "$boot_serial" ::
  mmd -i "$fat" ::/EFI ::/EFI/BOOT ::/loader ::/loader/entries
  mcopy -i "$fat" "$work/kernel/usr/lib/systemd/boot/efi/systemd-bootaa64.efi" ::/EFI/BOOT/BOOTAA64.EFI
  mcopy -i "$fat" "$work"/kernel/boot/vmlinuz-* ::/vmlinuz
  mcopy -i "$fat" "$tree/initrd" ::/initrd
  mcopy -i "$fat" "$image_folder/boot/loader/loader.conf" ::/loader/
  write_entry | mcopy -i "$fat" - ::/loader/entries/dottrack.conf
  mcopy -i "$fat" -s "$image_folder/boot/dottrack" ::/
  mcopy -i "$fat" "$tree/root/usr/share/doc/dottrack/examples/rig.toml" ::/dottrack/rig.toml.example
}

write_entry() {
  echo "title dottrack"
  echo "linux /vmlinuz"
  echo "initrd /initrd"
  echo "options root=UUID=$root_uuid dottrack.boot=UUID=${boot_serial:0:4}-${boot_serial:4}" \
    "dottrack.state=UUID=$state_uuid ro quiet panic=10"
}

# join_partitions TREE ROOT_MB IMAGE
join_partitions() {
  local tree=$1 root_mb=$2 image=$3
  mkdir -p "$(dirname "$image")"
  rm -f "$image"
  truncate -s $((1 + boot_mb + root_mb + state_mb + 1))M "$image"
  sgdisk -n "1:1M:+${boot_mb}M" -t 1:ef00 -c 1:dottrack-boot \
    -n "2:0:+${root_mb}M" -t 2:8305 -c 2:dottrack-root \
    -n "3:0:+${state_mb}M" -t 3:8310 -c 3:dottrack-state "$image"
  place "$tree/boot.fs" "$image" 1
  place "$tree/root.fs" "$image" $((1 + boot_mb))
  place "$tree/state.fs" "$image" $((1 + boot_mb + root_mb))
}

# place FILESYSTEM IMAGE MEGABYTE
place() { dd if="$1" of="$2" bs=1M seek="$3" conv=notrunc,sparse status=none; }
