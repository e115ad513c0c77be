"""Reads the files of result folders so that two runs can be compared bit for bit."""

from pathlib import Path

import h5py


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


def differing_arrays(file, other):
    """Paths of the datasets that are not in both HDF5 files with the same type, shape and bits."""
    a, b = arrays(file), arrays(other)
    same = (
        lambda name: name in a
        and name in b
        and (a[name].dtype, a[name].shape) == (b[name].dtype, b[name].shape)
        and a[name].tobytes() == b[name].tobytes()
    )
    return [name for name in sorted(a.keys() | b.keys()) if not same(name)]
