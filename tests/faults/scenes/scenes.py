"""Random scenes: both drivers solve them by their defaults and agree.

Densities of wall and fluid, stiffness, viscosity, step, material, time scheme, element and geometry are drawn from ranges
that are far wider than those of vessels. No step may be halved. A scene is `right` when both drivers solve its six steps
and their displacements agree to 1e-4, `unsolved` when one of them ends with a message and exit code 2. It is `without
solution` when both end in one step, and both walked to it through shorter ones whose solutions end at one length: two ways to
solve the equations then say that the step is too long for them, not for one way. Where answers differ,
each solves the scene again from another start and by new Jacobians. Answers of one driver that differ as well show that
the equations of a step have several solutions, as those of Saint-Venant and Kirchhoff's law have under compression; the
scene is `ambiguous` then, if that is one of few. Any other difference, or an answer by one whose numbers are not finite, is
wrong; so is a driver that leaves more than its part unsolved.
"""

import itertools
import math
import random
import re
from typing import Any, NamedTuple

import numpy as np
from harness import DRIVERS, Harness, execute, is_message

CASE = """
title = "a random scene"
element = "{element}"
geometry = "{geometry}"
[mesh]
file = "{mesh}"
[fluid]
density = {rho!r}
viscosity = {viscosity!r}
[structure]
density = {rho_s!r}
{bulk}
[structure.layers.media]
{media}
[structure.layers.adventitia]
{adventitia}
[inlet]
pressure = {pressure!r}
until = {until!r}
[time]
step = {step!r}
end = {end!r}
scheme = "{scheme}"
retries = 0
[newton]
tolerance = 1e-8
[output]
every = 0
"""
MESHES = {"section": ["--axisymmetric"], "quarter": ["--around", 16, "--sector", 90], "whole": ["--around", 16]}
MATERIALS = ("neo-hookean", "mooney-rivlin", "artery", "saint-venant-kirchhoff")
SCHEMES = ("euler", "midpoint", "bdf2", "generalised-alpha", "tr-bdf2")
STEPS = 6
BOUND = 1e-4  # relative difference of displacements
UNSOLVED = 0.01  # part of the scenes that a driver may leave unsolved
WITHOUT = 0.05  # part of the scenes whose steps may be too long to have a solution
AMBIGUOUS = 0.05  # part of the scenes that may have several solutions
# What a driver says of a step that it could not solve: which, the longest that has a solution, the next one that has none.
ENDS = re.compile(r"step (\d+) \(.* a step of (\S+) ms has a solution, none of (\S+) ms was found")
OTHER_WAYS = ("time.predictor=0", "newton.mode=full")


def layer(material, stiffness, first):
    """Constants of the artery's layers, kPa, times the stiffness."""
    c10 = (3.0 if first else 0.3) * stiffness
    lines = {
        "neo-hookean": [f"c10 = {c10!r}"],
        "mooney-rivlin": [f"c10 = {c10!r}", f"c01 = {0.1 * c10!r}"],
        "artery": [
            f"c10 = {c10!r}",
            f"k1 = {(2.3632 if first else 0.562) * stiffness!r}",
            f"k2 = {0.8393 if first else 0.7112}",
            f"alpha = {29.0 if first else 62.0}",
        ],
        "saint-venant-kirchhoff": [f"young = {6 * c10!r}", "poisson = 0.4"],
    }
    return "\n".join([f'material = "{material}"', *lines[material]])


def scene(choose):
    """Values of a case."""

    def between(low, high):
        return math.exp(choose.uniform(math.log(low), math.log(high)))

    stiffness, material = between(0.03, 30), choose.choice(MATERIALS)
    shape, step = choose.choice(list(MESHES)), between(1 / 128, 4)
    return dict(
        shape=shape,
        element=choose.choice(("p1", "p2p1")),
        geometry="axisymmetric" if shape == "section" else "3d",
        rho=between(0.1, 10),
        viscosity=between(3e-5, 1),
        rho_s=between(0.003, 300),
        bulk="" if material == "saint-venant-kirchhoff" else "bulk_modulus = 1e5",
        media=layer(material, stiffness, True),
        adventitia=layer(material, stiffness, False),
        pressure=1.332 * min(1, stiffness),
        until=max(0.125, step),
        step=step,
        end=STEPS * step,
        scheme=choose.choice(SCHEMES),
    )


