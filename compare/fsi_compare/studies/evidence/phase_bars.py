"""Where the time of runs went: stacked bars of assembly, set-up, solve, coupling and output."""

from typing import Dict, Sequence

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from ...errors import InputError
from ...layout import Table
from ...pictures import finish
from ..study_run import StudyRun

# Told apart in grey by lightness and hatch.
PARTS = {
    "assembly": {"facecolor": "#2c4a6e", "hatch": ""},
    "set-up": {"facecolor": "#e8871e", "hatch": "///"},
    "solve": {"facecolor": "#a9cbe8", "hatch": ""},
    "coupling": {"facecolor": "#ffffff", "hatch": "xxxx"},
    "output": {"facecolor": "#dddddd", "hatch": "...."},
    "other": {"facecolor": "#ffffff", "hatch": ""},
}
MEANING = ("Assembly: residuals and matrices. Set-up: factorisations and preconditioners. Solve: linear systems. "
           "Coupling: the interface's balance and acceleration. Output: result files and energy balance. Other: what "
           "is in no phase of `summary.json`.")
COUPLING_PHASES = ("assembly: interface balance",)


def phase_seconds(run: StudyRun) -> Dict[str, float]:
    """Seconds by part; together the run's wall time."""
    parts = dict.fromkeys(PARTS, 0.0)
    for name, phase in run.summary.get("phases", {}).items():
        parts[_part(name)] += float(phase["seconds"])
    if run.has("coupling.csv"):
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
    return {"assembly": "assembly", "set-up": "set-up", "factorisation": "set-up", "solve": "solve", "output": "output",
            "energy balance": "output", "coupling": "coupling"}.get(kind, "other")


def phase_table(runs: Sequence[StudyRun], labels: Sequence[str], stem: str = "phases",
                title: str = "Milliseconds per time step, by phase") -> Table:
    table = Table(stem=stem, title=title, columns=[("", "run"), *(("", part) for part in PARTS), ("", "all")],
                  csv_columns=["run", "steps", *(f"{part.replace('-', '_')}_s" for part in PARTS), "wall_s"])
    for run, label in zip(runs, labels):
        parts = phase_seconds(run)
        steps = max(run.steps, 1)
        table.rows.append(
            [label, *(f"{1e3 * s / steps:.3g}" for s in parts.values()), f"{1e3 * run.wall_s / steps:.3g}"])
        table.csv_rows.append([label, run.steps, *parts.values(), run.wall_s])
    table.notes.append(MEANING)
    return table


def phase_figure(runs: Sequence[StudyRun], labels: Sequence[str], title: str) -> Figure:
    """A bar per run, first on top; the length is the milliseconds of a time step."""
    width, height = 7.4, 0.7 + 0.34 * len(runs)
    figure = Figure(figsize=(width, height))
    canvas = FigureCanvasAgg(figure)
    axes = figure.subplots()
    for row, run in enumerate(runs):
        left, steps = 0.0, max(run.steps, 1)
        for part, seconds in phase_seconds(run).items():
            length = 1e3 * seconds / steps
            axes.barh(row, length, left=left, height=0.62, edgecolor="#000000", linewidth=0.6, **PARTS[part])
            left += length
    axes.set_yticks(range(len(runs)), labels)
    axes.set_ylim(len(runs) - 0.4, -0.6)
    axes.set_axisbelow(True)
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("ms of wall time per time step")
    handles = [Patch(edgecolor="#000000", linewidth=0.6, **style) for style in PARTS.values()]
    finish(figure, canvas, handles, list(PARTS), title, (width, height))
    return figure
