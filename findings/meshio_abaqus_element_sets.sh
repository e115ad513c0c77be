#!/usr/bin/env bash
# The set that *ELEMENT, ELSET=NAME of an Abaqus deck names is given to other elements by meshio where a block of elements
# without a name comes before it, such as triangles of a surface. meshio lays the set of the n-th named block on the n-th of all
# blocks, so the names of wall and blood move up, and the last elements have none. A name of two blocks, as of tetrahedra and
# wedges, has the elements of the last of them in both, also numbers that the first one does not have. Nothing is said. Sets by
# *ELSET, with numbers, are read as meant.
# A guess would be the elements below the line, and those of all lines with the name, as Abaqus and CalculiX take them.
# The same in 5.0.0 (Debian 12) and 5.3.5 (Debian 13). Each block of the deck has one tetrahedron, the last of "twice" has two.
# Output seen, sets by blocks: WALL [[0], []] BLOOD [[], [0]]; below triangles WALL [[0], [], []] BLOOD [[], [0], []]; WALL
# twice [[0, 1], [], [0, 1]].
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-meshio=7.0.0-3
debian trixie "$scratch/13" python3-meshio=7.0.0-really-5.3.5-6+deb13u1
cat >"$scratch/named.inp" <<'END'
*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 0, 1, 0
4, 0, 0, 1
5, 1, 1, 1
*ELEMENT, TYPE=C3D4, ELSET=WALL
11, 1, 2, 3, 4
*ELEMENT, TYPE=C3D4, ELSET=BLOOD
21, 2, 3, 4, 5
END
# The same below two triangles that have no name.
sed '/C3D4, ELSET=WALL/i *ELEMENT, TYPE=S3\n1, 1, 3, 2\n2, 2, 3, 5' "$scratch/named.inp" >"$scratch/triangles.inp"
# The wall in two lines.
{
  cat "$scratch/named.inp"
  printf '%s\n' '*ELEMENT, TYPE=C3D4, ELSET=WALL' '31, 1, 3, 4, 5' '32, 1, 2, 4, 5'
} >"$scratch/twice.inp"
cat >"$scratch/sets.py" <<'END'
import meshio

for name in ("named", "triangles", "twice"):
    mesh = meshio.read(f"/root/{name}.inp")
    blocks = [f"{len(block.data)} {block.type}" for block in mesh.cells]
    sets = [f"{key} {[list(map(int, part)) for part in parts]}" for key, parts in mesh.cell_sets.items()]
    print(f"{name}: {', '.join(blocks)};", *sets)
END
for version in 12 13; do
  cp "$scratch"/*.inp "$scratch/sets.py" "$scratch/$version/root/"
  within "$scratch/$version" python3 /root/sets.py >"$scratch/said$version" 2>"$scratch/log" ||
    fail "python ends with $(cat "$scratch/log")"
  cat "$scratch/said$version"
  diff "$scratch/said$version" - <<'END' || fail "sets in Debian $version"
named: 1 tetra, 1 tetra; WALL [[0], []] BLOOD [[], [0]]
triangles: 2 triangle, 1 tetra, 1 tetra; WALL [[0], [], []] BLOOD [[], [0], []]
twice: 1 tetra, 1 tetra, 2 tetra; WALL [[0, 1], [], [0, 1]] BLOOD [[], [0], []]
END
done
