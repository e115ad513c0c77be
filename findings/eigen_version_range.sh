#!/usr/bin/env bash
# Eigen 3.4.0 (Debian 12) is refused by find_package(Eigen3 3.4...5), a range that holds it. The version file that it brings
# wants the upper end to have its own major version too. A range within version 3 works; so does the single version 3.4, which
# in turn Eigen 5 refuses. So no version that CMake understands takes both: ask for none, and compare Eigen3_VERSION.
# Output seen: 3.4 found, 3.3...3.4 found, 3.4...5 refused.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" libeigen3-dev=3.4.0-4 cmake=3.25.1-1 make
cat >"$scratch/12/root/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(asks NONE)
find_package(Eigen3 ${asked} QUIET NO_MODULE)
file(WRITE /root/said "${Eigen3_FOUND}")
END
# try VERSION EXPECTED
try() {
  within "$scratch/12" cmake -S /root -B "/root/$1" -Dasked="$1" >"$scratch/log" 2>&1 || fail "cmake ends with $(cat "$scratch/log")"
  echo "find_package(Eigen3 $1): found = $(cat "$scratch/12/root/said")"
  [ "$(cat "$scratch/12/root/said")" = "$2" ] || fail "asked for $1"
}
try 3.4 1
try 3.3...3.4 1
try 3.4...5 0
