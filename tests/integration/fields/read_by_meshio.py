"""What meshio finds in FOLDER/fluid.xdmf and wall.xdmf, as JSON, once it was compared with the HDF5 files bit for bit."""

import json
import sys
from pathlib import Path

import h5py
import numpy as np
from meshio.xdmf import TimeSeriesReader


def entries(folder):
    """(time, part, dataset name, {(medium, field)}) of the finished entries of a run, from its HDF5 files alone."""
    parts = [folder / "fields.h5", *sorted(folder.glob("fields-*.h5"))]
    for part in parts:
        with h5py.File(part, "r") as h5:
            written = {tuple(name.split(".")): flags[()] for name, flags in h5["steps/written"].items()}
            for i, (number, time) in enumerate(zip(h5["steps/number"], h5["steps/time"])):
                names = {name for name, flags in written.items() if flags[i]}
                if names:
                    yield float(time), part, f"{number:08d}", names


def check(condition, what):
    if not condition:
        sys.exit(f"read_by_meshio: {what}")


def compared(folder, medium, killed):
    """`killed`: the last finished entry may not be listed yet."""
    file = folder / f"{medium}.xdmf"
    expected = list(entries(folder))
    with TimeSeriesReader(file) as reader:
        points, cells = reader.read_points_cells()
        missing = len(expected) - reader.num_steps
        check(missing in ((0, 1) if killed else (0,)), f"{file} lists {reader.num_steps} entries, not {len(expected)}")
        expected = expected[: reader.num_steps]
        check(len(cells) == 1, f"{file} has {len(cells)} blocks of cells")
        times, names = [], set()
        for i, (time, part, number, fields) in enumerate(expected):
            found_time, of_points, of_cells = reader.read_data(i)
            found = {**of_points, **{name: blocks[0] for name, blocks in of_cells.items()}}
            check(found_time == time, f"{file} has {found_time} for {time} ms")
            with h5py.File(part, "r") as h5:
                check(np.array_equal(points, h5[f"{medium}/points"]), f"points of {file}")
                check(np.array_equal(cells[0].data, h5[f"{medium}/cells"]), f"cells of {file}")
                check(np.array_equal(found.pop("layer"), h5[f"{medium}/layer"]), f"layers of {file}")
                check(set(found) == {field for of, field in fields if of == medium}, f"fields of {file}: {set(found)}")
                for name, values in found.items():
                    check(np.array_equal(values, h5[f"{medium}/{name}/{number}"]), f"{name} of {file} at {time}")
            times.append(found_time)
            names |= set(found)
    return {"times": times, "points": len(points), "cells": cells[0].type, "fields": sorted(names | {"layer"})}


def main():
    folder, killed = Path(sys.argv[1]), sys.argv[2:] == ["--killed"]
    json.dump(
        {
            file.stem: compared(folder, file.stem, killed)
            for file in sorted(folder.glob("*.xdmf"))
            if file.stem != "fields"
        },
        sys.stdout,
    )


main()
