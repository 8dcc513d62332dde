# shellcheck shell=bash
# Running the fuzz targets. Each starts from the corpus in the tree; what it finds on the way stays in
# build/fuzz, an input that breaks something goes to out/fuzz. Uses $log_folder of whoever sources it.
# shellcheck disable=SC2154

readonly fuzz_targets=(receiver dbc)
readonly fuzz_seconds=${DOTTRACK_FUZZ_S:-60}
readonly fuzz_fewest_runs=1000 # less is not fuzzing

# Runs and counts them all.
run_fuzz_targets() {
  local name status
  for name in "${fuzz_targets[@]}"; do
    status=0
    fuzz_target "$name" || status=$?
    count_check "$status"
  done
}

# fuzz_target NAME
fuzz_target() {
  local name=$1 log=$log_folder/fuzz-$1.log found=build/fuzz/corpus/$1 status=0 words=()
  rm -rf "$found" && mkdir -p "$found" out/fuzz
  [[ ! -f tests/fuzz/$name.dict ]] || words=(-dict="tests/fuzz/$name.dict")
  fuzzer "$name" "${words[@]}" -seed=1 -max_total_time="$fuzz_seconds" -max_len=4096 -timeout=10 \
    -rss_limit_mb=2048 -print_final_stats=1 "$found" "tests/fuzz/corpus/$name" \
    >"$log" 2>&1 || status=$?
  local runs edges
  runs=$(awk '/^stat::number_of_executed_units:/ { print $2 }' "$log")
  edges=$(grep -o 'cov: [0-9]*' "$log" | tail -n 1 | cut -d' ' -f2)
  printf '%-44s %4d s  %d executions, %d edges covered\n' "fuzz $name" "$fuzz_seconds" \
    "${runs:-0}" "${edges:-0}"
  ((status == 0)) || tell_finding "$name" "$log"
  ((status == 0 && ${runs:-0} >= fuzz_fewest_runs))
}

# fuzzer NAME ARGUMENTS...
fuzzer() {
  local name=$1
  shift
  UBSAN_OPTIONS=print_stacktrace=1 "build/fuzz/bin/${name}_fuzz" \
    -artifact_prefix="out/fuzz/$name-" "$@"
}

tell_finding() {
  local name=$1 log=$2 input
  show_end "$log"
  input=$(grep -o 'Test unit written to .*' "$log" | tail -n 1 | sed 's/.* //')
  [[ -n $input ]] || return 0
  echo "to repeat: build/fuzz/bin/${name}_fuzz $input" >&2
  echo "once it is mended, keep it: mv $input tests/fuzz/corpus/$name/" >&2
}
