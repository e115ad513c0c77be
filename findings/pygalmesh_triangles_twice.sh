#!/usr/bin/env bash
# pygalmesh gives each boundary triangle of a meshed segmentation twice. Between two labels it is there with the number of the
# one and of the other; on the outside both times with the same number. Areas, and integrals over the wall such as of a
# traction, come out doubled. That is how CGAL's output_to_medit, whose file pygalmesh reads, writes a mesh without
# show_patches. Each tetrahedron is there once.
# A guess would be one triangle for each piece of surface, or two, for its two sides, between labels alone.
# Seen with pygalmesh 0.10.6 (Debian 12): a lumen of label 1 within a wall of label 2, cut off at both ends.
# Output seen, numbers of the triangles of one place: outside (1, 1) and (2, 2), between (1, 2); of a tetrahedron (1) or (2).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-pygalmesh=0.10.6-1+b3
cat >"$scratch/12/root/vessel.py" <<'END'
import numpy, pygalmesh

across = numpy.arange(24) - 11.5
radius = numpy.hypot(across[:, None], across[None, :])
labels = numpy.zeros((24, 24, 24), dtype=numpy.uint8)
labels[radius < 8, 3:-3] = 2
labels[radius < 5, 3:-3] = 1
mesh = pygalmesh.generate_from_array(labels, [1.0, 1.0, 1.0], max_facet_distance=0.5, max_cell_circumradius=3.0,
                                     verbose=False)
for block, numbers in zip(mesh.cells, mesh.cell_data["medit:ref"]):
    places = {}
    for cell, number in zip(block.data, numbers):
        places.setdefault(tuple(sorted(cell)), []).append(int(number))
    kinds = sorted({tuple(sorted(place)) for place in places.values()})
    print(f"{block.type}: numbers of one place", ", ".join(f"({', '.join(map(str, kind))})" for kind in kinds))
END
within "$scratch/12" python3 /root/vessel.py >"$scratch/said" 2>"$scratch/log" ||
  fail "python ends with $(tail -1 "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "how often a cell is there"
triangle: numbers of one place (1, 1), (1, 2), (2, 2)
tetra: numbers of one place (1), (2)
END
