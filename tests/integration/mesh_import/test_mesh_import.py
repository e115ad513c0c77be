"""fsi-mesh import: meshes of other programs, in formats that meshio reads."""

import functools
import math
import re
import shlex
import shutil
import unittest

import meshio
import numpy as np

from programs import MESH, MONOLITHIC, FolderTest, execute

# A tetrahedron of which two sides are an inlet, one of them turned round.
TURNED = """$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
2 2 "inlet"
3 1 "fluid"
$EndPhysicalNames
$Entities
0 0 2 1
1 0 0 0 1 1 0 1 -2 0
2 0 0 0 1 0 1 1 2 0
1 0 0 0 1 1 1 1 1 0
$EndEntities
$Nodes
1 4 1 4
3 1 0 4
1
2
3
4
0 0 0
1 0 0
0 1 0
0 0 1
$EndNodes
$Elements
3 3 1 3
2 1 2 1
1 1 3 2
2 2 2 1
2 1 2 4
3 1 4 1
3 1 2 3 4
$EndElements
"""
TUBE = """
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 3, 1};
Mesh.MeshSizeMax = 0.8;
Physical Volume("fluid") = {1};
Physical Surface("inlet") = {3};
Physical Surface("outlet") = {2};
"""


PIPE = """
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 6, 1};
Cylinder(2) = {0, 0, 0, 0, 0, 6, 1.3};
BooleanFragments{ Volume{2}; Delete; }{ Volume{1}; Delete; }
Mesh.MeshSizeMax = 0.6;
Physical Volume("fluid") = {1};
Physical Volume("wall") = {2};
"""


