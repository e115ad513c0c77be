"""Reads meshes of XDMF (.xdmf), with their data in the document, in HDF5 or in binary files.

meshio 5.0.0 takes the names of topologies in one spelling only ("Tetrahedron", not "tetrahedron", which dolfinx
writes), one grid a document, and no grid that includes the geometry of another one, as those of tags do."""

import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np

from ..base.errors import InputError
from ..base.files import exists
from .groups import corner_keys
from .raw_mesh import KINDS, NODES, Blocks, RawMesh, nothing

# Names of topologies in lower case without underscores: meshio's kind.
TOPOLOGIES = {"polyvertex": "vertex", "quadrilateral": "quad"} | {k: k for k in ("hexahedron", "wedge", "pyramid")}
TOPOLOGIES |= dict.fromkeys(("polyline", "edge", "interval", "line"), "line") | {"edge3": "line3"}
TOPOLOGIES |= dict.fromkeys(("triangle", "tri3"), "triangle") | dict.fromkeys(("triangle6", "tri6"), "triangle6")
TOPOLOGIES |= dict.fromkeys(("tetrahedron", "tet", "tet4"), "tetra")
TOPOLOGIES |= dict.fromkeys(("tetrahedron10", "tet10"), "tetra10")
# Kinds in a topology "Mixed" by number.
MIXED = {4: "triangle", 5: "quadrilateral", 6: "tetrahedron", 7: "pyramid", 8: "wedge", 9: "hexahedron"}
MIXED |= {34: "edge3", 36: "triangle6", 38: "tetrahedron10", 1: "polyvertex", 2: "polyline"}
WITH_SIZE = (1, 2)  # those whose size stands behind the number
TYPES = {"float": "f", "int": "i", "uint": "u", "char": "i", "uchar": "u"}
DAMAGES = (OSError, ValueError, LookupError, TypeError, OverflowError)
REMEDY = "write the mesh anew, for one as .vtu"


def read_xdmf(path: Path) -> RawMesh:
    """Grids of one geometry as one mesh, a series in time by its first time, with the names of a collection's blocks.
    Raises InputError."""
    try:
        return _Document(path).mesh()
    except ElementTree.ParseError as error:
        raise InputError(path, "", f"is no XML: {error}", REMEDY) from None
    except DAMAGES as error:
        raise InputError(path, "", f"cannot be read: {error}", REMEDY) from None


