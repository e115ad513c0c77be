#!/usr/bin/env bash
# ParaView's filter Surface Flow (vtkIntegrateFlowThroughSurface) has the sign the other way round: velocity along the normal,
# by the right-hand rule of a triangle's points, counts as negative, so what leaves a surface that faces outwards is below
# zero. It takes one normal at each point, the mean of its triangles': where a surface has an edge, as a lumen has at the rims
# of its ends, the flow of both sides is wrong, by two thirds for a cube, unless the faces share no points.
# A guess would be the sum of velocity times normal times area, which is positive outwards and exact for a linear velocity.
# Seen with ParaView 5.11.0 (Debian 12): a square of area 1 that faces along z, velocity (0, 0, 2), flow 2; the cube of edge 1
# with the velocity (x, y, z), flow 3.
# Output seen: square -2, turned round 2; cube with common points -4.998, with points of its own for each face -3.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-paraview=5.11.0+dfsg-1+b1
cat >"$scratch/12/root/flow.py" <<'END'
from paraview.modules.vtkPVVTKExtensionsFiltersGeneral import vtkIntegrateFlowThroughSurface
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataObject, vtkPolyData


def flow(corners, triangles, velocity):
    points, cells, field, surface = vtkPoints(), vtkCellArray(), vtkDoubleArray(), vtkPolyData()
    field.SetName("velocity")
    field.SetNumberOfComponents(3)
    for corner in corners:
        points.InsertNextPoint(corner)
        field.InsertNextTuple(velocity(corner))
    for triangle in triangles:
        cells.InsertNextCell(3, triangle)
    surface.SetPoints(points)
    surface.SetPolys(cells)
    surface.GetPointData().AddArray(field)
    filter = vtkIntegrateFlowThroughSurface()
    filter.SetInputData(surface)
    filter.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "velocity")
    filter.Update()
    return round(filter.GetOutputDataObject(0).GetPointData().GetArray("Surface Flow").GetValue(0), 3)


SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
print("square", flow(SQUARE, [(0, 1, 2), (0, 2, 3)], lambda x: (0, 0, 2)))
print("turned", flow(SQUARE, [(2, 1, 0), (3, 2, 0)], lambda x: (0, 0, 2)))
CUBE = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
FACES = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2),
         (1, 3, 7), (1, 7, 5)]
print("cube", flow(CUBE, FACES, lambda x: x))
apart = [CUBE[n] for face in FACES for n in face]
print("apart", flow(apart, [(n, n + 1, n + 2) for n in range(0, len(apart), 3)], lambda x: x))
END
within "$scratch/12" python3 /root/flow.py >"$scratch/said" 2>"$scratch/log" || fail "python ends with $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "the flow"
square -2.0
turned 2.0
cube -4.998
apart -3.0
END
