# shellcheck shell=bash
# Debian packages: what is missing, and how to get it.

# Names in the given lists, one a line.
packages_in() {
  local list
  for list in "$@"; do grep -v '^#' "toolchain/packages/$list.txt"; done | sort -u
}

is_installed() {
  [[ $(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
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

# need LIST...: installs what the package lists name and the machine has not. Calls apt only then.
need() {
  command -v dpkg-query >/dev/null ||
    give_up "no dpkg here; expected Debian, or these by hand: $(packages_in "$@" | tr '\n' ' ')"
  local package missing=()
  while read -r package; do
    is_installed "$package" || missing+=("$package")
  done < <(packages_in "$@")
  ((${#missing[@]} == 0)) && return
  step "install ${missing[*]}" install apt_install "${missing[@]}" ||
    give_up "install these as root: apt-get install ${missing[*]}"
}