class _Document:
    def __init__(self, path: Path) -> None:
        self.path = path
        root = ElementTree.fromstring(path.read_bytes())
        domain = root.find("Domain")
        if root.tag.lower() != "xdmf" or domain is None:
            raise InputError(path, "", "holds no domain of XDMF", REMEDY)
        self.passed_over: dict[str, None] = {}
        self.root = root
        self.grids = list(self._uniform(domain))

    def mesh(self) -> RawMesh:
        if not self.grids:
            raise InputError(self.path, "", "holds no grid", REMEDY)
        points: np.ndarray | None = None
        blocks: Blocks = []
        data: dict[str, list[tuple[int, np.ndarray, np.ndarray]]] = {}  # name -> block, places, values
        named: dict[str, list[tuple[int, np.ndarray]]] = {}  # a collection's block -> block, places
        point_data: dict[str, np.ndarray] = {}
        for part, grid in self.grids:
            own = self._points(grid)
            if points is None:
                points = own
            elif own is not None and not np.array_equal(own, points):
                problem = f"has grids of several geometries, of which '{grid.get('Name', '')}' is one"
                remedy = "give each a file: fsi-mesh import ONE.xdmf OTHER.xdmf"
                raise InputError(self.path, "Geometry", problem, remedy)
            where, count = [], 0  # block, places in it, places in the grid
            for kind, nodes, places in self._elements(grid):
                block, at = _placed(blocks, kind, nodes)
                where.append((block, at, places))
                count += len(places)
            if not where:  # that of the first grid
                where = [(0, np.arange(len(blocks[0][1])), np.arange(len(blocks[0][1])))] if len(blocks) == 1 else []
                count = sum(len(places) for _, _, places in where)
            if part:
                named.setdefault(part, []).extend((block, at) for block, at, _ in where)
            for attribute in grid.findall("Attribute"):
                name, centre = attribute.get("Name", ""), attribute.get("Center", "Node").lower()
                values = self._scalars(attribute, name)
                if values is None:
                    continue
                if centre == "cell" and len(values) == count:
                    data.setdefault(name, []).extend((block, at, values[places]) for block, at, places in where)
                elif centre == "node" and points is not None and len(values) == len(points):
                    point_data[name] = values
                else:
                    self.passed_over[f"{name} ({len(values)} values at {centre}s)"] = None
        if points is None:
            raise InputError(self.path, "Geometry", "is missing", REMEDY)
        cell_data = {name: _spread(blocks, entries) for name, entries in data.items()}
        sets = {name: [_union(entries, i) for i in range(len(blocks))] for name, entries in named.items()}
        top = max((KINDS[kind][0] for kind, _ in blocks if kind in KINDS), default=0)
        solid = [i for i, (kind, _) in enumerate(blocks) if kind in KINDS and KINDS[kind][0] == top]
        # A name of all cells tells none apart: that of the only block, or of the mesh beside its tags.
        sets = {n: of for n, of in sets.items() if any(len(of[i]) < len(blocks[i][1]) for i in solid)}
        return RawMesh(points, blocks, cell_data, point_data, sets, passed_over=list(self.passed_over))

    def _uniform(self, parent: ElementTree.Element, block: str = "") -> list[tuple[str, ElementTree.Element]]:
        """Uniform grids within, of a series in time those of its first time, each with the name of the block of a
        collection that it is, or is in; empty: none."""
        found: list[tuple[str, ElementTree.Element]] = []
        temporal = parent.get("CollectionType", "").lower() == "temporal"
        for grid in parent.findall("Grid"):
            name = block if temporal or parent.tag != "Grid" else grid.get("Name", block)
            uniform = grid.get("GridType", "Uniform").lower() == "uniform"
            found += [(name, grid)] if uniform else self._uniform(grid, name)
            if temporal and found:
                break
        return found

    def _points(self, grid: ElementTree.Element) -> np.ndarray | None:
        geometry = grid.find("Geometry")
        if geometry is None:
            return None
        kind = (geometry.get("GeometryType") or geometry.get("Type") or "XYZ").upper()
        if kind not in ("XYZ", "XY"):
            raise InputError(self.path, "Geometry", f"is of the kind {kind}", "write the points as XYZ")
        return self._array(geometry).reshape(-1, len(kind)).astype(float)

    def _elements(self, grid: ElementTree.Element) -> list[tuple[str, np.ndarray, np.ndarray]]:
        """Kind, nodes and places in the grid of its elements, kind by kind; none where the grid includes another's."""
        topology = grid.find("Topology")
        if topology is None:
            return []
        said = topology.get("TopologyType") or topology.get("Type") or ""
        name = said.lower().replace("_", "")
        numbers = self._array(topology).astype(np.int64).ravel()
        if name == "mixed":
            return self._mixed(numbers)
        if name not in TOPOLOGIES:
            raise InputError(self.path, "Topology", f"is of the kind '{said}'", "write tetrahedra or triangles")
        kind = TOPOLOGIES[name]
        count = NODES[kind]
        said_count = int(topology.get("NodesPerElement") or count)
        if name in ("polyline", "polyvertex") and said_count != count:
            kind, count = f"polygon{said_count}", said_count
        if len(numbers) % count:
            problem = f"has {len(numbers)} numbers, which are no elements of {count} nodes"
            raise InputError(self.path, "Topology", problem, REMEDY)
        nodes = numbers.reshape(-1, count)
        return [(kind, nodes, np.arange(len(nodes)))]

    def _mixed(self, numbers: np.ndarray) -> list[tuple[str, np.ndarray, np.ndarray]]:
        found: dict[str, tuple[list[int], list[int]]] = {}  # kind -> where its nodes begin, places
        at, place, codes = 0, 0, numbers.tolist()
        while at < len(codes):
            code = codes[at]
            at += 1
            if code not in MIXED:
                raise InputError(self.path, "Topology", f"has an element of XDMF's kind {code}", REMEDY)
            at += code in WITH_SIZE
            name = MIXED[code]
            starts, places = found.setdefault(name, ([], []))
            starts.append(at)
            places.append(place)
            at += NODES[TOPOLOGIES[name]]
            place += 1
        result = []
        for name, (starts, places) in found.items():
            kind = TOPOLOGIES[name]
            result.append((kind, numbers[np.array(starts)[:, None] + np.arange(NODES[kind])], np.array(places)))
        return result

    def _scalars(self, attribute: ElementTree.Element, name: str) -> np.ndarray | None:
        kind = (attribute.get("AttributeType") or attribute.get("Type") or "Scalar").lower()
        if kind != "scalar":
            self.passed_over[f"{name} ({kind})"] = None
            return None
        return self._array(attribute).ravel()

    def _array(self, parent: ElementTree.Element) -> np.ndarray:
        """Numbers of the DataItem below an element."""
        item = self._item(parent)
        numbers = self._numbers(parent, item)
        said = [int(n) for n in item.get("Dimensions", "").split()]
        if said and int(np.prod(said)) != numbers.size:
            problem = f"has {numbers.size} numbers where the document says {' x '.join(map(str, said))}"
            raise InputError(self.path, parent.tag, problem, REMEDY)
        return numbers

    def _item(self, parent: ElementTree.Element) -> ElementTree.Element:
        item = parent.find("DataItem")
        if item is None:
            raise InputError(self.path, parent.tag, "has no DataItem", REMEDY)
        reference = item.get("Reference")
        if reference is not None:
            path = (item.text or "").strip() if reference.upper() == "XML" else reference
            target = self.root.find(re.sub(r"^/Xdmf/", "", path))
            if target is None:
                raise InputError(self.path, parent.tag, f"refers to {path}, which is not there", REMEDY)
            item = target
        kind = item.get("ItemType", "Uniform")
        if kind.lower() != "uniform":
            raise InputError(self.path, parent.tag, f"has a DataItem of the type {kind}", REMEDY)
        return item

    def _numbers(self, parent: ElementTree.Element, item: ElementTree.Element) -> np.ndarray:
        form = item.get("Format", "XML").upper()
        text = (item.text or "").strip()
        kind = TYPES.get((item.get("NumberType") or item.get("DataType") or "Float").lower())
        if kind is None:
            raise InputError(self.path, parent.tag, "holds no numbers", REMEDY)
        if form == "XML":
            return np.array(text.split(), dtype=float if kind == "f" else np.int64)
        if form == "HDF":
            return self._of_hdf(text)
        if form == "BINARY":
            order = ">" if item.get("Endian", "").lower() == "big" else "<"
            width = int(item.get("Precision") or 4)
            return np.fromfile(self._beside(text), dtype=f"{order}{kind}{width}", offset=int(item.get("Seek") or 0))
        raise InputError(self.path, "DataItem", f"is of the format {form}", REMEDY)

    def _of_hdf(self, text: str) -> np.ndarray:
        import h5py  # takes a while to load

        name, _, inside = text.rpartition(":")
        with h5py.File(self._beside(name), "r") as opened:
            if inside not in opened:
                raise InputError(self.path, "DataItem", f"asks {name} for {inside}, which is not there", REMEDY)
            return np.asarray(opened[inside])

    def _beside(self, name: str) -> Path:
        file = self.path.parent / name
        if not exists(file):
            raise InputError(self.path, "DataItem", f"{name} is not beside it", "copy the data file there, too")
        return file


