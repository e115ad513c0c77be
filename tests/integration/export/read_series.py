"""What ParaView's reader finds in FILE.pvd, or meshio in the FILE.vtu given, as JSON. A process of its own: ParaView and
h5py bring different HDF5 libraries."""

import json
import sys


def by_paraview(file):
    from paraview.modules.vtkPVVTKExtensionsIOCore import vtkPVDReader
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

    reader = vtkPVDReader()
    reader.SetFileName(file)
    reader.UpdateInformation()
    times = reader.GetOutputInformation(0).Get(Pipeline.TIME_STEPS())
    found = []
    for time in times:
        reader.UpdateTimeStep(time)
        grid = reader.GetOutputDataObject(0)
        fields = {
            kind: {
                data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)).tolist() for i in range(data.GetNumberOfArrays())
            }
            for kind, data in (("points", grid.GetPointData()), ("cells", grid.GetCellData()))
        }
        cells = range(grid.GetNumberOfCells())
        found.append(
            {
                "time": time,
                "points": vtk_to_numpy(grid.GetPoints().GetData()).tolist(),
                "kinds": sorted({grid.GetCell(i).GetClassName() for i in cells}),
                "cells": [
                    [grid.GetCell(i).GetPointId(k) for k in range(grid.GetCell(i).GetNumberOfPoints())] for i in cells
                ],
                "fields": fields,
            }
        )
    return found


def by_meshio(file):
    import meshio

    grid = meshio.read(file)
    return {
        "time": grid.field_data["TimeValue"].tolist(),
        "points": grid.points.tolist(),
        "kinds": [block.type for block in grid.cells],
        "cells": grid.cells[0].data.tolist(),
        "fields": {
            "points": {name: values.tolist() for name, values in grid.point_data.items()},
            "cells": {name: values[0].tolist() for name, values in grid.cell_data.items()},
        },
    }


json.dump((by_paraview if sys.argv[1].endswith(".pvd") else by_meshio)(sys.argv[1]), sys.stdout)
