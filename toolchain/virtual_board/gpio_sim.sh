# shellcheck shell=bash
# gpio-sim.ko: the kernel's simulated GPIO chips, which Debian's kernel leaves out, built from its
# own source against its own headers. Uses $work and what kernel_debs.sh has.
# shellcheck disable=SC2154

# build_gpio_sim OUT.ko VERSION
build_gpio_sim() {
  local out=$1 version=$2 folder=$work/gpio-sim
  [[ -e $out && $(cat "$folder/version" 2>/dev/null) == "$version" ]] && return
  rm -rf "$folder"
  mkdir -p "$folder/module"
  fetch_headers "$folder/headers" "$version"
  fetch_source "$folder" "$version"
  make_module "$folder" "$version"
  aarch64-linux-gnu-strip --strip-debug -o "$out" "$folder/module/gpio-sim.ko"
  rm -rf "$folder/headers"
  echo "$version" >"$folder/version"
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

# fetch_source FOLDER VERSION: the three files that make up the module.
fetch_source() {
  local source
  source=linux-source-$(main_version "$2")
  unpack "$1/source" "$source"
  tar -xJf "$1/source/usr/src/$source.tar.xz" -C "$1/module" --strip-components=1 \
    "$source/drivers/gpio/gpio-sim.c" "$source/drivers/gpio/gpiolib.h" \
    "$source/kernel/irq/irq_sim.c"
  rm -rf "$1/source"
}

# irq_sim is not in Debian's kernel either, so it becomes a part of the module. It asks for an
# interrupt's descriptor by a function that modules cannot call, and then by one that they can.
make_module() {
  local module=$1/module version=$2
  mv "$module/drivers/gpio/gpio-sim.c" "$module/gpio-sim-core.c"
  mv "$module/drivers/gpio/gpiolib.h" "$module/kernel/irq/irq_sim.c" "$module"
  sed -i -e 's/irq_to_desc(\([a-z_]*\))/irq_data_to_desc(irq_get_irq_data(\1))/' \
    -e '/^#include <linux\/irq_sim.h>/a #include <linux/irqdesc.h>' "$module/irq_sim.c"
  printf 'obj-m := gpio-sim.o\ngpio-sim-y := gpio-sim-core.o irq_sim.o\n' >"$module/Kbuild"
  make -C "$1/headers/usr/src/linux-headers-$version" M="$PWD/$module" \
    DEB_BUILD_ARCH="$(dpkg --print-architecture)" DEB_HOST_ARCH=arm64 \
    DEB_HOST_GNU_TYPE=aarch64-linux-gnu modules
}
