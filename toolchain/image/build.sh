#!/usr/bin/env bash
# build.sh DOTTRACK.deb OUT.img: a disk image for 64-bit Arm boards that start by UEFI. Needs neither
# mounts nor loop devices; what was fetched stays in build/image, renewed when a list changes.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."

# Files belong to root in the image, whoever makes it.
((EUID == 0)) || exec fakeroot -- "$0" "$@"

readonly image_folder=toolchain/image work=build/image

# shellcheck source=toolchain/image/fetch.sh
source "$image_folder/fetch.sh"
# shellcheck source=toolchain/image/root.sh
source "$image_folder/root.sh"
# shellcheck source=toolchain/image/initrd.sh
source "$image_folder/initrd.sh"
# shellcheck source=toolchain/image/disk.sh
source "$image_folder/disk.sh"

give_up() {
  echo "image: $*" >&2
  exit 1
}

# Lines of a list without its comments.
lines_of() { grep -v '^#' "$1"; }

main() {
  (($# == 2)) || give_up "expected DOTTRACK.deb and OUT.img"
  local deb=$1 image=$2 tree
  [[ -f $deb ]] || give_up "no package $deb"
  mkdir -p "$work"
  exec 9>"$work/lock"
  flock 9 # one at a time
  tree=$(mktemp -d -p "$work" tree.XXXXXX)
  # shellcheck disable=SC2064
  trap "rm -rf '$tree'" EXIT
  fetch_base
  fetch_kernel
  name_filesystems
  make_root "$deb" "$tree/root"
  make_initrd "$tree/root" "$tree/initrd"
  make_disk "$tree" "$image"
}

main "$@"
