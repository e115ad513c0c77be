"""Where a study stands, and how long it will go on: a line rewritten on a terminal, plain lines elsewhere."""

import sys
import time
from typing import Any, Sequence

from .mesh_levels import MESH_NODES
from ..base.numbers import is_number
from ..starting.duration import duration
from .study_file import Request
from .study_run import StudyRun


class StudyProgress:
    """Runs are weighted by mesh and steps; what the finished ones of the same method took tells the time left."""

    def __init__(self, quiet: bool, jobs: int):
        self._quiet, self._jobs = quiet, jobs
        self._terminal = sys.stderr.isatty()
        self._left: list[Request] = []
        self._total = self._known_count = self._failed_count = 0
        self._rates: dict[str, tuple[float, float]] = {}  # method -> (weight, seconds)
        self._began: dict[int, float] = {}

    @staticmethod
    def weight(request: Request) -> float:
        nodes = MESH_NODES.get(request.mesh.name if request.mesh else "coarse", 3e3)
        end, step = (request.settings.get(f"time.{name}") for name in ("end", "step"))
        return nodes * _positive(end, 12.0) / _positive(step, 0.125)

    def known(self, request: Request, run: StudyRun) -> None:
        self._known_count += 1
        if run.done:
            self._learn(request, run.seconds)
        else:
            self._failed_count += 1

    def plan(self, requests: Sequence[Request]) -> None:
        self._left = list(requests)
        self._total = len(self._left)
        if self._known_count and (self._total or self._failed_count) and self._known_count + self._total > 1:
            failed = f" ({self._failed_count} of them failed; --fresh makes all anew)" if self._failed_count else ""
            self._say(f"{self._known_count} runs are there already{failed}, {self._total} to go{self._left_text()}")

    def repeat(self, requests: Sequence[Request]) -> None:
        """The same request as often as it is run again."""
        self._left = list(requests)
        self._total = len(self._left)
        if self._left:
            self._say(f"Again for their seconds: {self._total} runs{self._left_text()}")

    def end(self, request: Request, run: StudyRun) -> None:
        self._left.remove(request)
        if run.done:
            self._learn(request, run.seconds)
        said = "" if run.done else f", {run.end_words}"
        self._say(f"{self._words(request, run.seconds)}{said}{self._left_text()}")

    def tick(self, running: Sequence[Request]) -> None:
        if self._terminal and not self._quiet and running:
            now = time.monotonic()
            began = self._began.setdefault(id(running[0]), now)
            text = f"\r\033[K{self._words(running[0], now - began)}{self._left_text()}"
            print(text, end="", file=sys.stderr, flush=True)

    def _words(self, request: Request, seconds: float) -> str:
        return f"[{self._total - len(self._left)}/{self._total}] {request.label}: {duration(seconds)}"

    def _learn(self, request: Request, seconds: float) -> None:
        weight, known = self._rates.get(request.method.name, (0.0, 0.0))
        self._rates[request.method.name] = (weight + self.weight(request), known + seconds)

    def _left_text(self) -> str:
        if not self._left or not self._rates:
            return ""
        mean = sum(s for _, s in self._rates.values()) / max(sum(w for w, _ in self._rates.values()), 1e-300)
        left = 0.0
        for request in self._left:
            weight, seconds = self._rates.get(request.method.name, (0.0, 0.0))
            left += self.weight(request) * (seconds / weight if weight else mean)
        return f", about {duration(left / self._jobs)} left"

    def _say(self, text: str) -> None:
        if not self._quiet:
            print(("\r\033[K" if self._terminal else "") + text, file=sys.stderr, flush=True)


def _positive(value: Any, usual: float) -> float:
    """The value if it is a positive number, else the usual one. A study's settings are for the driver to judge; here
    they only weigh the work."""
    return float(value) if is_number(value) and 1e-9 < value < 1e9 else usual
