# shellcheck shell=bash
# Steps that are quiet when they succeed and clear when they fail.

readonly log_folder=build/log

give_up() {
  echo "dev: $*" >&2
  exit 1
}

# step TITLE LOG COMMAND...: runs the command with its output in build/log/LOG.log. One line when it
# succeeds; when it fails the end of the log and where it is.
step() {
  local title=$1 log=$log_folder/$2.log
  shift 2
  local start=$SECONDS status=0
  mkdir -p "$log_folder"
  "$@" >"$log" 2>&1 || status=$?
  if ((status == 0)); then
    printf '%-44s %4d s\n' "$title" $((SECONDS - start))
    return 0
  fi
  printf '%-44s failed after %d s\n' "$title" $((SECONDS - start)) >&2
  show_end "$log"
  return "$status"
}

# The compiler's first error says more than the last line of a parallel build.
show_end() {
  local log=$1
  echo "--- $log: errors, then the end" >&2
  grep -E 'error:|Error:|undefined reference|FAILED: |: Failure$|\*\*\*' "$log" |
    cut -c 1-300 | head -n 12 >&2 || true
  echo "..." >&2
  tail -n 25 "$log" >&2
  echo "--- the whole log: $PWD/$log" >&2
}
