"""Where a study stands: a line that is rewritten on a terminal, plain lines elsewhere. It goes to the error output, so
that the tables can be piped."""

import sys
from typing import List, Optional, Sequence, Tuple

from fsi_compare.starting.duration import duration


class Progress:
    """Runs are weighted by their expected work; the time left follows from those that have ended, by preference from
    those of the same kind (mesh)."""

    def __init__(self, runs: List[Tuple[str, str, float]], quiet: bool, jobs: int = 1):
        self._left = {name: (kind, weight) for name, kind, weight in runs}
        self._total, self._jobs = len(runs), jobs
        self._known: List[Tuple[str, float, float]] = []  # kind, weight, seconds
        self._quiet = quiet
        self._terminal = sys.stderr.isatty()
        self._held: Optional[List[str]] = []  # refusals, while there is nothing else; None: there is

    def known(self, name: str, seconds: float) -> None:
        """This run was finished earlier and took that long then."""
        self._release()
        kind, weight = self._left.pop(name)
        if seconds > 0:
            self._known.append((kind, weight, seconds))
        self._say(f"{self._place(name)}: there already")

    def tick(self, names: Sequence[str]) -> None:
        """These runs are on their way."""
        if self._terminal and not self._quiet and names:
            text = f"{self._place(', '.join(names), len(names))}{self._left_text()}"
            print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)

    def end(self, name: str, failure: str, refused: bool, seconds: float) -> None:
        """This run has ended, well or with a failure; `refused`: as wrong use or bad input. As long as all are
        refused the mistake may be the study's own, to be reported once, so that the messages wait."""
        kind, weight = self._left.pop(name)
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
        self._say(f"{self._place(name)}: {duration(seconds)}{self._left_text()}")

    def _place(self, name: str, running: int = 0) -> str:
        return f"[{self._total - len(self._left) + running}/{self._total}] {name}"

    def _left_text(self) -> str:
        left = self.seconds_left()
        return f", about {duration(left)} left" if left is not None and self._left else ""

    def seconds_left(self) -> Optional[float]:
        if not self._known:
            return None
        total = 0.0
        for kind, weight in self._left.values():
            like = [entry for entry in self._known if entry[0] == kind] or self._known
            total += weight * sum(seconds for _, _, seconds in like) / sum(w for _, w, _ in like)
        return total / self._jobs

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
