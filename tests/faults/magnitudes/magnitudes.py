"""Numbers of any size: loads, units, steps and constants from the smallest to the largest.

Nothing in the discrete equations has a natural size in kPa, mm or ms. So
- a load that is a million million times smaller has an answer as much smaller (`loads`),
- the same scene in other units has the same answer (`units`),
- what a constant pressure moves in the first steps goes like the step, or its square, however short they are (`steps`),
- no load moves nothing, exactly (`rest`),
- with constants of any size both drivers agree (`constants`), and one pass a step claims no more than it knows
  (`explicit`).

A run is `right` when its numbers, all finite, agree with those that they are compared with; `refused` when it ends with
one message and exit code 1 or 2. Anything else is wrong.
"""

import itertools
import re
import subprocess
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from harness import DRIVERS, Harness, execute, is_one_message, summary

MONOLITHIC, PARTITIONED = DRIVERS
CASE = """
title = "magnitudes"
element = "{element}"
geometry = "{geometry}"
[mesh]
file = "{mesh}"
[fluid]
density = {rho!r}
viscosity = {viscosity!r}
[structure]
density = {rho_s!r}
bulk_modulus = {kappa!r}
[structure.layers.media]
{media}
[structure.layers.adventitia]
material = "neo-hookean"
c10 = {c10_adventitia!r}
[inlet]
pressure = {pressure!r}
until = {until!r}
[time]
step = {step!r}
end = {end!r}
scheme = "{scheme}"
retries = 0
[newton]
tolerance = 1e-6
[partitioned]
tolerance = 1e-6
[output]
fields = ["displacement", "velocity", "pressure"]
every = 1
"""
STANDARD: dict[str, Any] = dict(
    element="p2p1",
    geometry="axisymmetric",
    rho=1.0,
    viscosity=3.5e-3,
    rho_s=1.2,
    kappa=1e5,
    c10=3.0,
    c10_adventitia=0.3,
    k1=2.3632,
    k2=0.8393,
    material="neo-hookean",
    pressure=1.332e-6,
    until=0.2,
    step=0.1,
    end=0.6,
    scheme="midpoint",
)
BOUND = 2e-3  # relative difference of tables, in the Euclidean norm; tolerances are 1e-6, pressures feel them most
SCHEMES = (
    "aitken",
    "block-newton",
    "iqn-ils",
    "iqn-imvj",
    "newton-krylov",
    "robin-neumann",
    "robin-neumann-inexact",
    "robin-neumann-iqn",
    "robin-neumann-imvj",
)
COUPLED_SOLVERS = ("amg_fgmres", "ilu_exact", "amli_gmres")
TIME_SCHEMES = ("euler", "midpoint", "bdf2", "generalised-alpha", "tr-bdf2")
TABLES = {  # columns of pressure, length and flow
    "centerline_pressure.csv": ("pressure", [2]),
    "wall_displacement.csv": ("length", [2, 3]),
    "flow.csv": ("flow", [1, 2]),
}


