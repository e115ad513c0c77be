"""Just enough of gmsh's 2.2 ASCII format to cut meshes into scenes that fsi-mesh does not make."""

from itertools import combinations

TRIANGLE, TETRAHEDRON = 2, 4
CORNERS = {TRIANGLE: 3, TETRAHEDRON: 4}


class Mesh:
    """Nodes {tag: text of the coordinates} and elements {group: [corner tags]} of triangles and tetrahedra."""

    def __init__(self, file):
        lines = iter(file.read_text().splitlines())
        names, self.nodes, self.triangles, self.tetrahedra = {}, {}, {}, {}
        kinds = {TRIANGLE: self.triangles, TETRAHEDRON: self.tetrahedra}
        for line in lines:
            if line == "$PhysicalNames":
                for _ in range(int(next(lines))):
                    dimension, tag, name = next(lines).split(maxsplit=2)
                    names[int(dimension), int(tag)] = name.strip('"')
            elif line == "$Nodes":
                for _ in range(int(next(lines))):
                    tag, point = next(lines).split(maxsplit=1)
                    self.nodes[int(tag)] = point
            elif line == "$Elements":
                for _ in range(int(next(lines))):
                    _, kind, tags, physical, *rest = (int(word) for word in next(lines).split())
                    group = names[2 if kind == TRIANGLE else 3, physical]
                    kinds[kind].setdefault(group, []).append(tuple(rest[tags - 1 :]))

    def shared_faces(self, volume):
        """Faces between a volume and the others."""
        others = {face for name, cells in self.tetrahedra.items() if name != volume for face in faces(cells)}
        return sorted(faces(self.tetrahedra[volume]) & others)

    def write(self, file):
        used = {node for group in self.tetrahedra.values() for cell in group for node in cell}
        groups = [(2, TRIANGLE, self.triangles), (3, TETRAHEDRON, self.tetrahedra)]
        numbered = [
            (dimension, kind, tag, name, cells)
            for dimension, kind, named in groups
            for tag, (name, cells) in enumerate(named.items(), start=1)
        ]
        elements = [(kind, tag, cell) for _, kind, tag, _, cells in numbered for cell in cells]
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(numbered))]
        lines += [f'{dimension} {tag} "{name}"' for dimension, _, tag, name, _ in numbered]
        lines += ["$EndPhysicalNames", "$Nodes", str(len(used))]
        lines += [f"{tag} {point}" for tag, point in self.nodes.items() if tag in used]
        lines += ["$EndNodes", "$Elements", str(len(elements))]
        lines += [
            " ".join(map(str, (number, kind, 2, tag, tag, *cell)))
            for number, (kind, tag, cell) in enumerate(elements, start=1)
        ]
        file.write_text("\n".join([*lines, "$EndElements", ""]))
        return file


def faces(cells):
    """The triangles of tetrahedra, corners sorted."""
    return {tuple(sorted(face)) for cell in cells for face in combinations(cell, 3)}
