"""One run of a study: what was asked for, how it ended, and its files."""

import functools
from dataclasses import dataclass
from pathlib import Path

from ..base.errors import InputError
from ..base.files import is_file, read_object
from ..runs.coupling import chosen_scheme, coupling_kind
from ..runs.columns import Columns, read_columns
from ..runs.pressure_waves import PressureWaves
from ..runs.run_folder import ALONG_AXIS, pressure_file, read_pressure
from ..runs.samples import CENTRE_LINE, requested_line, waves_along
from ..runs.summary import FILE, checked
from ..runs.work_units import per_step
from .study_file import Request

DONE = "done"
NOT_CONVERGED = "not converged"  # exit code 2
REFUSED = "refused"  # exit code 1: bad input
CRASHED = "crashed"  # a signal, or an exit code that no program of ours has
OUT_OF_TIME = "out of time"
WRONG = "not finite"  # it says done, and a result file holds NaN or infinity


@dataclass(frozen=True)
class StudyRun:
    request: Request
    folder: Path
    status: str  # one of the above
    message: str  # why it is not done
    seconds: float  # of the process, start to end
    command: str  # to repeat it by hand
    timings: tuple[float, ...] = ()  # s, of the time steps: of all repetitions, of which this is the median

    @property
    def done(self) -> bool:
        return self.status == DONE

    @property
    def end_words(self) -> str:
        """How it ended, with what is known about a bad end."""
        return self.status if self.done else f"{self.status}: {self.message}"

    def __hash__(self) -> int:
        return hash(self.folder)

    @functools.cached_property
    def summary(self) -> dict:
        """`summary.json`; empty where the run wrote none, or one that cannot be what a driver wrote."""
        path = self.folder / FILE
        try:
            return checked(path, read_object(path, "", ""))
        except InputError:
            if self.done and is_file(path):
                raise
            return {}

    @functools.cached_property
    def pressure(self) -> PressureWaves:
        """Along the centre line; of a vessel without one along the line of `lines.csv` that stands for it, its arc
        length in place of z. Raises InputError."""
        file = pressure_file(self.folder)
        if file.name == ALONG_AXIS:
            return read_pressure(file)
        name = requested_line(file)
        return waves_along(file, CENTRE_LINE if name is None else name)

    def columns(self, file: str) -> Columns:
        """All columns of a CSV of the run, e.g. `iterations.csv`. Raises InputError when it is missing or broken."""
        return read_columns(self.folder / file)

    @property
    def method_label(self) -> str:
        """The method's name in the study; behind it the kind of coupling of a partitioned run, and the scheme where the
        study leaves that to the driver: `IQN-ILS, interface`."""
        method = self.request.method
        if method.program != "fsi-partitioned":
            return method.label
        scheme = None if "partitioned.scheme" in self.request.settings else chosen_scheme(self.summary)
        return ", ".join(word for word in (method.label, coupling_kind(self.summary), scheme) if word)

    @property
    def steps(self) -> int:
        return int(self.summary.get("totals", {}).get("steps", 0))

    @property
    def wall_s(self) -> float:
        """Seconds of the time steps, without start and mesh."""
        return float(self.summary.get("totals", {}).get("wall_s", float("nan")))

    @property
    def work_units_per_step(self) -> float | None:
        """Work units per step; None: the run did not measure the unit."""
        return per_step(self.summary)

    @property
    def passes(self) -> float:
        """Coupling iterations a step; of a monolithic run Newton iterations a step."""
        totals = self.summary.get("totals", {})
        key = "outer_iterations" if self.request.method.program == "fsi-partitioned" else "newton_iterations"
        return totals.get(key, float("nan")) / self.steps if self.steps else float("nan")


def known(value: float) -> float | None:
    """The value; None for NaN."""
    return value if value == value else None
