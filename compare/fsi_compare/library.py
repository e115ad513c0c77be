"""The names that `import fsi_compare` offers, from where they are made; plots are in reporting/plots.py."""

from .base.errors import InputError
from .results.comparison import LineDifference, difference
from .results.fields import MediumFields
from .results.line import Line
from .results.openings import Opening
from .results.run import RunResults, open_run
from .results.table import MissingColumn, Table

__all__ = [
    "InputError",
    "Line",
    "LineDifference",
    "MediumFields",
    "MissingColumn",
    "Opening",
    "RunResults",
    "Table",
    "difference",
    "open_run",
]
