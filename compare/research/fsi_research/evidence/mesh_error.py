"""How far a run's wave is from the artery's own: the error of mesh and time step, as the accuracy study measures it."""

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Callable, Dict, Mapping, Optional, Sequence, Tuple

from fsi_compare.base.case_names import with_present_names
from fsi_compare.base.errors import InputError
from fsi_compare.base.files import is_file, read_toml
from ..catalogue.names import MATERIALS
from fsi_compare.study.mesh_levels import MESHES
from fsi_compare.reporting.column import Column
from fsi_compare.reporting.layout import Table
from fsi_compare.study.section import flat
from fsi_compare.study.study_run import StudyRun
from fsi_compare.runs.reference import FILE, WaveReference, read_reference
from fsi_compare.runs.waves import DISPLACEMENT, PRESSURE, WRITTEN, read_waves, relative_difference

REFERENCES = Path(__file__).resolve().parents[2] / "studies" / "references"

# Entries of a case that leave the continuous problem as it is: how it is cut into elements and steps, how the equations
# are solved, and what is written. All others must be the reference's.
SOLVING = ("newton", "linear", "monolithic", "partitioned", "economy")
NUMERICAL = ("title", "element", "stabilisation", *SOLVING, "output", "mesh", "time")
STABILISATION = "structure.stabilisation"
DISCRETE = (STABILISATION, "structure.layer_pressure")
PRESSURE_HEAD, RADIAL_HEAD = "centre-line pressure", "radial displacement"
TUBES = ("3d", "axisymmetric")  # values of `geometry` in which the artery is the same body


@dataclass(frozen=True)
class MeshError:
    """Relative L2 errors over the centre line, or the wall's inner face, and the reference's levels; None: unknown."""

    pressure: Optional[float]
    displacement: Optional[float]  # radial
    unknown: str = ""  # why there are none
    own_pressure: Optional[float] = None  # the reference's own error, estimated
    own_displacement: Optional[float] = None

    @property
    def words(self) -> str:
        """For a caption that has named the error of mesh and step before."""
        if self.pressure is None or self.displacement is None:
            return f"unknown ({self.unknown})"
        return f"{percent(self.pressure)} in pressure, {percent(self.displacement)} in radial displacement"


def error_words(errors: Sequence[Tuple[str, MeshError]]) -> str:
    """`(name, error)` of each wave as a sentence for a caption; what is the same for all is said once."""
    words = [error.words for _, error in errors]
    if len(set(words)) == 1:
        return f"Error of mesh and step: {words[0]}."
    return "Error of mesh and step: " + "; ".join(f"{name} {error.words}" for name, error in errors) + "."


def percent(value: float) -> str:
    return f"{100 * value:.2g} %" if value < 1 else f"{100 * value:.0f} %"


def physical(case: Mapping[str, Any], settings: Optional[Mapping[str, Any]] = None) -> Dict[str, Any]:
    """What of a case file's entries, and of settings over them, states the continuous problem: dotted key -> value."""
    entries = {**dict(flat(case)), **(settings or {})}
    return {
        key: value
        for key, value in entries.items()
        if key.partition(".")[0] not in NUMERICAL and key not in DISCRETE and not (key == "geometry" and value in TUBES)
    }


@lru_cache(maxsize=None)
def references(folder: Path = REFERENCES) -> Dict[str, WaveReference]:
    """The kept references, by material."""
    return {name: read_reference(folder / name) for name in MATERIALS if is_file(folder / name / FILE)}


