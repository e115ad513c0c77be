#!/usr/bin/env bash
# A grid of tetrahedra that holds the triangles of its boundary as well, as gmsh and meshio write it, has other gradients at the
# wall than the same grid without them. vtkGradientFilter takes the mean over all cells of a point, also those of lower
# dimension, and a triangle of the wall knows nothing across it: the shear rate of a linear velocity at the wall comes out at
# half its value. vtkCellDataToPointData counts the triangles as well, with whatever they have for a field of the volume. Inside
# all is right, and nothing is said. vtkIntegrateAttributes leaves them out by itself, the gradient with
# SetContributingCellOption(2).
# A guess would be that the cells of the volume alone count, as where the same library integrates.
# Seen with VTK 9.1.0 (Debian 12): a tetrahedron with velocity (z, 0, 0), of which du/dz is 1, and viscosity 4.
# Output seen at its points, the last of which is off the wall: alone 1 1 1 1, 4 4 4 4; with a triangle 0.5 0.5 0.5 1, 2 2 2 4.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
cat >"$scratch/12/root/wall.py" <<'END'
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, VTK_TRIANGLE, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkCellDataToPointData
from vtkmodules.vtkFiltersGeneral import vtkGradientFilter
from vtkmodules.vtkFiltersParallel import vtkIntegrateAttributes


def grid(cells):
    """Cells of the unit tetrahedron, with velocity (z, 0, 0) at the points; the tetrahedron has viscosity 4, triangles none."""
    points, data, velocity, viscosity = vtkPoints(), vtkUnstructuredGrid(), vtkDoubleArray(), vtkDoubleArray()
    velocity.SetName("velocity")
    velocity.SetNumberOfComponents(3)
    viscosity.SetName("viscosity")
    for point in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)):
        points.InsertNextPoint(point)
        velocity.InsertNextTuple3(point[2], 0, 0)
    data.SetPoints(points)
    for kind, nodes in cells:
        data.InsertNextCell(kind, len(nodes), nodes)
        viscosity.InsertNextValue(4 if kind == VTK_TETRA else 0)
    data.GetPointData().AddArray(velocity)
    data.GetCellData().AddArray(viscosity)
    return data


def after(filter, data):
    filter.SetInputData(data)
    filter.Update()
    return filter.GetOutput()


def slopes(data, option=None):
    gradient = vtkGradientFilter()
    gradient.SetInputScalars(0, "velocity")
    if option is not None:
        gradient.SetContributingCellOption(option)
    array = after(gradient, data).GetPointData().GetArray("Gradients")
    return "du/dz " + " ".join(f"{array.GetComponent(point, 2):g}" for point in range(4))


tetrahedron, triangle = (VTK_TETRA, (0, 1, 2, 3)), (VTK_TRIANGLE, (0, 2, 1))
for name, data in (("tetrahedron", grid([tetrahedron])), ("with a triangle", grid([tetrahedron, triangle]))):
    field = after(vtkCellDataToPointData(), data).GetPointData().GetArray("viscosity")
    integral = after(vtkIntegrateAttributes(), data).GetCellData().GetArray("viscosity").GetTuple1(0)
    average = " ".join(f"{field.GetTuple1(point):g}" for point in range(4))
    print(f"{name}: {slopes(data)}; viscosity {average}; integral {integral:.4f}")
print("with a triangle, option 2:", slopes(grid([tetrahedron, triangle]), 2))
END
within "$scratch/12" python3 /root/wall.py >"$scratch/said" 2>"$scratch/log" || fail "python ends with $(cat "$scratch/log")"
[ ! -s "$scratch/log" ] || fail "VTK says $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "values at the wall"
tetrahedron: du/dz 1 1 1 1; viscosity 4 4 4 4; integral 0.6667
with a triangle: du/dz 0.5 0.5 0.5 1; viscosity 2 2 2 4; integral 0.6667
with a triangle, option 2: du/dz 1 1 1 1
END
