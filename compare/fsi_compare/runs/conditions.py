"""On what a run was made, as far as its result folder tells: mesh, time step, length. Runs that differ in these differ
in their waves for that reason too, whatever else is compared."""

from dataclasses import dataclass
from typing import Sequence

import numpy as np

from ..base.errors import printable
from .run_folder import Run

SAME = 1e-6  # relative: times that are nearer were written with different round-off


@dataclass(frozen=True)
class Conditions:
    mesh: str  # in words; empty: not recorded
    mesh_identity: str | None  # equal for equal meshes; None: not recorded
    smallest_step: float  # ms
    largest_step: float  # ms; greater where a restart changed it
    end: float  # ms

    @property
    def step_words(self) -> str:
        if self.largest_step - self.smallest_step <= SAME * self.largest_step:
            return f"step {self.largest_step:g} ms"
        return f"steps of {self.smallest_step:g} to {self.largest_step:g} ms"


def conditions(run: Run) -> Conditions:
    """Reads them from `summary.json` and the time levels of the pressure; a run of one level began at rest at zero."""
    mesh = run.summary.get("mesh", {})
    nodes = mesh.get("nodes")
    parts = [printable(mesh.get("name", "")), f"{nodes} nodes" if nodes is not None else ""]
    identity = mesh.get("hash", nodes)
    times = run.pressure.times
    steps = np.diff(times) if len(times) > 1 else times
    return Conditions(
        mesh=", ".join(part for part in parts if part),
        mesh_identity=None if identity is None else str(identity),
        smallest_step=float(np.min(steps)),
        largest_step=float(np.max(steps)),
        end=float(times[-1]),
    )


def departures(found: Sequence[Conditions], labels: Sequence[str]) -> list[str]:
    """A sentence, without its full stop, for each of mesh, step and length in which runs differ, naming each run's."""

    def differ(values: Sequence[float]) -> bool:
        return max(values) - min(values) > SAME * max(values)

    def listed(words: Sequence[str]) -> str:
        return "; ".join(f"{label}: {word}" for label, word in zip(labels, words))

    sentences = []
    if len({one.mesh_identity for one in found if one.mesh_identity is not None}) > 1:
        shown = listed([one.mesh or "not recorded" for one in found])
        sentences.append(f"the runs' meshes differ ({shown}): so do their waves, by the error of the coarser mesh")
    if differ([one.smallest_step for one in found]) or differ([one.largest_step for one in found]):
        shown = listed([one.step_words for one in found])
        sentences.append(f"the runs' time steps differ ({shown}): so do their waves, by the error of the longer step")
    if differ([one.end for one in found]):
        shown = listed([f"{one.end:g} ms" for one in found])
        sentences.append(f"the runs' lengths differ ({shown}): what is said of all levels holds for the common ones")
    return sentences
