#!/usr/bin/env bash
# Builds and tests; installs what is missing first. May be run again: only what changed is built anew.
#   scripts/test.sh         the quick tests of the release build: within 6 minutes of a fresh clone on two idle cores
#   scripts/test.sh --all   everything: unit tests under the address and undefined-behaviour sanitizers in a build without
#                           MPI, then the release build with every other test, and the unit tests that use MPI; must end
#                           within 25 minutes of a fresh clone on two idle cores. A test program is then one test of ctest,
#                           which spares its start for each case; the quick tests, and cmake -DFSI_TEST_CASES=ON
#                           -DFSI_UNIT_TESTS=ON, run each case by itself
# Ends with ctest's summary; any failure ends it earlier or makes its exit code non-zero.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fail() {
  echo "test.sh: error: $*" >&2
  exit 1
}

all=no
for argument in "$@"; do
  case "$argument" in
    --all) all=yes ;;
    *) fail "unknown option '$argument'; the only one is --all" ;;
  esac
done

run_tests() { ctest --test-dir "$1" -j"$(nproc)" --output-on-failure --no-tests=error "${@:2}"; }

scripts/install_packages.sh --tests

if [ $all = yes ]; then
  echo "== unit tests with sanitizers, and without MPI"
  cmake --preset sanitize -DFSI_TESTS=ON
  cmake --build --preset sanitize --target unit_tests fsi-monolithic fsi-partitioned
  run_tests build/sanitize -L '^unit$'
  run_tests build/sanitize -R '^partitions[.]WithoutMpi$'

  echo "== all other tests, release build"
  cmake --preset release -DFSI_TESTS=ON -DFSI_TEST_CASES=OFF -DFSI_UNIT_TESTS=OFF
  cmake --build --preset release
  run_tests build/release
else
  cmake --preset release -DFSI_TESTS=ON -DFSI_TEST_CASES=ON -DFSI_UNIT_TESTS=ON
  cmake --build --preset release --target quick_tests
  run_tests build/release -L '^quick$'
fi
