#!/usr/bin/env bash
# meshio does not put the nodes of second-order elements into the order of each format. Of gmsh's prisms of 18 nodes, as
# a boundary layer has them, eight of nine edges get the middle node of another edge. Hexahedra of 20 and 27 nodes come
# out right in VTU, and in Exodus with the middles of the upright edges and of the top exchanged. Corners are right, so
# the mesh looks well where a viewer draws straight edges, and elements are folded for whoever computes with their shape
# functions. Nothing is said. meshio reads its own files back as they were, so that check shows nothing. Tetrahedra of
# 10 nodes are right in both formats.
# A guess would be that a converter which renumbers hexahedra and tetrahedra does so with prisms, and for each format
# that has an order of its own.
# The same with meshio 5.0.0, gmsh 4.8.4, VTK 9.1.0 (Debian 12) and with 5.3.5, 4.13.1, 9.3.0 (Debian 13): a cube of
# straight elements, read by VTK. Counted are the edges whose middle node lies between their ends.
# Output seen: tetrahedra: VTU and Exodus 288 of 288; prisms: VTU 16 of 144, Exodus not supported; hexahedra of 20, and
# of 27 nodes: VTU 96 of 96, Exodus 32 of 96.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-meshio=7.0.0-3 python3-netcdf4=1.6.2-1+b1 gmsh=4.8.4+ds2-3 \
  python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
debian trixie "$scratch/13" python3-meshio=7.0.0-really-5.3.5-6+deb13u1 python3-netcdf4=1.7.2-1+b4 gmsh=4.13.1+ds1-6 \
  python3-vtk9=9.3.0+dfsg1-4+b1
for root in 12 13; do
  cat >"$scratch/$root/root/edges.py" <<'END'
import subprocess

import meshio
import numpy
from vtkmodules.vtkIOExodus import vtkExodusIIReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

SQUARE = """SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1};
Transfinite Curve{:} = 3;
Transfinite Surface{1};
"""
QUADS = "Recombine Surface{1};\n"
EXTRUDED = "Extrude {0, 0, 1} { Surface{1}; Layers{2}; RECOMBINE }\nPhysical Volume(1) = {1};\n"
LAYERS = EXTRUDED.replace("RECOMBINE", "Recombine;")
# The model, and whether nodes in the middle of faces are left out.
MODELS = {
    "tetra10": (SQUARE + EXTRUDED.replace("RECOMBINE", ""), 0),
    "wedge18": (SQUARE + LAYERS, 0),
    "hexahedron20": (SQUARE + QUADS + LAYERS, 1),
    "hexahedron27": (SQUARE + QUADS + LAYERS, 0),
}


def gmsh_mesh(kind):
    model, incomplete = MODELS[kind]
    with open("/root/cube.geo", "w") as file:
        file.write(model)
    options = ["-3", "-order", "2", "-v", "1", "-setnumber", "Mesh.SecondOrderIncomplete", str(incomplete)]
    subprocess.run(["gmsh", *options, "/root/cube.geo", "-o", "/root/cube.msh"], check=True)
    mesh = meshio.read("/root/cube.msh")
    return meshio.Mesh(mesh.points, [(block.type, block.data) for block in mesh.cells if block.type == kind])


def right_edges(reader, name):
    """How many edges have their third node in the middle, by VTK."""
    reader.SetFileName(name)
    reader.Update()
    grid = reader.GetOutputDataObject(0)
    while grid.IsA("vtkCompositeDataSet"):
        iterator = grid.NewIterator()
        iterator.InitTraversal()
        grid = iterator.GetCurrentDataObject()
    right = []
    for n in range(grid.GetNumberOfCells()):
        for k in range(grid.GetCell(n).GetNumberOfEdges()):
            points = grid.GetCell(n).GetEdge(k).GetPoints()
            start, end, middle = (numpy.array(points.GetPoint(i)) for i in range(3))
            right.append(abs(middle - (start + end) / 2).max() < 1e-6)
    return f"{sum(right)} of {len(right)}"


for kind in MODELS:
    mesh = gmsh_mesh(kind)
    for name, reader in (("/root/cube.vtu", vtkXMLUnstructuredGridReader()), ("/root/cube.exo", vtkExodusIIReader())):
        try:
            mesh.write(name)
        except KeyError as error:
            print(f"{kind} {name[-3:]}: KeyError {error}")
            continue
        again = meshio.read(name).cells
        same = len(again) == 1 and (again[0].data == mesh.cells[0].data).all()
        print(f"{kind} {name[-3:]}: {right_edges(reader, name)}, by meshio {'as it was' if same else 'changed'}")
END
  within "$scratch/$root" python3 /root/edges.py >"$scratch/$root/said" 2>"$scratch/log" ||
    fail "python ends with $(cat "$scratch/log")"
  grep . "$scratch/$root/said" >"$scratch/lines"
  cat "$scratch/lines"
  diff "$scratch/lines" - <<'END' || fail "the edges of Debian $root"
tetra10 vtu: 288 of 288, by meshio as it was
tetra10 exo: 288 of 288, by meshio as it was
wedge18 vtu: 16 of 144, by meshio as it was
wedge18 exo: KeyError 'wedge18'
hexahedron20 vtu: 96 of 96, by meshio as it was
hexahedron20 exo: 32 of 96, by meshio as it was
hexahedron27 vtu: 96 of 96, by meshio as it was
hexahedron27 exo: 32 of 96, by meshio as it was
END
done
