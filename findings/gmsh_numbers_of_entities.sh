#!/usr/bin/env bash
# gmsh saves the elements of physical groups, but in Medit (.mesh) and Nastran (.bdf) files it numbers them by the curve or
# surface that they lie on, not by their group. Who wrote Physical Surface("blood", 9) finds no 9 in the file, and a number that
# a group and another surface share picks the wrong elements. Of the same mesh, legacy VTK files have the numbers of the groups.
# Nothing is said. Mesh.SaveElementTagType = 2 makes it the group everywhere; the default is 1.
# A guess would be that a format which has room for one number gets that of the group, or the same one whatever the format.
# Seen with gmsh 4.8.4 (Debian 12): a square, whose sides 1 and 3 are group 7, side 4 group 8, surface 1 group 9.
# Output seen, sides, then triangles: mesh and bdf 1 3 4 1 1 1 1; vtk 7 7 8 9 9 9 9; with the option all the latter.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" gmsh=4.8.4+ds2-3
cat >"$scratch/12/root/square.geo" <<'END'
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Physical Curve("wall", 7) = {1, 3};
Physical Curve("inlet", 8) = {4};
Physical Surface("blood", 9) = {1};
Mesh.MeshSizeMin = 1;
END
# numbers FORMAT OPTION...: those of the elements in the order of the file.
numbers() {
  local format=$1
  shift
  within "$scratch/12" gmsh -v 2 -2 "$@" -o "/root/square.$format" /root/square.geo >"$scratch/log" 2>&1 ||
    fail "gmsh ends with $(cat "$scratch/log")"
  [ ! -s "$scratch/log" ] || fail "gmsh says $(cat "$scratch/log")"
  # The last of a line of Medit's edges and triangles, the third of Nastran's, what VTK has for each cell.
  case $format in
    mesh) awk 'NF == 1 && /[A-Z]/ { section = $1 } NF > 1 && (section == "Edges" || section == "Triangles") { print $NF }' ;;
    bdf) awk '/^C/ { print $3 }' ;;
    vtk) awk 'cells { print } /LOOKUP_TABLE/ { cells = 1 }' ;;
  esac <"$scratch/12/root/square.$format" | xargs
}
for format in mesh bdf vtk; do
  echo "$format: $(numbers $format)"
  echo "$format, Mesh.SaveElementTagType = 2: $(numbers $format -setnumber Mesh.SaveElementTagType 2)"
done | tee "$scratch/said"
diff "$scratch/said" - <<'END' || fail "numbers of elements"
mesh: 1 3 4 1 1 1 1
mesh, Mesh.SaveElementTagType = 2: 7 7 8 9 9 9 9
bdf: 1 3 4 1 1 1 1
bdf, Mesh.SaveElementTagType = 2: 7 7 8 9 9 9 9
vtk: 7 7 8 9 9 9 9
vtk, Mesh.SaveElementTagType = 2: 7 7 8 9 9 9 9
END
