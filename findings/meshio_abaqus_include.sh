#!/usr/bin/env bash
# meshio knows *INCLUDE of Abaqus decks, and reads the included file as a mesh of its own: nodes in one file and elements in
# another, as decks of preCICE's tutorials and of CalculiX have them, do not meet. It writes "Expected NODE before ELEMENT", which
# blames a deck that is right, and ends the program by SystemExit, which `except Exception` does not catch.
# The same in 5.0.0 (Debian 12) and 5.3.5 (Debian 13), whichever of the two is the file that is included.
# Output seen, of both versions: the deck in one file is 1 tetra; in two files it is SystemExit 1.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-meshio=7.0.0-3
debian trixie "$scratch/13" python3-meshio=7.0.0-really-5.3.5-6+deb13u1

mkdir "$scratch/decks"
printf '*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n' >"$scratch/decks/nodes.inp"
printf '*ELEMENT, TYPE=C3D4, ELSET=all\n1, 1, 2, 3, 4\n' >"$scratch/decks/elements.inp"
cat "$scratch/decks/nodes.inp" "$scratch/decks/elements.inp" >"$scratch/decks/whole.inp"
{ printf '*INCLUDE, INPUT=nodes.inp\n' && cat "$scratch/decks/elements.inp"; } >"$scratch/decks/nodes-included.inp"
{ cat "$scratch/decks/nodes.inp" && printf '*INCLUDE, INPUT=elements.inp\n'; } >"$scratch/decks/elements-included.inp"
cat >"$scratch/decks/read.py" <<'END'
import meshio
for name in ("whole", "nodes-included", "elements-included"):
    try:
        cells = meshio.read(f"/root/decks/{name}.inp").cells
        said = " ".join(f"{len(block.data)} {block.type}" for block in cells)
    except BaseException as error:
        said = f"{type(error).__name__} {error}"
    print(f"{name}: {said}")
END
for version in 12 13; do
  cp -r "$scratch/decks" "$scratch/$version/root/"
  said=$(within "$scratch/$version" python3 /root/decks/read.py 2>/dev/null | grep -E '^(whole|nodes-included|elements-included): ')
  echo "$said"
  [ "$said" = $'whole: 1 tetra\nnodes-included: SystemExit 1\nelements-included: SystemExit 1' ] || fail "$said"
done
