"""Starts the other programs as a user would, reads their result folders and compares them; never looks inside them.

As a library (docs/guide/reports.md#python):

    import fsi_compare

    run = fsi_compare.open_run("results/monolithic")
    run.time, run.centre_line["pressure"], run.openings["outlet"].flow, run.fields["wall"].at(3.0, "displacement")
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .library import *
    from .reporting.plots import plot_energy as plot_energy, plot_line as plot_line, plot_openings as plot_openings

__all__ = ["InputError", "Line", "LineDifference", "MediumFields", "MissingColumn", "Opening", "RunResults", "Surface"]
__all__ += ["Table", "difference", "open_run", "plot_energy", "plot_line", "plot_openings"]


def __getattr__(name: str) -> Any:
    """Names of the library are loaded on first use, since the program must not wait for what it does not need."""
    if name not in __all__:
        raise AttributeError(f"module 'fsi_compare' has no attribute '{name}'")
    if name.startswith("plot_"):  # matplotlib takes a second to load
        from .reporting import plots

        return getattr(plots, name)
    from . import library

    return getattr(library, name)


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
