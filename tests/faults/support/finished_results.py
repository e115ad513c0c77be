"""Whether two result folders hold the same results: tables, checkpoint, fields, and the run's status."""

import csv

import h5py
import numpy as np

from harness import summary


def table(file):
    """Rows of a table without the columns of seconds, which no two runs have in common."""
    with open(file, newline="", encoding="utf-8") as stream:
        rows = list(csv.reader(stream))
    kept = [k for k, name in enumerate(rows[0]) if not name.endswith("_s")]
    return [[row[k] for k in kept] for row in rows]


def datasets(file):
    """All datasets of an HDF5 file by name, as bytes with type and shape."""
    found = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset):
            values = np.asarray(item)
            found[name] = (str(values.dtype), values.shape, values.tobytes())

    with h5py.File(file, "r") as opened:
        opened.visititems(visit)
    return found


def difference(folder, reference):
    """What tells a finished run from an undisturbed one, "" if nothing does."""
    try:
        if summary(folder).get("status") != "done":
            return "summary.json does not say done"
        for file in sorted(reference.glob("*.csv")):
            if table(folder / file.name) != table(file):
                return file.name
        for name in ("fields.xdmf", "fluid.xdmf", "wall.xdmf", "checkpoint.h5"):
            if (folder / name).read_bytes() != (reference / name).read_bytes():
                return name
        if datasets(folder / "fields.h5") != datasets(reference / "fields.h5"):
            return "fields.h5"
        if not (folder / "run.log").read_text(encoding="utf-8").endswith("info    done\n"):
            return "run.log does not end with done"
    except (OSError, IndexError, KeyError, UnicodeDecodeError) as error:
        return f"{type(error).__name__}: {error}"
    left = [file.name for file in folder.iterdir() if file.suffix == ".tmp"]
    return f"{left[0]} is left" if left else ""