class SeveralFiles(FolderTest):
    """Lumen and wall of a pipe in a file each, with points of their own, and the openings as surfaces of VTK."""

    @classmethod
    @functools.cache
    def pipe(cls, order=1):
        """Points, mm; cells of fluid and wall; triangles of inlet and outlet, of the fluid."""
        (cls.base / "pipe.geo").write_text(PIPE)
        file = cls.base / "pipe.msh"
        process = execute(MESH, "geo", cls.base / "pipe.geo", "-o", file, "-q", "--order", order, "--format", "2.2")
        assert process.returncode == 0, process.stderr
        mesh = meshio.read(file)
        kind = "tetra" if order == 1 else "tetra10"
        tags = {name: int(data[0]) for name, data in mesh.field_data.items() if name in ("fluid", "wall")}
        physical = mesh.cell_data_dict["gmsh:physical"][kind]
        cells = mesh.cells_dict[kind]
        fluid, wall = (cells[physical == tags[name]] for name in ("fluid", "wall"))
        sides = np.concatenate([fluid[:, list(side)] for side in ((0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3))])
        ends = [sides[np.all(np.abs(mesh.points[sides, 2] - z) < 1e-9, axis=1)] for z in (0, 6)]
        return mesh.points, fluid, wall, ends

    def write_medium(self, name, points, cells):
        used, numbers = np.unique(cells, return_inverse=True)
        kind = "tetra" if cells.shape[1] == 4 else "tetra10"
        meshio.Mesh(points[used], [(kind, numbers.reshape(cells.shape))]).write(self.base / name)

    def write_surface(self, name, points, triangles):
        used, numbers = np.unique(triangles, return_inverse=True)
        array = '<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="ascii">{}</DataArray>'
        at = array.format("Float32", "Points", 3, " ".join(map(str, points[used].astype(np.float32).ravel())))
        nodes = array.format("Int64", "connectivity", 1, " ".join(map(str, numbers.ravel())))
        ends = array.format("Int64", "offsets", 1, " ".join(map(str, range(3, 3 * len(triangles) + 1, 3))))
        ids = array.format("Int32", "GlobalElementID", 1, " ".join(map(str, range(len(triangles)))))
        (self.base / name).write_text(
            '<VTKFile type="PolyData" byte_order="LittleEndian"><PolyData>'
            f'<Piece NumberOfPoints="{len(used)}" NumberOfPolys="{len(triangles)}"><Points>{at}</Points>'
            f"<Polys>{nodes}{ends}</Polys><CellData>{ids}</CellData></Piece></PolyData></VTKFile>"
        )

    def imported(self, *options, files=("fluid=lumen.vtu", "wall=wall.vtu", "inlet=inlet.vtp", "outlet=outlet.vtp")):
        (self.base / "out.msh").unlink(missing_ok=True)
        return execute(MESH, "import", *files, "-o", "out.msh", "--format", "2.2", *options, cwd=self.base)

    def write(self, order=1, wall_shift=0.0, face_shift=0.0):
        points, fluid, wall, (inlet, outlet) = self.pipe(order)
        self.write_medium("lumen.vtu", points, fluid)
        self.write_medium("wall.vtu", points + [0, wall_shift, 0], wall)
        self.write_surface("inlet.vtp", points + [0, 0, face_shift], inlet)
        self.write_surface("outlet.vtp", points, outlet)
        return points, fluid, wall, inlet, outlet

    def expect_whole(self, process, written, order=1):
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertEqual(process.stderr, "")
        points, fluid, wall, inlet, outlet = written
        kind = "tetrahedra" if order == 1 else "quadratic tetrahedra"
        self.assertIn(f"{len(points)} nodes, {len(fluid) + len(wall)} {kind}\n", process.stdout)
        mesh = meshio.read(self.base / "out.msh")
        of = {tag: name for name, (tag, _) in mesh.field_data.items()}
        kind = "triangle" if order == 1 else "triangle6"
        names = [of[tag] for tag in mesh.cell_data_dict["gmsh:physical"][kind]]
        self.assertEqual((names.count("inlet"), names.count("outlet")), (len(inlet), len(outlet)))

    def test_lumen_wall_and_faces_become_one_mesh_of_either_order(self):
        for order in (1, 2):
            with self.subTest(order=order):
                written = self.write(order)
                process = self.imported()
                self.expect_whole(process, written, order)
                self.assertRegex(process.stdout, r"(?m)^\d+ points of the files are those of a file before")

    def test_the_command_that_the_list_gives_makes_the_mesh(self):
        points, fluid, wall, inlet, outlet = self.write()
        files = ("fluid=lumen.vtu", "wall=wall.vtu", "inlet=inlet.vtp", "outlet=outlet.vtp")
        listed = execute(MESH, "import", *files, "--list", cwd=self.base)
        self.assertEqual((listed.returncode, listed.stderr), (0, ""))
        self.assertRegex(listed.stdout, r"(?m)^fluid and wall touch: \d+ triangles, \d+ points\.$")
        self.assertRegex(listed.stdout, rf"(?m)^inlet +{len(inlet)} triangles +area [\d.]+ unit\^2, flat ")
        command = shlex.split(re.search(r"(?m)^  fsi-mesh (import .*)$", listed.stdout).group(1))
        self.assertNotIn("--opening", command)
        process = execute(MESH, *command, "--format", "2.2", "-q", cwd=self.base)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        made = meshio.read(self.base / "imported.msh")
        (self.base / "imported.msh").unlink()  # other tests see that nothing is left
        self.assertEqual(set(made.field_data) - {"all"}, {"fluid", "wall", "inlet", "outlet"})
        self.assertEqual(len(made.points), len(points))

    def test_join_makes_near_points_one_and_says_which(self):
        written = self.write(wall_shift=1e-3, face_shift=2e-3)  # across: their points are sqrt(5) 1e-3 apart at a rim
        joined = self.imported("--join", 0.003)
        self.expect_whole(joined, written)
        self.assertRegex(
            joined.stdout, r"(?m)^--join 0.003: \d+ points are joined to others, the farthest 0.00224 mm apart\.$"
        )
        apart = self.imported("--join", 0.003, "-q")
        self.assertEqual((apart.returncode, apart.stdout, apart.stderr), (0, "", ""))
        process = self.imported()
        self.assertEqual(process.returncode, 1)
        self.assertIn("error: inlet.vtp: inlet: ", process.stderr)
        self.assertRegex(process.stderr, r"are up to 0.002 mm from the cells' points; give --join 0.0022")

    def test_a_mesh_in_metres_is_warned_of(self):
        points, fluid, *_ = self.pipe()
        self.write_medium("metres.vtu", points / 1000, fluid)
        for scale, words in (((), r"mm long: --scale 1000 if it is in m\n"), (("--scale", 1000), "")):
            process = self.imported(*scale, files=("fluid=metres.vtu",))
            self.assertEqual(process.returncode, 0, process.stderr)
            self.assertRegex(process.stderr, words or r"^$")

    def test_media_that_do_not_touch_are_warned_of(self):
        points, fluid, wall, *_ = self.write(wall_shift=1e-3)
        process = self.imported(files=("fluid=lumen.vtu", "wall=wall.vtu"))
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertRegex(
            process.stderr,
            r"^fsi-mesh: warning: fluid touches no other part: fluid and wall share no points and no side, their nearest "
            r"points are 0.001 mm apart: try --join 0.002\n",
        )
        # Doubled nodes of one file are joined as well.
        twice = np.concatenate([points, points])
        meshio.Mesh(
            twice,
            [("tetra", np.concatenate([fluid, wall + len(points)]))],
            cell_data={"m": [np.repeat([1, 2], [len(fluid), len(wall)])]},
        ).write(self.base / "doubled.vtu")
        words = ("--group", "fluid=m:1", "--group", "wall=m:2")
        self.assertIn("try --join 1e-06", self.imported(*words, files=("doubled.vtu",)).stderr)
        process = self.imported(*words, "--join", 1e-6, files=("doubled.vtu",))
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.assertIn(f"{len(points)} nodes", process.stdout)

    def test_parts_of_several_files_bear_the_files_names_where_they_must(self):
        points, fluid, wall, inlet, _ = self.write()
        for name, cells in (("a.vtu", fluid), ("b.vtu", wall)):
            data = {"ModelRegionID": [np.full(len(cells), 1)]}
            meshio.Mesh(points, [("tetra", cells)], cell_data=data).write(self.base / name)
        words = ("--group", "fluid=a/ModelRegionID:1", "--group", "wall=b/ModelRegionID:1")
        process = self.imported(*words, files=("a.vtu", "b.vtu"))
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        meshio.xdmf.write(self.base / "c.xdmf", meshio.Mesh(points, [("tetra", fluid)]), data_format="XML")
        facets = meshio.Mesh(points, [("triangle", inlet)], cell_data={"f": [np.full(len(inlet), 4)]})
        meshio.xdmf.write(self.base / "f.xdmf", facets, data_format="XML")
        process = self.imported("--group", "fluid=all", "--group", "inlet=f:4", files=("c.xdmf", "f.xdmf"))
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertIn('"inlet"', (self.base / "out.msh").read_text())

    def test_what_is_wrong_is_named_with_its_file_and_nothing_is_left(self):
        points, fluid, wall, inlet, _ = self.write()
        self.write_surface("far.vtp", points, wall[:5, :3])
        (self.base / "text.vtp").write_text("no surface")
        lumen = ("fluid=lumen.vtu",)
        for files, options, words in (
            ((*lumen, "wall=none.vtu"), (), "error: none.vtu: no such file"),
            ((*lumen, "inlet=text.vtp"), (), "error: text.vtp: is no file of VTK"),
            ((*lumen, "fluid=wall.vtu"), (), "error: fluid: is the name of two files"),
            ((*lumen, "inlet="), (), "error: inlet: 'inlet=' names no file"),
            (("inlet.vtp",), (), "error: inlet.vtp: is a surface, which no reader takes"),
            ((*lumen, "inlet=far.vtp"), (), "error: far.vtp: inlet: "),
            (lumen, ("--join", 5), "--join: 5 mm is as long as an edge of a cell"),
            (lumen, ("--join", -1), "--join: -1 is no distance"),
            (lumen, ("--group", "wall=fluid"), "--group wall: fluid shares"),
        ):
            with self.subTest(files=files, options=options):
                process = self.imported(*options, files=files)
                self.assertEqual(process.returncode, 1, process.stdout)
                self.assertEqual(len(process.stderr.splitlines()), 1, process.stderr)
                self.assertIn(words, process.stderr)
                self.assertEqual([f.name for f in self.base.iterdir() if "out." in f.name or "import" in f.name], [])


