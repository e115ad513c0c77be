#!/usr/bin/env bash
# The runs behind docs/guide/solvers.md: single Newton systems by every linear solver (the paper's Tables 3 to 5), stress
# cases, whole runs. Finished runs are kept; delete results/solvers to start afresh. On two cores about an hour and a
# quarter, most of it the paper's methods on the fine mesh.
#   scripts/solver_study.sh [FOLDER WITH THE PROGRAMS]      default: build/release/bin
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fail() {
  echo "solver_study.sh: error: $*" >&2
  exit 1
}

[ $# -le 1 ] || fail "$# arguments; give the folder with the programs, or nothing"
programs=${1:-build/release/bin}
for program in fsi-monolithic fsi-linear-study fsi-compare; do
  [ -x "$programs/$program" ] || fail "$programs: there is no $program in it; build first, or give another folder"
done
results=results/solvers
mkdir -p "$results"

exact=diagonal_exact,lower_exact,upper_exact,ssor_exact,ilu_exact
too_large=fine:direct
for method in ${exact//,/ }; do too_large+=",fine:$method"; done

# What does not converge is a result too: exit code 2 goes on.
solvers() { "$programs/fsi-compare" solvers "$@" || [ $? -eq 2 ]; }
solvers -o "$results/tables" --without "$too_large" >"$results/tables.txt"
solvers -o "$results/sub-problems" --sub-problems --methods fast --materials neo-hookean --systems 1:1 \
  >"$results/sub-problems.txt"
solvers -o "$results/stress" --stress --set linear.direct_below=0 >"$results/stress.txt"

# run NAME [OPTION...]: a run of the neo-Hookean artery, unless it is there already
run() {
  local name=$1
  shift
  if grep -qs '"status": "done"' "$results/$name/summary.json"; then return; fi
  echo "== $name"
  "$programs/fsi-monolithic" meshes/artery/neo-hookean.toml -o "$results/$name" --force -q "$@"
}
# The best of the paper's methods on the larger meshes: the first steps, from which the whole run follows.
for level in coarse intermediate fine; do
  run "$level-fast" --set mesh.level=$level
done
run coarse-direct --set monolithic.linear_solver=direct
run intermediate-direct --set mesh.level=intermediate --set monolithic.linear_solver=direct
run coarse-amg_fgmres --set monolithic.linear_solver=amg_fgmres
run intermediate-amg_fgmres --set mesh.level=intermediate --set monolithic.linear_solver=amg_fgmres --set time.end=3
run fine-amg_fgmres --set mesh.level=fine --set monolithic.linear_solver=amg_fgmres --set time.end=0.5
# The peer's setting (tolerance 1e-6), one and two threads.
for threads in 1 2; do
  run "peer-$threads" --set mesh.level=intermediate --set newton.tolerance=1e-6 --threads $threads
done

runs=()
for name in {coarse,intermediate,fine}-{fast,direct,amg_fgmres} peer-1 peer-2; do
  [ -d "$results/$name" ] && runs+=("$results/$name")
done
"$programs/fsi-compare" cost "${runs[@]}" -o "$results/cost" | tee "$results/cost.txt"
echo "Tables: $results/*.txt, $results/tables/solvers.md, $results/stress/stress.md"
