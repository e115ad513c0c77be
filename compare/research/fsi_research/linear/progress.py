"""Where a study stands: a line that is rewritten on a terminal, plain lines elsewhere. It goes to the error output, so
that the tables can be piped."""

import sys
import time
from typing import List, Optional, Tuple

from fsi_compare.starting.duration import duration


class Progress:
    """Runs are weighted by their expected work; the time left follows from those that have ended, by preference from
    those of the same kind (mesh)."""

    def __init__(self, runs: List[Tuple[str, str, float]], quiet: bool):
        self._left = list(runs)  # name, kind, weight
        self._total = len(runs)
        self._known: List[Tuple[str, float, float]] = []  # kind, weight, seconds
        self._quiet = quiet
        self._terminal = sys.stderr.isatty()
        self._start = 0.0
        self._held: Optional[List[str]] = []  # refusals, while there is nothing else; None: there is

    def known(self, seconds: float) -> None:
        """The next run was finished earlier and took that long then."""
        self._release()
        name, kind, weight = self._left.pop(0)
        if seconds > 0:
            self._known.append((kind, weight, seconds))
        self._say(f"{self._place(name)}: there already")

    def begin(self) -> None:
        self._start = time.monotonic()
        self.tick()

    def tick(self) -> None:
        if self._terminal and not self._quiet:
            running = time.monotonic() - self._start
            text = f"{self._place(self._left[0][0], 1)}: {duration(running)}{self._left_text(running)}"
            print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)

    def end(self, failure: str, refused: bool, seconds: float) -> None:
        """The next run has ended, well or with a failure; `refused`: as wrong use or bad input. As long as all are
        refused the mistake may be the study's own, to be reported once, so that the messages wait."""
        name, kind, weight = self._left.pop(0)
        if failure:
            text = f"{self._place(name)}: failed: {failure}"
            self._clear()
            if refused and self._held is not None:
                self._held.append(text)
                return
            self._release()
            print(text, file=sys.stderr, flush=True)  # errors even when quiet
            return
        self._release()
        self._known.append((kind, weight, seconds))
        self._say(f"{self._place(name)}: {duration(seconds)}{self._left_text(0)}")

    def _place(self, name: str, running: int = 0) -> str:
        return f"[{self._total - len(self._left) + running}/{self._total}] {name}"

    def _left_text(self, running: float) -> str:
        left = self.seconds_left()
        if left is None or not self._left:
            return ""
        return f", about {duration(max(0.0, left - running))} left"

    def seconds_left(self) -> Optional[float]:
        if not self._known:
            return None
        total = 0.0
        for _, kind, weight in self._left:
            like = [entry for entry in self._known if entry[0] == kind] or self._known
            total += weight * sum(seconds for _, _, seconds in like) / sum(w for _, w, _ in like)
        return total

    def _release(self) -> None:
        for text in self._held or ():
            self._clear()
            print(text, file=sys.stderr, flush=True)
        self._held = None

    def _say(self, text: str) -> None:
        if not self._quiet:
            self._clear()
            print(text, file=sys.stderr, flush=True)

    def _clear(self) -> None:
        if self._terminal and not self._quiet:
            print("\r\033[K", end="", file=sys.stderr)