class MeshImport(FolderTest):
    @classmethod
    @functools.cache
    def lumen(cls, order=1):
        """The tube's nodes in m, tetrahedra and the triangles of its surfaces, as meshio has them."""
        (cls.base / "tube.geo").write_text(TUBE)
        file = cls.base / "tube.msh"
        process = execute(MESH, "geo", cls.base / "tube.geo", "-o", file, "-q", "--order", order)
        assert process.returncode == 0, process.stderr
        mesh = meshio.read(file)
        kinds = {1: ("tetra", "triangle"), 2: ("tetra10", "triangle6")}[order]
        solid = np.concatenate([block.data for block in mesh.cells if block.type == kinds[0]])
        sides = [block.data for block in mesh.cells if block.type == kinds[1]]
        return mesh.points / 1000, (kinds[0], solid), [(kinds[1], side) for side in sides]

    def imported(self, file, *options):
        (self.base / "out.msh").unlink(missing_ok=True)
        return execute(MESH, "import", file, "-o", self.base / "out.msh", "--format", "2.2", *options)

    def expect_tube(self, process, order=1):
        self.assertEqual(process.returncode, 0, process.stderr)
        volume = float(re.search(r"^fluid +\d+ +([\d.]+)", process.stdout, re.MULTILINE).group(1))
        self.assertAlmostEqual(volume / (3 * math.pi), 1, delta=0.15 if order == 1 else 0.005)
        text = (self.base / "out.msh").read_text()
        self.assertEqual(set(re.findall(r'^\d \d+ "(\w+)"', text, re.MULTILINE)), {"fluid", "inlet", "outlet"})
        self.assertIn("\n1 9 2" if order == 2 else "\n1 2 2", text)

    def test_gmsh_files_of_both_formats_keep_their_names(self):
        """Volume and inlet have the same number, as gmsh gives them when left alone; names tell them apart."""
        script = TUBE.replace('("fluid")', '("fluid", 1)').replace('("inlet")', '("inlet", 1)')
        (self.base / "tube.geo").write_text(script)
        for version in ("2.2", "4.1"):
            file = self.base / f"tube-{version}.msh"
            process = execute(MESH, "geo", self.base / "tube.geo", "-o", file, "-q", "--format", version)
            self.assertEqual(process.returncode, 0, process.stderr)
            listed = execute(MESH, "import", file, "--list")
            for name, kind in (("fluid", "tetrahedra"), ("inlet", "triangles"), ("outlet", "triangles")):
                self.assertRegex(listed.stdout, rf"(?m)^{name} +\d+ {kind} ")
            process = self.imported(file)
            self.assertEqual(process.returncode, 0, process.stderr)
            text = (self.base / "out.msh").read_text()
            self.assertEqual(set(re.findall(r'^\d \d+ "(\w+)"', text, re.MULTILINE)), {"fluid", "inlet", "outlet"})

    def test_surfaces_that_a_group_of_gmsh_turns_round_belong_to_it(self):
        """Physical Surface("inlet") = {-1, 2}: format 4.1 keeps the minus, and a reader that compares numbers has half an inlet."""
        (self.base / "turned.msh").write_text(TURNED)
        listed = execute(MESH, "import", self.base / "turned.msh", "--list")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        self.assertRegex(listed.stdout, r"(?m)^inlet +2 triangles +area 1 ")
        self.assertRegex(listed.stdout, r"(?m)^gmsh:physical:2 +2 triangles ")

    def test_vtu_with_numbered_cells_of_both_orders_packed_or_not(self):
        for order, packing in ((1, "zlib"), (2, "lzma"), (1, None)):
            points, solid, sides = self.lumen(order)
            blocks = [solid, *sides]
            numbers = [np.full(len(data), i + 1) for i, (_, data) in enumerate(blocks)]
            mesh = meshio.Mesh(points, blocks, cell_data={"part": numbers})
            meshio.vtu.write(self.base / "tube.vtu", mesh, compression=packing)
            words = ("--scale", 1000, "--group", "fluid=part:1", "--group", "inlet=part:2", "--group", "outlet=part:3")
            self.expect_tube(self.imported(self.base / "tube.vtu", *words), order)

    def test_vtu_whose_cells_have_numbers_of_their_own(self):
        """As SimVascular writes it: ids of cells and points beside the region's number."""
        points, solid, sides = self.lumen()
        count = len(solid[1])
        data = {"ModelRegionID": [np.ones(count, np.int32)], "GlobalElementID": [np.arange(1, count + 1)]}
        ids = {"GlobalNodeID": np.arange(1, len(points) + 1), "velocity": np.ones((len(points), 3))}
        meshio.Mesh(points, [solid], ids, data).write(self.base / "tube.vtu")
        words = ("--opening", "inlet=0,0,0", "--opening", "outlet=0,0,3", "--scale", 1000)
        process = self.imported(self.base / "tube.vtu", "--group", "fluid=ModelRegionID:1", *words)
        self.expect_tube(process)
        for name in (
            "GlobalElementID (numbers of cells)",
            "GlobalNodeID (numbers of points)",
            "velocity (3 components)",
        ):
            self.assertIn(name, process.stdout)
        listed = execute(MESH, "import", self.base / "tube.vtu", "--list")
        self.assertRegex(listed.stdout, rf"(?m)^ModelRegionID:1 +{count} tetrahedra")
        self.assertNotIn("ElementID:", listed.stdout)

    def test_vtu_without_arrays(self):
        points, solid, _ = self.lumen()
        meshio.Mesh(points, [solid]).write(self.base / "tube.vtu")
        listed = execute(MESH, "import", self.base / "tube.vtu", "--list")
        self.assertRegex(listed.stdout, rf"(?m)^all +{len(solid[1])} tetrahedra")
        words = ("--opening", "inlet=0,0,0", "--opening", "outlet=0,0,3", "--scale", 1000)
        self.expect_tube(self.imported(self.base / "tube.vtu", "--group", "fluid=all", *words))

    def test_flat_ends_of_a_volume_without_names_by_the_command_of_the_list(self):
        points, solid, sides = self.lumen()
        meshio.Mesh(points, [solid]).write(self.base / "bare.vtu")
        listed = execute(MESH, "import", "bare.vtu", "--list", cwd=self.base)
        command = shlex.split(re.search(r"(?m)^  fsi-mesh (import .*)$", listed.stdout).group(1))
        self.assertEqual(command[-3:], ["--group", "fluid=all", "--flat-ends"])
        self.assertIn("--scale", command)
        process = execute(MESH, *command, "--format", "2.2", cwd=self.base)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.assertRegex(process.stdout, r"(?m)^Flat ends: end_1, [\d.]+ mm\^2 at \(0, 0, [03]\) mm; end_2, ")
        made = meshio.read(self.base / "bare.msh")
        (self.base / "bare.msh").unlink()
        physical = made.cell_data_dict["gmsh:physical"]["triangle"]
        counts = sorted(np.count_nonzero(physical == made.field_data[f"end_{k}"][0]) for k in (1, 2))
        self.assertEqual(counts, sorted(len(side) for _, side in sides))
        # Beside one that has a name; the sides of a wall are no ends.
        file = self.base / "bare.vtu"
        words = ("--group", "fluid=all", "--scale", 1000, "--flat-ends")
        process = self.imported(file, *words, "--opening", "inlet=0,0,0")
        self.assertRegex(process.stdout, r"(?m)^Flat ends: end_1, [\d.]+ mm\^2 at \(0, 0, 3\) mm\.$")
        process = self.imported(file, *words, "--opening", "inlet=0,0,0", "--opening", "outlet=0,0,3")
        self.assertEqual(process.returncode, 1)
        self.assertIn("--flat-ends: each flat part of the fluid's surface has a name", process.stderr)
        process = self.imported(file, "--group", "wall=all", "--scale", 1000, "--flat-ends")
        self.assertEqual((process.returncode, process.stderr.count("\n")), (1, 1))
        self.assertIn(
            "--flat-ends: names a part of the fluid's surface, and the mesh has no volume fluid", process.stderr
        )

    def test_med_and_abaqus_with_names_of_their_own(self):
        points, solid, sides = self.lumen()
        blocks = [solid, *sides]
        both = np.concatenate([sides[0][1], sides[1][1]])
        families = [np.full(len(solid[1]), -1), np.repeat([-2, -3], [len(sides[0][1]), len(sides[1][1])])]
        mesh = meshio.Mesh(1000 * points, [solid, ("triangle", both)], cell_data={"cell_tags": families})
        mesh.cell_tags = {-1: ["fluid"], -2: ["inlet"], -3: ["outlet"]}
        mesh.write(self.base / "tube.med")
        self.expect_tube(self.imported(self.base / "tube.med"))
        names = ("fluid", "inlet", "outlet")
        sets = {
            name: [np.arange(len(d)) if i == k else np.array([], int) for k, (_, d) in enumerate(blocks)]
            for i, name in enumerate(names)
        }
        meshio.Mesh(1000 * points, blocks, cell_sets=sets).write(self.base / "tube.inp")
        self.expect_tube(self.imported(self.base / "tube.inp"))

    def test_exodus_with_sets_of_points(self):
        points, solid, sides = self.lumen()
        sets = {"in": np.unique(sides[0][1]), "out": np.unique(sides[1][1])}
        mesh = meshio.Mesh(1000 * points, [solid], point_sets=sets, cell_data={"part": [np.ones(len(solid[1]))]})
        mesh.write(self.base / "tube.e")
        listed = execute(MESH, "import", self.base / "tube.e", "--list")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        self.assertRegex(listed.stdout, r"(?m)^in +\d+ points ")
        mesh.write(self.base / "tube.vtu")  # which has no sets: openings by where they are
        words = ("--group", "fluid=part:1", "--opening", "inlet=0,0,0", "--opening", "outlet=0,0,3")
        self.expect_tube(self.imported(self.base / "tube.vtu", *words))

    def test_sets_of_points_and_cells_inside_out(self):
        points, solid, sides = self.lumen()
        number = np.zeros(len(points), int)
        number[np.unique(sides[0][1])] = 1
        number[np.unique(sides[1][1])] = 2
        turned = solid[1].copy()
        turned[:5] = turned[:5][:, [0, 2, 1, 3]]
        mesh = meshio.Mesh(points, [("tetra", turned)], {"end": number}, {"part": [np.ones(len(turned), int)]})
        mesh.write(self.base / "tube.vtk")
        words = ("--group", "fluid=part:1", "--group", "inlet=end:1", "--group", "outlet=end:2", "--scale", 1000)
        process = self.imported(self.base / "tube.vtk", *words)
        self.expect_tube(process)
        self.assertIn("5 cells were turned inside out", process.stdout)

    def test_what_is_wrong_is_named_and_nothing_is_left(self):
        points, solid, sides = self.lumen()
        meshio.Mesh(points, [solid], cell_data={"part": [np.ones(len(solid[1]), int)]}).write(self.base / "tube.vtu")
        cube = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
        meshio.Mesh(cube, [("hexahedron", np.array([[0, 1, 3, 2, 4, 5, 7, 6]]))]).write(self.base / "cube.vtu")
        for name in ("text.vtu", "text.med", "text.unv", "text.inp", "text.e", "text.xdmf"):
            (self.base / name).write_text("no mesh")
        for file, options, words in (
            ("none.vtu", (), ("none.vtu: no such file",)),
            ("text.vtu", (), ("text.vtu: is no file of VTK",)),
            ("text.med", (), ("cannot be read as MED",)),
            ("text.unv", (), ("is a universal file of I-DEAS, which no reader takes",)),
            ("text.inp", (), ("line 1: 'no mesh' stands before any keyword",)),
            ("text.e", (), ("cannot be read as Exodus",)),
            ("text.xdmf", (), ("is no XML",)),
            ("cube.vtu", (), ("holds hexahedron in place of tetrahedra",)),
            ("tube.vtu", (), ("--group: is not given", "part:1 (tetrahedra)")),
            ("tube.vtu", ("--group", "fluid=prt:1"), ("no part prt:1", "did you mean part:1?")),
            ("tube.vtu", ("--group", "fluid"), ("'fluid' is no NAME=PART",)),
            ("tube.vtu", ("--scale", 0, "--group", "fluid=part:1"), ("--scale: 0 is no factor",)),
            ("tube.vtu", ("--scale", 1000, "--group", "fluid=part:1", "--opening", "inlet=0"), ("is no NAME=X,Y,Z",)),
            (
                "tube.vtu",
                ("--scale", 1000, "--group", "media=part:1", "--opening", "inlet=0,0,0"),
                ("--opening inlet: ", "the mesh has no volume fluid, but media", "--group fluid=PART"),
            ),
        ):
            with self.subTest(file=file, options=options):
                process = self.imported(self.base / file, *options)
                self.assertEqual(process.returncode, 1, process.stdout)
                self.assertEqual(len(process.stderr.splitlines()), 1, process.stderr)
                for word in words:
                    self.assertIn(word, process.stderr)
                self.assertEqual([f.name for f in self.base.iterdir() if "out" in f.name or "import" in f.name], [])


