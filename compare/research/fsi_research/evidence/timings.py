"""How far the seconds of a run that was timed several times are apart."""

from typing import Optional, Sequence


def spread(timings: Sequence[float]) -> Optional[float]:
    """Slowest over fastest; None: timed once."""
    return max(timings) / min(timings) if len(timings) > 1 and min(timings) > 0 else None
