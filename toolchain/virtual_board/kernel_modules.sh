# shellcheck shell=bash
# Drivers of what is emulated that Debian's kernel leaves out, built from its own source against its
# own headers: gpio-sim, simulated GPIO chips, and ctucanfd, the listening CAN controller. Uses
# $work and what kernel_debs.sh has.
# shellcheck disable=SC2154

# build_modules FOLDER VERSION: FOLDER/gpio-sim.ko, FOLDER/ctucanfd.ko.
build_modules() {
  local out=$1 version=$2 headers=$work/headers
  [[ -e $out/gpio-sim.ko && $(cat "$out/version" 2>/dev/null) == "$version" ]] && return
  rm -rf "$out" "$headers"
  mkdir -p "$out/source"
  fetch_headers "$headers" "$version"
  fetch_source "$out/source" "$version"
  arrange_gpio_sim "$out/source/drivers/gpio" "$out/source/kernel/irq"
  arrange_ctucanfd "$out/source/drivers/net/can/ctucanfd"
  make_module "$out/source/drivers/gpio/gpio-sim.ko" "$out" "$headers" "$version"
  make_module "$out/source/drivers/net/can/ctucanfd/ctucanfd.ko" "$out" "$headers" "$version"
  rm -rf "$headers"
  echo "$version" >"$out/version"
}

# The kernel's main version, as names of source packages have it: 6.1 of 6.1.0-56-arm64.
main_version() { cut -d . -f 1,2 <<<"$1"; }

# fetch_headers FOLDER VERSION
fetch_headers() {
  local abi=${2%-arm64} makefile=$1/usr/src/linux-headers-$2/Makefile
  unpack "$1" "linux-headers-$2:arm64" "linux-headers-$abi-common" "linux-kbuild-$(main_version "$2")"
  # The headers expect to be installed.
  sed -i "s|include /usr/src|include $PWD/$1/usr/src|" "$makefile"
}

# fetch_source FOLDER VERSION
fetch_source() {
  local source
  source=linux-source-$(main_version "$2")
  unpack "$1/package" "$source"
  tar -xJf "$1/package/usr/src/$source.tar.xz" -C "$1" --strip-components=1 --wildcards \
    "$source/drivers/gpio/gpio-sim.c" "$source/drivers/gpio/gpiolib.h" \
    "$source/kernel/irq/irq_sim.c" "$source/drivers/net/can/ctucanfd/*"
  rm -rf "$1/package"
}

# irq_sim is not in Debian's kernel either, so it becomes a part of the module. It asks for an
# interrupt's descriptor by a function that modules cannot call, and then by one that they can.
arrange_gpio_sim() {
  local folder=$1
  mv "$folder/gpio-sim.c" "$folder/gpio-sim-core.c"
  mv "$2/irq_sim.c" "$folder"
  sed -i -e 's/irq_to_desc(\([a-z_]*\))/irq_data_to_desc(irq_get_irq_data(\1))/' \
    -e '/^#include <linux\/irq_sim.h>/a #include <linux/irqdesc.h>' "$folder/irq_sim.c"
  printf 'obj-m := gpio-sim.o\ngpio-sim-y := gpio-sim-core.o irq_sim.o\n' >"$folder/Kbuild"
}

# Core and PCI device in one module.
arrange_ctucanfd() {
  rm -f "$1/Makefile"
  printf 'obj-m := ctucanfd.o\nctucanfd-y := ctucanfd_base.o ctucanfd_pci.o\n' >"$1/Kbuild"
}

# make_module MODULE OUT HEADERS VERSION
make_module() {
  make -C "$3/usr/src/linux-headers-$4" M="$PWD/$(dirname "$1")" \
    DEB_BUILD_ARCH="$(dpkg --print-architecture)" DEB_HOST_ARCH=arm64 \
    DEB_HOST_GNU_TYPE=aarch64-linux-gnu modules
  aarch64-linux-gnu-strip --strip-debug -o "$2/$(basename "$1")" "$1"
}
