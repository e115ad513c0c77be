"""Reads surfaces of VTK's XML format (.vtp): text, base64 or raw, packed by zlib or not."""

import base64
import re
import struct
import xml.etree.ElementTree as ElementTree
import zlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Dict, List, Optional

import numpy as np

from ..base.errors import InputError

TYPES = {
    f"{kind}{bits}": f"{letter}{bits // 8}"
    for kind, letter in (("Int", "i"), ("UInt", "u"))
    for bits in (8, 16, 32, 64)
}
TYPES |= {"Float32": "f4", "Float64": "f8"}


@dataclass
class Surface:
    """Points, mm or whatever the file has; polygons as lists of points; fields of the points."""

    points: np.ndarray
    polygons: List[List[int]] = field(default_factory=list)
    fields: Dict[str, np.ndarray] = field(default_factory=dict)


class _File:
    """The arrays of one file."""

    def __init__(self, path: Path) -> None:
        self.path = path
        text = path.read_bytes()
        # What is appended raw is no XML: it is cut out, from the underscore on.
        found = re.search(rb"<AppendedData[^>]*>\s*_", text)
        self.appended = b""
        if found:
            end = text.rindex(b"</AppendedData>")
            self.appended = text[found.end() : end]
            self.raw = b'"raw"' in found.group()
            text = text[: found.start()] + text[end + len(b"</AppendedData>") :]
        try:
            self.root = ElementTree.fromstring(text)
        except ElementTree.ParseError as error:
            raise InputError(path, "", f"is no XML: {error}", "write it anew as .vtp") from None
        if self.root.tag != "VTKFile" or self.root.get("type") != "PolyData":
            raise InputError(path, "", "holds no PolyData of VTK", "write the surface as .vtp")
        self.order = "<" if self.root.get("byte_order", "LittleEndian") == "LittleEndian" else ">"
        self.header = self.order + ("Q" if self.root.get("header_type") == "UInt64" else "I")
        compressor = self.root.get("compressor", "")
        if compressor not in ("", "vtkZLibDataCompressor"):
            raise InputError(path, "", f"is packed by {compressor}", "write it with zlib or without packing")
        self.packed = bool(compressor)

    def array(self, element: Any) -> np.ndarray:
        """A DataArray's numbers, in rows of its components."""
        kind = TYPES.get(element.get("type", ""))
        if kind is None:
            raise InputError(self.path, element.get("Name", "array"), "is no array of numbers")
        form = element.get("format", "ascii")
        if form == "ascii":
            numbers = np.array((element.text or "").split(), dtype=kind)
        elif form == "binary":
            numbers = np.frombuffer(
                self._unpacked(self._coded((element.text or "").strip().encode())), self.order + kind
            )
        else:
            data = self.appended[int(element.get("offset", "0")) :]
            numbers = np.frombuffer(self._unpacked(data if self.raw else self._coded(data)), self.order + kind)
        components = int(element.get("NumberOfComponents") or 1)
        return numbers.reshape(-1, components) if components > 1 else numbers

    def _coded(self, text: bytes) -> bytes:
        """Bytes of base64: header and data are coded one after the other, each with a padding of its own."""
        size = struct.calcsize(self.header)
        length = -(-size // 3) * 4
        if not self.packed:
            (count,) = struct.unpack_from(self.header, base64.b64decode(text[:length]))
            return base64.b64decode(text[: -(-(size + count) // 3) * 4])
        (blocks,) = struct.unpack_from(self.header, base64.b64decode(text[:length]))
        length = -(-size * (3 + blocks) // 3) * 4
        head = base64.b64decode(text[:length])
        counts = struct.unpack_from(f"{self.order}{blocks}{self.header[1]}", head, 3 * size)
        return head + base64.b64decode(text[length : length + -(-sum(counts) // 3) * 4])

    def _unpacked(self, data: bytes) -> bytes:
        size = struct.calcsize(self.header)
        (first,) = struct.unpack_from(self.header, data)
        if not self.packed:
            return data[size : size + first]
        counts = struct.unpack_from(f"{self.order}{first}{self.header[1]}", data, 3 * size)
        at, parts = size * (3 + first), []
        for count in counts:
            parts.append(zlib.decompress(data[at : at + count]))
            at += count
        return b"".join(parts)


def read_vtp(path: Path) -> Surface:
    """The polygons of all pieces. Raises InputError."""
    try:
        return _read(_File(path))
    except (OSError, ValueError, struct.error, zlib.error, IndexError, TypeError) as error:
        raise InputError(path, "", f"cannot be read: {error}", "write the surface anew as .vtp") from None


def _read(file: _File) -> Surface:
    surface = Surface(np.zeros((0, 3)))
    parts: Dict[str, List[np.ndarray]] = {}
    for piece in file.root.iter("Piece"):
        points = piece.find("Points/DataArray")
        if points is None:
            continue
        if int(piece.get("NumberOfStrips") or 0) > 0:
            raise InputError(file.path, "", "holds strips of triangles", "write its surface as polygons")
        first = len(surface.points)
        surface.points = np.vstack((surface.points, file.array(points).reshape(-1, 3)))
        arrays = {a.get("Name"): a for a in piece.findall("Polys/DataArray")}
        if "offsets" in arrays:
            corners, ends = file.array(arrays["connectivity"]), file.array(arrays["offsets"])
            surface.polygons += [[int(p) + first for p in part] for part in np.split(corners, ends[:-1]) if len(part)]
        for element in piece.findall("PointData/DataArray"):
            parts.setdefault(element.get("Name", ""), []).append(file.array(element))
    surface.fields = {name: np.concatenate(found) for name, found in parts.items()}
    return surface


def scalar_field(surface: Surface, name: str, path: Path) -> np.ndarray:
    """A field of one number a point. Raises InputError that lists those there are."""
    scalars = [n for n, values in surface.fields.items() if values.ndim == 1 and len(values) == len(surface.points)]
    if name not in scalars:
        there: Optional[str] = ", ".join(scalars)
        raise InputError(path, name, "is no field of one number at each point", f"those there are: {there or 'none'}")
    return surface.fields[name]
