#!/usr/bin/env bash
# prepare.sh IMAGE HARDWARE_TEST DOTTRACK_BOARD: makes in build/board what the virtual board takes:
# board.img, observer.img and variables.fd.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."

readonly work=build/board scenario=tests/board/board.toml
readonly firmware_variables=/usr/share/AAVMF/AAVMF_VARS.fd

give_up() {
  echo "board: $*" >&2
  exit 1
}

# shellcheck source=toolchain/virtual_board/kernel_debs.sh
source toolchain/virtual_board/kernel_debs.sh
# shellcheck source=toolchain/virtual_board/kernel_modules.sh
source toolchain/virtual_board/kernel_modules.sh
# shellcheck source=toolchain/virtual_board/disks.sh
source toolchain/virtual_board/disks.sh

main() {
  (($# == 3)) || give_up "expected IMAGE, HARDWARE_TEST and DOTTRACK_BOARD"
  local image=$1 hardware_test=$2 harness=$3
  mkdir -p "$work"
  build_modules "$work/modules" "$(kernel_version)"
  make_observer "$work/observer.img" "$work/modules" "$hardware_test"
  rm -rf "$work/rig"
  "$harness" rig "$scenario" "$work/rig"
  make_card "$image" "$work/board.img" "$work/rig"
  cp "$firmware_variables" "$work/variables.fd"
}

main "$@"
