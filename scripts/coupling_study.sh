#!/usr/bin/env bash
# The runs behind docs/coupling.md: passes per step of every coupling scheme at tolerance 1e-6, and how far each is from the
# monolithic solution at 1e-9. Finished runs are kept; delete results/coupling to start afresh.
#   scripts/coupling_study.sh [FOLDER WITH THE PROGRAMS [coarse|intermediate|fine]...]   default: build/release/bin coarse
# FSI_THREADS=1: with other work on the machine two threads wait for each other.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

programs=${1:-build/release/bin}
[ $# -gt 0 ] && shift
levels=("${@:-coarse}")
results=results/coupling
mkdir -p "$results"

# run NAME PROGRAM MATERIAL [OPTION...]: unless it is there already, finished or failed
run() {
  local name=$1 program=$2 material=$3
  shift 3
  if grep -qsE '"status": "(done|not converged)"' "$results/$name/summary.json"; then return; fi
  "$programs/$program" "meshes/artery/$material.toml" -o "$results/$name" -q --threads "${FSI_THREADS:-0}" --set output.every=0 \
    --set output.checkpoint_every=0 "$@" || echo "$name: exit code $?"
}

passes() {  # NAME: mean and range of the passes of a step
  awk -F, -v name="$1" 'NR > 1 { n++; sum += $3; if (n == 1 || $3 < least) least = $3; if ($3 > most) most = $3 }
    END { printf "%-52s %3d steps  %6.1f (%d-%d) passes\n", name, n, sum / n, least, most }' "$results/$1/coupling.csv"
}

materials=(neo-hookean mooney-rivlin artery)
for level in "${levels[@]}"; do
  case "$level" in
    coarse) end=12 times=1.5,3,4.5,6,7.5,9 schemes=(iqn-ils iqn-imvj robin-neumann robin-neumann-iqn robin-neumann-imvj aitken newton-krylov) ;;
    intermediate) end=3 times=1.5,3 schemes=(iqn-ils iqn-imvj robin-neumann robin-neumann-iqn robin-neumann-imvj aitken) ;;
    fine) end=1 schemes=(iqn-ils robin-neumann) materials=(neo-hookean) ;;
    *) echo "coupling_study.sh: error: no mesh level '$level'" >&2; exit 1 ;;
  esac
  for material in "${materials[@]}"; do
    for scheme in "${schemes[@]}"; do
      name=$level-$material-$scheme
      run "$name" fsi-partitioned "$material" --set mesh.level="$level" --set time.end=$end \
        --set partitioned.scheme="$scheme"
      passes "$name"
    done
    [ "$level" = fine ] && continue
    run "$level-$material-monolithic" fsi-monolithic "$material" --set mesh.level="$level" --set time.end=$end \
      --set monolithic.newton_tolerance=1e-10
    for scheme in "${schemes[@]}"; do
      run "$level-$material-$scheme-1e-9" fsi-partitioned "$material" --set mesh.level="$level" --set time.end=$end \
        --set partitioned.scheme="$scheme" --set partitioned.tolerance=1e-9
      "$programs/fsi-compare" pressure "$results/$level-$material-monolithic" \
        "$results/$level-$material-$scheme-1e-9" -o "$results/$level-$material-$scheme-agreement" --times "$times" \
        >"$results/$level-$material-$scheme-agreement.txt" || echo "$level-$material-$scheme: no agreement to show"
    done
  done
done | tee "$results/passes.txt"
