#!/usr/bin/env bash
# Builds and tests; installs what is missing first. May be run again: only what changed is built anew.
#   scripts/test.sh         the quick tests of the release build
#   scripts/test.sh --all   everything, with warnings as errors: unit tests under the address and undefined-behaviour
#                           sanitizers in a build by clang, without MPI, for x86-64-v2, those whose code has changed since
#                           they last passed; three sources that depend on the width of vectors for another processor
#                           level; then the release build by gcc, for this machine, with every other test and the unit
#                           tests that use MPI or vectors. A test program is then one test of ctest, which spares its
#                           start for each case; cmake -DFSI_TEST_CASES=ON makes each case one
#   scripts/test.sh --sanitized  all unit tests under the sanitizers; where they pass and all changes are in a commit, that
#                           commit goes into tests/checks/sanitized_clean.txt, from which --all counts
#   scripts/test.sh --long  what --all leaves out of the tests: all combinations of elements, materials, schemes, solvers and
#                           drivers where --all takes them by turns, and the drivers with sanitizers
#   scripts/test.sh --levels  all that depends on the width of vectors for the levels x86-64-v2, -v3 and -v4, with
#                           warnings as errors, and its unit tests where this processor has the level
#   scripts/test.sh --serial  the quick tests of programs without MPI: where the machine's PETSc and MPI are no pair
# CONTRIBUTING.md says how many minutes that takes on which kind of machine.
# Ends with ctest's summary; any failure ends it earlier or makes its exit code non-zero.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fail() {
  echo "test.sh: error: $*" >&2
  exit 1
}

sanitized_clean=tests/checks/sanitized_clean.txt
what=quick mpi=()
for argument in "$@"; do
  case "$argument" in
    --all | --sanitized | --long | --levels) what=${argument#--} ;;
    --serial) mpi=(-DFSI_MPI=OFF) ;;
    *) fail "unknown option '$argument'; those there are: --all, --sanitized, --long, --levels, --serial" ;;
  esac
done
[ "$what" = quick ] || [ ${#mpi[@]} -eq 0 ] || fail "--serial beside --$what: it is for the quick tests"

# Whether this machine's processor has a level, x86-64-v3 for one. Processors of other kinds have none.
has_level() { /lib64/ld-linux-x86-64.so.2 --help 2>/dev/null | grep -q "$1 (supported"; }

# build_level LEVEL TARGET
build_level() {
  echo "== $1"
  cmake --preset level -B "build/level/$1" -DFSI_ARCH="$1" -DFSI_WARNINGS_AS_ERRORS=ON
  cmake --build "build/level/$1" --target "$2"
}

# The commit that the sources are of; nothing where they are of none.
committed() { git diff --quiet HEAD 2>/dev/null && git rev-parse --short=8 HEAD; }

# sanitized_tests [--since FILE]: unit tests under the sanitizers; with FILE those that a change since its commit can change.
# By another compiler than the release build's: each warns of what the other does not.
sanitized_tests() {
  cmake --preset sanitize -DCMAKE_CXX_COMPILER=clang++ -DFSI_TESTS=ON -DFSI_WARNINGS_AS_ERRORS=ON
  local programs
  programs=$("${PYTHON:-python3}" -B tests/checks/sanitized_tests.py . build/sanitize "$@")
  [ -n "$programs" ] || { echo "No unit test's code has changed since they passed under the sanitizers: none is run"; return 0; }
  # shellcheck disable=SC2086  # words
  cmake --build --preset sanitize --target $programs
  run_tests build/sanitize -L '^unit$' -R ": (${programs//$'\n'/|})\$"
}

# Files that the sources' folder holds beside what git keeps. Building and testing leave it as it was.
strangers() {
  git rev-parse --is-inside-work-tree >/dev/null 2>&1 || return 0
  git ls-files --others --exclude '/build/' | sort
}

run_tests() { ctest --test-dir "$1" -j"$(nproc)" --output-on-failure --no-tests=error "${@:2}"; }

scripts/install_packages.sh --tests
before=$(strangers)

case "$what" in
all)
  echo "== unit tests with sanitizers, by clang, and without MPI, of what has changed"
  sanitized_tests --since "$sanitized_clean"

  # The release build below is for this machine's level; here the other one that counts. x86-64-v2 has had its turn.
  if has_level x86-64-v4; then build_level x86-64-v3 level_sources; elif has_level x86-64-v2; then build_level x86-64-v4 level_sources; fi

  echo "== all other tests, release build"
  cmake --preset release -DFSI_TESTS=ON -DFSI_TEST_CASES=OFF -DFSI_UNIT_TESTS=OFF -DFSI_WARNINGS_AS_ERRORS=ON
  cmake --build --preset release
  run_tests build/release
  ;;
sanitized)
  echo "== unit tests with sanitizers, by clang, and without MPI"
  state=$(committed) || true
  sanitized_tests
  if [ -n "$state" ] && [ "$state" = "$(committed)" ]; then
    rest=$(tail -n +2 "$sanitized_clean")
    printf '%s\n' "$state" "$rest" >"$sanitized_clean"
    echo "$sanitized_clean names this commit now; commit the file"
  fi
  ;;
long)
  echo "== drivers with sanitizers, by clang, and without MPI"
  cmake --preset sanitize -DCMAKE_CXX_COMPILER=clang++ -DFSI_TESTS=ON -DFSI_WARNINGS_AS_ERRORS=ON
  cmake --build --preset sanitize --target fsi-mesh fsi-monolithic fsi-partitioned fsi_with_settings
  run_tests build/sanitize -R '^partitions[.]WithoutMpi$'

  echo "== all combinations, release build"
  cmake --preset release -DFSI_TESTS=ON -DFSI_TEST_CASES=OFF -DFSI_UNIT_TESTS=OFF
  cmake --build --preset release
  FSI_LONG_TESTS=1 run_tests build/release -L '^turns$'
  ;;
levels)
  for level in x86-64-v2 x86-64-v3 x86-64-v4; do
    build_level "$level" level_tests
    if has_level "$level"; then run_tests "build/level/$level" -R '^(math|materials|fem|mesh_motion|derived): '; fi
  done
  ;;
quick)
  cmake --preset release "${mpi[@]}" -DFSI_TESTS=ON -DFSI_TEST_CASES=OFF -DFSI_UNIT_TESTS=ON \
    -DFSI_WARNINGS_AS_ERRORS=OFF
  cmake --build --preset release --target quick_tests
  run_tests build/release -L '^quick$'
  ;;
esac

after=$(strangers)
[ "$before" = "$after" ] || fail "the tests have left files in the sources: $(comm -13 <(echo "$before") <(echo "$after"))"
