#!/usr/bin/env bash
# Open MPI: how long a process lives after Ctrl-C of mpirun, and what lengthens it.
#   4.1.4 (Debian 12): SIGTERM one second after the interrupt, SIGKILL one second later; the setting
#     odls_base_sigkill_timeout = 4 makes that 4 and 8 seconds. Its name says the time to the kill: it is half of that.
#   5.0.7 (Debian 13): SIGTERM after a quarter of a second, SIGKILL within half a second; the setting is taken without a word
#     and has no effect.
# Neither hands the interrupt itself on: the process sees SIGCONT first.
# Output seen: 4.1.4 TERM 1.0 KILL 1.9, with the setting 4.0 and 8.0; 5.0.7 TERM 0.3 KILL 0.4, with the setting 0.3 and 0.5.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/4" openmpi-bin=4.1.4-3+b1 openssh-client
debian trixie "$scratch/5" openmpi-bin=5.0.7-1 openssh-client

# Prints SIGTERM's and the last sign of life's seconds after the interrupt.
cat >"$scratch/interrupt.sh" <<'END'
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
cat >/tmp/process.sh <<'PROCESS'
trap 'date +%s.%N >/tmp/term' TERM
trap 'echo interrupted >/tmp/int' INT
for _ in $(seq 400); do date +%s.%N >/tmp/alive; sleep 0.05; done
PROCESS
rm -f /tmp/term /tmp/int
mpirun "$@" -n 1 --oversubscribe bash /tmp/process.sh >/tmp/said 2>&1 &
launcher=$!
sleep 3
start=$(date +%s.%N)
kill -INT $launcher
wait $launcher || true
sleep 0.2
[ ! -e /tmp/int ] || echo "interrupted"
awk -v s="$start" '{ printf "%.1f ", $1 - s }' /tmp/term /tmp/alive
echo
END
for version in 4 5; do cp "$scratch/interrupt.sh" "$scratch/$version/root/"; done

try() { within "$scratch/$1" bash /root/interrupt.sh "${@:2}"; }
# between FROM TO NUMBER
between() { awk -v a="$1" -v b="$2" -v x="$3" 'BEGIN { exit !(x >= a && x <= b) }'; }
expect() {
  local what=$1 term_from=$2 term_to=$3 kill_from=$4 kill_to=$5 term last
  shift 5
  read -r term last < <(try "$@")
  echo "$what: SIGTERM after $term s, last sign of life after $last s"
  between "$term_from" "$term_to" "$term" || fail "$what: SIGTERM after $term s"
  between "$kill_from" "$kill_to" "$last" || fail "$what: killed after $last s"
}
expect "4.1.4" 0.8 1.6 1.6 3.0 4
expect "4.1.4, timeout 4" 3.8 4.6 7.5 9.0 4 --mca odls_base_sigkill_timeout 4
expect "5.0.7" 0.0 0.6 0.1 0.9 5
expect "5.0.7, timeout 4" 0.0 0.6 0.1 0.9 5 --mca odls_base_sigkill_timeout 4
