"""What `fsi-mesh check` asks of a mesh in any format: its size under each guess of the unit, gaps between its parts and
doubled points. All else is asked of the mesh by `fsi-mesh` itself."""

import shlex
from typing import Sequence

import numpy as np

from .listing import MOST_VOLUMES, UNITS, box_of, separate_volumes, unit_words
from .parts import WHOLE, FoundMesh, shown_names
from .raw_mesh import Block
from .touching import Contact, contacts, doubled_words, gap_words, lonely


def examined(file: str, mesh: FoundMesh, scale: float, groups: Sequence[tuple[str, str]]) -> list[str]:
    """Lines; those of what may be wrong begin with "warning: ", and one with "options: " where an import needs any to
    name the parts as they are taken here. The mesh is scaled already."""
    options = "".join(f" --group {shlex.quote(f'{name}={part}')}" for name, part in groups)
    options += f" --scale {scale:g}" if scale != 1 else ""
    command = f"fsi-mesh import {shlex.quote(file)}{options} -o NEW.msh"
    volumes = separate_volumes(mesh)
    lines = [_size(mesh, scale)]
    longest = float(box_of(mesh, WHOLE).max())
    if scale == 1 and (words := unit_words(longest)):
        lines.append(f"warning: {words}; {command} with it mends that")
    few = len(volumes) <= MOST_VOLUMES
    found = contacts(mesh.points, volumes, mesh.dimension, distances=few)
    lines += _contact_lines(command, mesh, volumes, found, few)
    doubled = doubled_words(mesh.points, [block for blocks in volumes.values() for block in blocks])
    lines += [f"warning: {doubled}: {command}"] if doubled else []
    return lines + ([f"options:{options}"] if options else [])


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
    command: str, mesh: FoundMesh, volumes: dict[str, list[Block]], found: list[Contact], few: bool
) -> list[str]:
    """Lines about volumes that share sides with another one, and about those that are alone."""
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
            said.append(f"warning: a gap: {gap_words(contact)}: {command}")
    return lines + said
