# shellcheck shell=bash disable=SC2154
# Stages of a long command, to be read by a bash script: `stage` runs one into the log file and measures it, `print_table`
# prints what was measured. The script says in `log` where the log file is and in `measured` of which folder the disk space
# counts; `not_measured` is a pattern of what is mounted there from elsewhere. It calls `report_failure` when it ends.

stage_now=""
stage_last=""
stage_rows=()

# Processor seconds, in hundredths, of the children of this shell that have ended.
children_hundredths() {
  local fields
  read -r -a fields <"/proc/$$/stat"
  echo $(((fields[15] + fields[16]) * 100 / $(getconf CLK_TCK)))
}

used_kib() { du -sx --block-size=1K --exclude="${not_measured:-}" "$measured" | cut -f1; }

# stage NAME COMMAND...: its output is in the log only. Fails as the command does, for a script under `set -e`.
stage() {
  local name=$1 start=$EPOCHREALTIME processor used
  shift
  processor=$(children_hundredths) used=$(used_kib)
  stage_now=$name
  echo "== $name"
  echo "== $name" >>"$log"
  "$@" >>"$log" 2>&1
  stage_now="" stage_last=$name
  local end=$EPOCHREALTIME
  # EPOCHREALTIME has microseconds behind a point or a comma, as the locale wants it
  local tenths=$(((${end/[.,]/} - ${start/[.,]/}) / 100000))
  processor=$((($(children_hundredths) - processor) / 10))
  used=$(($(used_kib) - used))
  stage_rows+=("$(printf '%-26s %8d.%d %12d.%d %10d' "$name" $((tenths / 10)) $((tenths % 10)) \
    $((processor / 10)) $((processor % 10)) $((used / 1024)))")
}

# Stages that the last one has printed itself, as scripts/quickstart.sh does: name and seconds.
print_own_stages() {
  tac "$log" | awk -v heading="== $stage_last" '$0 == heading { exit } 1' |
    grep -E '^[^=].{23} +[0-9]+\.[0-9] s$' | tac | sed 's/^/  /' || true
}

print_table() {
  echo
  printf '%-26s %10s %14s %10s\n' stage seconds "processor s" "disk MiB"
  [ ${#stage_rows[@]} -eq 0 ] || printf '%s\n' "${stage_rows[@]}"
}

# For the trap at the end: which stage it was, or what came after which, and the end of the output.
report_failure() {
  local code=$?
  [ "$code" -ne 0 ] || return 0
  print_table
  echo
  tail -n 30 "$log"
  if [ -n "$stage_now" ]; then
    echo "error: failed in the stage '$stage_now'" >&2
  else
    echo "error: failed after the stage '$stage_last'" >&2
  fi
}