STATIC = """
element = "p1"
[mesh]
file = "out.msh"
[structure]
density = 1.2
bulk_modulus = 1e4
[structure.layers.wall]
material = "neo-hookean"
c10 = 60
[load]
pressure = 1.0
[static]
"""


class ErrorsOfTheReader(FolderTest):
    """What fsi-mesh repeats of fsi-compare, which it starts from its own folder."""

    def test_the_error_is_shown_whatever_comes_before_it(self):
        program, reader = self.base / "fsi-mesh", self.base / "fsi-compare"
        shutil.copy(MESH, program)
        (self.base / "a.vtu").touch()
        for said, shown in (
            (("fsi-compare: warning: odd", "fsi-compare: error: a.vtu: is broken"), "a.vtu: is broken"),
            (
                ("Traceback (most recent call last):", "  somewhere", "ValueError: 3 is no 4"),
                "a.vtu: ValueError: 3 is no 4",
            ),
            ((), "a.vtu: fsi-compare ended without a message"),
        ):
            lines = "".join(f"echo '{line}' >&2\n" for line in said)
            reader.write_text(f"#!/bin/sh\n{lines}exit 1\n")
            reader.chmod(0o755)
            process = execute(program, "import", "a.vtu", "-o", "out.msh", cwd=self.base)
            self.assertEqual((process.returncode, process.stdout), (1, ""))
            self.assertEqual(process.stderr, f"fsi-mesh: error: {shown}\n")


