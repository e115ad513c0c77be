"""Reads what write_sample_fields has written through ParaView's XDMF reader and compares it with the formulas there."""

import os
import sys

from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOXdmf2 import vtkXdmfReader


def leaves(block, name=""):
    """(name, grid) of all grids in a tree of blocks."""
    if not hasattr(block, "GetNumberOfBlocks"):
        yield name, block
        return
    for i in range(block.GetNumberOfBlocks()):
        data = block.GetMetaData(i)
        yield from leaves(block.GetBlock(i), data.Get(block.NAME()) if data else "")


def check(condition, what):
    if not condition:
        sys.exit(f"read_sample_fields: {what}")


def check_vectors(array, points, time, what):
    check(array is not None and array.GetNumberOfComponents() == 3, f"{what} is missing or no vector")
    for i in range(points.GetNumberOfPoints()):
        expected = tuple(x + 10 * time for x in points.GetPoint(i))
        check(array.GetTuple(i) == expected, f"{what} of node {i} is {array.GetTuple(i)}, not {expected}")


def check_scalars(array, points, time, shift, what):
    check(array is not None and array.GetNumberOfComponents() == 1, f"{what} is missing or no scalar")
    for i in range(points.GetNumberOfPoints()):
        x, y, z = points.GetPoint(i)
        expected = x + 100 * y + 10000 * z + time + shift
        check(array.GetValue(i) == expected, f"{what} of node {i} is {array.GetValue(i)}, not {expected}")


def main():
    reader = vtkXdmfReader()
    reader.SetFileName(os.path.join(sys.argv[1], "fields.xdmf"))
    reader.UpdateInformation()
    information = reader.GetOutputInformation(0)
    times = information.Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    check(times == (0.0, 1.0), f"time steps are {times}")

    for time in times:
        information.Set(vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP(), time)
        reader.Modified()
        information.Set(vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP(), time)
        reader.Update()
        grids = dict(leaves(reader.GetOutputDataObject(0)))
        check(sorted(grids) == ["fluid", "wall"], f"grids are {sorted(grids)}")
        fluid, wall = grids["fluid"], grids["wall"]
        check(fluid.GetNumberOfPoints() == 5 and fluid.GetNumberOfCells() == 2, "the fluid has other points or cells")
        check(wall.GetNumberOfPoints() == 6 and wall.GetNumberOfCells() == 3, "the wall has other points or cells")
        check([fluid.GetCell(1).GetPointId(i) for i in range(4)] == [1, 2, 3, 4], "a fluid cell has other nodes")
        check(fluid.GetPoint(4) == (1.0, 1.0, 1.0), "a fluid node is elsewhere")
        check(wall.GetCell(2).GetClassName() == "vtkTetra", "the wall's cells are no tetrahedra")
        layer = wall.GetCellData().GetArray("layer")
        check(layer is not None and [layer.GetValue(i) for i in range(3)] == [7, 7, 9], "the layers differ")
        check(wall.GetPointData().GetArray("velocity") is None, "the wall has a velocity")
        check_vectors(fluid.GetPointData().GetArray("velocity"), fluid, time, f"fluid velocity at {time}")
        check_vectors(wall.GetPointData().GetArray("displacement"), wall, time, f"wall displacement at {time}")
        check_scalars(fluid.GetPointData().GetArray("pressure"), fluid, time, 0.0, f"fluid pressure at {time}")
        check_scalars(wall.GetPointData().GetArray("pressure"), wall, time, 0.5, f"wall pressure at {time}")


main()
