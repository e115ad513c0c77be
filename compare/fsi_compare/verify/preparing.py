"""What is settled before a family is run: its members, the samples it is judged by, whether it fits the budget."""

import argparse
from pathlib import Path
from typing import Any, Sequence

import numpy as np

from ..base.errors import InputError
from ..base.files import is_file
from ..gallery.mesh_chain import READ
from ..results.fields import read_fields
from ..runs.columns import ITERATIONS
from ..starting.duration import duration
from .adapting import Adapted, about_adapted, nodes_of
from .artery_sizes import keeps_short_waves
from .family import CaseFacts, Member, members, mesh_ratio
from .making import Maker
from .mesh_family import Recipe, mesh_file_of
from .quantities import curves_of
from .direction import OUTSIDE
from .results import FamilyRuns, Judged

STAYS = (
    "Curved surfaces stay where the mesh file has them, however fine the elements become: what the vessel's shape is off by is in "
    "no bar. It is where the meshes are made of the shape: "
)
SHAPE = STAYS + '--mesh "geo SCRIPT.geo".'
ADAPTED = STAYS + "by the commands of --mesh, without --adapt."
SURFACE = "The vessel is the smoothed surface: what that is off by, and what its smoothing and its triangles leave, is in no bar."
OTHER_NODES = 0.05  # of a mesh's nodes: what another version of gmsh may make more or fewer of
TRIED = 0.25  # of the budget, that a member may take before the family is known to fit
# Of standard samples: fields by medium, and significant digits of a coordinate, as a case file has them.
FIELDS, DIGITS = {"wall": "displacement", "fluid": "velocity"}, 9
PRINTED = (SHAPE, ADAPTED, SURFACE)  # with the bars, not only in the report


def plan(recipe: Recipe, facts: CaseFacts, options: argparse.Namespace) -> list[Member]:
    ratio = mesh_ratio(recipe, options.levels, not options.coarser)
    if recipe.adapts and options.coarser:
        raise InputError("", "--adapt", "makes finer meshes only", "leave --coarser out")
    if not recipe.coarsens and options.coarser:
        problem = "a mesh file alone has no coarser ones"
        raise InputError(facts.path, "mesh.file", problem, 'say how it is made: --mesh "geo SCRIPT.geo"')
    levels = options.levels if recipe.coarsens or recipe.adapts else 3
    return members(recipe, facts, ratio, levels, not options.coarser)


OWN = Member(1.0, 1.0)


def sample(maker: Maker, start: Member = OWN) -> Member:
    """Adds standard samples where the case has none, and says which. `start`: the member to run first; returns it, or
    the user's own where it fails. Raises InputError where that fails, too, or has no fields to choose by."""
    maker.run([start])
    run = next(iter(maker.families.values())).runs[start]
    if not run.done and start != OWN:
        maker.note(f"begins with the case's own settings, for the coarser run is missing: {run.message or run.status}")
        return sample(maker)
    if curves_of(run.folder):
        return start
    points = standard_points(run.folder)
    if not points:
        raise samples_nothing(maker.requests.facts)
    maker.begin_again(points)
    places = "; ".join(f"{key.rpartition('.')[2]} = {value}" for key, value in points.items())
    maker.note(f"the case samples nothing; points are taken where most happens at its end: {places}")
    return start


def standard_points(folder: Path) -> dict[str, Any]:
    """Entries of a case by their full keys, from the fields of its own run; empty where it has written none. A point
    lies in the middle of the element whose nodes move most together, so that finer meshes have it inside, too."""
    found: dict[str, Any] = {}
    for medium, fields in read_fields(folder).items():
        field = FIELDS.get(medium, "")
        if field not in fields.names:
            continue
        times = fields.times_of(field)
        values = np.asarray(fields.at(float(times[-1]), field), dtype=float)
        corners = fields.cells[:, : 3 if fields.cells.shape[1] in (3, 6) else 4]
        sizes = np.linalg.norm(values.reshape(len(values), -1), axis=1)
        cell = int(np.argmax(np.mean(sizes[corners], axis=1)))
        middle = np.mean(fields.points[corners[cell]], axis=0)
        found[f"output.points.{medium}_most"] = [float(f"{x:.{DIGITS}g}") for x in middle]
    return found


def samples_nothing(facts: CaseFacts) -> InputError:
    return InputError(facts.path, "output", "samples nothing", "ask for a point: [output.points] with NAME = [x, y, z]")


def within_budget(options: argparse.Namespace, maker: Maker, family: Sequence[Member]) -> Sequence[Member]:
    """The family, or where it does not fit one without members finer than the case. Raises InputError if neither
    does."""
    budget = 60 * options.budget
    maker.run([member for member in family if member.is_own])
    if maker.seconds + maker.predicted(family) <= budget:
        return family
    requests = maker.requests
    _try_out(maker, family, budget)
    whole = maker.seconds + maker.predicted(family)
    if whole <= budget:
        return family
    if requests.recipe.coarsens and not options.coarser:
        options.coarser = True
        cheaper = plan(requests.recipe, requests.facts, options)
        if maker.seconds + maker.predicted(cheaper) <= budget:
            maker.note(f"no member is finer than the case: with them the family would take about {duration(whole)}")
            return cheaper
        whole = maker.seconds + maker.predicted(cheaper)
    problem = f"{options.budget:g} min are too short: the cheapest family takes about {duration(whole)}"
    raise InputError("", "--budget", problem, f"give {whole / 60:.2g} or more, or a coarser case")


