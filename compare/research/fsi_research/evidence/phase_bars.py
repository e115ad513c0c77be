"""Where the time of runs went: stacked bars of assembly, set-up, solve, coupling and output."""

from typing import Dict, NamedTuple, Sequence

from matplotlib.figure import Figure
from matplotlib.patches import Patch

from fsi_compare.base.errors import InputError
from fsi_compare.base.files import is_file
from fsi_compare.reporting.column import Column
from fsi_compare.reporting.layout import Table
from fsi_compare.reporting.pictures import finish
from fsi_compare.study.study_run import StudyRun

# Told apart in grey by lightness and hatch.
PARTS = {
    "assembly": {"facecolor": "#2c4a6e", "hatch": ""},
    "set-up": {"facecolor": "#e8871e", "hatch": "///"},
    "solve": {"facecolor": "#a9cbe8", "hatch": ""},
    "coupling": {"facecolor": "#ffffff", "hatch": "xxxx"},
    "output": {"facecolor": "#dddddd", "hatch": "...."},
    "other": {"facecolor": "#ffffff", "hatch": ""},
}
MEANING = (
    "Assembly: residuals and matrices. Set-up: factorisations and preconditioners. Solve: linear systems. "
    "Coupling: the interface's balance and acceleration. Output: result files and energy balance. Other: what "
    "is in no phase of `summary.json`."
)
COUPLING_PHASES = ("assembly: interface balance",)
TOO_SHORT = 0.015  # of the longest bar: a part that is nowhere longer is not seen


def phase_seconds(run: StudyRun) -> Dict[str, float]:
    """Seconds by part; together the run's wall time."""
    parts = dict.fromkeys(PARTS, 0.0)
    for name, phase in run.summary.get("phases", {}).items():
        parts[_part(name)] += float(phase["seconds"])
    if is_file(run.folder / "coupling.csv"):
        try:
            parts["coupling"] += float(run.columns("coupling.csv")["coupling_s"].sum())
        except (InputError, KeyError):
            pass  # an older run: stays in "other"
    parts["other"] += max(0.0, run.wall_s - sum(parts.values()))
    return parts


def _part(name: str) -> str:
    if name in COUPLING_PHASES:
        return "coupling"
    kind = name.partition(": ")[0]
    return {
        "assembly": "assembly",
        "set-up": "set-up",
        "factorisation": "set-up",
        "solve": "solve",
        "output": "output",
        "checkpoint": "output",
        "energy balance": "output",
        "coupling": "coupling",
    }.get(kind, "other")


class Phases(NamedTuple):
    """A run's seconds by part."""

    label: str
    run: StudyRun
    parts: Dict[str, float]

    def per_step(self, seconds: float) -> str:
        return _shown(1e3 * seconds / max(self.run.steps, 1))


def _of_part(part: str) -> Column[Phases]:
    return Column(
        part, part.replace("-", "_"), lambda p: p.parts[part], unit="s", text=lambda p: p.per_step(p.parts[part])
    )


PHASES: Sequence[Column[Phases]] = (
    Column("run", "run", lambda p: p.label, left=True),
    Column(csv="steps", value=lambda p: p.run.steps),
    *(_of_part(part) for part in PARTS),
    Column("all", "wall", lambda p: p.run.wall_s, unit="s", text=lambda p: p.per_step(p.run.wall_s)),
)


def phase_table(
    runs: Sequence[StudyRun],
    labels: Sequence[str],
    stem: str = "phases",
    title: str = "Milliseconds per time step, by phase",
) -> Table:
    found = [Phases(label, run, phase_seconds(run)) for run, label in zip(runs, labels)]
    return Table(stem, title, PHASES, found, notes=[MEANING])


def _shown(milliseconds: float) -> str:
    return format(milliseconds, ".3g" if milliseconds < 1000 else ".0f")


def phase_figure(runs: Sequence[StudyRun], labels: Sequence[str], title: str) -> Figure:
    """A bar per run, first on top; the length is the milliseconds of a time step, and stands at its end. Parts too
    short to be seen have their numbers in the legend."""
    width, height = 7.4, 0.7 + 0.34 * len(runs)
    figure = Figure(figsize=(width, height))
    axes = figure.subplots()
    lengths = [
        {part: 1e3 * seconds / max(run.steps, 1) for part, seconds in phase_seconds(run).items()} for run in runs
    ]
    longest = max(sum(bar.values()) for bar in lengths)
    for row, bar in enumerate(lengths):
        left = 0.0
        for part, length in bar.items():
            axes.barh(row, length, left=left, height=0.62, edgecolor="#000000", linewidth=0.6, **PARTS[part])
            left += length
        axes.text(left + 0.01 * longest, row, _shown(left), va="center", fontsize=8)
    axes.set_xlim(0, 1.1 * longest)
    axes.set_yticks(range(len(runs)), labels)
    axes.set_ylim(len(runs) - 0.4, -0.6)
    axes.set_axisbelow(True)
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("ms of wall time per time step")
    handles = [Patch(edgecolor="#000000", linewidth=0.6, **style) for style in PARTS.values()]
    return finish(
        figure,
        handles,
        [_legend(part, [bar[part] for bar in lengths], longest) for part in PARTS],
        title,
        (width, height),
    )


def _legend(part: str, lengths: Sequence[float], longest: float) -> str:
    if max(lengths) > TOO_SHORT * longest:
        return part
    return f"{part}: {min(lengths):.2g} to {max(lengths):.2g} ms" if max(lengths) > 0 else f"{part}: none"
