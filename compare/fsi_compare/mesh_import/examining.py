"""What `fsi-mesh check` asks of a mesh in any format: its size under each guess of the unit, gaps between its parts and
doubled points. All else is asked of the mesh by `fsi-mesh` itself."""

import shlex
from typing import Dict, List

import numpy as np

from .listing import MOST_VOLUMES, UNITS, box_of, separate_volumes, unit_words
from .parts import WHOLE, FoundMesh, shown_names
from .raw_mesh import Block
from .touching import Contact, contacts, doubled_words, gap_words, lonely


def examined(file: str, mesh: FoundMesh, scale: float) -> List[str]:
    """Lines; those of what may be wrong begin with "warning: ". The mesh is scaled already."""
    volumes = separate_volumes(mesh)
    lines = [_size(mesh, scale)]
    longest = float(box_of(mesh, WHOLE).max())
    if scale == 1 and (words := unit_words(longest)):
        lines.append(f"warning: {words}; fsi-mesh import {shlex.quote(file)} -o NEW.msh with it mends that")
    few = len(volumes) <= MOST_VOLUMES
    found = contacts(mesh.points, volumes, mesh.dimension, distances=few)
    lines += _contact_lines(file, mesh, volumes, found, few)
    doubled = doubled_words(mesh.points, [block for blocks in volumes.values() for block in blocks])
    return lines + ([f"warning: {doubled}: {_import(file)}"] if doubled else [])


def _size(mesh: FoundMesh, scale: float) -> str:
    box = box_of(mesh, WHOLE)
    sizes = [
        " x ".join(f"{x * factor:.4g}" for x in box) + f" mm if in {unit}"
        for unit, factor in (UNITS if scale == 1 else UNITS[:1])
    ]
    if scale != 1:
        sizes = [sizes[0].split(" if ")[0] + f" by --scale {scale:g}"]
    return f"size: {', '.join(sizes)}"


def _contact_lines(
    file: str, mesh: FoundMesh, volumes: Dict[str, List[Block]], found: List[Contact], few: bool
) -> List[str]:
    """Of volumes that share sides with another one, and of those that are alone."""
    sides = "triangles" if mesh.dimension == 3 else "edges"
    lines = [
        f"{contact.first} and {contact.second} touch: {contact.sides} {sides}, {contact.points} points"
        for contact in found
        if contact.sides
    ]
    alone = lonely(volumes, found)
    if not few:
        return lines + ([f"warning: no side in common with another volume has: {shown_names(alone)}"] if alone else [])
    said = []
    for contact in found:
        if not contact.sides and (contact.first in alone or contact.second in alone):
            said.append(f"warning: a gap: {gap_words(contact)}: {_import(file)}")
    return lines + said


def _import(file: str) -> str:
    return f"fsi-mesh import {shlex.quote(file)} -o NEW.msh"
