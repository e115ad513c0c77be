#!/usr/bin/env bash
# From a fresh clone to reports. Builds the monolithic driver for the one element that this takes, runs the paper's
# neo-Hookean artery on the coarse mesh and reports on that run. Then builds all programs for all elements, runs the same
# case by the partitioned driver, compares the pressure waves, and makes the short form of the paper's study: three
# materials, the paper's tables and figures beside ours. May be run again; it replaces its own results only.
#   scripts/quickstart.sh --serial   programs without MPI, for one process: where the machine's PETSc and MPI are no pair
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=build/release # where README's next commands look
results=results/quickstart
case_file=meshes/artery/neo-hookean.toml

mpi=() # as the build folder has it, otherwise with MPI
for argument in "$@"; do
  if [ "$argument" != --serial ]; then
    echo "quickstart.sh: error: unknown option '$argument'; the only one is --serial" >&2
    exit 1
  fi
  mpi=(-DFSI_MPI=OFF)
done

stages=()
stage() {
  local name=$1 start=$EPOCHREALTIME
  shift
  echo "== $name"
  "$@"
  local end=$EPOCHREALTIME
  # EPOCHREALTIME has microseconds behind a point or a comma, as the locale wants it
  local ms=$(((${end/[.,]/} - ${start/[.,]/}) / 1000))
  stages+=("$(printf '%-24s %6d.%d s' "$name" $((ms / 1000)) $((ms % 1000 / 100)))")
}

# build_programs [-DFSI_...] NAME...: these only. A folder that scripts/test.sh has configured keeps its tests; a new one
# does without the packages that they need.
build_programs() {
  local options=()
  [ -f "$build/CMakeCache.txt" ] || options=(-DFSI_TESTS=OFF)
  if [[ "$1" == -D* ]]; then
    options+=("$1")
    shift
  fi
  cmake --preset release "${mpi[@]}" "${options[@]}"
  cmake --build "$build" --target "$@"
}

first_element=() # a folder with programs has all elements already, or most of them
[ -x "$build/bin/fsi-monolithic" ] || first_element=(-DFSI_FIRST_ELEMENT=ON)

rm -rf "$results"
mkdir -p "$results"
stage "packages" scripts/install_packages.sh
stage "build, one element" build_programs "${first_element[@]}" fsi-monolithic
stage "monolithic run" "$build/bin/fsi-monolithic" "$case_file" -o "$results/monolithic"
stage "report" "$build/bin/fsi-compare" report "$results/monolithic" -o "$results/report"
echo
echo "The first report: $PWD/$results/report/report.html. All elements, the other driver and the paper's study follow."
echo
stage "build, all elements" build_programs fsi-mesh fsi-monolithic fsi-partitioned fsi-linear-study
stage "partitioned run" "$build/bin/fsi-partitioned" "$case_file" -o "$results/partitioned"
stage "comparison" "$build/bin/fsi-compare" pressure "$results/monolithic" "$results/partitioned" -o "$results/compare"
stage "study of the paper" "$build/bin/fsi-compare" study paper --quick -o "$results/paper"

echo
printf '%s\n' "${stages[@]}"
echo
echo "Pressure along the centre line from both drivers: $PWD/$results/compare/pressure_waves.png"
echo "Open $PWD/$results/paper/report.html: the paper's tables, figures and claims beside ours."
