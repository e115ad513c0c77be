"""Groups of a mesh as a gmsh file, and checks of the mesh."""

from typing import Sequence, TextIO

import numpy as np

from ..base.errors import InputError, say_warning
from .groups import Group, as_sides
from .joining import distances_to
from .parts import FoundMesh
from .raw_mesh import ELEMENTS, KINDS, TURNED, Block
from .sources import Source
from .touching import contacts, doubled_words, gap_words


def require_sides(file: str, mesh: FoundMesh, groups: list[Group], sources: Sequence[Source]) -> None:
    """Facets of another file than the cells' are to be sides of cells."""
    missing = as_sides(mesh, groups)
    if not missing or len(sources) == 1:
        return
    group, corners = missing[0]
    at = next((source.file for source in sources if source.name == group.name), file)
    used = [block.nodes.ravel() for g in groups if g.dimension == mesh.dimension for block in g.parts]
    cells, loose = np.unique(np.concatenate(used)), np.setdiff1d(np.unique(corners), np.concatenate(used))
    count = sum(len(block.nodes) for block in group.parts)
    problem = f"{len(corners)} of its {count} {ELEMENTS[group.dimension]} are sides of no cell"
    if not len(loose):
        raise InputError(at, group.name, f"{problem}, though their corners are", "give the faces of this very mesh")
    span = float(np.ptp(mesh.points[cells], axis=0).max())
    farthest = float(distances_to(mesh.points[loose], mesh.points[cells], span).max())
    problem += f"; {len(loose)} of their corners are up to {farthest:.3g} mm from the cells' points"
    raise InputError(at, group.name, problem, f"give --join {1.1 * farthest:.2g}, if that is a small part of an edge")


def warn_of_gaps(mesh: FoundMesh, groups: list[Group]) -> None:
    """A volume that shares no side with another one is alone: no interface."""
    volumes: dict[str, list[Block]] = {}
    for group in groups:
        if group.dimension == mesh.dimension:
            volumes.setdefault(group.name, []).extend(group.parts)
    found = contacts(mesh.points, volumes, mesh.dimension)
    alone = False
    for name in volumes:
        mine = [contact for contact in found if name in (contact.first, contact.second)]
        if mine and not any(contact.sides for contact in mine):
            say_warning(f"{name} touches no other part: {'; '.join(gap_words(contact) for contact in mine)}")
            alone = True
    doubled = "" if alone else doubled_words(mesh.points, [block for parts in volumes.values() for block in parts])
    if doubled:
        say_warning(doubled)


def turn(mesh: FoundMesh, groups: list[Group]) -> int:
    """Turns linear and quadratic tetrahedra of negative volume; how many there were."""
    count = 0
    for block in (block for group in groups for block in group.parts if block.kind in TURNED):
        a, b, c, d = (mesh.points[block.nodes[:, k]] for k in range(4))
        wrong = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) < 0
        count += int(wrong.sum())
        block.nodes[wrong] = block.nodes[wrong][:, list(TURNED[block.kind])]
    return count


def write_gmsh(out: TextIO, mesh: FoundMesh, groups: list[Group]) -> None:
    """Writes gmsh's format. meshio's own writer takes a name once only, and volumes and surfaces may share one."""
    used = np.unique(np.concatenate([block.nodes.ravel() for group in groups for block in group.parts]))
    number = np.zeros(len(mesh.points), dtype=np.int64)
    number[used] = np.arange(1, len(used) + 1)
    names = {key: i for i, key in enumerate(dict.fromkeys((group.dimension, group.name) for group in groups), 1)}
    out.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(names)}\n")
    for (dimension, name), tag in names.items():
        out.write(f'{dimension} {tag} "{name}"\n')
    out.write(f"$EndPhysicalNames\n$Nodes\n{len(used)}\n")
    for i, (x, y, z) in enumerate(mesh.points[used].tolist(), 1):
        out.write(f"{i} {x!r} {y!r} {z!r}\n")
    blocks: list[tuple[int, Block]] = [(names[g.dimension, g.name], block) for g in groups for block in g.parts]
    out.write(f"$EndNodes\n$Elements\n{sum(len(block.nodes) for _, block in blocks)}\n")
    at = 0
    for tag, block in blocks:
        _, _, kind, order = KINDS[block.kind]
        for nodes in number[block.nodes[:, list(order)]]:
            at += 1
            out.write(f"{at} {kind} 2 {tag} {tag} {' '.join(map(str, nodes))}\n")
    out.write("$EndElements\n")
