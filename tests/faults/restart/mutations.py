"""What is done to the folder, mesh or case that a restart is asked to go on with.

A mutation is a Mutation. Those of checkpoints that keep the file well formed renew its checksum, so that the checks
behind the checksum are asked.
"""

import dataclasses
import math
import re
import shutil
from pathlib import Path
from typing import Callable, Optional

import h5py
import numpy as np

BLOCK = 512  # bytes before the HDF5 file, with format and checksum
REFUSED, SAME, ACCEPTED = "refused", "same bytes", "accepted"

OF_STEPS = ("energy.csv", "iterations.csv", "coupling.csv")  # the others have rows of levels
TABLES = {  # rows of a level or step
    "centerline_pressure.csv": 181,
    "wall_displacement.csv": 181,
    "flow.csv": 1,
    "energy.csv": 1,
    "iterations.csv": 1,
    "coupling.csv": 1,
}


@dataclasses.dataclass
class Mutation:
    """A change, and the verdicts that are right."""

    kind: str
    what: str
    expected: tuple
    change: Optional[Callable] = None  # of the folder
    settings: tuple = ()
    other_program: bool = False
    warning: str = ""  # that the log of the run must have


def checksum(data):
    """FNV-1a with 64 bits."""
    value = 14695981039346656037
    for byte in data:
        value = ((value ^ byte) * 1099511628211) & 0xFFFFFFFFFFFFFFFF
    return f"{value:016x}"


def seal(file):
    """Renews the checksum of a changed checkpoint."""
    data = bytearray(file.read_bytes())
    begin = data.index(b"checksum ") + len(b"checksum ")
    data[begin : begin + 16] = checksum(data[BLOCK:]).encode()
    file.write_bytes(data)


def edited(change):
    """A change of the HDF5 file within a checkpoint."""

    def of(folder):
        file = folder / "checkpoint.h5"
        with h5py.File(file, "r+") as h5:
            change(h5)
        seal(file)

    return of


def replaced(h5, name, values):
    del h5[name]
    h5[name] = values


def raw_checkpoints(data, choose, count):
    """Damage that the checksum must find."""

    def write(new):
        return lambda folder: (folder / "checkpoint.h5").write_bytes(new)

    for _ in range(count):
        at, bit = choose.randrange(len(data)), 1 << choose.randrange(8)
        yield "bit", f"bit {bit} of byte {at}", write(data[:at] + bytes([data[at] ^ bit]) + data[at + 1 :])
        size = choose.randrange(len(data))
        yield "cut", f"cut to {size} bytes", write(data[:size])
        at, size = choose.randrange(len(data)), choose.randrange(1, 5000)
        if data[at : at + size].strip(b"\0"):
            yield "zeros", f"{size} zeros at {at}", write((data[:at] + bytes(size) + data[at + size :])[: len(data)])
    yield "empty", "empty", write(b"")
    yield "longer", "a byte more", write(data + b"\0")
    yield "text", "a text", write(b"fsi-duo\n" * 100)
    for version in (b"1", b"3", b"20"):
        yield "version", f"format {version.decode()}", write(
            re.sub(rb"checkpoint \d+", b"checkpoint " + version, data, 1)
        )