class Magnitudes:
    def __init__(self, harness):
        self.harness = harness
        self.runs = itertools.count()
        self.known = {}

    def mesh(self, element, geometry, length=1.0):
        """A short tube, its lengths times `length`."""
        order = 2 if element == "p2p1" else 1
        file = self.harness.base / f"{geometry}-{order}-{length:g}.msh"
        if not file.exists():
            kind: list[Any] = ["--axisymmetric"] if geometry == "axisymmetric" else ["--around", 8, "--sector", 90]
            sizes = zip(("--inner-radius", "--media", "--adventitia", "--length"), (1.43, 0.26, 0.13, 3))
            cells = zip(("--lumen-cells", "--media-cells", "--adventitia-cells", "--axial-cells"), (2, 1, 1, 4))
            words: list[Any] = [w for name, value in sizes for w in (name, repr(value * length))]
            words += [w for pair in cells for w in pair] + kind + ["--order", order, "--size", length]
            made = execute(self.harness.program("fsi-mesh"), "artery", "-q", "-o", file, *words)
            if made.returncode != 0:
                raise SystemExit(f"cannot make the mesh: {made.stderr}")
        return file

    def run(self, program, settings=(), length=1.0, **values):
        """Starts a run, once for the same; returns (exit code, message, folder)."""
        key = (program, tuple(settings), length, tuple(sorted(values.items())))
        if key in self.known:
            return self.known[key]
        v: dict[str, Any] = {**STANDARD, **values}
        v["mesh"] = self.mesh(v["element"], v["geometry"], length)
        v["media"] = f'material = "{v["material"]}"\nc10 = {v["c10"]!r}'
        if v["material"] == "artery":
            v["media"] += f'\nk1 = {v["k1"]!r}\nk2 = {v["k2"]!r}\nalpha = 29.0'
        number = next(self.runs)
        case, folder = self.harness.base / f"{number}.toml", self.harness.base / f"{number}"
        case.write_text(CASE.format(**v))
        command = [self.harness.program(program), case, "-o", folder, "-q", "--threads", 1]
        for setting in settings:
            command += ["--set", setting]
        try:
            process = execute(*command, timeout=120)
            answer = (process.returncode, process.stderr, folder)
        except subprocess.TimeoutExpired:
            answer = (-1, "it hangs", folder)
        self.known[key] = answer
        return answer

    def judge(self, what, program, settings=(), other=None, bound=BOUND, scales=None, may_refuse=False, **values):
        """Counts the verdict on a run. `other`: folder to compare with; `scales`: what its quantities are multiplied with
        to be those of the run, by kind."""
        code, said, folder = self.run(program, settings, **values)
        count, name = self.harness.count, f"{what} [{program} {' '.join(settings)}]"
        if code in (1, 2) and is_one_message(last_line(said), program):
            count("refused" if may_refuse else "wrong", f"{name}: refused: {said.strip()}")
        elif code != 0:
            count("wrong", f"{name}: ends with {code}: {said.strip()}")
        elif not_finite(folder):
            count("wrong", f"{name}: not finite: {not_finite(folder)}")
        else:
            apart = {k: d for k, d in differences(folder, other, scales).items() if not d <= bound} if other else {}
            count("wrong" if apart else "right", f"{name}: {apart}")
        return folder if code == 0 else None


def last_line(text):
    return text.splitlines(keepends=True)[-1] if text else ""


def columns(folder):
    found = {}
    for name, (kind, places) in TABLES.items():
        rows = np.loadtxt(folder / name, delimiter=",", skiprows=1, ndmin=2)
        found[name] = (kind, rows[:, places])
    names = (folder / "energy.csv").read_text().split("\n", 1)[0].split(",")
    rows = np.loadtxt(folder / "energy.csv", delimiter=",", skiprows=1, ndmin=2)
    for column, kind in (
        ("fluid_kinetic_energy_uJ", "energy"),
        ("wall_isochoric_energy_uJ", "elastic"),
        ("inlet_work_uJ", "energy"),
    ):
        found[column] = (kind, rows[:, [names.index(column)]])
    return found


def length_of(x):
    largest = np.abs(x).max()
    return largest * np.linalg.norm(x / largest) if largest > 0 else 0.0  # squares of small numbers are zero


def differences(folder, other, scales=None):
    scales = scales or {}
    found = {}
    theirs = columns(other)
    for name, (kind, mine) in columns(folder).items():
        expected = theirs[name][1] * scales.get(kind, 1.0)
        if mine.shape != expected.shape:
            found[name] = np.inf
        elif length_of(expected) > 0 or length_of(mine) > 0:
            found[name] = length_of(mine - expected) / max(length_of(expected), 5e-324)
    return found


def not_finite(folder):
    """Names of files of a finished run with a number that is not finite."""
    found = []
    for file in sorted(folder.iterdir()):
        if file.suffix == ".csv":
            if not np.isfinite(np.loadtxt(file, delimiter=",", skiprows=1, ndmin=2)).all():
                found.append(file.name)
        elif file.suffix == ".h5":
            with h5py.File(file, "r") as opened:
                bad: list[str] = []

                def look(name, item, bad=bad):
                    if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and not np.isfinite(item[()]).all():
                        bad.append(name)

                opened.visititems(look)
                found += [f"{file.name}:{name}" for name in bad]
        elif file.suffix == ".json" and re.search(r"(?i)\b(nan|inf|null)\b", file.read_text()):
            found.append(file.name)
    return found


