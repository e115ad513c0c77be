"""The energy balance of runs from their `energy.csv`: what there is, what was put in, and where it went."""

from dataclasses import dataclass
from typing import List, Optional, Sequence, Tuple

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.base.files import is_file
from fsi_compare.reporting.column import Column
from fsi_compare.reporting.layout import Table
from ..drawing.log_axes import plain_log_axis
from fsi_compare.reporting.pictures import PANEL_INCHES, finish
from fsi_compare.reporting.report import Report
from fsi_compare.study.study_run import StudyRun

FILE = "energy.csv"
ENERGIES = (
    "fluid_kinetic_energy_uJ",
    "wall_kinetic_energy_uJ",
    "wall_isochoric_energy_uJ",
    "wall_volumetric_energy_uJ",
)
SUPPLIES = (
    ("inlet_work_uJ", 1),
    ("load_work_uJ", 1),
    ("inlet_kinetic_inflow_uJ", 1),
    ("outlet_kinetic_outflow_uJ", -1),
)

# Each with a marker of its own, so that they are told apart in grey.
LINES = {
    "supplied": {"linestyle": "-", "color": "#000000", "linewidth": 2.0, "marker": ""},
    "lost by discretisation": {"linestyle": "-", "color": "#5fa55a", "linewidth": 1.4, "marker": "D"},
    "elastic": {"linestyle": "-.", "color": "#e8871e", "linewidth": 1.4, "marker": "^"},
    "kinetic, fluid": {"linestyle": "--", "color": "#2c6fbb", "linewidth": 1.4, "marker": "o"},
    "lost by viscosity": {"linestyle": ":", "color": "#b02a5b", "linewidth": 1.8, "marker": "x"},
    "kinetic, wall": {"linestyle": (0, (1, 1.5)), "color": "#2c6fbb", "linewidth": 1.4, "marker": "s"},
}
SHOWN = 3e-3  # of what was supplied: the picture's lower end
REMAINDER = "left over"  # too small for the picture
PARTS = (
    "supplied",
    "kinetic, fluid",
    "kinetic, wall",
    "elastic",
    "lost by viscosity",
    "lost by discretisation",
    REMAINDER,
)


@dataclass(frozen=True)
class Balance:
    """Over time, in uJ; what a step supplies or loses is summed from the start."""

    times: np.ndarray  # ms
    parts: dict  # name in PARTS -> values

    def end(self, name: str) -> float:
        return float(self.parts[name][-1])

    @property
    def largest_remainder(self) -> float:
        """Relative to what was supplied in all."""
        supplied = np.max(np.abs(self.parts["supplied"]))
        return float(np.max(np.abs(self.parts[REMAINDER])) / supplied) if supplied > 0 else float("nan")


def balance(run: StudyRun) -> Optional[Balance]:
    """A run's balance; None: it wrote none."""
    if not is_file(run.folder / FILE):
        return None
    columns = run.columns(FILE)
    zero = np.zeros(len(columns["time_ms"]))

    def get(name: str) -> np.ndarray:
        return columns.get(name, zero)

    return Balance(
        columns["time_ms"],
        {
            "supplied": np.cumsum(sum(sign * get(name) for name, sign in SUPPLIES)),
            "kinetic, fluid": get(ENERGIES[0]),
            "kinetic, wall": get(ENERGIES[1]),
            "elastic": get(ENERGIES[2]) + get(ENERGIES[3]),
            "lost by viscosity": np.cumsum(get("viscous_dissipation_uJ")),
            "lost by discretisation": np.cumsum(get("numerical_dissipation_uJ")),
            REMAINDER: np.cumsum(get("remainder_uJ")),
        },
    )


def energy_figure(balances: Sequence[Balance], labels: Sequence[str], title: str) -> Figure:
    """A panel per run, on one logarithmic scale: most parts are small beside what was supplied and lost."""
    columns = min(len(balances), 3)
    rows = -(-len(balances) // columns)
    figure = Figure(
        figsize=(columns * (PANEL_INCHES[0] - 0.7) + (2 if columns == 1 else 0), rows * (PANEL_INCHES[1] + 0.5))
    )
    grid = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
    for axes in grid.flat[len(balances) :]:
        axes.set_visible(False)
    for axes, one, label in zip(grid.flat, balances, labels):
        every = max(1, len(one.times) // 6)
        handles = [
            axes.plot(
                one.times,
                one.parts[name],
                markersize=4.5,
                markevery=(i * every // len(LINES), every),
                markerfacecolor="#ffffff",
                **style,
            )[0]
            for i, (name, style) in enumerate(LINES.items())
        ]
        axes.set_yscale("log")
        axes.set_title(label)
        axes.set_xlabel("t in ms")
        axes.set_xlim(0, one.times[-1])
    most = max(float(np.max(one.parts["supplied"])) for one in balances)
    if most > 0:
        grid[0, 0].set_ylim(SHOWN * most, 1.6 * most)  # shared by all
    for row in grid:
        row[0].set_ylabel("energy in uJ")
        plain_log_axis(row[0].yaxis)
    return finish(figure, handles, list(LINES), title)


Named = Tuple[str, Balance]  # label of the run


def _of_part(name: str) -> Column[Named]:
    """In the CSV in uJ, for people in percent of what was supplied."""

    def text(one: Named) -> str:
        share = 100 * one[1].end(name) / one[1].end("supplied")
        return f"{share:.1e}" if name == REMAINDER else f"{share:.2f}"

    return Column(name, name.replace(", ", "_").replace(" ", "_"), lambda one: one[1].end(name), unit="uJ", text=text)


ENERGY: Sequence[Column[Named]] = (
    Column("run", "run", lambda one: one[0], left=True),
    Column(csv="time", unit="ms", value=lambda one: float(one[1].times[-1])),
    Column("supplied in {unit}", "supplied", lambda one: one[1].end("supplied"), ".4g", "uJ"),
    *(_of_part(name) for name in PARTS[1:]),
    Column(
        "left over at most",
        "largest_remainder_relative",
        lambda one: one[1].largest_remainder,
        lambda share: f"{100 * share:.1e}",
    ),
)


def energy_table(balances: Sequence[Balance], labels: Sequence[str], stem: str = "energy") -> Table:
    return Table(
        stem,
        "Energy at the end of the runs, in percent of what was supplied",
        ENERGY,
        list(zip(labels, balances)),
        notes=[
            "Left over: what the balance of the discrete equations misses, summed over the steps; the last column "
            "its largest value at any time."
        ],
    )


def energy_section(
    report: Report, runs: Sequence[StudyRun], labels: Sequence[str], stem: str = "energy"
) -> List[Balance]:
    """Table and picture of the runs that have a balance; a sentence where none has."""
    found = [(balance(run), label) for run, label in zip(runs, labels)]
    balances = [one for one, _ in found if one is not None]
    names = [label for one, label in found if one is not None]
    if not balances:
        report.text(f"The runs hold no `{FILE}`.")
        return []
    report.figure(
        stem,
        lambda: energy_figure(balances, names, "Energy balance"),
        "Energy over time. Supplied: work of the inlet's pressure and kinetic energy that flows in, less what flows "
        "out at the outlet; supplied and lost are summed from the start. Elastic: isochoric and volumetric. "
        f"Logarithmic, down to {SHOWN:g} of the most that was supplied; what is left over is far below.",
    )
    report.table(energy_table(balances, names, stem))
    return balances
