"""Unstructured grids as VTK's XML files (.vtu), and series of them by their times (.pvd): what VisIt, ParaView and
meshio open. [Kitware's VTK file formats] Not by meshio's own writer: it leaves out the time."""

import base64
import struct
import zlib
from pathlib import Path
from typing import Sequence
from xml.sax.saxutils import quoteattr

import numpy as np

CELL_TYPES = {3: 5, 4: 10, 6: 22, 10: 24}  # by nodes: triangle, tetrahedron, and their quadratic forms
HEAD = '<?xml version="1.0"?>\n'
Arrays = dict[str, np.ndarray]  # by name
BLOCK = 1 << 22  # bytes that are compressed at once


def write_vtu(
    path: Path, points: np.ndarray, cells: np.ndarray, of_points: Arrays, of_cells: Arrays, time: float
) -> None:
    """One grid at one time, in ms, which stands in the file as TimeValue. `points` (nodes, 3), `cells` (cells, 3, 4, 6
    or 10), values (nodes or cells,) or (..., components). Numbers keep their bits."""
    count = cells.shape[1]
    kinds = np.full(len(cells), CELL_TYPES[count], dtype=np.uint8)
    ends = count * np.arange(1, len(cells) + 1, dtype=np.int64)
    with open(path, "w", encoding="ascii") as out:
        out.write(
            HEAD + '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64" '
            'compressor="vtkZLibDataCompressor">\n<UnstructuredGrid>\n<FieldData>\n'
        )
        out.write(_array("TimeValue", np.array([time]), ' NumberOfTuples="1"'))
        out.write(f'</FieldData>\n<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">\n<Points>\n')
        out.write(_array("Points", points) + "</Points>\n<Cells>\n")
        for name, values in (("connectivity", cells.astype(np.int64).ravel()), ("offsets", ends), ("types", kinds)):
            out.write(_array(name, values))
        out.write("</Cells>\n")
        for tag, arrays in (("PointData", of_points), ("CellData", of_cells)):
            out.write(f"<{tag}>\n" + "".join(_array(name, arrays[name]) for name in sorted(arrays)) + f"</{tag}>\n")
        out.write("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")


def write_pvd(path: Path, series: Sequence[tuple[float, str]]) -> None:
    """A series of (time in ms, file beside it)."""
    sets = "".join(f'<DataSet timestep="{time!r}" part="0" file={quoteattr(file)}/>\n' for time, file in series)
    path.write_text(
        HEAD + '<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">\n<Collection>\n'
        f"{sets}</Collection>\n</VTKFile>\n",
        encoding="utf-8",
    )


TYPES = {"f8": "Float64", "f4": "Float32", "i8": "Int64", "i4": "Int32", "u1": "UInt8"}


def _array(name: str, values: np.ndarray, more: str = "") -> str:
    little = np.ascontiguousarray(values, dtype=values.dtype.newbyteorder("<"))
    components = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
    kind = TYPES[little.dtype.str[1:]]
    text = _compressed(little.tobytes())
    return f'<DataArray type="{kind}" Name={quoteattr(name)}{components}{more} format="binary">\n{text}\n</DataArray>\n'


def _compressed(data: bytes) -> str:
    """Number of blocks, length of a block and of the last one if it is shorter, lengths when compressed; the blocks."""
    blocks: list[bytes] = [zlib.compress(data[at : at + BLOCK], 1) for at in range(0, len(data), BLOCK)]
    head = struct.pack(f"<{3 + len(blocks)}Q", len(blocks), BLOCK, len(data) % BLOCK, *map(len, blocks))
    return base64.b64encode(head).decode("ascii") + base64.b64encode(b"".join(blocks)).decode("ascii")
