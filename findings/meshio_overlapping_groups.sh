#!/usr/bin/env bash
# gmsh writes an entity into as many physical groups as it belongs to. meshio 5.0.0 (Debian 12) reads both groups of such a
# surface as cell_sets, while its array gmsh:physical holds the first one alone. Written again as .msh the second group keeps its
# name and loses its cells; in VTU one array for all sets holds the last set's number. A reader that trusts gmsh:physical, or a
# file that went through meshio, has the group empty, without an error: read groups from cell_sets, and from gmsh's own file.
# Output seen: read: physical [1], sets wall [0], monitored [0]; msh again: wall [0], monitored []; VTU: one array, [1].
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-meshio=7.0.0-3
cat >"$scratch/12/root/two.msh" <<'END'
$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
2 1 "wall"
2 2 "monitored"
$EndPhysicalNames
$Entities
0 0 1 0
1 0 0 0 1 1 0 2 1 2 0
$EndEntities
$Nodes
1 3 1 3
2 1 0 3
1
2
3
0 0 0
1 0 0
0 1 0
$EndNodes
$Elements
1 1 1 1
2 1 2 1
1 1 2 3
$EndElements
END
cat >"$scratch/12/root/groups.py" <<'END'
import meshio


def sets(mesh):
    return {name: mesh.cell_sets[name][0].astype(int).tolist() for name in ("wall", "monitored")}


first = meshio.read("/root/two.msh")
print("read: physical", first.cell_data["gmsh:physical"][0].tolist(), sets(first))
first.write("/root/again.msh", file_format="gmsh")
print("msh again:", sets(meshio.read("/root/again.msh")))
first = meshio.read("/root/two.msh")
first.write("/root/again.vtu")
again = meshio.read("/root/again.vtu")
print("vtu:", {name: data[0].tolist() for name, data in again.cell_data.items() if not name.startswith("gmsh:")})
END
within "$scratch/12" python3 /root/groups.py >"$scratch/said" 2>"$scratch/log" || fail "python ends with $(cat "$scratch/log")"
grep -v '^ *$' "$scratch/said" | tee "$scratch/lines"
diff "$scratch/lines" - <<'END' || fail "what is read, or written, of the second group"
read: physical [1] {'wall': [0], 'monitored': [0]}
msh again: {'wall': [0], 'monitored': []}
vtu: {'wall-monitored-gmsh:bounding_entities': [1]}
END
