"""What `fsi-mesh check` asks of a mesh in any format: its size under each guess of the unit, gaps between its parts and
doubled points. All else is asked of the mesh by `fsi-mesh` itself."""

import shlex
from typing import Sequence

from .listing import MOST_VOLUMES, UNITS, Volumes, box_of, separate_volumes, unit_words
from .parts import WHOLE, FoundMesh, shown_names
from .touching import Contact, contacts, doubled_words, gap_words, lonely, touch_words


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
    lines += _contact_lines(command, volumes, contacts(mesh.points, volumes, mesh.dimension, distances=few), few)
    doubled = doubled_words(mesh.points, [block for blocks in volumes.values() for block in blocks])
    lines += [f"warning: {doubled}: {command}"] if doubled else []
    return lines + ([f"options:{options}"] if options else [])


def _size(mesh: FoundMesh, scale: float) -> str:
    box = box_of(mesh, WHOLE)
    guesses = [(f"if in {unit}", factor) for unit, factor in UNITS] if scale == 1 else [(f"by --scale {scale:g}", 1.0)]
    sizes = [" x ".join(f"{x * factor:.4g}" for x in box) + f" mm {words}" for words, factor in guesses]
    return f"size: {', '.join(sizes)}"


def _contact_lines(command: str, volumes: Volumes, found: list[Contact], few: bool) -> list[str]:
    """Lines about volumes that share sides with another one, and about those that are alone."""
    lines = [touch_words(contact) for contact in found if contact.sides]
    alone = lonely(volumes, found)
    if not few:
        return lines + ([f"warning: no side in common with another volume has: {shown_names(alone)}"] if alone else [])
    apart = [contact for contact in found if not contact.sides and {contact.first, contact.second} & set(alone)]
    return lines + [f"warning: a gap: {gap_words(contact)}: {command}" for contact in apart]
