# shellcheck shell=bash
# A small initrd: busybox and the drivers that may stand before the root file system.
# Uses $image_folder, $work, lines_of and kernel_version of whoever sources it.
# shellcheck disable=SC2154

# What initrd/init calls.
readonly applets=(cat chroot cut find findfs grep md5sum modprobe mount reboot rm sed sh sleep sort
  switch_root tail tr umount xargs)

# make_initrd ROOT OUT
make_initrd() {
  local root=$1 out=$2 tree version applet
  tree=$(mktemp -d -p "$work" initrd.XXXXXX)
  version=$(kernel_version)
  mkdir -p "$tree"/{bin,dev,proc,sys,run,root,"lib/modules/$version"}
  ln -s bin "$tree/sbin" # where the kernel itself looks for modprobe
  cp "$root/usr/bin/busybox" "$tree/bin/"
  for applet in "${applets[@]}"; do ln -s busybox "$tree/bin/$applet"; done
  cp "$image_folder/initrd/init" "$tree/init"
  copy_modules "$version" "$tree"
  depmod -b "$tree" "$version"
  (cd "$tree" && find . | sort | cpio -o -H newc -R 0:0 --quiet | gzip -9n) >"$out"
  rm -rf "$tree"
}

# The listed modules and all that they need.
copy_modules() {
  local version=$1 tree=$2 from=$work/kernel/usr/lib/modules/$1 file
  cp "$from"/modules.{order,builtin,builtin.modinfo} "$tree/lib/modules/$version/"
  listed_modules "$from" |
    xargs modprobe -d "$work/kernel" -S "$version" --show-depends -a 2>/dev/null |
    awk '$1 == "insmod" && !seen[$2]++ { print $2 }' |
    while read -r file; do
      file=${file#*"/lib/modules/$version/"}
      install -D -m 644 "$from/$file" "$tree/lib/modules/$version/$file"
    done
}

listed_modules() {
  local entry
  while read -r entry; do
    find "$1/kernel" \( -path "$1/kernel/$entry/*.ko" -o -path "$1/kernel/$entry.ko" \
      -o -path "$1/kernel/drivers/$entry/*.ko" -o -path "$1/kernel/drivers/$entry.ko" \) \
      -printf '%f\n'
  done < <(lines_of "$image_folder/initrd_modules.txt") | sed 's/\.ko$//' | sort -u
}