def sealed_checkpoints(file, choose):
    """Well-formed checkpoints with wrong contents."""
    with h5py.File(file, "r") as h5:
        arrays = {f"arrays/{name}": h5[f"arrays/{name}"][()] for name in h5["arrays"]}
        reals = [f"reals/{name}" for name in h5.get("reals", [])]
    for name, values in arrays.items():
        optional = name == "arrays/extremes" or any(part in name for part in ("stepper.", "march.", "table."))
        for bad in (math.nan, math.inf):
            if values.size:
                place = choose.randrange(values.size)

                def put(h5, name=name, place=place, bad=bad):
                    h5[name][place] = bad

                yield "not finite", f"{name}[{place}] = {bad}", put
        yield "longer array", f"{name} one longer", lambda h5, n=name, v=values: replaced(h5, n, np.append(v, 0.0))
        if values.size:
            yield "shorter array", f"{name} one shorter", lambda h5, n=name, v=values: replaced(h5, n, v[:-1])
            yield "empty array", f"{name} empty", lambda h5, n=name: replaced(h5, n, np.zeros(0))
            yield "text array", f"{name} as text", lambda h5, n=name: replaced(h5, n, "text")
        if not optional:

            def remove(h5, name=name):
                del h5[name]

            yield "missing array", f"{name} missing", remove
    for name in reals:
        yield "not finite", f"{name} = nan", lambda h5, n=name: replaced(h5, n, [math.nan])
        yield "two values", f"{name} twice", lambda h5, n=name: replaced(h5, n, [1.0, 2.0])
    with_levels = [name for name in ("mesh", "flow", "wall") if f"arrays/level0.{name}" in arrays]

    def exchange(a, b):
        def of(h5):
            for name in with_levels:
                one, two = h5[f"arrays/{a}.{name}"][()], h5[f"arrays/{b}.{name}"][()]
                h5[f"arrays/{a}.{name}"][...], h5[f"arrays/{b}.{name}"][...] = two, one

        return of

    yield "exchanged arrays", "levels 0 and 1", exchange("level0", "level1")
    for step in (-1, 0, 1, 3, 5, 7, 1000, 2**31, 2**40, 2**62, -(2**62)):
        yield "step", f"step {step}", lambda h5, s=step: replaced(h5, "step", np.array([s], dtype=np.int64))
    for time in (math.nan, -math.inf, 0.0, -0.5, 0.4, 0.5000001, 1e300):
        yield "time", f"time {time}", lambda h5, t=time: replaced(h5, "time", [t])
    yield "step", "two steps", lambda h5: replaced(h5, "step", np.array([4, 4], dtype=np.int64))
    yield "step", "no step", lambda h5: replaced(h5, "step", np.zeros(0, dtype=np.int64))
    for name in ("level_times", "balance_times", "since_jump", "step_lengths", "inserted_steps"):
        values = arrays.get(f"arrays/{name}")
        if values is None:
            continue
        turned = values[::-1].copy()
        if not np.array_equal(turned, values):
            yield "times", f"{name} turned round", lambda h5, n=name, v=turned: replaced(h5, f"arrays/{n}", v)
        yield "times", f"{name} negative", lambda h5, n=name, v=values: replaced(h5, f"arrays/{n}", -v - 1)
        yield "times", f"{name} huge", lambda h5, n=name, v=values: replaced(h5, f"arrays/{n}", v + 1e12)
    yield "unknown", "an array more", lambda h5: h5.create_dataset("arrays/more", data=[1.0])
    for name in ("program", "case_hash", "mesh_hash"):
        yield "attribute", f"{name} of another run", lambda h5, n=name: h5.attrs.__setitem__(n, np.bytes_("other"))
        yield "attribute", f"{name} missing", lambda h5, n=name: h5.attrs.__delitem__(n)
        yield "attribute", f"{name} a number", lambda h5, n=name: h5.attrs.__setitem__(n, 3)


def needed_rows(name, step, level):
    """Rows that a restart from `step` needs of a table, with levels up to `level`."""
    return TABLES[name] * (step if name in OF_STEPS else level)


