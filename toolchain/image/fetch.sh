# shellcheck shell=bash
# What comes from the machine's own package source: the root file system's packages, the kernel and
# the boot loader. Uses $image_folder, $work, give_up and lines_of of whoever sources it.
# shellcheck disable=SC2154

# current NAME KEY: whether build/image/NAME was made from KEY.
current() { [[ -e $work/$1 && $(cat "$work/$1.key" 2>/dev/null) == "$2" ]]; }

key_of() { cat "$@" | sha256sum | cut -c 1-16; }

# The machine's own Debian sources, as lines of a sources.list.
debian_sources() {
  # shellcheck disable=SC2016
  apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) $(COMPONENT)' \
    'Created-By: Packages' 'Origin: Debian' 'Architecture: arm64' | sort -u
}

release() { (. /etc/os-release && echo "$VERSION_CODENAME"); }

# Unpacked, not configured: that takes seconds, needs no emulation, and root.sh does the little that
# the packages' scripts would have done.
fetch_base() {
  local key
  key=$(key_of "$image_folder"/root_packages.txt "$image_folder"/root_without.txt)-$(release)
  current base "$key" && return
  [[ -n $(debian_sources) ]] ||
    give_up "apt knows no arm64 packages; expected: dpkg --add-architecture arm64; apt-get update"
  rm -rf "$work/base"
  debian_sources | mmdebstrap --mode="$(fetch_mode)" --architectures=arm64 --variant=extract \
    --skip=check/qemu --hook-dir=/usr/share/mmdebstrap/hooks/merged-usr \
    --include="$(lines_of "$image_folder/root_packages.txt" | paste -sd ,)" \
    "$(release)" "$work/base" -
  without "$work/base" "$image_folder/root_without.txt"
  echo "$key" >"$work/base.key"
}

fetch_mode() { if [[ -n ${FAKEROOTKEY:-} ]]; then echo chrootless; else echo root; fi; }

# without FOLDER LIST: removes what the list names, with wildcards.
without() {
  local pattern
  while read -r pattern; do
    find "$1" -path "$1/$pattern" -prune -exec rm -rf {} +
  done < <(lines_of "$2")
}

kernel_package() {
  apt-cache depends linux-image-arm64:arm64 |
    sed -n 's/^ *Depends: \(linux-image-[0-9].*-arm64\).*/\1/p' | head -n 1
}

# The kernel is unpacked; its own scripts would build an initrd under emulation for minutes.
fetch_kernel() {
  local package key deb
  package=$(kernel_package)
  [[ -n $package ]] || give_up "apt knows no linux-image-arm64"
  key=$(apt-cache show "$package:arm64" |
    key_of - "$image_folder/modules_without.txt" "$image_folder/fetch.sh")
  current kernel "$key" && return
  rm -rf "$work/kernel" "$work/debs"
  mkdir -p "$work/debs" "$work/kernel/usr/lib"
  ln -s usr/lib "$work/kernel/lib"
  (cd "$work/debs" && apt-get -q download "$package:arm64" systemd-boot-efi:arm64)
  for deb in "$work"/debs/*.deb; do
    dpkg-deb --fsys-tarfile "$deb" | tar -x -C "$work/kernel" --keep-directory-symlink
  done
  prune_modules "$(echo "$work"/kernel/usr/lib/modules/*)"
  rm -rf "$work/debs"
  echo "$key" >"$work/kernel.key"
}

# prune_modules FOLDER: takes out what the list names and whatever cannot do without it.
prune_modules() {
  local folder=$1 file needs need
  depmod -b "$work/kernel" "$(kernel_version)"
  without "$folder/kernel" "$image_folder/modules_without.txt"
  while IFS=: read -r file needs; do
    for need in $needs; do
      [[ -e $folder/$need ]] || rm -f "$folder/$file"
    done
  done <"$folder/modules.dep"
  depmod -b "$work/kernel" "$(kernel_version)"
}

kernel_version() { basename "$work"/kernel/usr/lib/modules/*; }
