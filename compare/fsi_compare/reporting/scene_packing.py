"""Arrays as a page holds them: whole numbers of 16 or 32 bits, as differences from the row before, their bytes apart,
deflated, in base64. templates/scene_data.js reads them."""

import base64
import zlib
from typing import Any

import numpy as np

NONE = 65535
LEVEL = 6


def in_16_bits(values: np.ndarray) -> tuple[float, float, np.ndarray]:
    """Least value, step and numbers of steps, to 1/65534 of the range; what is no number is NONE."""
    finite = np.isfinite(values)
    low, high = (float(values[finite].min()), float(values[finite].max())) if finite.any() else (0.0, 0.0)
    step = (high - low) / (NONE - 1)
    numbers = np.full(values.shape, NONE, dtype="<u2")
    numbers[finite] = np.round((values[finite] - low) / step).astype("<u2") if step > 0 else 0
    return low, step, numbers


def short(numbers: np.ndarray) -> list[float]:
    """To nine digits."""
    return [float(f"{number:.9g}") for number in numbers]


def packed_numbers(values: np.ndarray) -> dict[str, Any]:
    """Rows of numbers, (rows, ...), in 16 bits each; see in_16_bits()."""
    low, step, numbers = in_16_bits(np.asarray(values, dtype=float).reshape(len(values), -1))
    changes = numbers.copy()
    changes[1:] -= numbers[:-1]  # from the row before, modulo 2^16: what changes slowly is small
    return {"low": low, "step": step, "rows": len(numbers), "data": deflated(_planes(changes, 2))}


def packed_counts(numbers: np.ndarray) -> dict[str, Any]:
    """Whole numbers from zero, one row."""
    row = np.asarray(numbers).ravel()
    before = np.concatenate([[0], row[:-1]]).astype(np.int64)
    return {"count": len(row), "data": deflated(_planes((row - before).astype(np.int32).view(np.uint32), 4))}


def plain_bytes(numbers: np.ndarray) -> str:
    """Small tables as they are."""
    return base64.b64encode(np.ascontiguousarray(numbers, dtype=np.uint8).tobytes()).decode("ascii")


def _planes(numbers: np.ndarray, size: int) -> bytes:
    """Lowest bytes of all, then the next."""
    little = np.ascontiguousarray(numbers, dtype=f"<u{size}")
    return little.view(np.uint8).reshape(-1, size).T.tobytes()


def deflated(data: bytes) -> str:
    """In base64."""
    return base64.b64encode(zlib.compress(data, LEVEL)).decode("ascii")
