"""Compares the results of two runs that must agree bit for bit, whatever happened to one of them."""

from pathlib import Path

from result_data import differing_arrays, without_seconds

TABLES = (
    "centerline_pressure.csv",
    "wall_displacement.csv",
    "flow.csv",
    "energy.csv",
    "iterations.csv",
    "coupling.csv",
)


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
            found += [f"{name}:{path}" for path in differing_arrays(folder / name, other / name)]
        else:
            found.append(name)
    return found