class WallAlone(FolderTest):
    """A wall without fluid and without names: its faces are known by their shape."""

    def wall(self, *options):
        """Writes the wall of an artery as wall.vtu; its points and cells."""
        file = self.base / "artery.msh"
        size = "--lumen-cells 3 --media-cells 2 --adventitia-cells 1 --around 12 --axial-cells 4 --length 3".split()
        process = execute(MESH, "artery", *size, *options, "-o", file, "-q", "--format", "2.2")
        self.assertEqual(process.returncode, 0, process.stderr)
        mesh = meshio.read(file)
        fluid = mesh.field_data["fluid"][0]
        cells = mesh.cells_dict["tetra"][mesh.cell_data_dict["gmsh:physical"]["tetra"] != fluid]
        used, numbers = np.unique(cells, return_inverse=True)
        points, cells = mesh.points[used], numbers.reshape(cells.shape)
        meshio.Mesh(points, [("tetra", cells)]).write(self.base / "wall.vtu")
        return points, cells

    def imported(self, *options):
        (self.base / "out.msh").unlink(missing_ok=True)
        return execute(
            MESH,
            "import",
            "wall.vtu",
            "--group",
            "wall=all",
            "-o",
            "out.msh",
            "--format",
            "2.2",
            *options,
            cwd=self.base,
        )

    def test_its_faces_are_named_and_a_case_takes_them(self):
        self.wall()
        process = self.imported("--wall-faces")
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        mesh = meshio.read(self.base / "out.msh")
        triangles, physical = mesh.cells_dict["triangle"], mesh.cell_data_dict["gmsh:physical"]["triangle"]
        faces = {name: mesh.points[triangles[physical == tag]] for name, (tag, d) in mesh.field_data.items() if d == 2}
        self.assertEqual(set(faces), {"inner", "outer", "wall_ends"})
        for name, radius in (("inner", 1.43), ("outer", 1.82)):
            self.assertLess(np.abs(np.hypot(faces[name][..., 0], faces[name][..., 1]) - radius).max(), 1e-9)
            # Twelve flat sides of a prism 3 mm long.
            a, b, c = (faces[name][:, k] for k in range(3))
            area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
            self.assertAlmostEqual(area, 12 * 2 * radius * math.sin(math.pi / 12) * 3, places=6)
        self.assertEqual(set(faces["wall_ends"][..., 2].ravel()), {0.0, 3.0})
        (self.base / "case.toml").write_text(STATIC)
        process = execute(MONOLITHIC, "case.toml", "--check", cwd=self.base)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.imported()
        process = execute(MONOLITHIC, "case.toml", "--check", cwd=self.base)
        self.assertEqual(process.returncode, 1)
        (self.base / "out.msh").unlink()

    def test_what_is_no_tube_is_said_with_what_it_is(self):
        points, cells = self.wall()
        keep = ~((points[cells].mean(axis=1)[:, 2] > 2.2) & (points[cells].mean(axis=1)[:, 0] > 0))  # a step in the end
        meshio.Mesh(points, [("tetra", cells[keep])]).write(self.base / "wall.vtu")
        process = self.imported("--wall-faces")
        self.assertEqual(process.returncode, 1)
        self.assertRegex(
            process.stderr,
            r"\Afsi-mesh: error: wall\.vtu: --wall-faces: the wall's surface has 1 plane ring and 1 further part",
        )
        self.assertFalse((self.base / "out.msh").exists())


if __name__ == "__main__":
    unittest.main()
