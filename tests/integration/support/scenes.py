"""Small coupled scenes of every element and geometry, for the paper's case files."""

from math import pi, sin

from programs import ARTERY, make_mesh

ELEMENTS = {"p1": 1, "p2p1": 2}  # and the order of their meshes
GEOMETRIES = ("3d", "axisymmetric", "plane")
KINDS = [(element, geometry) for element in ELEMENTS for geometry in GEOMETRIES]

# Sections of case files that several tests put together.
FLUID = """[fluid]
density = 1.0
viscosity = 3.5e-3
"""
WALL = """[structure]
density = 1.2
bulk_modulus = 1e5
[structure.layers.media]
material = "neo-hookean"
c10 = 3.0
[structure.layers.adventitia]
material = "neo-hookean"
c10 = 0.3
"""

TUBE = ("--length", 3, "--lumen-cells", 2, "--media-cells", 1, "--adventitia-cells", 1)
# A quarter between planes of symmetry, and half a section: some hundred nodes.
TUBES = {
    "3d": (*TUBE, "--axial-cells", 4, "--around", 8, "--sector", 90),
    "axisymmetric": (*TUBE, "--axial-cells", 8, "--axisymmetric"),
}


def forms(case):
    """The paper's files ask for its stabilisation and a wall pressure that does not jump. In the tests the one with
    fibres has the programs' own defaults in their place."""
    return ("stabilisation=projected", "structure.layer_pressure=separate") if case == ARTERY else ()


def scene(folder, element, geometry):
    """Settings that put a case of the artery on a mesh in `folder`, made on first use."""
    file = folder / f"{geometry}-{ELEMENTS[element]}.msh"
    if not file.exists():
        if geometry == "plane":
            write_channel(file, ELEMENTS[element])
        else:
            make_mesh(file, *TUBES[geometry], "--order", ELEMENTS[element])
    return f"element={element}", f"geometry={geometry}", f"mesh.file={file}"


def scaled(mesh, file, factor):
    """A gmsh file with its nodes nearer to the origin: coordinates are the lines of three numbers among its nodes."""
    lines = mesh.read_text().split("\n")
    begin, end = lines.index("$Nodes"), lines.index("$EndNodes")
    for i in range(begin, end):
        words = lines[i].split()
        if len(words) == 3:
            lines[i] = " ".join(repr(factor * float(word)) for word in words)
    file.write_text("\n".join(lines))
    return file


HEIGHTS = (0.0, 0.5, 1.0, 1.25, 1.4)  # mm, where rows of cells meet
ROWS = ("fluid", "fluid", "media", "adventitia")
LENGTH, COLUMNS, BULGE = 3.0, 6, 0.1  # mm, cells, part of the height


def write_channel(file, order=1):
    """The upper half of a plane channel along x between walls of two layers, as a gmsh file: y = 0 is a plane of
    symmetry. The channel widens in its middle, so that the edges of quadratic cells are curved."""
    nodes, points, groups = {}, [], {}

    def node(i, j):  # in half cells
        if (i, j) not in nodes:
            x, lower, upper = LENGTH * i / (2 * COLUMNS), HEIGHTS[j // 2], HEIGHTS[(j + 1) // 2]
            y = (lower + upper) / 2
            points.append(f"{x!r} {y * (1 + BULGE * min(y, 1) * sin(pi * x / LENGTH))!r} 0.0")
            nodes[i, j] = len(points)
        return nodes[i, j]

    def add(group, *corners):  # in cells
        around = [(0, 1), (1, 2), (2, 0)] if len(corners) == 3 else [(0, 1)]
        cell = [node(2 * i, 2 * j) for i, j in corners]
        if order == 2:
            cell += [node(corners[a][0] + corners[b][0], corners[a][1] + corners[b][1]) for a, b in around]
        groups.setdefault((len(corners) - 1, group), []).append(cell)

    for j, region in enumerate(ROWS):
        for i in range(COLUMNS):
            a, b, c, d = (i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)
            for triangle in ((a, b, c), (a, c, d)) if (i + j) % 2 else ((a, b, d), (b, c, d)):
                add(region, *triangle)
            if j == 0:
                add("symmetry_y", a, b)
            if j == len(ROWS) - 1:
                add("outer", d, c)
        for i, opening in ((0, "inlet"), (COLUMNS, "outlet")):
            add(opening if region == "fluid" else "wall_ends", (i, j), (i, j + 1))

    kinds = {1: {1: 1, 2: 8}, 2: {1: 2, 2: 9}}  # gmsh's numbers for lines and triangles
    elements = [
        (kinds[dimension][order], tag, cell)
        for tag, ((dimension, _), cells) in enumerate(groups.items(), start=1)
        for cell in cells
    ]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(groups))]
    lines += [f'{dimension} {tag} "{name}"' for tag, (dimension, name) in enumerate(groups, start=1)]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(points))]
    lines += [f"{tag} {point}" for tag, point in enumerate(points, start=1)]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [
        " ".join(map(str, (number, kind, 2, tag, tag, *cell)))
        for number, (kind, tag, cell) in enumerate(elements, start=1)
    ]
    file.write_text("\n".join([*lines, "$EndElements", ""]))
    return file
