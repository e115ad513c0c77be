"""A short tube as SimVascular lays out a project of svMultiPhysics: a folder of mesh for each medium, faces as .vtp, ids
of nodes, elements, regions and faces, all in cm; and the solver.xml of a case on it. Coarse: it is to be read."""

import meshio
import numpy as np

# A hexahedron as six tetrahedra about its diagonal, the same in each: their faces fit from cell to cell.
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
TETRAHEDRA = ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6))
RADIUS, THICKNESS, LENGTH = 1.0, 0.5, 4.0  # mm
ACROSS, ALONG = 6, 4  # cells: of these across, one on each side is wall


def tube():
    """Points, mm; tetrahedra of fluid and wall; triangles of the faces by name."""
    n, m = ACROSS + 1, ALONG + 1
    i, j, k = (axis.ravel() for axis in np.meshgrid(np.arange(n), np.arange(n), np.arange(m), indexing="ij"))
    half = ACROSS // 2
    ring = np.maximum(np.abs(i - half), np.abs(j - half))  # squares around the axis
    radii = np.concatenate([np.linspace(0, RADIUS, half), [RADIUS + THICKNESS]])
    # A square of the grid, half way to its circle: no cell is flat.
    direction = np.stack([i - half, j - half], axis=1) / np.maximum(ring, 1)[:, None]
    length = np.maximum(np.linalg.norm(direction, axis=1), 1e-300)[:, None]
    rounded = direction * (0.4 + 0.6 / length)
    points = np.column_stack([radii[ring][:, None] * rounded, k * LENGTH / ALONG])
    number = np.arange(n * n * m).reshape(n, n, m)
    fluid, wall = [], []
    for a, b, c in np.ndindex(ACROSS, ACROSS, ALONG):
        nodes = number[tuple((CORNERS + [a, b, c]).T)]
        cells = nodes[list(map(list, TETRAHEDRA))]
        (wall if a in (0, ACROSS - 1) or b in (0, ACROSS - 1) else fluid).append(cells)
    media = {"fluid": np.concatenate(fluid), "wall": np.concatenate(wall)}
    faces = {}
    for medium, cells in media.items():
        boundary = sides_once(cells)
        at = points[boundary]
        for end, z in (("inlet", 0.0), ("outlet", LENGTH)):
            faces[f"{medium}_{end}"] = boundary[np.all(np.abs(at[:, :, 2] - z) < 1e-9, axis=1)]
        along = boundary[np.ptp(at[:, :, 2], axis=1) > 1e-9]
        outer = np.all(ring[along] == half, axis=1)
        if medium == "fluid":
            faces["interface"] = along
        else:
            faces["outside"] = along[outer]
    return points, media, faces


def sides_once(cells):
    sides = np.concatenate([cells[:, list(side)] for side in ((1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2))])
    _, first, uses = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
    return sides[first[uses == 1]]


def write_volume(path, points, cells, region):
    used, numbers = np.unique(cells, return_inverse=True)
    mesh = meshio.Mesh(points[used], [("tetra", numbers.reshape(cells.shape))])
    mesh.point_data["GlobalNodeID"] = np.arange(1, len(used) + 1, dtype=np.int32)
    mesh.cell_data["GlobalElementID"] = [np.arange(1, len(cells) + 1, dtype=np.int32)]
    mesh.cell_data["ModelRegionID"] = [np.full(len(cells), region, dtype=np.int32)]
    path.parent.mkdir(parents=True, exist_ok=True)
    mesh.write(path)


def write_face(path, points, triangles, face):
    used, numbers = np.unique(triangles, return_inverse=True)

    def array(kind, name, values, components=1):
        text = " ".join(map(str, np.asarray(values).ravel()))
        tag = f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">'
        return f"{tag}{text}</DataArray>"

    count = len(triangles)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(
        '<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>'
        f'<Piece NumberOfPoints="{len(used)}" NumberOfPolys="{count}">'
        f'<PointData>{array("Int32", "GlobalNodeID", used + 1)}</PointData>'
        f'<CellData>{array("Int32", "GlobalElementID", range(1, count + 1))}'
        f'{array("Int32", "ModelFaceID", [face] * count)}</CellData>'
        f'<Points>{array("Float64", "Points", points[used], 3)}</Points>'
        f'<Polys>{array("Int64", "connectivity", numbers)}'
        f'{array("Int64", "offsets", range(3, 3 * count + 1, 3))}</Polys>'
        "</Piece></PolyData></VTKFile>"
    )


def write_meshes(folder, cm_of_mm=0.1):
    """mesh/lumen and mesh/wall below the folder. Returns the tube."""
    points, media, faces = tube()
    at = points * cm_of_mm
    for number, (medium, name) in enumerate((("fluid", "lumen"), ("wall", "wall"))):
        write_volume(folder / "mesh" / name / "mesh-complete.mesh.vtu", at, media[medium], number + 1)
        own = [
            face
            for face in faces
            if face.startswith(medium) or face == ("interface" if medium == "fluid" else "outside")
        ]
        for k, face in enumerate(own):
            write_face(folder / "mesh" / name / "mesh-surfaces" / f"{face}.vtp", at, faces[face], k + 1)
    write_face(folder / "mesh" / "wall" / "mesh-surfaces" / "inside.vtp", at, faces["interface"], 9)
    return points, media, faces


