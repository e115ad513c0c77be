"""Loads matplotlib so that this program decides how, and not the environment, the user's settings or a file in the
working folder: the same data give the same picture, and no message but ours comes of it."""

import logging
import os

from ..base.errors import InputError


def load_matplotlib() -> None:
    """Call before the first import of a module that draws. Raises InputError."""
    os.environ["MPLBACKEND"] = "agg"  # pictures are files
    os.environ["MATPLOTLIBRC"] = os.devnull
    if os.environ.get("MPLCONFIGDIR"):
        os.environ["MPLCONFIGDIR"] = os.path.abspath(os.environ["MPLCONFIGDIR"])
    # It would tell where its cache of fonts is when the usual place cannot be written; that only costs time.
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    here = os.open(".", os.O_PATH | os.O_DIRECTORY)
    try:
        os.chdir(os.path.dirname(os.path.abspath(__file__)))  # settings in the working folder go before all others
        import matplotlib.font_manager  # noqa: F401
        import matplotlib.figure  # noqa: F401
    except (OSError, ValueError, RuntimeError) as error:
        problem = f"cannot be loaded: {getattr(error, 'strerror', None) or error}"
        remedy = "set MPLCONFIGDIR and TMPDIR to folders that can be written"
        raise InputError("matplotlib", "", problem, remedy) from None
    finally:
        os.fchdir(here)
        os.close(here)
