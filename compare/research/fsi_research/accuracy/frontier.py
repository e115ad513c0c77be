"""The efficient frontier of settings: those that no other beats in both seconds and error."""

from typing import List, Optional, Sequence, Tuple

Point = Tuple[float, float]  # seconds, error


def frontier(points: Sequence[Point], gain: float = 0.0) -> List[int]:
    """Indices of the points that are not dominated, by rising seconds and falling error. A point is dominated when
    another is no slower and more accurate, or faster and no less accurate; of equals the first stays. With a `gain`,
    a slower point must lessen the error by that part: what a looser tolerance changes by chance is no progress."""
    best: List[int] = []
    for i in sorted(range(len(points)), key=lambda i: (points[i][0], points[i][1], i)):
        seconds, error = points[i]
        if seconds == seconds and error == error and (not best or error < (1 - gain) * points[best[-1]][1]):
            best.append(i)
    return best


def cheapest(points: Sequence[Point], target: float) -> Optional[int]:
    """Index of the fastest point with an error of at most `target`; None when there is none."""
    good = [i for i, (seconds, error) in enumerate(points) if error <= target and seconds == seconds]
    return min(good, key=lambda i: points[i][0]) if good else None
