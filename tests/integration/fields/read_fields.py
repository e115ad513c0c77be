"""What ParaView's own reader finds in FOLDER/fields.xdmf, as JSON. A process of its own: ParaView and h5py bring
different HDF5 libraries."""

import json
import os
import sys

from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkIOXdmf2 import vtkXdmfReader


def leaves(block, name=""):
    """(name, grid) of all grids in a tree of blocks."""
    if not hasattr(block, "GetNumberOfBlocks"):
        yield name, block
        return
    for i in range(block.GetNumberOfBlocks()):
        data = block.GetMetaData(i)
        yield from leaves(block.GetBlock(i), data.Get(block.NAME()) if data else "")


def values(array):
    tuples = [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]
    return tuples if array.GetNumberOfComponents() > 1 else [entry[0] for entry in tuples]


def named(data):
    arrays = (data.GetArray(i) for i in range(data.GetNumberOfArrays()))
    return {array.GetName(): values(array) for array in arrays}


def contents(grid):
    cells = range(grid.GetNumberOfCells())
    return {
        "points": [grid.GetPoint(i) for i in range(grid.GetNumberOfPoints())],
        "kinds": sorted({grid.GetCell(i).GetClassName() for i in cells}),
        "cells": [[grid.GetCell(i).GetPointId(k) for k in range(grid.GetCell(i).GetNumberOfPoints())] for i in cells],
        "point fields": named(grid.GetPointData()),
        "cell fields": named(grid.GetCellData()),
    }


def main():
    reader = vtkXdmfReader()
    reader.SetFileName(os.path.join(sys.argv[1], "fields.xdmf"))
    reader.UpdateInformation()
    information = reader.GetOutputInformation(0)
    times = information.Get(Pipeline.TIME_STEPS())
    found = {"times": list(times), "grids": []}
    for time in times:
        reader.Modified()
        information.Set(Pipeline.UPDATE_TIME_STEP(), time)
        reader.Update()
        found["grids"].append({name: contents(grid) for name, grid in leaves(reader.GetOutputDataObject(0))})
    json.dump(found, sys.stdout)


main()
