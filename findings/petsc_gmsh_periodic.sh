#!/usr/bin/env bash
# Periodic Surface of gmsh gives two surfaces the same triangles, and gmsh saves which nodes belong together. PETSc's DMPlex
# takes that as an order and glues the two: a vessel whose outlet was given the mesh of its inlet, to hand a profile from one to
# the other, becomes a ring without inlet and outlet. The triangles of both are inside the mesh, and each of them has the
# numbers of both in the label "Face Sets", so a condition by number finds its faces, which have blood on both sides. Nothing
# is said.
# -dm_plex_gmsh_periodic 0 leaves the mesh as it is; the default is to glue.
# A guess would be the mesh as saved, as of readers that skip the section, or that periodicity has to be asked for.
# Seen with PETSc 3.18.5 and gmsh 4.8.4 (Debian 12): a tube with 140 triangles on its wall, 15 on each end.
# Output seen: 79 vertices, boundary 140 triangles, none of outlet or inlet; not glued 92 vertices, boundary 170, 15 of each.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-petsc4py=3.18.5-1 gmsh=4.8.4+ds2-3
cat >"$scratch/12/root/vessel.geo" <<'END'
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 4, 1};
MeshSize{:} = 0.7;
Periodic Surface{2} = {3} Translate{0, 0, 4};
Physical Volume("blood", 1) = {1};
Physical Surface("wall", 1) = {1};
Physical Surface("outlet", 2) = {2};
Physical Surface("inlet", 3) = {3};
END
cat >"$scratch/12/root/read.py" <<'END'
from petsc4py import PETSc

for glue in (None, 0):
    if glue is not None:
        PETSc.Options()["dm_plex_gmsh_periodic"] = glue
    mesh = PETSc.DMPlex().createFromFile("/root/vessel.msh", comm=PETSc.COMM_SELF)
    first, end = mesh.getDepthStratum(0)
    faces = range(*mesh.getHeightStratum(1))
    numbers = {"wall": 1, "outlet": 2, "inlet": 3}
    sets = {name: set(mesh.getStratumIS("Face Sets", number).getIndices()) for name, number in numbers.items()}
    outside = {face for face in faces if mesh.getSupportSize(face) == 1}
    print("default:" if glue is None else f"periodic {glue}:", f"{end - first} vertices, boundary {len(outside)};",
          ", ".join(f"{name} {len(found & outside)} of {len(found)}" for name, found in sets.items()) +
          f"; outlet and inlet {len(sets['outlet'] & sets['inlet'])}")
END
within "$scratch/12" gmsh -v 2 -3 -o /root/vessel.msh /root/vessel.geo >"$scratch/log" 2>&1 ||
  fail "gmsh ends with $(cat "$scratch/log")"
within "$scratch/12" env PETSC_DIR=/usr/lib/petscdir/petsc3.18/x86_64-linux-gnu-real \
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 python3 /root/read.py >"$scratch/said" 2>"$scratch/log" ||
  fail "python ends with $(cat "$scratch/log")"
[ ! -s "$scratch/log" ] || fail "python says $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "what is on the boundary"
default: 79 vertices, boundary 140; wall 140 of 140, outlet 0 of 15, inlet 0 of 15; outlet and inlet 15
periodic 0: 92 vertices, boundary 170; wall 140 of 140, outlet 15 of 15, inlet 15 of 15; outlet and inlet 0
END
