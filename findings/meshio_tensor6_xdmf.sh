#!/usr/bin/env bash
# A symmetric tensor of six components that went from a VTU file to an XDMF file by meshio is another tensor in VTK and
# ParaView. VTK has the order xx, yy, zz, xy, yz, xz. meshio leaves the numbers as they are and calls them Tensor6, whose order
# is xx, xy, xz, yy, yz, zz, and so VTK's reader of XDMF takes them, which makes nine components of the six. The second normal
# stress becomes a shear stress; even the trace changes, and with it the pressure. meshio reads its own file back as it was, so
# a look at it by meshio shows nothing.
# A guess would be that both formats have one order, or that a converter which knows Tensor6 puts the numbers into its order.
# Seen with meshio 5.0.0 and ParaView 5.11.0 (Debian 12): one tetrahedron, xx 1, yy 2, zz 3, xy 12, yz 23, xz 13.
# Output seen, rows of the tensor: VTU 1 12 13, 12 2 23, 13 23 3, trace 6; XDMF 1 2 3, 2 12 23, 3 23 13, trace 26; by meshio
# 1 2 3 12 23 13.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-meshio=7.0.0-3 python3-h5py=3.7.0-8 python3-paraview=5.11.0+dfsg-1+b1
cat >"$scratch/12/root/tensor.py" <<'END'
import meshio
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkTensorGlyph
from vtkmodules.vtkIOXdmf2 import vtkXdmfReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter


def as_vtk_takes_it(reader, name):
    """The rows of the tensor by which VTK stretches its glyphs: those of the unit vectors, at the first node, which is 0."""
    reader.SetFileName(name)
    reader.Update()
    grid = reader.GetOutputDataObject(0)
    grid.GetPointData().SetActiveTensors("stress")
    units, vertices, source = vtkPoints(), vtkCellArray(), vtkPolyData()
    for unit in ((1, 0, 0), (0, 1, 0), (0, 0, 1)):
        vertices.InsertNextCell(1, [units.InsertNextPoint(unit)])
    source.SetPoints(units)
    source.SetVerts(vertices)
    glyph = vtkTensorGlyph()
    glyph.SetInputData(grid)
    glyph.SetSourceData(source)
    glyph.ExtractEigenvaluesOff()
    glyph.ColorGlyphsOff()
    glyph.Update()
    rows = [glyph.GetOutput().GetPoint(n) for n in range(3)]
    return f"{', '.join(' '.join(f'{x:g}' for x in row) for row in rows)}; trace {rows[0][0] + rows[1][1] + rows[2][2]:g}"


# VTK itself writes the file that meshio converts.
points, grid, stress, writer = vtkPoints(), vtkUnstructuredGrid(), vtkDoubleArray(), vtkXMLUnstructuredGridWriter()
stress.SetName("stress")
stress.SetNumberOfComponents(6)
for point in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)):
    points.InsertNextPoint(point)
    stress.InsertNextTuple((1, 2, 3, 12, 23, 13))
grid.SetPoints(points)
grid.InsertNextCell(VTK_TETRA, 4, [0, 1, 2, 3])
grid.GetPointData().AddArray(stress)
writer.SetInputData(grid)
writer.SetFileName("/root/one.vtu")
writer.Write()
meshio.read("/root/one.vtu").write("/root/one.xdmf")
print("VTU by VTK:", as_vtk_takes_it(vtkXMLUnstructuredGridReader(), "/root/one.vtu"))
print("XDMF by VTK:", as_vtk_takes_it(vtkXdmfReader(), "/root/one.xdmf"))
print("XDMF by meshio:", *(f"{value:g}" for value in meshio.read("/root/one.xdmf").point_data["stress"][0]))
END
within "$scratch/12" python3 -W ignore /root/tensor.py >"$scratch/said" 2>"$scratch/log" ||
  fail "python ends with $(cat "$scratch/log")"
[ ! -s "$scratch/log" ] || fail "python says $(cat "$scratch/log")"
grep -o 'AttributeType="[^"]*"' "$scratch/12/root/one.xdmf" >>"$scratch/said"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "the tensor"
VTU by VTK: 1 12 13, 12 2 23, 13 23 3; trace 6
XDMF by VTK: 1 2 3, 2 12 23, 3 23 13; trace 26
XDMF by meshio: 1 2 3 12 23 13
AttributeType="Tensor6"
END