def tables(folder, other, step, level, choose, count):
    """Changes of tables among the rows that are needed."""

    def lines_changed(name, change):
        def of(target):
            lines = (target / name).read_text().splitlines(keepends=True)
            change(lines)
            (target / name).write_text("".join(lines))

        return of

    for name in TABLES:
        if not (folder / name).exists():
            continue
        needed = needed_rows(name, step, level)
        text = (folder / name).read_bytes()
        end = len(b"".join(text.splitlines(keepends=True)[: needed + 1]))

        for _ in range(count):
            k = choose.randrange(1, needed + 1)
            j = choose.choice([i for i in range(1, needed + 1) if i != k])

            def swap(lines, k=k, j=j):
                lines[k], lines[j] = lines[j], lines[k]

            def last_digit(lines, k=k):
                cells = lines[k].rstrip("\n").split(",")
                cells[2] = cells[2][:-1] + str((int(cells[2][-1]) + 1) % 10)
                lines[k] = ",".join(cells) + "\n"

            def cell(lines, value, k=k):
                cells = lines[k].rstrip("\n").split(",")
                cells[choose.randrange(len(cells))] = value
                lines[k] = ",".join(cells) + "\n"

            yield "row removed", f"{name} without line {k + 1}", lines_changed(name, lambda lines, k=k: lines.pop(k))
            yield "row doubled", f"{name}, line {k + 1} twice", lines_changed(
                name, lambda lines, k=k: lines.insert(k, lines[k])
            )
            yield "row repeated", f"{name}, line {k + 1} again at the end", lines_changed(
                name, lambda lines, k=k: lines.append(lines[k])
            )
            yield "rows exchanged", f"{name}, lines {k + 1} and {j + 1}", lines_changed(name, swap)
            yield "digit", f"{name}, a digit of line {k + 1}", lines_changed(name, last_digit)
            for value in ("nan", "inf", "", "x", "1e999", "1;5"):
                yield "cell", f"{name}, line {k + 1} with '{value}'", lines_changed(
                    name, lambda lines, v=value, c=cell: c(lines, v)
                )
            size = choose.randrange(end)
            yield "table cut", f"{name} cut to {size} bytes", lambda t, n=name, s=size: (t / n).write_bytes(
                text_of(t / n)[:s]
            )
        yield "header", f"{name} with another header", lines_changed(
            name, lambda lines: lines.__setitem__(0, "step," + lines[0])
        )
        yield "table emptied", f"{name} empty", lambda t, n=name: (t / n).write_bytes(b"")
        yield "table removed", f"{name} missing", lambda t, n=name: (t / n).unlink()
        yield "table is a folder", f"{name} a folder", lambda t, n=name: ((t / n).unlink(), (t / n).mkdir())
        yield "table of another run", f"{name} of another run", lambda t, n=name: shutil.copy(other / n, t / n)


def text_of(file):
    return Path(file).read_bytes()


def harmless_tables(folder, step, level, choose):
    """What a kill leaves: rows of later steps, whole or torn."""
    for name in TABLES:
        if not (folder / name).exists():
            continue
        lines = (folder / name).read_bytes().splitlines(keepends=True)
        end = len(b"".join(lines[: needed_rows(name, step, level) + 1]))
        for size in (end, choose.randrange(end, sum(map(len, lines)) + 1)):
            yield "torn", f"{name} cut behind what is needed, at {size}", lambda t, n=name, s=size: (t / n).write_bytes(
                text_of(t / n)[:s]
            )
        yield "torn", f"{name} with half a line more", lambda t, n=name: (t / n).write_bytes(text_of(t / n) + b"9.9,1")
    for name in ("summary.json", "run.log", "fields.xdmf", "fluid.xdmf", "wall.xdmf"):
        yield "made anew", f"{name} missing", lambda t, n=name: (t / n).unlink()
    yield "made anew", "summary.json damaged", lambda t: (t / "summary.json").write_bytes(b"\0{[")


def field_files(choose):
    """fields.h5, which the earlier run has written."""

    def cut(folder):
        data = text_of(folder / "fields.h5")
        (folder / "fields.h5").write_bytes(data[: choose.randrange(len(data))])

    def change(of):
        def changed(folder):
            with h5py.File(folder / "fields.h5", "r+") as h5:
                of(h5)

        return changed

    def without_flag(h5):
        for name in h5["steps/written"]:
            h5[f"steps/written/{name}"][1] = 0

    def points(h5):
        h5["fluid/points"][3] *= 1 + 1e-12

    yield "fields removed", "fields.h5 missing", lambda t: (t / "fields.h5").unlink()
    yield "fields damaged", "fields.h5 empty", lambda t: (t / "fields.h5").write_bytes(b"")
    yield "fields damaged", "fields.h5 a text", lambda t: (t / "fields.h5").write_bytes(b"no HDF5\n" * 1000)
    yield "fields damaged", "fields.h5 a folder", lambda t: ((t / "fields.h5").unlink(), (t / "fields.h5").mkdir())
    for _ in range(5):
        yield "fields damaged", "fields.h5 cut", cut
    yield "fields changed", "an entry less", change(without_flag)
    yield "fields changed", "times turned round", change(
        lambda h5: replaced(h5, "steps/time", h5["steps/time"][()][::-1])
    )
    yield "fields changed", "a time less", change(lambda h5: replaced(h5, "steps/time", h5["steps/time"][:-1]))
    yield "fields changed", "a dataset missing", change(lambda h5: h5["fluid/pressure"].__delitem__("00000002"))
    yield "fields changed", "another grid", change(lambda h5: replaced(h5, "wall/cells", h5["wall/cells"][:-1]))
    yield "fields changed", "other points", change(points)
    yield "fields changed", "no flags", change(lambda h5: h5["steps"].__delitem__("written"))