def _placed(blocks: Blocks, kind: str, nodes: np.ndarray) -> tuple[int, np.ndarray]:
    """Places of these elements: in a block that has them all, in any order, as tags of cells do; else in an added
    block."""
    for i, (other, there) in enumerate(blocks):
        if other == kind and kind in KINDS and len(nodes) and len(there):
            keys = corner_keys(kind, np.concatenate([there, nodes]))
            mine, known = keys[len(there) :], keys[: len(there)]
            order = np.argsort(known, kind="stable")
            at = np.searchsorted(known[order], mine)
            if np.all(at < len(known)) and np.array_equal(known[order][at], mine):
                return i, order[at]
    blocks.append((kind, nodes))
    return len(blocks) - 1, np.arange(len(nodes))


def _union(entries: list[tuple[int, np.ndarray]], block: int) -> np.ndarray:
    """Places in a block."""
    return np.unique(np.concatenate([nothing(), *(at for own, at in entries if own == block)]))


def _spread(blocks: Blocks, entries: list[tuple[int, np.ndarray, np.ndarray]]) -> list[np.ndarray]:
    """An array a block, NaN where nothing is said."""
    whole = [np.full(len(nodes), np.nan) for _, nodes in blocks]
    for block, at, values in entries:
        whole[block][at] = values
    return whole
