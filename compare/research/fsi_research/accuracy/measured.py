"""A finished run with its errors and seconds, as accuracy-cost compares them."""

from dataclasses import dataclass
from typing import Dict, Iterable, List, Mapping, Optional, Sequence, Tuple

from fsi_compare.base.case_names import short_name
from fsi_compare.runs.coupling import coupling_kind
from fsi_compare.runs.waves import AVERAGED, DISPLACEMENT, QUANTITIES, Waves, read_run, relative_difference
from fsi_compare.runs.work_units import in_all
from fsi_compare.study.study_file import Request, show
from fsi_compare.study.study_run import StudyRun
from .plan import Plan

JUDGED = (AVERAGED, DISPLACEMENT)  # by which settings are chosen; the raw pressure is stated beside them

SOLVERS = ("newton.", "linear.", "monolithic.", "partitioned.")
SOLVING = (*SOLVERS, "output.")  # settings that leave the discrete equations as they are
GAIN = 0.02  # a slower setting whose total error is smaller by less than this part is no better
STEP, SCHEME, STABILISATION = "time.step", "time.scheme", "structure.stabilisation"
ELEMENT, GEOMETRY, KIND, LAYER_PRESSURE = "element", "geometry", "stabilisation", "structure.layer_pressure"


def discretisation(request: Request) -> Tuple:
    """What the discrete equations depend on: equal for runs that differ in their solvers only."""
    settings = {key: value for key, value in request.settings.items() if not key.startswith(SOLVING)}
    return (
        request.case,
        request.mesh.name if request.mesh else "",
        tuple(sorted((k, str(v)) for k, v in settings.items())),
    )


@dataclass(frozen=True, eq=False)
class Measured:
    run: StudyRun
    waves: Mapping[str, Waves]  # by quantity's column
    total: Mapping[str, float]  # relative L2 error against the reference, by quantity's column
    algebraic: Mapping[str, float]  # the same against the tight solution of the same equations; empty: there is none

    @property
    def seconds(self) -> float:
        return self.run.wall_s

    @property
    def work_units(self) -> Optional[float]:
        return in_all(self.run.summary)

    @property
    def step(self) -> float:  # ms
        return float(self.run.request.settings[STEP])

    @property
    def nodes(self) -> int:
        return int(self.run.summary.get("mesh", {}).get("nodes", 0))

    @property
    def mesh(self) -> str:
        mesh = self.run.request.mesh
        return mesh.name if mesh else "of the case"

    @property
    def mesh_label(self) -> str:
        mesh = self.run.request.mesh
        return mesh.label if mesh else "of the case"

    @property
    def partitioned(self) -> bool:
        return self.run.request.method.program == "fsi-partitioned"

    @property
    def kind(self) -> str:
        """Kind of coupling; where the run does not say it, the driver."""
        return coupling_kind(self.run.summary) or ("partitioned" if self.partitioned else "monolithic")

    @property
    def worst(self) -> float:
        """The larger of the total errors of averaged pressure and displacement."""
        return max(self.total[q.column] for q in JUDGED)

    @property
    def worst_of_all(self) -> float:
        """The raw pressure's too."""
        return max(self.total.values())

    @property
    def worst_algebraic(self) -> float:
        return max(self.algebraic.values()) if self.algebraic else float("nan")

    @property
    def discretisation(self) -> Tuple:
        return discretisation(self.run.request)

    @property
    def equations(self) -> str:
        """Mesh, step, element and what else makes the equations in words, as far as the study sets it."""
        settings = self.run.request.settings
        alpha = settings.get(STABILISATION)
        words = [f"{self.mesh_label} mesh", f"step {self.step:g} ms"]
        words += [str(settings[key]) for key in (SCHEME, ELEMENT, GEOMETRY) if key in settings]
        words += [f"{settings[KIND]} stabilisation"] if KIND in settings else []
        words += [f"{settings[LAYER_PRESSURE]} layer pressure"] if LAYER_PRESSURE in settings else []
        return ", ".join(words + ([f"stabilisation {show(alpha)}"] if alpha is not None else []))

    @property
    def solving(self) -> str:
        """Method and what is set beside it."""
        request = self.run.request
        varied = [
            f"{short_name(key).replace('_', ' ')} {show(value)}"
            for key, value in request.settings.items()
            if key.startswith(SOLVERS) and (key.endswith("tolerance") or request.method.settings.get(key) != value)
        ]
        return ", ".join([self.run.method_label, *varied])

    @property
    def words(self) -> str:
        return f"{self.equations}, {self.solving}"


def measure(runs: Iterable[StudyRun], plan: Plan) -> List[Measured]:
    """The finished runs in their order, each once."""
    done: Dict[str, StudyRun] = {}
    for run in runs:
        if run.done:
            done.setdefault(str(run.folder), run)
    waves = {key: read_run(run.folder, plan.times(run.request.case)) for key, run in done.items()}
    tight = {
        discretisation(run.request): waves[key] for key, run in done.items() if run.request.method.name == plan.tight
    }
    found = []
    for key, run in done.items():
        case = run.request.case
        times = plan.times(case)
        exact = tight.get(discretisation(run.request))
        own = waves[key]
        found.append(
            Measured(
                run,
                own,
                {
                    q.column: relative_difference(own[q.column], plan.references[case].waves[q.column], times)
                    for q in QUANTITIES
                },
                _against(own, exact, times) if run.request.method.name != plan.tight else {},
            )
        )
    return found


def _against(
    own: Mapping[str, Waves], exact: Optional[Mapping[str, Waves]], times: Sequence[float]
) -> Dict[str, float]:
    if exact is None:
        return {}
    return {q.column: relative_difference(own[q.column], exact[q.column], times) for q in QUANTITIES}