def methods(full):
    """Drivers with their settings and values: one thing varied at a time."""
    yield MONOLITHIC, (), {}
    yield PARTITIONED, (), {}
    yield MONOLITHIC, ("monolithic.linear_solver=direct",), {}
    yield PARTITIONED, ("partitioned.linear_solver=direct", "partitioned.scheme=iqn-ils"), {}
    for program in DRIVERS:
        yield program, (), dict(material="artery", scheme="euler")
        yield program, (), dict(element="p1", scheme="bdf2")
    if not full:
        return
    for program in DRIVERS:
        for scheme in TIME_SCHEMES:
            yield program, (), dict(scheme=scheme)
        for element in ("p1", "p2p1"):
            yield program, (), dict(element=element, geometry="3d")
            yield program, (), dict(element=element, geometry="3d", material="artery")
    for mode in ("kept", "full"):
        yield MONOLITHIC, (f"newton.mode={mode}",), {}
    for scheme in SCHEMES:
        for solver in ("fast", "direct"):
            settings = (f"partitioned.scheme={scheme}", f"partitioned.linear_solver={solver}")
            yield PARTITIONED, settings, dict(until=0.2, end=0.3)
    for solver in COUPLED_SOLVERS:
        settings = (f"monolithic.linear_solver={solver}", "structure.layer_pressure=continuous")
        yield MONOLITHIC, settings, dict(element="p1", geometry="3d", scheme="euler")


def loads(magnitudes, full):
    """Linear answers: against the one with a load that is a millionth of the artery's."""
    factors = (1e-3, 1e-6, 1e-14, 1e-30, 1e-90) if full else (1e-6, 1e-30)
    for program, settings, values in methods(full):
        reference = magnitudes.judge("load 1e-6", program, settings, **values)
        if reference is None:
            continue
        for factor in factors:
            scales = {kind: factor for kind in ("pressure", "length", "flow")} | {
                "energy": factor * factor,
                "elastic": factor * factor,
            }
            magnitudes.judge(
                f"load 1e-6 times {factor:g}, {values}",
                program,
                settings,
                other=reference,
                scales=scales,
                **{**values, "pressure": STANDARD["pressure"] * factor},
            )


def units(magnitudes, full):
    """The same scene in other units of length, time and mass: m, s, kg; cm, s, g; and changes of a million each, all
    combinations. With the last a run may be refused: norms of residuals add up rows of different units, and Newton's
    method or a linear solver does not get along with any of them. No answer may be wrong."""
    changes = [(1e-3, 1e-3, 1e-6), (0.1, 1e-3, 1e-3), (10, 1000, 1e-3)]
    must = len(changes)
    if full:
        changes += [(L, T, M) for L in (1e-6, 1, 1e6) for T in (1e-6, 1, 1e6) for M in (1e-6, 1, 1e6)]
    choices = list(methods(False)) if full else list(methods(False))[:2]
    for program, settings, values in choices:
        reference = magnitudes.judge("the units of the project", program, settings, **values)
        if reference is None:
            continue
        for place, (L, T, M) in enumerate(changes):
            v: dict[str, Any] = {**STANDARD, **values}
            pressure = M / (L * T**2)
            for name in ("pressure", "kappa", "c10", "c10_adventitia", "k1"):
                v[name] *= pressure
            for name in ("step", "end", "until"):
                v[name] *= T
            for name in ("rho", "rho_s"):
                v[name] *= M / L**3
            v["viscosity"] *= M / (L * T)
            magnitudes.judge(
                f"unit of length 1/{L:g}, time 1/{T:g}, mass 1/{M:g}, {values}",
                program,
                settings,
                other=reference,
                scales={
                    "pressure": pressure,
                    "length": L,
                    "flow": L**3 / T,
                    "energy": pressure * L**3,
                    "elastic": pressure * L**3,
                },
                length=L,
                may_refuse=place >= must,
                **v,
            )


def steps(magnitudes, full):
    """A pressure from rest: velocities grow like the time, displacements like its square, while that is short. At the
    reference's step sound, 290 mm/ms, goes a hundredth of an element."""
    first = 1e-6
    for program, settings, values in methods(full):
        values = {**values, "pressure": 1.332, "until": 1e9, "step": first, "end": 4 * first}
        reference = magnitudes.judge("step 1e-6", program, settings, **values)
        if reference is None:
            continue
        for step in (1e-7, 1e-9, 1e-12) if full else (1e-9,):
            t = step / first
            magnitudes.judge(
                f"step {step:g}, {values}",
                program,
                settings,
                other=reference,
                scales={"length": t * t, "flow": t, "energy": t * t, "elastic": t**4},
                may_refuse=any("amg" in s or "amli" in s for s in settings),  # the paper's multigrid at 1e-12 ms
                **{**values, "step": step, "end": 4 * step},
            )


