#!/usr/bin/env bash
# vtkIntegrateAttributes (ParaView: Integrate Variables) cuts a quadratic tetrahedron into eight linear ones between its ten
# nodes, also where its edges are straight, and takes the field linear in each. The integral of a quadratic field, which the
# nodes describe exactly, is that of linear elements of half the size; of x^2 over one tetrahedron it is 41 % too large.
# Volumes of curved cells suffer likewise. Fields that are linear, and volumes of straight cells, are exact, so the usual test
# by the field 1 shows nothing.
# A guess would be quadrature with the cell's own shape functions, which VTK has and uses to interpolate at points.
# Seen with VTK 9.1.0 (Debian 12). Exact: straight 1/6, 1/24 of x, 1/60 = 0.016667 of x^2; with the middle of one edge moved
# outwards by (0.1, 0.1, 0) the volume is 1/5.
# Output seen: straight: volume 0.166667, of x 0.041667, of x^2 0.023438; curved: volume 0.191667.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
cat >"$scratch/12/root/integrate.py" <<'END'
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_QUADRATIC_TETRA, vtkUnstructuredGrid
from vtkmodules.vtkFiltersParallel import vtkIntegrateAttributes

# Vertices, then middles of edges in VTK's order.
STRAIGHT = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (0.5, 0, 0), (0.5, 0.5, 0), (0, 0.5, 0), (0, 0, 0.5), (0.5, 0, 0.5),
            (0, 0.5, 0.5)]


def integrals(nodes):
    points, cell, grid = vtkPoints(), vtkIdList(), vtkUnstructuredGrid()
    points.SetDataTypeToDouble()
    fields = {"x": vtkDoubleArray(), "x^2": vtkDoubleArray()}
    for node in nodes:
        cell.InsertNextId(points.InsertNextPoint(node))
        fields["x"].InsertNextValue(node[0])
        fields["x^2"].InsertNextValue(node[0] ** 2)
    grid.SetPoints(points)
    grid.InsertNextCell(VTK_QUADRATIC_TETRA, cell)
    for name, field in fields.items():
        field.SetName(name)
        grid.GetPointData().AddArray(field)
    integrate = vtkIntegrateAttributes()
    integrate.SetInputData(grid)
    integrate.Update()
    sums = integrate.GetOutput()
    return [sums.GetCellData().GetArray("Volume").GetValue(0)] + [sums.GetPointData().GetArray(name).GetValue(0) for name in fields]


print("straight: volume {:.6f}, of x {:.6f}, of x^2 {:.6f}".format(*integrals(STRAIGHT)))
print("curved: volume {:.6f}".format(*integrals(STRAIGHT[:5] + [(0.6, 0.6, 0)] + STRAIGHT[6:])))
END
within "$scratch/12" python3 /root/integrate.py >"$scratch/said" 2>"$scratch/log" || fail "python ends with $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "the integrals"
straight: volume 0.166667, of x 0.041667, of x^2 0.023438
curved: volume 0.191667
END
