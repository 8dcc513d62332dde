# shellcheck shell=bash
# Debian packages: what is missing, and how to get it.

# Names in the given lists, one a line.
packages_in() {
  local list
  for list in "$@"; do grep -v '^#' "toolchain/packages/$list.txt"; done | sort -u
}

# is_installed NAME[:ARCHITECTURE]: without one, the machine's own.
is_installed() {
  local architecture
  if [[ $1 == *:* ]]; then architecture=${1##*:}; else architecture=$(dpkg --print-architecture); fi
  dpkg-query -W -f='${Architecture} ${db:Status-Status}\n' "$1" 2>/dev/null |
    grep -xE "(all|$architecture) installed" >/dev/null
}

# With nobody there to type a password, sudo must not ask for one.
sudo=(sudo)
[[ -t 2 && ${CI:-} != true ]] || sudo+=(-n)

apt() {
  local apt_get=(env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Use-Pty=0)
  if ((EUID == 0)); then
    "${apt_get[@]}" "$@"
  elif command -v sudo >/dev/null; then
    "${sudo[@]}" "${apt_get[@]}" "$@"
  else
    return 1
  fi
}

apt_install() {
  apt install --no-install-recommends "$@" && return
  apt update && apt install --no-install-recommends "$@"
}

# know_architectures PACKAGE...: makes apt know the architectures of packages like NAME:arm64.
know_architectures() {
  local package architecture known
  known=$(dpkg --print-architecture && dpkg --print-foreign-architectures)
  for package in "$@"; do
    architecture=${package##*:}
    [[ $package != *:* || $known == *"$architecture"* ]] && continue
    add_architecture "$architecture" && apt update || return
    known+=" $architecture"
  done
}

add_architecture() {
  if ((EUID == 0)); then dpkg --add-architecture "$1"; else "${sudo[@]}" dpkg --add-architecture "$1"; fi
}

install_missing() { know_architectures "$@" && apt_install "$@"; }

# need LIST...: installs what the package lists name and the machine has not. Calls apt only then.
need() {
  command -v dpkg-query >/dev/null ||
    give_up "no dpkg here; expected Debian, or these by hand: $(packages_in "$@" | tr '\n' ' ')"
  local package missing=()
  while read -r package; do
    is_installed "$package" || missing+=("$package")
  done < <(packages_in "$@")
  ((${#missing[@]} == 0)) && return
  step "install ${missing[*]}" install install_missing "${missing[@]}" ||
    give_up "install these as root: apt-get install ${missing[*]}"
}