class Scenes:
    def __init__(self, harness):
        self.harness = harness
        self.scheme = harness.options.scheme
        self.unsolved = {program: 0 for program in DRIVERS}
        self.runs = itertools.count()

    def mesh(self, shape, element):
        """A tube of 6 mm."""
        order = 2 if element == "p2p1" else 1
        file = self.harness.base / f"{shape}-{order}.msh"
        if not file.exists():
            cells: list[Any] = ["--lumen-cells", 2, "--media-cells", 1, "--adventitia-cells", 1, "--axial-cells", 6]
            words = ["--length", 6, *cells, *MESHES[shape], "--order", order]
            made = execute(self.harness.program("fsi-mesh"), "artery", "-q", "-o", file, *words)
            if made.returncode != 0:
                raise SystemExit(f"cannot make the mesh: {made.stderr}")
        return file

    def solve(self, program, case, folder, *settings):
        """Displacements of the wall, or where solutions end, or None; what is wrong."""
        words = [case, "-o", folder, "-q", "--threads", 1]
        if self.scheme and program == "fsi-partitioned":
            settings = (*settings, f'partitioned.scheme="{self.scheme}"')
        for setting in settings:
            words += ["--set", setting]
        process = execute(self.harness.program(program), *words, timeout=600)
        if process.returncode == 2 and is_message(process.stderr, program):
            ends = ENDS.search(process.stderr)
            return (End(int(ends[1]), float(ends[2]), float(ends[3])) if ends else None), ""
        if process.returncode != 0:
            return None, f"{program}: exit code {process.returncode}: {process.stderr.strip()}"
        moved = np.loadtxt(folder / "wall_displacement.csv", delimiter=",", skiprows=1)[:, 2:]
        return moved, "" if np.isfinite(moved).all() else f"{program}: not finite"

    def judge(self, values):
        number = next(self.runs)
        case = self.harness.base / f"{number}.toml"
        case.write_text(CASE.format(mesh=self.mesh(values["shape"], values["element"]), **values))
        answers, faults = [], []
        for program in DRIVERS:
            moved, fault = self.solve(program, case, self.harness.base / f"{number}-{program}")
            answers.append(moved)
            faults += [fault] if fault else []
        name = f"scene {number}: {values}"
        if faults:
            return self.harness.count("wrong", f"{name}: {'; '.join(faults)}")
        whole, parts = answers
        if isinstance(whole, End) and isinstance(parts, End) and whole.is_that_of(parts):
            print(f"solutions end: {name}: in step {whole.step}, {whole.solved} to {whole.failed} ms", flush=True)
            return self.harness.count("without solution", name)
        for program, answer in zip(DRIVERS, answers):
            self.unsolved[program] += not isinstance(answer, np.ndarray)
        if not all(isinstance(answer, np.ndarray) for answer in answers):
            print(
                f"unsolved: {name}: {whole if isinstance(whole, End) else ''} {parts if isinstance(parts, End) else ''}"
            )
            return self.harness.count("unsolved", name)
        apart = distance(whole, parts)
        if apart <= BOUND:
            return self.harness.count("right", name)
        ambiguous = any(self.has_several(program, case, answer) for program, answer in zip(DRIVERS, answers))
        if ambiguous:
            print(f"several solutions: {name}: {apart:.1e} apart", flush=True)
        self.harness.count("ambiguous" if ambiguous else "wrong", f"{name}: {apart:.1e} apart")

    def has_several(self, program, case, answer):
        """Whether a driver that goes another way comes to another answer of its own."""
        for number, setting in enumerate(OTHER_WAYS):
            other, fault = self.solve(program, case, case.parent / f"{case.stem}-{program}-{number}", setting)
            if isinstance(other, np.ndarray) and not fault and distance(answer, other) > BOUND:
                return True
        return False


class End(NamedTuple):
    """Where the solutions of a step end: the longest length that has one and the next that has none, ms."""

    step: int
    solved: float
    failed: float

    def is_that_of(self, other):
        """Whether another walk ended there too: the same step, and lengths with a part in common, or as good as that."""
        return self.step == other.step and max(self.solved, other.solved) <= 1.02 * min(self.failed, other.failed)


def distance(one, other):
    """Largest difference of two answers, relative to the largest value."""
    return np.abs(one - other).max() / (np.abs(one).max() or 1)


def main():
    def prepare(parser):
        parser.add_argument("--scenes", type=int, help="how many; 12 unless given, 60 with --full")
        parser.add_argument("--scheme", help="of the partitioned driver; what it chooses unless given")

    harness = Harness(
        "scenes", __doc__.splitlines()[0], ("right", "unsolved", "without solution", "ambiguous"), prepare
    )
    scenes, choose = Scenes(harness), random.Random(harness.options.seed)
    count = harness.options.scenes or (60 if harness.full else 12)
    for _ in range(count):
        scenes.judge(scene(choose))
    for program, unsolved in scenes.unsolved.items():
        print(f"{program}: {unsolved} of {count} scenes unsolved")
        if unsolved > max(1, UNSOLVED * count):
            harness.count("too many unsolved", program)
    if harness.counts["without solution"] > max(1, WITHOUT * count):
        harness.count("too many without solution", f"{harness.counts['without solution']} of {count}")
    ambiguous = harness.counts["ambiguous"]
    if ambiguous > max(1, AMBIGUOUS * count):
        harness.count("too many ambiguous", f"{ambiguous} of {count}")
    harness.finish()


if __name__ == "__main__":
    main()