def meshes(mesh, folder):
    """Changed copies of an ASCII mesh: (what, file, expected verdicts)."""
    text = Path(mesh).read_text()
    names = text[text.index("$PhysicalNames") : text.index("$EndPhysicalNames")]

    def renamed(**to):
        changed = re.sub(r'"(\w+)"', lambda found: f'"{to.get(found[1], found[1])}"', names)
        return text.replace(names, changed)

    def moved(factor):
        """Of the first point that does not lie on an axis."""
        begin = text.index("$Nodes")
        found = next(m for m in re.finditer(r"^(-?\d\.\d{6,}) (-?\d\.\d{6,}) (\S+)$", text[begin:], re.M))
        place = begin + found.start(1)
        return text[:place] + repr(float(found[1]) * factor) + text[place + len(found[1]) :]

    changes = {
        "inlet and outlet exchanged": (renamed(inlet="outlet", outlet="inlet"), (REFUSED,)),
        "layers exchanged": (renamed(media="adventitia", adventitia="media"), (REFUSED,)),
        "outer face without name": (renamed(outer="skin"), (REFUSED,)),
        "clamped ends without name": (renamed(wall_ends="skin"), (REFUSED,)),
        "a point moved by 1e-12": (moved(1 + 1e-12), (REFUSED,)),
        "a point moved by 1e-3": (moved(1 + 1e-3), (REFUSED,)),
        "the same mesh in another file": (text, (SAME,)),
    }
    for number, (what, (changed, expected)) in enumerate(changes.items()):
        if changed == text and expected != (SAME,):
            raise SystemExit(f"restart: cannot change the mesh: {what}")
        file = folder / f"mesh-{number}.msh"
        file.write_text(changed)
        yield what, file, expected


# Cases: what a run may be continued with. Every key that a case can have is named here.
OTHER_CASES = {
    REFUSED: (
        "element=p2p1",
        "stabilisation=projected",
        "fluid.density=1.000001",
        "fluid.viscosity=3.6e-3",
        "fluid.grad_div=true",
        "structure.density=1.3",
        "structure.bulk_modulus=2e5",
        "structure.stabilisation=0.25",
        "structure.layer_pressure=separate",
        "structure.axis_origin=[0,0,1]",
        "structure.axis_direction=[0,0,2]",
        "structure.layers.media.c10=3.0000001",
        "structure.layers.adventitia.c10=0.31",
        "inlet.pressure=1.3320001",
        "inlet.until=0.25",
        "time.scheme=bdf2",
        "time.end=0.375",
    ),
    SAME: (
        'title="another"',
        "time.retries=9",
        "newton.max_iterations=77",
        "linear.restart=33",
        "partitioned.max_iterations=77",
        "partitioned.velocity_gap=0.7",
        "economy.constant_operators=rebuilt",
        "output.checkpoint_every=1",
    ),
    ACCEPTED: (
        "time.step=0.0625",
        "time.end=0.875",
        "time.predictor=0",
        "newton.tolerance=1e-3",
        "newton.mode=full",
        "partitioned.tolerance=1e-3",
        "partitioned.scheme=aitken",
        "output.every=0",
        "output.every=2",
        "output.interval=0.1",
        'output.fields=["pressure"]',
        "output.energy=false",
        "output.checkpoint_every=0",
    ),
}
