"""Arrays of VTK's XML files (.vtp, .vtu): text, base64 or raw, packed by zlib, lzma or not.

Base64 is decoded piece by piece: each piece has a padding of its own, at which Python 3.13 and later refuse to go
on."""

import base64
import lzma
import re
import struct
import xml.etree.ElementTree as ElementTree
import zlib
from pathlib import Path
from typing import Any, Callable, Iterator, TypeVar

import numpy as np

from ..base.errors import InputError
from ..base.files import exists

TYPES = {f"{kind}{8 * size}": f"{kind[0].lower()}{size}" for kind in ("Int", "UInt") for size in (1, 2, 4, 8)}
TYPES |= {"Float32": "f4", "Float64": "f8"}
RAW = re.compile(rb"""encoding\s*=\s*["']raw["']""")

EXTENSIONS = {"PolyData": ".vtp", "UnstructuredGrid": ".vtu"}
UNPACKERS: dict[str, Callable[[bytes], bytes]] = {
    "": lambda data: data,
    "vtkZLibDataCompressor": zlib.decompress,
    "vtkLZMADataCompressor": lzma.decompress,
}
# What a damaged file raises beside InputError.
DAMAGES = (OSError, ValueError, struct.error, zlib.error, lzma.LZMAError, LookupError, TypeError, OverflowError)


class VtkFile:
    """The arrays of one file. `contents` is the kind of data set that is asked for, as `PolyData`. Raises
    InputError."""

    def __init__(self, path: Path, contents: str) -> None:
        self.path, self.contents = path, contents
        text = path.read_bytes()
        if text.startswith(b"version https://git-lfs"):
            raise InputError(path, "", "is a pointer of Git LFS in the place of the file", "fetch it by git lfs pull")
        # What is appended raw is no XML: it is cut out, from the underscore on.
        found = re.search(rb"<AppendedData[^>]*>\s*_", text)
        self.appended, self.raw = b"", False
        if found:
            end = text.rindex(b"</AppendedData>")
            self.appended = text[found.end() : end]
            self.raw = RAW.search(found.group()) is not None
            text = text[: found.start()] + text[end + len(b"</AppendedData>") :]
        try:
            self.root = ElementTree.fromstring(text)
        except ElementTree.ParseError as error:
            raise InputError(path, "", f"is no XML: {error}", f"write it anew as {EXTENSIONS[contents]}") from None
        if self.root.tag != "VTKFile" or self.root.get("type") != contents:
            raise InputError(path, "", f"holds no {contents} of VTK", f"write it as {EXTENSIONS[contents]}")
        self.order = "<" if self.root.get("byte_order", "LittleEndian") == "LittleEndian" else ">"
        self.header = self.order + ("Q" if self.root.get("header_type") == "UInt64" else "I")
        compressor = self.root.get("compressor", "")
        if compressor not in UNPACKERS:
            raise InputError(path, "", f"is packed by {compressor}", "write it with zlib or without packing")
        self.packed = bool(compressor)
        self.unpack = UNPACKERS[compressor]

    def array(self, element: Any) -> np.ndarray:
        """A DataArray's numbers, in rows of its components."""
        kind = TYPES.get(element.get("type", ""))
        if kind is None:
            raise InputError(self.path, element.get("Name", "array"), "is no array of numbers")
        form = element.get("format", "ascii")
        if form == "ascii":
            numbers = np.array((element.text or "").split(), dtype=kind)
        else:
            binary = form == "binary"
            if not binary and not self.appended:
                raise InputError(self.path, element.get("Name", "array"), "is appended to a file without AppendedData")
            data = (element.text or "").strip().encode() if binary else self.appended[int(element.get("offset", "0")) :]
            raw = self.raw and not binary
            numbers = np.frombuffer(self._unpacked(data if raw else self._coded(data)), self.order + kind)
        components = int(element.get("NumberOfComponents") or 1)
        return numbers.reshape(-1, components) if components > 1 else numbers

    def _coded(self, text: bytes) -> bytes:
        """Bytes of base64: header and data are coded one after the other, each with a padding of its own."""
        size = struct.calcsize(self.header)
        length = -(-size // 3) * 4
        (count,) = struct.unpack_from(self.header, base64.b64decode(text[:length]))  # of bytes, or of packed blocks
        if not self.packed:
            return base64.b64decode(text[: -(-(size + count) // 3) * 4])
        length = -(-size * (3 + count) // 3) * 4
        head = base64.b64decode(text[:length])
        counts = struct.unpack_from(f"{self.order}{count}{self.header[1]}", head, 3 * size)
        return head + base64.b64decode(text[length : length + -(-sum(counts) // 3) * 4])

    def _unpacked(self, data: bytes) -> bytes:
        size = struct.calcsize(self.header)
        (first,) = struct.unpack_from(self.header, data)
        if not self.packed:
            return data[size : size + first]
        counts = struct.unpack_from(f"{self.order}{first}{self.header[1]}", data, 3 * size)
        at, parts = size * (3 + first), []
        for count in counts:
            parts.append(self.unpack(data[at : at + count]))
            at += count
        return b"".join(parts)


def scalars_of(
    file: VtkFile, piece: Any, place: str, count: int, passed_over: dict[str, None]
) -> dict[str, np.ndarray]:
    """Arrays of one number an entry below `place` of a piece. Others are not decoded: files of results may have
    hundreds. `passed_over` gets a word on each of these, once."""
    found = {}
    for element in piece.findall(f"{place}/DataArray"):
        name, components = element.get("Name", ""), int(element.get("NumberOfComponents") or 1)
        if element.get("type") not in TYPES:
            passed_over[f"{name} (no numbers)"] = None
            continue
        if components > 1:
            passed_over[f"{name} ({components} components)"] = None
            continue
        values = file.array(element)
        if len(values) != count:
            problem = f"has {len(values)} numbers for {count} {'points' if place == 'PointData' else 'cells'}"
            raise InputError(file.path, name, problem, f"write it anew as {EXTENSIONS[file.contents]}")
        found[name] = values
    return found


Read = TypeVar("Read")


def read_by(reader: Callable[[VtkFile], Read], path: Path, contents: str, what: str) -> Read:
    """What `reader` makes of a file, `what` for its message. Raises InputError, of damages too."""
    if not exists(path):
        raise InputError(path, "", "no such file", f"give a {what}, {EXTENSIONS[contents]}")
    try:
        return reader(VtkFile(path, contents))
    except DAMAGES as error:
        remedy = f"write the {what} anew as {EXTENSIONS[contents]}"
        raise InputError(path, "", f"cannot be read: {error}", remedy) from None


def require_points(file: VtkFile, nodes: np.ndarray, count: int) -> None:
    if np.any((nodes < 0) | (nodes >= count)):
        raise InputError(file.path, "connectivity", "names a point that is not there", "write the mesh anew")


def pieces(file: VtkFile) -> Iterator[tuple[Any, np.ndarray]]:
    """The pieces that have points, and these, (points, 3)."""
    for piece in file.root.iter("Piece"):
        there = piece.find("Points/DataArray")
        if there is not None:
            yield piece, file.array(there).reshape(-1, 3)
