#!/usr/bin/env bash
# vtkFillHolesFilter closes the ends of a tube by triangles that are turned the other way round than those of the wall: inwards
# where the wall's turn outwards. Nothing is open any more, and every edge has two triangles, so the usual tests of a closed
# surface pass. The volume by the divergence theorem is 5.18 in place of 15.53, and vtkMassProperties gives 12.92 of the closed
# tube, while of the open one, whose volume it has no means to know, it gave the right 15.53. vtkPolyDataNormals, with its
# default ConsistencyOn, turns the lids.
# A guess would be that new triangles follow their neighbours, and that a closed surface is what vtkMassProperties needs.
# Seen with VTK 9.1.0 (Debian 12): a tube of radius 1 and length 5 with 24 edges around, of which the volume is 15.529.
# Output seen: open: mass properties 15.529; filled: open edges 0, volume 5.176, mass properties 12.921; turned: 15.529,
# 15.529.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
cat >"$scratch/12/root/fill.py" <<'END'
from math import cos, pi, sin
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkTriangle
from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkMassProperties, vtkPolyDataNormals
from vtkmodules.vtkFiltersModeling import vtkFillHolesFilter

AROUND, ALONG = 24, 10
points, triangles, tube = vtkPoints(), vtkCellArray(), vtkPolyData()
points.SetDataTypeToDouble()
for z in range(ALONG + 1):
    for n in range(AROUND):
        points.InsertNextPoint(cos(2 * pi * n / AROUND), sin(2 * pi * n / AROUND), 5 * z / ALONG)
for z in range(ALONG):
    for n in range(AROUND):
        a, b = z * AROUND + n, z * AROUND + (n + 1) % AROUND
        triangles.InsertNextCell(3, (a, b, b + AROUND))
        triangles.InsertNextCell(3, (a, b + AROUND, a + AROUND))
tube.SetPoints(points)
tube.SetPolys(triangles)


def after(filter, data):
    filter.SetInputData(data)
    filter.Update()
    return filter.GetOutput()


def volume(surface):
    corners, total, normal = vtkIdList(), 0, [0, 0, 0]
    for cell in range(surface.GetNumberOfCells()):
        surface.GetCellPoints(cell, corners)
        a, b, c = (surface.GetPoint(corners.GetId(n)) for n in range(3))
        vtkTriangle.ComputeNormalDirection(a, b, c, normal)  # not of length 1: twice the area
        total += (a[0] * normal[0] + a[1] * normal[1] + (a[2] - 2.5) * normal[2]) / 6
    return total


def show(name, surface):
    edges, mass = vtkFeatureEdges(), vtkMassProperties()
    edges.FeatureEdgesOff()
    mass.SetInputData(surface)
    print(f"{name}: open edges {after(edges, surface).GetNumberOfCells()}, volume {volume(surface):.3f}, "
          f"mass properties {mass.GetVolume():.3f}")


fill, normals = vtkFillHolesFilter(), vtkPolyDataNormals()
fill.SetHoleSize(100)
normals.SplittingOff()
show("open", tube)
show("filled", after(fill, tube))
show("turned", after(normals, fill.GetOutput()))
END
within "$scratch/12" python3 /root/fill.py >"$scratch/said" 2>"$scratch/log" || fail "python ends with $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "what the lids make of the volume"
open: open edges 48, volume 10.353, mass properties 15.529
filled: open edges 0, volume 5.176, mass properties 12.921
turned: open edges 0, volume 15.529, mass properties 15.529
END
