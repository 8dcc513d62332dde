# shellcheck shell=bash
# Other programs read what dottrack says. Packages come from npm into build/interop; logs and what
# the programs made of them stay in out/interop. Uses $log_folder of whoever sources it.
# shellcheck disable=SC2154

readonly interop_folder=build/interop
readonly interop_out=out/interop
readonly interop_scenarios=(classic fd extended extended_fd)

# Any node and npm will do; Debian's where there are none.
need_node() {
  local missing=()
  command -v node >/dev/null || missing+=(nodejs)
  command -v npm >/dev/null || missing+=(npm)
  ((${#missing[@]} == 0)) && return
  step "install ${missing[*]}" install install_missing "${missing[@]}" ||
    give_up "install these as root: apt-get install ${missing[*]}"
}

install_readers() {
  mkdir -p "$interop_folder"
  cp tests/interop/{package.json,package-lock.json,.npmrc,*.mjs} "$interop_folder/"
  (cd "$interop_folder" && npm ci)
}

# identifiers_of SCENARIO: as options of dottrack.
identifiers_of() {
  local file=tests/interop/scenarios/$1.toml base
  base=$(sed -n 's/^base_id = //p' "$file")
  [[ -z $base ]] || printf '%s\n' --base-id "$base"
  ! grep -q '^extended = true' "$file" || echo --extended
}

# Runs and counts them all.
run_interop_checks() {
  local dottrack=$PWD/build/release/bin/dottrack scenario ids
  for scenario in "${interop_scenarios[@]}"; do
    mapfile -t ids < <(identifiers_of "$scenario")
    make_log "$dottrack" "$scenario" || { count_check 1; continue; }
    read_by_others "$scenario" "$interop_out/$scenario/can.log" "${ids[@]}" \
      --poses "$interop_out/$scenario/poses.csv"
  done
  # What a kernel's CAN delivered, where the virtual board has run.
  [[ ! -s out/board/can.log ]] || read_by_others board out/board/can.log
  check "MAVLink classic" mavlink-classic node "$interop_folder/mavlink_check.mjs" "$dottrack" \
    "$interop_out/classic/can.log"
}

make_log() {
  rm -rf "${interop_out:?}/$2"
  step "log $2" "interop-log-$2" "$1" sim "tests/interop/scenarios/$2.toml" --out "$interop_out/$2"
}

# read_by_others NAME LOG [OPTIONS OF can_check.mjs...]
read_by_others() {
  local name=$1 log=$2 dottrack=$PWD/build/release/bin/dottrack
  shift 2
  check "candied $name" "candied-$name" \
    node "$interop_folder/can_check.mjs" "$dottrack" "$log" "$@"
  check "can-utils $name" "can-utils-$name" \
    node "$interop_folder/can_utils_check.mjs" "$log" "$interop_out/$name.asc"
}

# check TITLE LOG COMMAND...: a step that counts; what it says is shown.
check() {
  local log=$log_folder/interop-$2.log status=0
  step "$1" "interop-$2" "${@:3}" || status=$?
  count_check "$status"
  ((status != 0)) || sed 's/^/  /' "$log"
}