def rest(magnitudes, full):
    """Without a load nothing moves."""
    for program, settings, values in methods(full):
        code, said, folder = magnitudes.run(program, settings, **{**values, "pressure": 0.0})
        moved = code == 0 and any(np.abs(x).max() > 0 for _, x in columns(folder).values())
        right = code == 0 and not moved and not not_finite(folder)
        magnitudes.harness.count(
            "right" if right else "wrong", f"no load [{program} {settings}]: {code} {said} {moved}"
        )


def constants(magnitudes, full):
    """Constants of any size: both drivers agree, or refuse."""
    extremes = {
        "k2": (5e-324, 1e-12, 1e3, 1e300) + ((1e-300, 1e-3, 1e6) if full else ()),
        "c10": (1e-6, 1e12) + ((1e-300, 1e-12, 1e6, 1e300) if full else ()),
        "rho": (1e-9, 1e9) + ((1e-300, 1e-30, 1e-3, 1e3, 1e300) if full else ()),
        "rho_s": (1e-9, 1e9) + ((1e-300, 1e-30, 1e3, 1e300) if full else ()),
        "viscosity": (1e-300, 1e6) + ((1e-30, 1e-9, 1e30, 1e300) if full else ()),
        "kappa": (1e12,) + ((1.0, 1e30, 1e300) if full else ()),
        "pressure": (1e3, 1e300) + ((5e-324, 1e-300, 1e-160, 1e-100, 1e30) if full else ()),
    }
    for name, values in extremes.items():
        for value in values:
            given = {name: value, "material": "artery"}
            if name == "k2":
                given["pressure"] = 1.0
            folder = magnitudes.judge(f"{name} = {value:g}", MONOLITHIC, may_refuse=True, **given)
            magnitudes.judge(f"{name} = {value:g}", PARTITIONED, other=folder, may_refuse=True, **given)


def explicit(magnitudes, full):
    """One pass a step: refused before the first step where its added mass makes it unstable. Else it is about as far from
    a scheme that iterates as the added mass over the wall's answer, a tenth at a density of 30 mg/mm^3 here. It claims
    nothing where the run ends before its check can speak."""
    count = magnitudes.harness.count
    for density, steps_made in itertools.product((0.1, 1.2, 30.0, 1e5), (1, 2, 4, 7, 8, 12) if full else (1, 12)):
        values = {"element": "p1", "scheme": "euler", "rho_s": density, "end": 0.1 * steps_made}
        code, said, folder = magnitudes.run(PARTITIONED, ("partitioned.scheme=explicit",), **values)
        name = f"explicit, density {density:g}, {steps_made} steps: {code}: {said.strip()}"
        if code == 2 and is_one_message(said, PARTITIONED) and "step 1 " in said and "added mass" in said:
            count("refused" if density < 2 else "wrong", name)
        elif code == 0 and density > 2:
            open_question = "unchecked" in summary(folder) and "claims nothing" in said
            reference = magnitudes.run(PARTITIONED, ("partitioned.scheme=iqn-ils",), **values)[2]
            apart = {name: d for name, d in differences(folder, reference).items() if name.endswith(".csv") and d > 0.2}
            right = open_question == (steps_made < 8) and not apart and not not_finite(folder)
            count("right" if right else "wrong", f"{name} {apart}")
        else:
            count("wrong", name)


GROUPS = {f.__name__: f for f in (loads, units, steps, rest, constants, explicit)}


def main():
    def prepare(parser):
        parser.add_argument("--only", choices=sorted(GROUPS), help="one group of runs")

    harness = Harness("magnitudes", __doc__.splitlines()[0], ("right", "refused"), prepare)
    magnitudes = Magnitudes(harness)
    for name, group in GROUPS.items():
        if harness.options.only in (None, name):
            group(magnitudes, harness.full)
    harness.finish()


if __name__ == "__main__":
    main()
