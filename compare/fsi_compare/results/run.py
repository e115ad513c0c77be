"""One run: a result folder whose parts are read when they are first asked for."""

from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..base.errors import InputError, printable
from ..base.files import read_object
from ..base.suggestions import hint
from ..runs.run_folder import read_finished, require_folder
from ..runs.samples import LINES, read_samples
from ..runs.summary import AGAIN, FILE, FINISHED, PROGRAMS, checked
from .fields import MediumFields, read_fields
from .line import Line, line_of, lines_of
from .openings import Opening, inlet_and_outlet, openings_of
from .picture import Scene, picture
from .surfaces import Surface, Surfaces
from .table import Table, read_table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NOT_WRITTEN = "ask for it in the case, or see summary.json for why it is not there"


class RunResults:
    """What a run has left in its folder. Each part is read once, on first use; a part that the run did not write is
    None. Made by `open_run`."""

    def __init__(self, folder: Path, summary: dict[str, Any]) -> None:
        self.folder = folder
        #: summary.json as it stands: counts, totals, seconds of each phase, mesh
        self.summary: dict[str, Any] = summary
        self._read: dict[str, Table] = {}

    def __repr__(self) -> str:
        return f"<RunResults {self.folder}: {self.program}, {self.status}, '{self.title}'>"

    @property
    def program(self) -> str:
        """'fsi-monolithic' or 'fsi-partitioned'."""
        return str(self.summary["program"])

    @property
    def status(self) -> str:
        """'done', or how else the run stands: 'running', 'interrupted', 'not converged', 'failed'."""
        return str(self.summary.get("status", "unknown"))

    @property
    def title(self) -> str:
        """Title of the case."""
        return printable(self.summary.get("title", ""))

    @property
    def label(self) -> str:
        """A short name for legends: the folder's."""
        return printable(self.folder.resolve().name)

    @property
    def processes(self) -> int:
        """Number of processes; their seconds, memory and halo are in `summary["per_process"]`."""
        return int(self.summary.get("processes", 1))

    @property
    def tables(self) -> list[str]:
        """Names of the tables that are there: ['energy.csv', 'flow.csv', ...]."""
        return sorted(path.name for path in self.folder.glob("*.csv"))

    def table(self, name: str) -> Table:
        """Any table by its name, with or without '.csv': columns with units. Raises InputError when it is not there."""
        file = name if name.endswith(".csv") else name + ".csv"
        if file not in self._read:
            if file not in self.tables:
                remedy = hint(file, self.tables) if self.tables else NOT_WRITTEN
                raise InputError(self.folder, "", f"has no table '{file}'", remedy)
            self._read[file] = read_table(self.folder / file, finished=self.status == "done")
        return self._read[file]

    def _optional(self, name: str) -> Table | None:
        return self.table(name) if name in self.tables else None

    @property
    def iterations(self) -> Table:
        """A row for each time step: iterations, seconds, estimated error of the solver. Raises InputError."""
        return self.table("iterations.csv")

    @property
    def time(self) -> np.ndarray:
        """Ends of the time steps, ms, (steps,)."""
        return self.iterations["time"]

    @property
    def static(self) -> bool:
        """Whether its times are shares of a load. Only a wall at rest has energies without a kinetic one."""
        return {"wall_isochoric_energy", "wall_kinetic_energy"} & set(self.energy or ()) == {"wall_isochoric_energy"}

    @property
    def energy(self) -> Table | None:
        """The energy balance of each time step, uJ (docs/energy.md)."""
        return self._optional("energy.csv")

    @property
    def coupling(self) -> Table | None:
        """Passes and residuals of each time step of a partitioned run."""
        return self._optional("coupling.csv")

    @cached_property
    def centre_line(self) -> Line | None:
        """'pressure' in Pa along the middle of the fluid."""
        return self._whole("centerline_pressure.csv", "centre line")

    @cached_property
    def wall_line(self) -> Line | None:
        """'radial' and 'axial' displacement in mm of the inner wall, mean over the circumference."""
        return self._whole("wall_displacement.csv", "wall")

    def _whole(self, file: str, name: str) -> Line | None:
        """The line that is all of a table."""
        if file not in self.tables:
            return None
        path = self.folder / file
        return line_of(name, path, read_samples(path, finished=self.status == "done")[""])

    @cached_property
    def lines(self) -> dict[str, Line]:
        """Lines that the case asks for, by name; empty for none."""
        return lines_of(self.folder / LINES, finished=self.status == "done") if LINES in self.tables else {}

    @cached_property
    def points(self) -> dict[str, Table]:
        """Points that the case asks for, by name: a row for each time. Empty for none."""
        return self._named("points.csv", "point")

    @cached_property
    def planes(self) -> dict[str, Table]:
        """Planes that the case asks for, by name: flow, mean pressure and area, a row for each time. Empty for none."""
        return self._named("planes.csv", "plane")

    @cached_property
    def surfaces(self) -> dict[str, Table]:
        """Forces on the surfaces that the case asks for, by name: a row for each time. Empty for none."""
        return self._named("surfaces.csv", "surface")

    def _named(self, file: str, column: str) -> dict[str, Table]:
        table = self._optional(file)
        return {} if table is None else table.groups(column)

    @cached_property
    def openings(self) -> dict[str, Opening]:
        """Openings by name; empty for a run without fluid."""
        table = self._optional("openings.csv")
        if table is not None:
            return openings_of(table)
        flow = self._optional("flow.csv")
        return {} if flow is None else inlet_and_outlet(flow)

    @property
    def has_samples(self) -> bool:
        """Whether there is any line, opening, plane or point."""
        lines = self.centre_line is not None or self.wall_line is not None
        return lines or bool(self.lines or self.openings or self.planes or self.points)

    @cached_property
    def fields(self) -> dict[str, MediumFields]:
        """Fields by medium, 'fluid' and 'wall'; empty when the run has written none. Values are read on demand."""
        return read_fields(self.folder)

    def surface(self, name: str) -> Surface:
        """Points, triangles (edges of a two-dimensional mesh) and fields over time of the 'interface', the 'lumen' (all
        of the fluid's boundary but its openings), the 'openings' or one by its name, the wall's 'inner' and 'outer'
        side, or a two-dimensional 'fluid section', 'wall section'. Raises InputError for one that is not there."""
        return self.meshes.get(name)

    @cached_property
    def scene(self) -> Scene:
        """What pictures are made from, and its quantities by name: `run.scene.quantities`. Raises InputError."""
        return Scene(self.meshes, str(self.folder / "fields.h5"), self.static)

    def picture(
        self,
        field: str | None = None,
        time: float | None = None,
        factor: float = 1.0,
        cut: bool | None = None,
        unit: str | None = None,
        span: tuple[float, float] | None = None,
        view: str | None = None,
    ) -> "Figure":
        """The vessel coloured by a field as a matplotlib figure: at a time in ms (default: the last), moved by `factor`
        times the displacement, `cut` open by a plane through its middle or not (default: for the velocity), in 'kPa',
        'Pa' or 'mmHg', with the range of colours `span`, seen from 'x', '-x', ... or an opening. Raises InputError."""
        return picture(self.scene, field, time, factor, cut, unit, span, view, self.label)

    @cached_property
    def meshes(self) -> Surfaces:
        """All surfaces, and cuts by planes. Raises InputError where the run has written no fields, and for fields of
        another mesh than the run's."""
        self._check_mesh()
        return Surfaces(self.folder, self.fields, self.openings, str(self.summary.get("geometry", "3d")))

    def _check_mesh(self) -> None:
        """A medium that the scene leaves out has no fields: the mesh may have more cells than fields.h5, never
        fewer."""
        mesh = self.summary.get("mesh", {})
        own = mesh.get("tetrahedra", mesh.get("triangles"))
        found = sum(len(medium.cells) for medium in self.fields.values())
        if isinstance(own, int) and found > own:
            problem = f"has {found} cells, the run's mesh {own} by summary.json: it belongs to another run"
            raise InputError(self.folder / "fields.h5", "", problem, "put back its own, or run it again")


def open_run(folder: "str | PathLike[str]", unfinished: bool = False) -> RunResults:
    """The run in a result folder.

    `unfinished`: also one that has not ended well or still goes on; what it has written so far is read. Raises
    InputError, whose message says what to do.
    """
    path = Path(folder)
    if not unfinished:
        return RunResults(path, read_finished(path))
    require_folder(path)
    summary = checked(path / FILE, read_object(path / FILE, FINISHED, AGAIN))
    if summary.get("program") not in PROGRAMS:
        raise InputError(path / FILE, "program", "is missing or unknown", "give the result folder of a driver")
    return RunResults(path, summary)
