#!/usr/bin/env bash
# gmsh leaves out the kinds of elements that its writer of a format does not know, and says nothing: pyramids in Abaqus decks
# (.inp) and in Universal files (.unv), pyramids and prisms in Medit files (.mesh), although that format has both. Where a wall
# of hexahedra meets a lumen of tetrahedra gmsh puts pyramids between them, so the saved mesh has holes along the interface. In
# Medit files, which FreeFEM and mmg read, whole boundary layers of prisms are gone. Nastran (.bdf) and legacy VTK files have
# all elements.
# A guess would be that what was meshed is saved, or that an element which a format cannot hold is reported.
# Seen with gmsh 4.8.4 (Debian 12): a cube of 8 hexahedra below one of tetrahedra, 4 pyramids between; a layer of 8 prisms.
# Output seen, cubes: .inp and .unv 72 tetrahedra, 8 hexahedra; .mesh the same; .msh, .bdf and .vtk 4 pyramids as well; layer:
# .mesh nothing, all others 8 prisms.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" gmsh=4.8.4+ds2-3
cat >"$scratch/12/root/cubes.geo" <<'END'
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {0, 0, 1, 1, 1, 1};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Transfinite Curve{:} = 3;
Transfinite Surface{:};
Recombine Surface{1:6};
Transfinite Volume{1};
Physical Volume("all") = {1, 2};
END
cat >"$scratch/12/root/layer.geo" <<'END'
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1};
Transfinite Curve{:} = 3;
Transfinite Surface{1};
Extrude {0, 0, 1} { Surface{1}; Layers{1}; Recombine; }
Physical Volume("all") = {1};
END
# elements FORMAT: the word or number by which a file of that format, read from stdin, calls each of its elements.
elements() {
  case $1 in
    msh2) awk '/^\$Elements/ { inside = 1 } inside && NF > 5 { print $2 }' ;;
    inp) awk '/^\*/ { word = ""; if (match($0, /type=[A-Z0-9]+/)) word = substr($0, RSTART + 5, RLENGTH - 5); next }
              word != "" { print word }' ;;
    unv) awk '/^ +2412$/ { inside = 1; next } /^ +-1$/ { inside = 0 }
              inside && nodes > 0 { nodes -= NF; next } inside { print $2; nodes = $6 }' ;;
    mesh) awk '/^ ?(Tetrahedra|Hexahedra|Prisms|Pyramids)/ { word = $1; getline; for (n = $1; n > 0; --n) print word }' ;;
    bdf) grep -oE '^C[A-Z]+[0-9]*' || true ;;
    vtk) awk '/^CELL_TYPES/ { inside = 1; next } /^CELL_DATA/ { inside = 0 } inside && NF { print $1 }' ;;
  esac
}
for name in cubes layer; do
  for format in msh2 inp unv mesh bdf vtk; do
    within "$scratch/12" gmsh -3 -format $format -o "/root/$name.$format" "/root/$name.geo" >"$scratch/log" 2>&1 ||
      fail "gmsh ends with $(cat "$scratch/log")"
    ! grep -i warning "$scratch/log" || fail "gmsh warns"
    elements $format <"$scratch/12/root/$name.$format" | sort | uniq -c | xargs echo "$name.$format:"
  done
done | tee "$scratch/said"
# In .msh 4, 5, 6, 7, in VTK 10, 12, 13, 14, in .unv 111, 115, 112 stand for tetrahedron, hexahedron, prism, pyramid.
diff "$scratch/said" - <<'END' || fail "elements of the files"
cubes.msh2: 72 4 8 5 4 7
cubes.inp: 72 C3D4 8 C3D8
cubes.unv: 72 111 8 115
cubes.mesh: 8 Hexahedra 72 Tetrahedra
cubes.bdf: 8 CHEXA 4 CPYRAM 72 CTETRA
cubes.vtk: 72 10 8 12 4 14
layer.msh2: 8 6
layer.inp: 8 C3D6
layer.unv: 8 112
layer.mesh:
layer.bdf: 8 CPENTA
layer.vtk: 8 13
END
