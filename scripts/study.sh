#!/usr/bin/env bash
# The runs behind docs/evidence/evidence.md: three materials, both drivers, coarse and intermediate mesh. About half an hour on two
# cores. Finished runs are kept; delete results/study to start afresh.
#   scripts/study.sh [FOLDER WITH THE PROGRAMS]      default: build/release/bin
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fail() {
  echo "study.sh: error: $*" >&2
  exit 1
}

[ $# -le 1 ] || fail "$# arguments; give the folder with the programs, or nothing"
programs=${1:-build/release/bin}
for program in fsi-monolithic fsi-partitioned fsi-compare; do
  [ -x "$programs/$program" ] || fail "$programs: there is no $program in it; build first, or give another folder"
done
results=results/study
mkdir -p "$results"

# run NAME PROGRAM CASE [OPTION...]: unless that run is there already
run() {
  local name=$1 program=$2 case_name=$3
  shift 3
  if grep -qs '"status": "done"' "$results/$name/summary.json"; then return; fi
  echo "== $name"
  "$programs/$program" "meshes/artery/$case_name.toml" -o "$results/$name" --force -q "$@"
}

materials=(neo-hookean mooney-rivlin artery)
for material in "${materials[@]}"; do
  run "coarse-$material-monolithic" fsi-monolithic "$material"
  run "coarse-$material-full" fsi-monolithic "$material" --set newton.mode=full
  run "coarse-$material-partitioned" fsi-partitioned "$material" --set partitioned.scheme=aitken \
    --set partitioned.tolerance=1e-9
  run "intermediate-$material-monolithic" fsi-monolithic "$material" --set mesh.level=intermediate
done
run intermediate-neo-hookean-full fsi-monolithic neo-hookean --set mesh.level=intermediate --set newton.mode=full \
  --set time.end=1.5
for tolerance in 1e-2 1e-3 1e-6; do
  run "coarse-neo-hookean-partitioned-$tolerance" fsi-partitioned neo-hookean --set partitioned.scheme=aitken \
    --set partitioned.tolerance=$tolerance
done

compare() {
  local name=$1
  shift
  "$programs/fsi-compare" pressure "$@" -o "$results/$name" >"$results/$name.txt"
}
for material in "${materials[@]}"; do
  compare "drivers-$material" "$results/coarse-$material-monolithic" "$results/coarse-$material-partitioned" \
    --labels monolithic,partitioned
done
compare loose-tolerance "$results/coarse-neo-hookean-monolithic" "$results/coarse-neo-hookean-partitioned-1e-2" \
  "$results/coarse-neo-hookean-partitioned-1e-3" --labels "monolithic,partitioned 1e-2,partitioned 1e-3"
for level in coarse intermediate; do
  compare "materials-$level" "$results/$level-neo-hookean-monolithic" "$results/$level-mooney-rivlin-monolithic" \
    "$results/$level-artery-monolithic" --labels neo-Hookean,Mooney-Rivlin,artery
done

# Reference for the mesh error: the axisymmetric twins on a fine grid at the same step, by the same weak forms.
run coarse-neo-hookean-weak-stabilisation fsi-monolithic neo-hookean --set structure.stabilisation=0.05
run intermediate-neo-hookean-weak-stabilisation fsi-monolithic neo-hookean --set structure.stabilisation=0.05 \
  --set mesh.level=intermediate
for material in "${materials[@]}"; do
  run "axisymmetric-$material" fsi-monolithic "axisymmetric/$material" --set mesh.error=0.2%
  "$programs/fsi-compare" accuracy "$results/axisymmetric-$material" --times 1.5,3,4.5,6,7.5,9 \
    -o "$results/accuracy-$material" "$results"/{coarse,intermediate}-"$material"-monolithic \
    $(ls -d "$results"/{coarse,intermediate}-"$material"-weak-stabilisation 2>/dev/null)
done | tee "$results/reference-errors.txt"

for material in "${materials[@]}"; do
  for run in coarse-$material-full coarse-$material-monolithic coarse-$material-partitioned; do
    awk -F, -v name="$run" 'NR > 1 { n++; outer += $3; newton += $4; s += $6; if ($3 > most_outer) most_outer = $3; if ($4 > most_newton) most_newton = $4 }
      END { printf "%-36s %3d steps  coupling mean %5.1f most %3d  Newton mean %6.1f most %4d  %7.1f s\n", name, n, outer / n, most_outer, newton / n, most_newton, s }' \
      "$results/$run/iterations.csv"
  done
done | tee "$results/iterations.txt"
echo "Tables and pictures: $results/*.txt, $results/*/pressure_waves.png"
