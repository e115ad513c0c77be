"""Arrays as a page holds them: whole numbers of 16 or 32 bits, as differences from the row before, their bytes apart,
deflated, in base64. templates/scene_data.js reads them."""

import base64
import zlib
from typing import Any

import numpy as np

NONE = 65535
LEVEL = 6


def packed_numbers(values: np.ndarray) -> dict[str, Any]:
    """Rows of numbers, (rows, ...), in 16 bits each, to 1/65534 of their range; what is no number stays none."""
    rows = np.asarray(values, dtype=float).reshape(len(values), -1)
    finite = np.isfinite(rows)
    low, high = (float(rows[finite].min()), float(rows[finite].max())) if finite.any() else (0.0, 0.0)
    step = (high - low) / (NONE - 1)
    numbers = np.full(rows.shape, NONE, dtype=np.uint16)
    numbers[finite] = np.round((rows[finite] - low) / step).astype(np.uint16) if step > 0 else 0
    return {"low": low, "step": step, "rows": len(rows), "data": _deflated(numbers)}


def packed_counts(numbers: np.ndarray) -> dict[str, Any]:
    """Whole numbers from zero, one row."""
    row = np.asarray(numbers).ravel()
    before = np.concatenate([[0], row[:-1]]).astype(np.int64)
    return {"count": len(row), "data": _text(_planes((row - before).astype(np.int32).view(np.uint32), 4))}


def plain_bytes(numbers: np.ndarray) -> str:
    """Small tables as they are."""
    return base64.b64encode(np.ascontiguousarray(numbers, dtype=np.uint8).tobytes()).decode("ascii")


def deflated_text(text: str) -> str:
    return _text(text.encode("utf-8"))


def _deflated(numbers: np.ndarray) -> str:
    """Rows as differences from the row before, modulo 2^16: what changes slowly is small."""
    changes = numbers.copy()
    changes[1:] -= numbers[:-1]
    return _text(_planes(changes, 2))


def _planes(numbers: np.ndarray, size: int) -> bytes:
    """Lowest bytes of all, then the next."""
    little = np.ascontiguousarray(numbers, dtype=f"<u{size}")
    return little.view(np.uint8).reshape(-1, size).T.tobytes()


def _text(data: bytes) -> str:
    return base64.b64encode(zlib.compress(data, LEVEL)).decode("ascii")
