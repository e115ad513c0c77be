"""The names that `import fsi_compare` offers, from where they are made; plots are in reporting/plots.py. The list of
them is that of the package, __init__.py."""

from .base.errors import InputError as InputError
from .results.comparison import LineDifference as LineDifference, difference as difference
from .results.fields import MediumFields as MediumFields
from .results.line import Line as Line
from .results.openings import Opening as Opening
from .results.run import RunResults as RunResults, open_run as open_run
from .results.surfaces import Surface as Surface
from .results.table import MissingColumn as MissingColumn, Table as Table
