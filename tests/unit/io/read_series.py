"""Reads the series that write_sample_fields has written, by one of the libraries that users have, and compares times,
points, cells and values with the formulas there:
  read_series.py FOLDER meshio        fluid.xdmf and wall.xdmf by meshio
  read_series.py FOLDER vtkIOXdmf2    the same and fields.xdmf by VTK, as ParaView (XDMF Reader) and VisIt do
  read_series.py FOLDER vtkIOXdmf3    fluid.xdmf and wall.xdmf by VTK's newer library, as ParaView (Xdmf3 Reader) does
"""

import importlib
import sys
from pathlib import Path

import numpy as np

ENTRIES, STEP = 259, 0.25
POINTS = {
    "fluid": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],  # then the middles
    "wall": [
        (0, 0, 0),
        (1, 0, 0),
        (0, 1, 0),
        (0.5, 0, 0),
        (0.5, 0.5, 0),
        (0, 0.5, 0),
        (1, 1, 0),
        (1, 0.5, 0),
        (0.5, 1, 0),
    ],
}
POINTS["fluid"] += [(0.5, 0, 0), (0.5, 0.5, 0), (0, 0.5, 0), (0, 0, 0.5), (0.5, 0, 0.5), (0, 0.5, 0.5)]
CELLS = {"fluid": [list(range(10))], "wall": [[0, 1, 2, 3, 4, 5], [1, 6, 2, 7, 8, 4]]}
KINDS = {"fluid": ("tetra10", "vtkQuadraticTetra"), "wall": ("triangle6", "vtkQuadraticTriangle")}
# (values, components) of fields at points and cells
FIELDS = {
    "fluid": ({"pressure": (10, 1), "rate": (10, 6)}, {"traction": (1, 3)}),
    "wall": ({"displacement": (9, 3)}, {"mises": (2, 1), "stress": (2, 6)}),
}
LAYERS = [2, 3]
SYMMETRIC = (0, 1, 2, 1, 3, 4, 2, 4, 5)  # xx, xy, xz, yy, yz, zz as a full tensor, row by row


def check(condition, what):
    if not condition:
        sys.exit(f"read_series: {what}")


def check_grid(medium, time, points, cells, kind, fields, full_tensors):
    """`fields`: (of points, of cells), by name."""
    check(np.array_equal(points, POINTS[medium]), f"points of the {medium} at {time} are {points}")
    check(np.array_equal(cells, CELLS[medium]), f"cells of the {medium} are {cells}")
    check(kind in KINDS[medium], f"cells of the {medium} are of kind {kind}")
    for found, expected in zip(fields, FIELDS[medium]):
        for name, (count, components) in expected.items():
            values = np.arange(count * components).reshape(count, components) + 1000.0 * time
            if components == 6 and full_tensors:
                values = values[:, SYMMETRIC]
            check(name in found, f"{name} of the {medium} is missing at {time}")
            got = np.asarray(found[name]).reshape(count, -1)
            check(np.array_equal(got, values), f"{name} of the {medium} at {time} is {got}, not {values}")
    if medium == "wall":
        check(list(np.ravel(fields[1]["layer"])) == LAYERS, "the layers differ")


def by_meshio(folder):
    from meshio.xdmf import TimeSeriesReader

    for medium in POINTS:
        with TimeSeriesReader(folder / f"{medium}.xdmf") as reader:
            points, cells = reader.read_points_cells()
            check(reader.num_steps == ENTRIES, f"{medium}.xdmf has {reader.num_steps} entries")
            check(len(cells) == 1, f"{medium}.xdmf has {len(cells)} blocks of cells")
            for i in range(reader.num_steps):
                time, of_points, of_cells = reader.read_data(i)
                check(time == i * STEP, f"entry {i} is at {time} ms")
                of_cells = {name: blocks[0] for name, blocks in of_cells.items()}
                check_grid(medium, time, points, cells[0].data, cells[0].type, (of_points, of_cells), False)


def leaves(block, name):
    """(name, grid) of all grids in a tree of blocks."""
    if not hasattr(block, "GetNumberOfBlocks"):
        yield name, block
        return
    for i in range(block.GetNumberOfBlocks()):
        data = block.GetMetaData(i)
        yield from leaves(block.GetBlock(i), data.Get(block.NAME()) if data else "")


def arrays(data):
    found = (data.GetArray(i) for i in range(data.GetNumberOfArrays()))
    return {array.GetName(): [array.GetTuple(i) for i in range(array.GetNumberOfTuples())] for array in found}


def by_vtk(folder, module):
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

    library = importlib.import_module(f"vtkmodules.{module}")
    full_tensors = module == "vtkIOXdmf2"  # the other one leaves the six components as they are
    kind = library.vtkXdmfReader if module == "vtkIOXdmf2" else library.vtkXdmf3Reader
    documents = {"fluid": ["fluid"], "wall": ["wall"]}
    if module == "vtkIOXdmf2":  # the other one loses the names of media
        documents["fields"] = ["fluid", "wall"]
    for file, media in documents.items():
        reader = kind()
        reader.SetFileName(str(folder / f"{file}.xdmf"))
        reader.UpdateInformation()
        information = reader.GetOutputInformation(0)
        times = information.Get(Pipeline.TIME_STEPS())
        check(np.array_equal(times, np.arange(ENTRIES) * STEP), f"times of {file}.xdmf are {times}")
        for time in (*times[:3], times[150], times[151], *times[-4:]):  # about restart and second HDF5 file
            reader.Modified()
            information.Set(Pipeline.UPDATE_TIME_STEP(), time)
            reader.Update()
            grids = dict(leaves(reader.GetOutputDataObject(0), file))
            check(sorted(grids) == media, f"grids of {file}.xdmf are {sorted(grids)}")
            for medium, grid in grids.items():
                cells = []
                for cell in range(grid.GetNumberOfCells()):
                    of_cell = grid.GetCell(cell)
                    cells.append([of_cell.GetPointId(k) for k in range(of_cell.GetNumberOfPoints())])
                points = [grid.GetPoint(i) for i in range(grid.GetNumberOfPoints())]
                fields = arrays(grid.GetPointData()), arrays(grid.GetCellData())
                check_grid(medium, time, points, cells, grid.GetCell(0).GetClassName(), fields, full_tensors)


def main():
    folder, library = Path(sys.argv[1]), sys.argv[2]
    if library == "meshio":
        by_meshio(folder)
    else:
        by_vtk(folder, library)


main()
