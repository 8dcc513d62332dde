# shellcheck shell=bash
# Counting instructions under callgrind against the committed figures: a check of the work that the
# tracker does, whatever the machine has to do besides. Uses $log_folder of whoever sources it.
# shellcheck disable=SC2154

readonly instruction_figures=tests/instructions/figures.txt
readonly instruction_program=build/release/bin/dottrack_instructions

# How many instructions NAME takes.
count_instructions() {
  local log=$log_folder/instructions-${1//\//-}.log
  valgrind --tool=callgrind --collect-atstart=no --callgrind-out-file=/dev/null \
    "$instruction_program" "$1" >"$log" 2>&1 || { show_end "$log"; return 1; }
  awk '/Collected :/ { print $4 }' "$log"
}

# check_instructions NAME FIGURE: fails when there are more than 5 % more than the figure.
check_instructions() {
  local name=$1 figure=$2 count verdict
  count=$(count_instructions "$name") || return
  verdict=$(awk -v n="$count" -v f="$figure" 'BEGIN {
    r = f > 0 ? n / f : 99
    print (r > 1.05 ? "too many" : r < 0.95 ? "lower the figure" : "as before") }')
  printf '%-24s %12d instructions, %12d committed: %s\n' "$name" "$count" "$figure" "$verdict"
  [[ $verdict != "too many" ]]
}

check_all_instructions() {
  local name figure status
  while read -r name figure; do
    [[ -n $name && $name != \#* ]] || continue
    status=0
    check_instructions "$name" "$figure" || status=$?
    count_check "$status"
  done <"$instruction_figures"
}
