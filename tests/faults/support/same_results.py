"""Compares the results of two runs that must agree bit for bit, whatever happened to one of them."""

from pathlib import Path

import h5py

TABLES = (
    "centerline_pressure.csv",
    "wall_displacement.csv",
    "flow.csv",
    "energy.csv",
    "iterations.csv",
    "coupling.csv",
)


def without_seconds(file):
    """Rows of a table as lists of cells, without the columns of wall-clock seconds, whose names end with `_s`."""
    rows = [line.split(",") for line in Path(file).read_text(encoding="utf-8").splitlines()]
    kept = [i for i, name in enumerate(rows[0]) if not name.endswith("_s")] if rows else []
    return [[row[i] for i in kept if i < len(row)] for row in rows]


def arrays(file):
    """All datasets of an HDF5 file by path."""
    found = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset):
            found[name] = item[()]

    with h5py.File(file, "r") as opened:
        opened.visititems(visit)
    return found


def different_arrays(file, other):
    """Paths of the datasets that are not in both files bit for bit."""
    a, b = arrays(file), arrays(other)
    same = (
        lambda name: name in a
        and name in b
        and a[name].dtype == b[name].dtype
        and a[name].tobytes() == b[name].tobytes()
    )
    return [f"{Path(file).name}:{name}" for name in sorted(a.keys() | b.keys()) if not same(name)]


def difference(folder, other, fields=True):
    """What differs between two result folders: names of tables and datasets; empty when the bytes are the same."""
    folder, other = Path(folder), Path(other)
    found = []
    for name in TABLES:
        if (folder / name).exists() != (other / name).exists():
            found.append(name)
        elif (folder / name).exists() and without_seconds(folder / name) != without_seconds(other / name):
            found.append(name)
    files = {"checkpoint.h5"}
    if fields:
        files |= {file.name for parent in (folder, other) for file in parent.glob("fields*.h5")}
    for name in sorted(files):
        if (folder / name).exists() and (other / name).exists():
            found += different_arrays(folder / name, other / name)
        else:
            found.append(name)
    return found