def _try_out(maker: Maker, family: Sequence[Member], budget: float) -> None:
    """Runs members of other meshes, from the cheapest, while one is predicted to take little of the budget: how seconds
    grow with the mesh is measured, not assumed, before a family is refused."""
    for member in sorted((m for m in family if m.step == 1 and not (m.looser or m.other)), key=lambda m: -m.mesh):
        if maker.predicted([member]) > TRIED * budget or maker.seconds + maker.predicted([member]) > budget:
            return
        maker.run([member])


def tell_damped(maker: Maker) -> None:
    """Tells that mesh.error is for other steps than the case's, where the case says so itself (mesh.waves). No driver
    does: runs of the family have the mesh as a file."""
    entries = maker.requests.facts.entries
    mesh = entries.get("mesh", {})
    if "error" in mesh and mesh.get("waves") == "damped" and keeps_short_waves(entries):
        maker.note(
            f"mesh.error = {mesh['error']} is for damped waves, of euler and 1/8 ms; the case's steps keep waves that this mesh "
            "does not resolve: without mesh.waves it is one that does"
        )


def tell_other_mesh(maker: Maker) -> None:
    """Tells that the family is built around another mesh than the case's file, as their numbers of nodes show."""
    facts, recipe = maker.requests.facts, maker.requests.recipe
    file = mesh_file_of(facts.path, facts.entries)
    made = maker.nodes(1.0) if is_file(file) else None
    if made is None:
        return
    try:
        there = nodes_of(file)
    except InputError:  # no mesh of gmsh, of which no run is made here
        return
    if abs(made - there) > OTHER_NODES * there:
        words = f"geo {recipe.geo.script.name} --set NAME=VALUE" if recipe.geo is not None else "WORDS"
        maker.note(
            f"{file.name} has {there} nodes, the mesh that the family is built around {made}: the bars are of runs on that "
            f'one; say how the file was made: --mesh "{words}"'
        )


def tell_mesh(maker: Maker, recipe: Recipe) -> None:
    """Tells what the family's meshes come from, unless that was told already."""
    tell_damped(maker)
    if isinstance(recipe, Adapted):
        maker.notes.append(about_adapted(recipe))
        maker.notes += [] if recipe.remakes else [ADAPTED if recipe.base.chain else SHAPE]
        return
    if recipe.command == "refine":
        made = f"{recipe.file} and what fsi-mesh refine makes of it; none is coarser than the case's own."
        maker.notes += [f"Meshes: {made}", SHAPE]
    elif recipe.chain:
        made = f"fsi-mesh {shown(recipe.words)}; of each command what it has of sizes, finer and coarser."
        maker.notes += [f"Meshes: {made}", *([] if recipe.words[0] == "geo" else [SURFACE])]
    else:
        words = [recipe.geo.script.name] if recipe.geo is not None else []
        maker.notes.append(f"Meshes: fsi-mesh {' '.join([recipe.command, *words, *recipe.words])}, finer and coarser.")


def shown(words: Sequence[str]) -> str:
    """Files by their last names."""
    return " ".join(Path(word).name if word.endswith(READ) else word for word in words)


def tell_unpaid(maker: Maker, judged: Sequence[Judged]) -> None:
    """Tells which curves further adaptation has not brought nearer: their meshes are adapted to something else."""
    if not isinstance(maker.requests.recipe, Adapted):
        return
    curves = [one for one in judged if one.quantity.whole is not None and not one.quantity.whole.largest]
    apart = [one for one in curves if one.bar.mesh.state == OUTSIDE and not one.bar.mesh.lacking]
    unpaid = sorted({one.quantity.curve for one in apart})
    if unpaid:
        maker.note(
            f"the last adaptation has not paid for {', '.join(unpaid)}: they changed by as much as by the one before. The coarser "
            "mesh is as good for these; fsi-mesh adapt --of velocity, displacement or pressure makes one for that quantity"
        )


def tell_ends(maker: Maker, families: Sequence[FamilyRuns], times: Sequence[float]) -> None:
    """Tells that time.periods has ended members at different times, or before `times` in ms that are asked for."""
    periodic = "periods" in maker.requests.facts.entries.get("time", {})
    runs = [run for family in families for run in family.done.values() if periodic]
    ends = sorted(float(run.columns(ITERATIONS)["time_ms"][-1]) for run in runs)
    if ends and ends[-1] > ends[0] * (1 + 1e-9):
        maker.note(
            f"time.periods ends members at {ends[0]:g} to {ends[-1]:g} ms: values at the end and of the last period are of "
            f"each one's own end, norms over time of other spans; for one span leave it out, with time.end = {ends[-1]:g}"
        )
    late = [f"{time:g}" for time in times if ends and time > ends[0]]
    if late:
        maker.note(
            f"time.periods ends a member at {ends[0]:g} ms, before {', '.join(late)} ms of --times: no bar holds there"
        )


def tell_unrefined(maker: Maker, families: Sequence[FamilyRuns]) -> Sequence[str]:
    """Tells that layers of the wall have as many elements in all meshes of the family. Returns the sentences."""
    sizes = sorted({member.mesh for family in families for member in family.done})
    kept = maker.requests.recipe.unrefined(sizes, maker.requests.folder) if len(sizes) > 1 else {}
    if not kept:
        return []
    layers = ", ".join(f"{name}: {number}" for name, number in kept.items())
    return [
        f"Elements through the wall's layers are as many in all meshes ({layers}): what these leave is in no bar. It is where a "
        "layer has two or more, --layer NAME=THICKNESS:2."
    ]
