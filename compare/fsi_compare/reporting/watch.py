"""`fsi-compare watch`: follows a run while it goes on, in the terminal or in a page that is rewritten as steps come."""

import argparse
import math
import shutil
import sys
import time
from pathlib import Path

import numpy as np

from ..base import interruption
from ..base.errors import InputError
from ..base.files import output_folder, write_text
from ..base.options import Commands, add_command, add_usual
from .watched import BLOCKS, PLAIN, Curve, State, lines_of, state_of, thinned_to

DESCRIPTION = """\
Follows a run while it goes on: step, time, speed, iterations, pressures and flows
of the openings. It reads what the run has written, never the run itself, and ends
with it; Ctrl-C ends it before.
"""
EXAMPLES = """\
examples:
  fsi-compare watch results/monolithic
  fsi-compare watch results/monolithic --page watch.html
"""
NAP = 0.2  # seconds between looks for a signal
PAGE_WIDTH, PAGE_HEIGHT, PAGE_POINTS = 420, 60, 400


def add_parser(commands: Commands, version: str) -> None:
    command = add_command(commands, "watch", watch, "follows a run while it goes on", DESCRIPTION, EXAMPLES)
    command.add_argument("folder", metavar="RUN", type=Path, help="result folder of a run that has begun")
    command.add_argument("--page", metavar="FILE", type=Path, help="HTML file that is written anew as steps come")
    command.add_argument("--every", metavar="S", type=float, default=1.0, help="seconds between looks (default: 1)")
    add_usual(command, version, "accepted as by all programs; this needs one")


def watch(options: argparse.Namespace) -> int:
    """Until the run has ended. The exit code is 0 however that was: the run itself has said it."""
    if not (math.isfinite(options.every) and options.every > 0):
        raise InputError("", "--every", f"{options.every} is not positive", "give seconds, like 1")
    if options.page is not None and options.page.suffix not in (".html", ".htm"):
        raise InputError(options.page, "--page", "is no page's name", "end it with .html")
    screen = Screen(options.quiet)
    state = state_of(options.folder)
    steps = -1
    while True:
        if state.steps != steps or state.over:
            screen.show(state)
            if options.page is not None:
                write_page(options.page, state, options.every)
            steps = state.steps
        if state.over:
            return 0
        end = time.monotonic() + options.every
        while time.monotonic() < end:
            interruption.check()
            time.sleep(min(NAP, options.every))
        state = state_of(options.folder)


class Screen:
    """A terminal is written over; elsewhere there is a line for each look."""

    def __init__(self, quiet: bool) -> None:
        self._quiet = quiet
        self._terminal = sys.stdout.isatty()
        self._height = 0

    def show(self, state: State) -> None:
        if self._quiet:
            return
        left = "" if state.seconds_left is None else f", about {state.seconds_left:.0f} s left"
        width = shutil.get_terminal_size().columns
        lines = lines_of(state, left, width, BLOCKS if _has_blocks() else PLAIN)
        if not self._terminal:
            print(lines[0], flush=True)
            return
        up = f"\033[{self._height}A" if self._height else ""
        print(up + "".join(f"\033[K{line[: width - 1]}\n" for line in lines) + "\033[J", end="", flush=True)
        self._height = len(lines)


def _has_blocks() -> bool:
    try:
        BLOCKS.encode(getattr(sys.stdout, "encoding", None) or "ascii")
        return True
    except (UnicodeEncodeError, LookupError):
        return False


def write_page(page: Path, state: State, every: float) -> None:
    """A page that asks the browser to read it again while the run goes on; nothing serves it."""
    from .templating import render

    curves: list[tuple[Curve, str]] = [(curve, _points(curve.values)) for curve in state.curves]
    refresh = None if state.over else max(1, round(every))
    text = render("watch.html.j2", state=state, curves=curves, refresh=refresh, width=PAGE_WIDTH, height=PAGE_HEIGHT)
    with output_folder(page.parent) as place:
        write_text(place / page.name, text)


def _points(values: np.ndarray) -> str:
    """The points of an SVG polyline."""
    shown = thinned_to(values, PAGE_POINTS)
    span = float(np.ptp(shown)) or 1.0
    x = np.linspace(2, PAGE_WIDTH - 2, len(shown)) if len(shown) > 1 else np.array([PAGE_WIDTH / 2])
    y = PAGE_HEIGHT - 4 - (PAGE_HEIGHT - 8) * (shown - shown.min()) / span
    return " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y))
