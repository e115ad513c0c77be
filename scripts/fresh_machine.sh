#!/usr/bin/env bash
# A fresh Debian machine: makes a minimal Debian in a folder, clones the last commit into it and runs there, by chroot,
# what README promises of such a machine. Prints seconds, processor seconds and disk space of every stage. Any failure
# names its stage and makes the exit code 1. The whole output is in a log file.
#   scripts/fresh_machine.sh [OPTIONS] [FOLDER]
#                     README's two commands, scripts/quickstart.sh and scripts/test.sh, as root, and then, with everything
#                     installed, as an ordinary user. FOLDER is for the machine, new or empty; without it a temporary one
#   --no-tests          without scripts/test.sh
#   --serial            both commands with --serial: programs without MPI
#   --short             packages, configuring, one program, and a run of it
#   --package FILE.deb  not the sources: installs a Debian package and runs the commands of docs/guide/tutorial.md by its programs
#   --container         not README's commands: the steps of containers/Containerfile, and the entry point of what they make
#   --arm               beside --container: on 64-bit Arm, by qemu; the compiler's passes alone are a cross compiler's
#   --suite NAME        which Debian: bookworm (12), trixie (13) or testing; otherwise bookworm
#   --level v2|v3|v4    a lower processor level, x86-64-v3 for one: programs are compiled for it, and libraries that choose
#                       by the processor (OpenBLAS, glibc, numpy) choose for it. This is no emulator: an instruction
#                       beyond the level, if there is one, still runs. Registers that the level does not have are
#                       counted in the programs
#   --debs FOLDER       .deb files to take instead of downloads; what is downloaded is put beside them
#   --ccache FOLDER     compiles with ccache, whose cache is there: for developers, as seconds then say little
#   --keep              leaves the machine in its folder
#   --log FILE          the log file, otherwise build/fresh_machine.log
#   --help              this text
# Needs root, the Debian package mmdebstrap, and a kernel that allows namespaces: all mounts are in one of its own, and
# go with its last process. Debian's mirror, apt's proxy and the name server are this machine's.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
top=${here%/*}

fail() {
  echo "fresh_machine.sh: error: $*" >&2
  exit 1
}

mode=clone tests=yes serial="" arm="" suite=bookworm level="" package="" debs="" cache="" keep=no folder="" log=$top/build/fresh_machine.log
choose() {
  [ "$mode" = clone ] || fail "--$1 beside --$mode: these are different things to try; give one of them"
  mode=$1
}
existing_folder() { [ -d "$2" ] || fail "$1 $2: there is no such folder"; }
while [ $# -gt 0 ]; do
  case "$1" in
    --package | --suite | --level | --debs | --ccache | --log) [ $# -gt 1 ] || fail "$1 needs a value; see --help" ;;
  esac
  case "$1" in
    --help) sed -n '2,/^set /s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" && exit 0 ;;
    --no-tests) tests=no ;;
    --serial) serial=--serial ;;
    --arm) arm=--arm ;;
    --short | --container) choose "${1#--}" ;;
    --package) choose package && package=$2 && shift ;;
    --suite) suite=$2 && shift ;;
    --level) level=$2 && shift ;;
    --debs) debs=$2 && shift && existing_folder --debs "$debs" ;;
    --ccache) cache=$2 && shift && existing_folder --ccache "$cache" ;;
    --keep) keep=yes ;;
    --log) log=$2 && shift ;;
    -*) fail "unknown option '$1'; see --help" ;;
    *)
      [ -z "$folder" ] || fail "two folders, $folder and $1; give one"
      folder=$1
      ;;
  esac
  shift
done

case "$suite" in bookworm | trixie | testing) ;; *) fail "--suite $suite: the suites are bookworm, trixie and testing" ;; esac
[ "$mode" != container ] || [ "$suite" = bookworm ] || fail "--suite beside --container: the container file names its own Debian"
case "$level" in "" | v2 | v3 | v4) ;; *) fail "--level $level: the levels are v2, v3 and v4" ;; esac
[ -z "$serial" ] || [ "$mode" = clone ] || fail "--serial beside --$mode: it is for README's commands"
[ -z "$arm" ] || [ "$mode" = container ] || fail "--arm beside --$mode: it is for --container"
[ -z "$arm" ] || [ -z "$level" ] || fail "--level beside --arm: a level is one of x86-64"
[ -z "$level" ] || /lib64/ld-linux-x86-64.so.2 --help | grep -q "x86-64-$level (supported" ||
  fail "--level $level: this machine's processor does not have it; a level can only be lowered"
[ "$mode" != package ] || dpkg-deb --field "$package" Package >/dev/null 2>&1 ||
  fail "--package $package: this is no Debian package"
[ -z "$folder" ] || [ ! -e "$folder" ] || { [ -d "$folder" ] && [ -z "$(ls -A "$folder")" ]; } ||
  fail "$folder is there and not empty; give another folder, or none"
[ "$mode" != container ] || python3 -B "$here/fresh_machine/containerfile.py" "$top/containers/Containerfile" >/dev/null
[ "$(id -u)" -eq 0 ] || fail "needs root, for chroot and what dpkg does there"
for needed in "mmdebstrap mmdebstrap" "git git"; do
  command -v "${needed%% *}" >/dev/null || fail "${needed%% *} is missing; install the Debian package ${needed##* }"
done
# shellcheck source=fresh_machine/arm.sh
. "$here/fresh_machine/arm.sh"
lacks=${arm:+$(arm_lacks)}
[ -z "$lacks" ] || fail "--arm: $lacks"
git -C "$top" rev-parse --verify --quiet HEAD >/dev/null || fail "$top is no git repository with a commit to clone"
unshare --mount --pid --fork true 2>/dev/null ||
  fail "the kernel does not allow this user mount and process namespaces (within a container: start it privileged)"

temporary=no
if [ -z "$folder" ]; then
  temporary=yes
  folder=$(mktemp -d)
fi
mkdir -p "$folder" "$(dirname "$log")"
folder=$(cd "$folder" && pwd)
: >"$log"
log=$(cd "$(dirname "$log")" && pwd)/$(basename "$log")

# Mounts were never in this namespace, only in the one below; a folder in which something is mounted here all the same is
# nothing to remove.
remove_machine() {
  if [ "$keep" = yes ]; then
    echo "The machine is in $folder."
    return
  fi
  ! grep -qF " $folder/" /proc/self/mountinfo || fail "something is mounted below $folder, which therefore stays"
  local trial
  for trial in 1 2 3; do # processes that were killed may still be ending
    if rm -rf --one-file-system "${folder:?}"/*; then break; fi
    sleep "$trial"
  done
  [ $temporary = no ] || rmdir "$folder"
}

# In namespaces of their own: what is mounted goes, and what still runs is killed, with the first process there; and that
# one with unshare, and that with this script, however it ends.
run_stages() {
  export fresh_mode=$mode fresh_tests=$tests fresh_serial=$serial fresh_arm=$arm fresh_suite=$suite fresh_level=$level
  export fresh_debs=${debs:+$(cd "$debs" && pwd)} fresh_log=$log
  export fresh_package=${package:+$(realpath "$package")} fresh_ccache=${cache:+$(cd "$cache" && pwd)} fresh_folder=$folder
  setpriv --pdeathsig KILL unshare --mount --propagation private --pid --mount-proc --fork --kill-child \
    bash "$here/fresh_machine/stages.sh" &
  local inside=$! code=0
  trap 'code=143; { kill -KILL $inside; wait $inside; } 2>/dev/null || true' INT TERM HUP # without the shell's word on it
  wait $inside || { [ $code -ne 0 ] || code=1; }
  trap - INT TERM HUP
  echo "Log: $log"
  remove_machine
  exit $code
}
run_stages # in a function, which a change of this file in the meantime does not reach