GENERAL = """<GeneralSimulationParameters>
  <Continue_previous_simulation> 0 </Continue_previous_simulation>
  <Number_of_spatial_dimensions> 3 </Number_of_spatial_dimensions>
  <Number_of_time_steps> {steps} </Number_of_time_steps>
  <Time_step_size> {step} </Time_step_size>
  <Spectral_radius_of_infinite_time_step> 0.50 </Spectral_radius_of_infinite_time_step>
  <Save_results_to_VTK_format> true </Save_results_to_VTK_format>
  <Increment_in_saving_VTK_files> 2 </Increment_in_saving_VTK_files>
  <Start_saving_after_time_step> 1 </Start_saving_after_time_step>
</GeneralSimulationParameters>
"""


def mesh_entry(name, folder, faces, domain=""):
    text = f'<Add_mesh name="{name}">\n  <Mesh_file_path> mesh/{folder}/mesh-complete.mesh.vtu </Mesh_file_path>\n'
    for face, file in faces.items():
        path = f"mesh/{folder}/mesh-surfaces/{file}.vtp"
        text += f'  <Add_face name="{face}">\n    <Face_file_path> {path} </Face_file_path>\n'
        text += "  </Add_face>\n"
    return text + (f"  <Domain> {domain} </Domain>\n" if domain != "" else "") + "</Add_mesh>\n"


LUMEN = {"lumen_inlet": "fluid_inlet", "lumen_outlet": "fluid_outlet", "lumen_wall": "interface"}
WALL = {"wall_inlet": "wall_inlet", "wall_outlet": "wall_outlet", "wall_inner": "inside", "wall_outer": "outside"}
FLUID_VALUES = """<Density> 1.06 </Density>
  <Viscosity model="Constant"><Value> 0.04 </Value></Viscosity>
  <Backflow_stabilization_coefficient> 0.2 </Backflow_stabilization_coefficient>
"""
WALL_VALUES = """<Constitutive_model type="neoHookean"> </Constitutive_model>
  <Dilational_penalty_model> quad </Dilational_penalty_model>
  <Density> 1.2 </Density>
  <Elasticity_modulus> 4.0e6 </Elasticity_modulus>
  <Poisson_ratio> 0.45 </Poisson_ratio>
"""
LS = '<LS type="GMRES"><Tolerance> 1e-6 </Tolerance></LS>'
RCR = """<Type> Neu </Type> <Time_dependence> RCR </Time_dependence>
  <RCR_values> <Capacitance> 1.5e-5 </Capacitance> <Distal_resistance> 1212 </Distal_resistance>
    <Proximal_resistance> 121 </Proximal_resistance> <Distal_pressure> 0 </Distal_pressure>
    <Initial_pressure> 2e4 </Initial_pressure> </RCR_values>"""
CLAMP = "<Type> Dir </Type> <Value> 0.0 </Value>"


def condition(face, text):
    return f'<Add_BC name="{face}"> {text} </Add_BC>\n'


def whole(*parts):
    return (
        '<?xml version="1.0" encoding="UTF-8" ?>\n<svMultiPhysicsFile version="0.1">\n'
        + "".join(parts)
        + "</svMultiPhysicsFile>\n"
    )


def fsi(wall=WALL_VALUES, fluid=FLUID_VALUES, conditions=None, steps=4, step="1e-4"):
    conditions = conditions or {
        "lumen_inlet": "<Type> Neu </Type> <Value> 2.0e4 </Value>",
        "lumen_outlet": RCR,
        "wall_inlet": CLAMP,
        "wall_outlet": CLAMP,
        "wall_outer": "<Type> Robin </Type> <Stiffness> 1e6 </Stiffness> <Damping> 100 </Damping>",
    }
    return whole(
        GENERAL.format(steps=steps, step=step),
        mesh_entry("lumen", "lumen", LUMEN, 0),
        mesh_entry("vessel", "wall", WALL, 1),
        '<Add_projection name="wall_inner"> <Project_from_face> lumen_wall </Project_from_face> </Add_projection>\n',
        f'<Add_equation type="FSI"> <Coupled> true </Coupled> <Max_iterations> 7 </Max_iterations>\n'
        f'<Domain id="0"> <Equation> fluid </Equation> {fluid} </Domain>\n'
        f'<Domain id="1"> <Equation> struct </Equation> {wall} </Domain>\n{LS}\n',
        *(condition(face, text) for face, text in conditions.items()),
        "</Add_equation>\n",
        f'<Add_equation type="mesh"> <Poisson_ratio> 0.3 </Poisson_ratio> {LS} {condition("lumen_inlet", CLAMP)}',
        "</Add_equation>\n",
    )


def rigid(conditions, fluid=FLUID_VALUES, steps=4, step="1e-3", more=""):
    return whole(
        GENERAL.format(steps=steps, step=step),
        mesh_entry("msh", "lumen", LUMEN),
        f'<Add_equation type="fluid"> {fluid} {LS}\n',
        *(condition(face, text) for face, text in conditions.items()),
        f"{more}</Add_equation>\n",
    )


def wall_alone(conditions, wall=WALL_VALUES, equation="struct", steps=4, step="1e-4"):
    return whole(
        GENERAL.format(steps=steps, step=step),
        mesh_entry("vessel", "wall", WALL),
        f'<Add_equation type="{equation}"> {wall} {LS}\n',
        *(condition(face, text) for face, text in conditions.items()),
        "</Add_equation>\n",
    )
