#!/usr/bin/env bash
# gmsh saves coordinates in Nastran files (.bdf) with as many digits as eight characters hold, and not evenly: a positive
# number is rounded, of a negative one the end is cut off, and its sign costs it one more decimal. A circle about the origin is
# no longer round: in metres, the radius 3.1475926 mm becomes 3.148 mm on one side and 3.14 mm on the other; below 1 mm three
# digits are left, of negative numbers two. Gmsh warns of nothing. Free fields (Mesh.BdfFieldFormat = 0), which have no such
# limit, are written with the same eight characters; large fields (2) have all digits. The default is small fields (1).
# A guess would be that coordinates keep their digits as in .msh, .inp or .unv files, or are at least rounded alike.
# Seen with gmsh 4.8.4 (Debian 12): points at x = 0.0031475926, -0.0031475926 and -0.00031475926.
# Output seen: small and free fields 0.003148, -0.00314, -3.1E-04; large fields 0.0031475926, -0.0031475926, -0.00031475926.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" gmsh=4.8.4+ds2-3
cat >"$scratch/12/root/lines.geo" <<'END'
r = 0.0031475926;
Point(1) = {r, 0, 0}; Point(2) = {-r, 0, 0}; Point(3) = {-r / 10, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3};
Mesh.MeshSizeMin = 1;
END
for format in 0 1 2; do
  within "$scratch/12" gmsh -v 2 -1 -setnumber Mesh.BdfFieldFormat "$format" -o "/root/$format.bdf" /root/lines.geo >"$scratch/log" 2>&1 ||
    fail "gmsh ends with $(cat "$scratch/log")"
  [ ! -s "$scratch/log" ] || fail "gmsh says $(cat "$scratch/log")"
  # The third field of GRID, without the number of the coordinate system: free, of eight characters, of sixteen.
  case $format in
    0) pattern='s/^GRID,[^,]*,[^,]*,\([^,]*\),.*/\1/p' ;;
    1) pattern='s/^GRID  .\{18\}\(.\{8\}\).*/\1/p' ;;
    2) pattern='s/^GRID\* .\{34\}\(.\{16\}\).*/\1/p' ;;
  esac
  echo "format $format:" "$(sed -n "$pattern" "$scratch/12/root/$format.bdf" | xargs)"
done | tee "$scratch/said"
diff "$scratch/said" - <<'END' || fail "digits of coordinates"
format 0: 0.003148 -0.00314 -3.1E-04
format 1: 0.003148 -0.00314 -3.1E-04
format 2: 0.0031475926 -0.0031475926 -0.00031475926
END
