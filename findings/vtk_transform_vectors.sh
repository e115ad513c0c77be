#!/usr/bin/env bash
# A grid that VTK brings from mm to m may have another velocity. vtkTransformFilter and vtkTransformPolyDataFilter multiply
# vectors by the matrix of the transform, its scale included: 0.001 of the coordinates is 0.001 of the velocity. They do so
# with one array, the active vectors, and leave the others as they are. Which one is active is said by Vectors="velocity" in
# the file; without these words no array is changed, and when the grid is turned none is turned. ParaView's filter Transform
# changes all arrays of three components: velocity and displacement are both scaled. A stress tensor of nine components is
# turned by none of the three, even where it is the active one (Tensors="stress"). Nothing is said.
# A guess would be that a scale is for the coordinates alone, and that a rotation turns all vectors and tensors, or none.
# Seen with ParaView 5.11.0 and the VTK that it brings (Debian 12): one tetrahedron, velocity and displacement (1, 0, 0),
# stress xx = 1; scaled by 0.001, and turned by 90 degrees about z, after which yy would be 1 and xx 0.
# Output seen, velocity, displacement: scaled: velocity active 0.001, 1; not 1, 1; ParaView 0.001, 0.001; turned: velocity
# active (0, 1, 0), (1, 0, 0); not (1, 0, 0) both; ParaView (0, 1, 0) both. Stress xx = 1, yy = 0 in all.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-paraview=5.11.0+dfsg-1+b1
cat >"$scratch/12/root/transform.py" <<'END'
import paraview.simple
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkTransformFilter, vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


def array(values, name, components=1, kind="Float64"):
    return f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">{values}</DataArray>'


def read(name, active):
    fields = array("1 0 0 " * 4, "velocity", 3) + array("1 0 0 " * 4, "displacement", 3)
    fields += array("1 0 0 0 0 0 0 0 0 " * 4, "stress", 9)
    points = array("0 0 0 1 0 0 0 1 0 0 0 1", "points", 3)
    cells = array("0 1 2 3", "connectivity", kind="Int64")
    cells += array(4, "offsets", kind="Int64") + array(10, "types", kind="UInt8")
    with open(name, "w") as file:
        file.write('<VTKFile type="UnstructuredGrid" version="1.0"><UnstructuredGrid>'
                   '<Piece NumberOfPoints="4" NumberOfCells="1">'
                   f"<PointData {active}>{fields}</PointData><Points>{points}</Points><Cells>{cells}</Cells>"
                   "</Piece></UnstructuredGrid></VTKFile>")
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(name)
    reader.Update()
    return reader


def show(name, grid):
    values = [grid.GetPointData().GetArray(field).GetTuple(1) for field in ("velocity", "displacement", "stress")]
    velocity, displacement, stress = ([round(number, 6) + 0.0 for number in value] for value in values)
    point = [round(number, 6) + 0.0 for number in grid.GetPoint(1)]
    print(f"  {name}: point {point}, velocity {velocity}, displacement {displacement}, xx {stress[0]}, yy {stress[4]}")


def moved(filter, reader, transform):
    filter.SetInputConnection(reader.GetOutputPort())
    filter.SetTransform(transform)
    filter.Update()
    return filter.GetOutput()


for scale, angle in ((0.001, 0), (1, 90)):
    print(f"scaled by {scale}, turned by {angle}")
    transform = vtkTransform()
    transform.Scale(scale, scale, scale)
    transform.RotateZ(angle)
    for name, active in (("active", 'Vectors="velocity" Tensors="stress"'), ("not", "")):
        reader = read(f"/root/{name}.vtu", active)
        show(name, moved(vtkTransformFilter(), reader, transform))
        surface = vtkGeometryFilter()
        surface.SetInputConnection(reader.GetOutputPort())
        show(f"{name}, surface", moved(vtkTransformPolyDataFilter(), surface, transform))
        filter = paraview.simple.Transform(Input=paraview.simple.OpenDataFile(f"/root/{name}.vtu"))
        filter.Transform.Scale = [scale] * 3
        filter.Transform.Rotate = [0, 0, angle]
        show(f"{name}, ParaView", paraview.servermanager.Fetch(filter))
END
within "$scratch/12" python3 /root/transform.py >"$scratch/said" 2>"$scratch/log" ||
  fail "python ends with $(cat "$scratch/log")"
[[ ! -s $scratch/log ]] || fail "a warning: $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "vectors"
scaled by 0.001, turned by 0
  active: point [0.001, 0.0, 0.0], velocity [0.001, 0.0, 0.0], displacement [1.0, 0.0, 0.0], xx 1.0, yy 0.0
  active, surface: point [0.001, 0.0, 0.0], velocity [0.001, 0.0, 0.0], displacement [1.0, 0.0, 0.0], xx 1.0, yy 0.0
  active, ParaView: point [0.001, 0.0, 0.0], velocity [0.001, 0.0, 0.0], displacement [0.001, 0.0, 0.0], xx 1.0, yy 0.0
  not: point [0.001, 0.0, 0.0], velocity [1.0, 0.0, 0.0], displacement [1.0, 0.0, 0.0], xx 1.0, yy 0.0
  not, surface: point [0.001, 0.0, 0.0], velocity [1.0, 0.0, 0.0], displacement [1.0, 0.0, 0.0], xx 1.0, yy 0.0
  not, ParaView: point [0.001, 0.0, 0.0], velocity [0.001, 0.0, 0.0], displacement [0.001, 0.0, 0.0], xx 1.0, yy 0.0
scaled by 1, turned by 90
  active: point [0.0, 1.0, 0.0], velocity [0.0, 1.0, 0.0], displacement [1.0, 0.0, 0.0], xx 1.0, yy 0.0
  active, surface: point [0.0, 1.0, 0.0], velocity [0.0, 1.0, 0.0], displacement [1.0, 0.0, 0.0], xx 1.0, yy 0.0
  active, ParaView: point [0.0, 1.0, 0.0], velocity [0.0, 1.0, 0.0], displacement [0.0, 1.0, 0.0], xx 1.0, yy 0.0
  not: point [0.0, 1.0, 0.0], velocity [1.0, 0.0, 0.0], displacement [1.0, 0.0, 0.0], xx 1.0, yy 0.0
  not, surface: point [0.0, 1.0, 0.0], velocity [1.0, 0.0, 0.0], displacement [1.0, 0.0, 0.0], xx 1.0, yy 0.0
  not, ParaView: point [0.0, 1.0, 0.0], velocity [0.0, 1.0, 0.0], displacement [0.0, 1.0, 0.0], xx 1.0, yy 0.0
END
