# shellcheck shell=bash
# Running ctest and counting what it ran. Uses $jobs and $log_folder of whoever sources it.
# shellcheck disable=SC2154

passed=0
failed=0
skipped=0
declare -A skip_reasons=()

# Adds one finished check that is not a ctest test.
count_check() {
  if (($1 == 0)); then passed=$((passed + 1)); else failed=$((failed + 1)); fi
}

# test_preset PRESET [CTEST ARGUMENTS...]: runs the tests of a built preset and counts them.
test_preset() {
  local preset=$1 status=0
  local junit=$PWD/$log_folder/$preset.xml
  shift
  rm -f "$junit"
  step "test $preset" "test-$preset" \
    ctest --preset "$preset" -j "$jobs" --output-junit "$junit" "$@" || status=$?
  if [[ -s $junit ]]; then
    count_tests "$preset" "$junit"
  else
    failed=$((failed + 1))
    echo "test $preset: ctest wrote no results" >&2
  fi
  return "$status"
}

count_tests() {
  local preset=$1 p f s kind text
  {
    read -r p f s
    while read -r kind text; do
      if [[ $kind == skip ]]; then
        skip_reasons[$text]=$((${skip_reasons[$text]:-0} + 1))
      else
        echo "failed in $preset: $text" >&2
      fi
    done
  } < <(awk -f toolchain/dev/junit.awk "$2")
  passed=$((passed + p)) failed=$((failed + f)) skipped=$((skipped + s))
  ((p + f > 0)) || { echo "test $preset: no test ran" >&2; failed=$((failed + 1)); }
}

# The last line of a run.
print_count() {
  local reason
  for reason in "${!skip_reasons[@]}"; do
    echo "skipped ${skip_reasons[$reason]}: $reason"
  done | sort
  echo "$passed passed, $failed failed, $skipped skipped"
  ((failed == 0 && passed > 0))
}
