#!/usr/bin/env bash
# In ParaView's Python Calculator, and in its Programmable Filter, trace() of a symmetric stress of six components, as ParaView
# itself has them, is one number for all points: xx of the first point, yy of the second, zz of the third, xy of the fourth, yz
# of the fifth and xz of the sixth, added up. det(), inverse() and eigenvalue() raise an error of six components, trace() none.
# A tensor of nine components has its trace at each point, but it is turned over when it is read: T[:,0,1] is yx, and
# gradient(u)[:,0,1] is dv/dx, not du/dy. Results are turned back, so T alone comes out as it is in the file, and nothing shows
# of a symmetric tensor. dot(T, n) is right.
# A guess would be xx + yy + zz at each point, as six components are a tensor to Tensor Glyph, and the row before the column.
# Seen with ParaView 5.11.0 (Debian 12): two tetrahedra of eight points. Point n has the stress n times 1, 2, 3, 12, 23, 13, of
# which the trace is 6 n; T has xx to zz of 11, 12, 13, 21, 22, 23, 31, 32, 33; u = (y, 0, 0), of which du/dy is 1.
# Output seen, first and last point: trace of the stress 255, 255, of T 66, 66; T[:,0,1] 21, T[:,1,0] 12; gradient(u)[:,0,1] 0,
# gradient(u)[:,1,0] 1; T all nine as they are; dot(T, (0.6, 0.8, 0)) 16.2, 30.2, 44.2; det, inverse, eigenvalue RuntimeError.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-paraview=5.11.0+dfsg-1+b1
cat >"$scratch/12/root/tensors.py" <<'END'
from paraview.simple import ProgrammableFilter, PythonCalculator, TrivialProducer
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkUnstructuredGrid


def field(name, rows):
    array = vtkDoubleArray()
    array.SetName(name)
    array.SetNumberOfComponents(len(rows[0]))
    for row in rows:
        array.InsertNextTuple(row)
    grid.GetPointData().AddArray(array)


def value(filter):
    """The result at the first and at the last point."""
    filter.UpdatePipeline()
    array = filter.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("result")
    if not array:
        return "no result"
    return "; ".join(" ".join(f"{x:g}" for x in array.GetTuple(point)) for point in (0, 7))


points, grid = vtkPoints(), vtkUnstructuredGrid()
for x in (0, 2):
    for point in ((x, 0, 0), (x + 1, 0, 0), (x, 1, 0), (x, 0, 1)):
        points.InsertNextPoint(point)
grid.SetPoints(points)
for first in (0, 4):
    grid.InsertNextCell(VTK_TETRA, 4, [first, first + 1, first + 2, first + 3])
field("stress", [(n, 2 * n, 3 * n, 12 * n, 23 * n, 13 * n) for n in range(1, 9)])
field("T", 8 * [(11, 12, 13, 21, 22, 23, 31, 32, 33)])
field("n", 8 * [(0.6, 0.8, 0)])
field("u", [(points.GetPoint(point)[1], 0, 0) for point in range(8)])
producer = TrivialProducer()
producer.GetClientSideObject().SetOutput(grid)
for expression in ("trace(stress)", "trace(T)", "T", "T[:,0,1]", "T[:,1,0]", "gradient(u)[:,0,1]", "gradient(u)[:,1,0]",
                   "dot(T, n)", "det(stress)", "inverse(stress)", "eigenvalue(stress)"):
    print(f"{expression}: {value(PythonCalculator(Input=producer, Expression=expression, ArrayName='result'))}", flush=True)
for expression in ("trace(stress)", "T[:,0,1]"):
    script = f"""stress, T = inputs[0].PointData["stress"], inputs[0].PointData["T"]
output.PointData.append({expression}, "result")"""
    print(f"filter, {expression}: {value(ProgrammableFilter(Input=producer, Script=script))}", flush=True)
END
within "$scratch/12" python3 /root/tensors.py >"$scratch/said" 2>"$scratch/log" ||
  fail "python ends with $(cat "$scratch/log")"
grep '^RuntimeError' "$scratch/log" >>"$scratch/said" || fail "no error is raised"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "the tensors"
trace(stress): 255; 255
trace(T): 66; 66
T: 11 12 13 21 22 23 31 32 33; 11 12 13 21 22 23 31 32 33
T[:,0,1]: 21; 21
T[:,1,0]: 12; 12
gradient(u)[:,0,1]: 0; 0
gradient(u)[:,1,0]: 1; 1
dot(T, n): 16.2 30.2 44.2; 16.2 30.2 44.2
det(stress): no result
inverse(stress): no result
eigenvalue(stress): no result
filter, trace(stress): 255; 255
filter, T[:,0,1]: 21; 21
RuntimeError: Determinant only works for an array of matrices(3D array). Input shape (8, 6)
RuntimeError: Inverse only works for an array of matrices(3D array). Input shape (8, 6)
RuntimeError: Eigenvalue only works for an array of matrices(3D array). Input shape (8, 6)
END
