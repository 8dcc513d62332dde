# shellcheck shell=bash
# Parts of the image's kernel that the unit does without and the virtual board needs, from the
# machine's own package source. Uses $work and give_up of whoever sources it.
# shellcheck disable=SC2154

# The kernel that ./dev image has put into the image.
kernel_version() { basename build/image/kernel/usr/lib/modules/*; }

# unpack FOLDER PACKAGE...: what these packages hold.
unpack() {
  local folder=$1 debs deb
  shift
  debs=$(mktemp -d -p "$work" debs.XXXXXX)
  (cd "$debs" && apt-get -q download "$@") || give_up "apt cannot download $*"
  mkdir -p "$folder"
  for deb in "$debs"/*.deb; do dpkg -x "$deb" "$folder"; done
  rm -rf "$debs"
}