def mesh_error(run: StudyRun) -> MeshError:
    """Against the reference with the same physical entries, over those of its levels that the run must reach."""
    request = run.request
    mesh = request.mesh.name if request.mesh else None
    try:
        case = with_present_names(read_toml(request.case_file, "", ""))
    except InputError:
        return MeshError(None, None, "its case file cannot be read")
    section = case.get("mesh")
    made = request.settings.get("mesh.error")
    if mesh is None and isinstance(section, dict):
        mesh = section.get("level")
        made = made or section.get("error")
    if (mesh not in MESHES and not made) or "mesh.file" in request.settings or (request.mesh and request.mesh.options):
        return MeshError(None, None, "its mesh is not one of the artery made on demand, for which the references are")
    own = physical(case, request.settings)
    known = references()
    reference = next((one for one in known.values() if one.case == own), None)
    if reference is None:
        return MeshError(None, None, _departure(own, known))
    errors = {}
    for quantity in WRITTEN:
        try:
            waves = read_waves(run.folder / quantity.file, quantity.column)
        except InputError:
            return MeshError(None, None, f"{quantity.file} is missing or incomplete")
        kept = reference.waves[quantity.column]
        if not (waves.covers(kept.times[0]) and waves.covers(kept.times[-1])):
            return MeshError(
                None,
                None,
                f"the reference runs from {kept.times[0]:g} to {kept.times[-1]:g} ms, this run from "
                f"{waves.times[0]:g} to {waves.times[-1]:g} ms",
            )
        errors[quantity.column] = relative_difference(waves, kept, [float(time) for time in kept.times])
    return MeshError(
        errors[PRESSURE.column],
        errors[DISPLACEMENT.column],
        "",
        reference.own_error[PRESSURE.column],
        reference.own_error[DISPLACEMENT.column],
    )


def _departure(own: Mapping[str, Any], known: Mapping[str, WaveReference]) -> str:
    """The entries in which a case departs from the reference nearest to it."""
    if not known:
        return "there is no reference"
    different = [
        sorted(key for key in {*own, *one.case} if own.get(key) != one.case.get(key)) for one in known.values()
    ]
    nearest = min(different, key=len)
    shown = [f"{key} = {own[key]}" if key in own else f"no {key}" for key in nearest[:2]]
    return f"no reference for {', '.join(shown)}" + (" and more" if len(nearest) > 2 else "")


Wave = Tuple[StudyRun, MeshError]


def _error(name: str, csv: str, group: str, value: Callable[[MeshError], Optional[float]]) -> Column[Wave]:
    return Column(name, csv, lambda w: value(w[1]), lambda e: f"{100 * e:.2g}", group=group, missing="unknown")


def _mesh_words(run: StudyRun) -> str:
    mesh = run.request.mesh.name if run.request.mesh else ""
    factor = run.request.settings.get(STABILISATION)
    return mesh if factor is None else f"{mesh}, stabilisation {factor:g}"


ERRORS: Sequence[Column[Wave]] = (
    Column(
        "case",
        "case",
        lambda w: w[0].request.case,
        text=lambda w: MATERIALS.get(w[0].request.case, w[0].request.case),
        left=True,
    ),
    Column("mesh", "mesh", lambda w: _mesh_words(w[0]), left=True),
    Column("method", "method", lambda w: w[0].request.method.name, text=lambda w: w[0].method_label, left=True),
    _error("error", "pressure_relative_L2", PRESSURE_HEAD, lambda e: e.pressure),
    _error("reference's own", "pressure_reference_own", PRESSURE_HEAD, lambda e: e.own_pressure),
    _error("error", "radial_relative_L2", RADIAL_HEAD, lambda e: e.displacement),
    _error("reference's own", "radial_reference_own", RADIAL_HEAD, lambda e: e.own_displacement),
    Column(csv="unknown_because", value=lambda w: w[1].unknown),
)


def error_table(runs: Sequence[StudyRun], errors: Sequence[MeshError]) -> Table:
    """A line per run, with the reference's own error beside it."""
    reasons = dict.fromkeys(error.unknown for error in errors if error.unknown)
    return Table(
        "mesh_error",
        "How far the waves are from the reference, in percent: the error of mesh and time step",
        ERRORS,
        list(zip(runs, errors)),
        notes=[
            "Relative L2 norm over the line and the reference's time levels, as in the study `accuracy-cost`. The "
            "references are axisymmetric and finer in mesh and step than any run here; how each was made stands in its "
            "reference.json. Their own error is an estimate.",
            *(f"unknown: {reason}" for reason in reasons),
        ],
    )
