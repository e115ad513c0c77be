"""Files of meshes as other programs write them: names, order of nodes, and what is refused."""

import unittest

import h5py
import numpy as np
import synthetic  # noqa: F401: the package's folder onto the path
from folder_case import FolderCase

from fsi_compare.base.errors import InputError
from fsi_compare.mesh_import.groups import facets_between
from fsi_compare.mesh_import.parts import found_mesh
from fsi_compare.mesh_import.readers import read_mesh
from fsi_compare.mesh_import.sources import Source, read_sources
from fsi_compare.mesh_import.vtk_file import VtkFile
from fsi_compare.mesh_import.vtu import mesh_of

# A tetrahedron, and one on its face x + y + z = 1.
POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1.0]])
CELLS = np.array([[0, 1, 2, 3], [1, 2, 3, 4]])
EDGES = ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))  # in the middles of which VTK has the nodes 4, 5, ... of ten
CURVED = np.vstack([POINTS[:4], [(POINTS[a] + POINTS[b]) / 2 for a, b in EDGES]])


def sides_at(mesh, name):
    """Corners of the facets of a part, sorted."""
    rows = [nodes[places] for (_, nodes), places in zip(mesh.blocks, mesh.cell_sets[name]) if len(places)]
    return [sorted(row[:3].tolist()) for block in rows for row in block]


class Readers(FolderCase):
    def read(self, name, text=None):
        if text is not None:
            (self.base / name).write_text(text)
        return read_mesh(self.base / name)

    def expect_refusal(self, name, text, words):
        with self.assertRaises(InputError) as caught:
            self.read(name, text)
        self.assertIn(words, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))

    def expect_middles(self, mesh):
        """Nodes behind the corners are the middles of the edges, in VTK's order."""
        for kind, nodes in mesh.blocks:
            if kind == "tetra10":
                for k, (a, b) in enumerate(EDGES):
                    middle = (mesh.points[nodes[:, a]] + mesh.points[nodes[:, b]]) / 2
                    np.testing.assert_allclose(mesh.points[nodes[:, 4 + k]], middle, atol=1e-15)
            if kind == "triangle6":
                for k, (a, b) in enumerate(((0, 1), (1, 2), (0, 2))):
                    middle = (mesh.points[nodes[:, a]] + mesh.points[nodes[:, b]]) / 2
                    np.testing.assert_allclose(mesh.points[nodes[:, 3 + k]], middle, atol=1e-15)

    # XDMF

    def xdmf(self, grids, more=""):
        return f'<Xdmf Version="3.0" xmlns:xi="http://www.w3.org/2001/XInclude"><Domain>{grids}</Domain></Xdmf>{more}'

    GEOMETRY = (
        '<Geometry GeometryType="XYZ"><DataItem Dimensions="5 3" Format="XML">'
        + " ".join(f"{x:g}" for x in POINTS.ravel())
        + "</DataItem></Geometry>"
    )

    @staticmethod
    def topology(name, numbers, rows, key="TopologyType", more=""):
        dimensions = f"{rows} {len(numbers) // rows}" if rows else len(numbers)
        item = f'<DataItem Dimensions="{dimensions}" NumberType="Int" Format="XML">{" ".join(map(str, numbers))}</DataItem>'
        return f'<Topology {key}="{name}" {more}>{item}</Topology>'

    @staticmethod
    def attribute(name, values, centre="Cell"):
        return (
            f'<Attribute Name="{name}" AttributeType="Scalar" Center="{centre}"><DataItem Dimensions="{len(values)} 1" '
            f'Format="XML">{" ".join(map(str, values))}</DataItem></Attribute>'
        )

    def test_xdmf_names_topologies_in_any_case(self):
        for name in ("Tetrahedron", "tetrahedron", "TETRAHEDRON", "tet_4"):
            for key in ("TopologyType", "Type"):
                grid = self.GEOMETRY + self.topology(name, CELLS.ravel(), 2, key) + self.attribute("region", [7, 8])
                mesh = self.read("a.xdmf", self.xdmf(f'<Grid Name="m" GridType="Uniform">{grid}</Grid>'))
                self.assertEqual([kind for kind, _ in mesh.blocks], ["tetra"])
                np.testing.assert_array_equal(mesh.blocks[0][1], CELLS)
                np.testing.assert_array_equal(mesh.cell_data["region"][0], [7, 8])

    def test_xdmf_of_dolfinx_has_a_grid_for_tags_of_cells_in_another_order_and_of_facets(self):
        include = '<xi:include xpointer="xpointer(/Xdmf/Domain/Grid/Geometry)"/>'
        mesh = f'<Grid Name="mesh">{self.topology("tetrahedron", CELLS.ravel(), 2)}{self.GEOMETRY}</Grid>'
        order = CELLS[::-1, [1, 0, 2, 3]].ravel()
        cells = f'{include}{self.topology("tetrahedron", order, 2)}{self.attribute("cells", [8, 7])}'
        facets = f'{include}{self.topology("triangle", [0, 1, 2, 4, 2, 3], 2)}{self.attribute("facets", [3, 4])}'
        read = self.read("a.xdmf", self.xdmf(f"{mesh}<Grid>{cells}</Grid><Grid>{facets}</Grid>"))
        self.assertEqual([(kind, len(nodes)) for kind, nodes in read.blocks], [("tetra", 2), ("triangle", 2)])
        np.testing.assert_array_equal(read.cell_data["cells"][0], [7, 8])
        found = found_mesh("a.xdmf", read, 1.0)
        self.assertEqual(list(found.cells), ["cells:7", "cells:8", "facets:3", "facets:4", "all"])
        np.testing.assert_array_equal(found.cells["facets:4"][1], [1])

    def test_xdmf_of_mixed_elements_in_hdf5(self):
        import h5py

        with h5py.File(self.base / "a.h5", "w") as file:
            file["/m/x"] = POINTS
            file["/m/t"] = np.array([4, 0, 1, 2, 6, 0, 1, 2, 3, 2, 2, 0, 1, 6, 1, 2, 3, 4])
            file["/m/v"] = np.array([[5], [1], [9], [2]])
        grid = (
            '<Geometry Type="XYZ"><DataItem Format="HDF" Dimensions="5 3">a.h5:/m/x</DataItem></Geometry><Topology '
            'Type="Mixed"><DataItem Format="HDF" NumberType="Int" Dimensions="18">a.h5:/m/t</DataItem></Topology><Attribute '
            'Name="v" Center="Cell"><DataItem Format="HDF" Dimensions="4 1">a.h5:/m/v</DataItem></Attribute>'
        )
        read = self.read("a.xdmf", self.xdmf(f"<Grid>{grid}</Grid>"))
        blocks = {kind: nodes for kind, nodes in read.blocks}
        np.testing.assert_array_equal(blocks["tetra"], CELLS)
        found = found_mesh("a.xdmf", read, 1.0)
        self.assertEqual(list(found.cells), ["v:1", "v:2", "v:5", "v:9", "all"])

    def test_xdmf_of_blocks_is_read_whole_and_with_their_names(self):
        """Of a series in time at its first; a name of all cells is none."""

        def grid(name, cells, geometry=self.GEOMETRY):
            cells = np.asarray(cells)
            return f'<Grid Name="{name}">{geometry}{self.topology("tetrahedron", cells.ravel(), len(cells))}</Grid>'

        def collection(kind, *grids, name="c"):
            return f'<Grid Name="{name}" GridType="Collection" CollectionType="{kind}">{"".join(grids)}</Grid>'

        blocks = [grid("lumen", CELLS[:1]), grid("wall", CELLS[1:])]
        later = [grid("lumen", CELLS[:1, ::-1]), grid("late", CELLS[1:])]
        for text, parts in (
            (collection("Spatial", *blocks), ["lumen", "wall"]),
            (collection("Temporal", collection("Spatial", *blocks), collection("Spatial", *later)), ["lumen", "wall"]),
            (
                collection(
                    "Spatial",
                    collection("Temporal", blocks[0], later[0], name="a"),
                    collection("Temporal", blocks[1], later[1], name="b"),
                ),
                ["a", "b"],
            ),
            (collection("Temporal", grid("t0", CELLS), grid("t1", CELLS[:1])), []),
            (collection("Spatial", grid("one", CELLS)), []),
            ("".join(blocks), []),
        ):
            read = self.read("a.xdmf", self.xdmf(text))
            np.testing.assert_array_equal(np.concatenate([nodes for _, nodes in read.blocks]), CELLS)
            found = found_mesh("a.xdmf", read, 1.0)
            self.assertEqual(list(found.cells), [*parts, "all"])
            for name, nodes in zip(parts, CELLS):
                rows = [block.nodes[places] for block, places in zip(found.blocks, found.cells[name])]
                np.testing.assert_array_equal(np.concatenate(rows), [nodes])
        moved = grid("wall", CELLS[1:], self.GEOMETRY.replace("0 0 0", "0 0 2", 1))
        text = self.xdmf(collection("Temporal", collection("Spatial", blocks[0], moved)))
        self.expect_refusal("a.xdmf", text, "has grids of several geometries, of which 'wall' is one")

    def test_xdmf_that_is_wrong(self):
        good = self.GEOMETRY + self.topology("tetrahedron", CELLS.ravel(), 2)
        for grid, words in (
            (good.replace("tetrahedron", "tetra hedron"), "Topology: is of the kind 'tetra hedron'"),
            (good.replace('"5 3"', '"6 3"'), "Geometry: has 15 numbers where the document says 6 x 3"),
            (good.replace('Format="XML"', 'Format="HDF"', 1).replace("0 0 0 1", "b.h5:/x 0", 1), "is not beside it"),
            (good.replace("<DataItem", '<DataItem ItemType="HyperSlab"', 1), "has a DataItem of the type HyperSlab"),
            (self.topology("tetrahedron", CELLS.ravel(), 2), "Geometry: is missing"),
            ("", "Geometry: is missing"),
        ):
            self.expect_refusal("a.xdmf", self.xdmf(f"<Grid>{grid}</Grid>"), words)
        self.expect_refusal("a.xdmf", "<Xdmf><Dom", "is no XML")
        self.expect_refusal("a.xdmf", self.xdmf(""), "holds no grid")

    # Exodus

    def exodus(self, kind, cells, points=POINTS, sides=(), names=("fluid", "wall"), side_name="inlet"):
        """A block a cell; `sides`: element and side, from 1."""
        import netCDF4

        with netCDF4.Dataset(self.base / "a.e", "w", format="NETCDF3_64BIT_OFFSET") as file:
            for key, size in (("len", 33), ("num_dim", 3), ("num_nodes", len(points)), ("num_el_blk", len(cells))):
                file.createDimension(key, size)
            for axis, values in zip("xyz", points.T):
                file.createVariable(f"coord{axis}", "f8", ("num_nodes",))[:] = values

            def texts(key, dimension, words):
                rows = np.array([list(word.ljust(33, "\0")) for word in words], "S1")
                file.createVariable(key, "S1", (dimension, "len"))[:] = rows

            file.createVariable("eb_prop1", "i4", ("num_el_blk",))[:] = [10 * (k + 1) for k in range(len(cells))]
            texts("eb_names", "num_el_blk", names[: len(cells)])
            for number, cell in enumerate(cells, 1):
                file.createDimension(f"num_el_in_blk{number}", 1)
                file.createDimension(f"num_nod_per_el{number}", len(cell))
                shape = (f"num_el_in_blk{number}", f"num_nod_per_el{number}")
                variable = file.createVariable(f"connect{number}", "i4", shape)
                variable.elem_type = kind
                variable[:] = np.array([cell]) + 1
            if sides:
                file.createDimension("num_side_sets", 1)
                file.createDimension("num_side_ss1", len(sides))
                file.createVariable("ss_prop1", "i4", ("num_side_sets",))[:] = [4]
                texts("ss_names", "num_side_sets", [side_name])
                for key, column in (("elem_ss1", 0), ("side_ss1", 1)):
                    file.createVariable(key, "i4", ("num_side_ss1",))[:] = [side[column] for side in sides]
        return self.read("a.e")

    def test_exodus_blocks_and_side_sets_have_their_names(self):
        for kind in ("TETRA", "TETRA4", "tet4", "TET"):
            # Sides of a tetrahedron by the manual: 1 2 4, 2 3 4, 1 4 3, 1 3 2.
            mesh = self.exodus(kind, CELLS, sides=((1, 1), (1, 3), (1, 4), (2, 1), (2, 2), (2, 3), (2, 4)))
            self.assertEqual([(k, len(n)) for k, n in mesh.blocks[:2]], [("tetra", 1), ("tetra", 1)])
            expected = [[0, 1, 3], [0, 2, 3], [0, 1, 2], [1, 2, 4], [2, 3, 4], [1, 3, 4], [1, 2, 3]]
            self.assertEqual(sides_at(mesh, "inlet"), expected)
            found = found_mesh("a.e", mesh, 1.0)
            self.assertEqual(list(found.cells), ["fluid", "wall", "inlet", "all"])
            self.assertEqual(len(found.cells["all"]), len(found.blocks))

    def test_exodus_shells_have_two_faces_before_their_edges(self):
        cells = [CELLS[0], np.array([0, 1, 2])]
        sides = ((2, 1), (2, 2), (2, 3), (2, 5))
        # To the Exodus library triangles in space are shells, whatever their type says.
        for kind in ("TRISHELL3", "SHELL3", "TRISHELL", "TRI3", "TRI", "TRIANGLE"):
            mesh = self.exodus(kind, cells[1:], sides=[(1, side) for _, side in sides])
            self.assertEqual([(k, len(n)) for k, n in mesh.blocks], [("triangle", 1), ("triangle", 2), ("line", 2)])
            self.assertEqual(sides_at(mesh, "inlet"), [[0, 1, 2], [0, 1, 2], [0, 1], [0, 2]])
        # Of a triangle in the plane the first side is an edge.
        mesh = self.exodus("TRI3", cells[1:], POINTS[:, :2], sides=((1, 1), (1, 3)))
        self.assertEqual(sides_at(mesh, "inlet"), [[0, 1], [0, 2]])
        for points, count in ((POINTS[:, :2], 3), (POINTS, 5)):
            with self.assertRaisesRegex(InputError, f"names side {count + 1} of a triangle, which has {count}"):
                self.exodus("TRI3", cells[1:], points, sides=((1, count + 1),))

    def test_exodus_cells_of_ten_nodes_whatever_their_type_says(self):
        for kind in ("TETRA", "TETRA10", "TET10"):
            mesh = self.exodus(kind, [np.arange(10)], CURVED, [(1, side) for side in (1, 2, 3, 4)])
            self.assertEqual([k for k, _ in mesh.blocks], ["tetra10", "triangle6"])
            self.expect_middles(mesh)
            self.assertEqual(sides_at(mesh, "inlet"), [[0, 1, 3], [1, 2, 3], [0, 2, 3], [0, 1, 2]])

    def test_exodus_without_names_has_numbers_that_are_not_taken_unasked(self):
        mesh = self.exodus("TETRA", CELLS, sides=((1, 1),), names=("", ""), side_name="")
        self.assertEqual(list(mesh.cell_sets), ["block:10", "block:20", "sideset:4"])
        found = found_mesh("a.e", mesh, 1.0)
        self.assertEqual(found.numbered, {"block:10", "block:20", "sideset:4", "all"})

    def test_exodus_that_is_wrong(self):
        for kind, cells, sides, words in (
            ("TETRA8", [np.arange(8)], (), "fluid: has elements of the type TETRA8 with 8 nodes"),
            ("TETRA", CELLS, ((3, 1),), "inlet: names an element that is not there"),
            ("TETRA", CELLS, ((1, 5),), "inlet: names side 5 of a tetra, which has 4"),
        ):
            with self.assertRaises(InputError) as caught:
                self.exodus(kind, cells, CURVED, sides)
            self.assertIn(words, str(caught.exception))
        self.expect_refusal("b.e", "no mesh", "cannot be read as Exodus")

    # MED

    def med(self, kind, cells, points, facets=(), family_sets=True):
        """Laid out as by gmsh 4: no NOEUD, and GRO only of families of physical groups."""
        import h5py

        with h5py.File(self.base / "a.med", "w") as file:
            step = file.create_group("ENS_MAA/tube/-0000000000000000001-0000000000000000001")
            nodes = step.create_dataset("NOE/COO", data=points.T.ravel())
            nodes.attrs["NBR"] = len(points)
            for name, rows, numbers in (
                (kind, cells, [-1, -2][: len(cells)]),
                ("TR3", facets, [-3, -4][: len(facets)]),
            ):
                if len(rows):
                    step.create_dataset(f"MAI/{name}/NOD", data=np.asarray(rows).T.ravel() + 1).attrs["NBR"] = len(rows)
                    step.create_dataset(f"MAI/{name}/FAM", data=np.array(numbers))
            file.create_group("FAS/tube/FAMILLE_ZERO").attrs["NUM"] = 0
            groups = {
                "F_3D_1": (-1, ["fluid"]),
                "F_3D_2": (-2, []),
                "F_2D_3": (-3, ["inlet", "ends"]),
                "F_2D_4": (-4, ["ends"]),
            }
            for name, (number, texts) in groups.items():
                family = file.create_group(f"FAS/tube/ELEME/{name}")
                family.attrs["NUM"] = number
                if texts:
                    rows = [np.frombuffer(text.encode().ljust(80, b"\0"), np.int8) for text in texts]
                    family.create_dataset("GRO/NOM", data=np.array(rows))
        return self.read("a.med")

    def write_dolfin(self, **groups):
        """Two tetrahedra as dolfin's HDF5File writes them: functions have points and elements of their own."""
        points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1.0]])
        cells = np.array([[0, 1, 2, 3], [1, 2, 3, 4]])
        facets = np.array([[0, 1, 2], [1, 2, 3], [2, 3, 4], [0, 1, 3]])
        path = self.base / "mesh.h5"
        made = {
            "mesh": (points, cells, None),
            "domains": (points, cells[::-1], np.array([2, 1])),
            "boundaries": (points, facets, np.array([7, 0, 8, 7])),
            **groups,
        }
        with h5py.File(path, "w") as file:
            for name, (at, nodes, values) in made.items():
                file[f"{name}/coordinates"], file[f"{name}/topology"] = at, nodes
                if values is not None:
                    file[f"{name}/values"] = values.astype(np.uint64)
        return path, points, cells, facets

    def test_hdf5_of_dolfin(self):
        path, points, cells, facets = self.write_dolfin()
        mesh = found_mesh("mesh.h5", read_mesh(path), 1000.0)
        np.testing.assert_array_equal(mesh.points, 1000 * points)

        def nodes(part):
            return np.concatenate([b.nodes[p] for b, p in zip(mesh.blocks, mesh.cells[part]) if len(p)])

        # Cells are once there, though mesh and function both have them.
        self.assertEqual(len(nodes("all")), 2)
        np.testing.assert_array_equal(nodes("domains:1"), cells[:1])
        np.testing.assert_array_equal(nodes("domains:2"), cells[1:])
        np.testing.assert_array_equal(nodes("boundaries:7"), facets[[0, 3]])
        np.testing.assert_array_equal(nodes("boundaries:8"), facets[2:3])
        self.assertNotIn("boundaries:0", mesh.cells)

    def test_hdf5_of_dolfin_that_is_wrong(self):
        _, points, cells, facets = self.write_dolfin()
        wrong = {
            "other points": {"boundaries": (points + 1, facets, np.arange(4))},
            "values of 4 elements": {"boundaries": (points, facets, np.arange(3))},
            "no points and simplices": {"boundaries": (points, np.zeros((4, 9), dtype=int), np.arange(4))},
            "two functions of the cells": {"more": (points, cells, np.array([1, 2]))},
        }
        for words, groups in wrong.items():
            path, *_ = self.write_dolfin(**groups)
            with self.assertRaisesRegex(InputError, words):
                read_mesh(path)
        with h5py.File(self.base / "mesh.h5", "w") as file:
            file["results"] = np.zeros(3)
        with self.assertRaisesRegex(InputError, "is no mesh of dolfin"):
            read_mesh(self.base / "mesh.h5")
        (self.base / "mesh.h5").write_text("none")
        with self.assertRaisesRegex(InputError, "cannot be read"):
            read_mesh(self.base / "mesh.h5")

    def write_dolfin_xml(self, **companions):
        """Two tetrahedra, cells and vertices not in order; `companions`: the contents of NAME_KEY.xml."""
        head = '<?xml version="1.0"?>\n<dolfin xmlns:dolfin="http://fenicsproject.org">'
        vertices = [
            f'<vertex index="{i}" x="{x!r}" y="{y!r}" z="{z!r}" />' for i, (x, y, z) in enumerate(POINTS.tolist())
        ]
        cells = [
            f'<tetrahedron index="{i}" ' + " ".join(f'v{k}="{n}"' for k, n in enumerate(row)) + " />"
            for i, row in enumerate(CELLS.tolist())
        ]
        for old in self.base.glob("d*.xml"):
            old.unlink()
        for name, text in companions.items():
            (self.base / f"d_{name}.xml").write_text(f"{head}{text}</dolfin>")
        return (
            f'{head}<mesh celltype="tetrahedron" dim="3"><vertices size="5">{"".join(vertices[::-1])}</vertices>'
            f'<cells size="2">{"".join(cells[::-1])}</cells></mesh></dolfin>'
        )

    def test_xml_of_dolfin(self):
        of_cells = '<mesh_function type="uint" dim="3" size="2"><entity index="1" value="7" />'
        of_cells += '<entity index="0" value="0" /></mesh_function>'
        # Of the second cell the facets without its first and its last vertex; a facet of value 0 says nothing.
        of_facets = '<mesh_function><mesh_value_collection name="f" type="uint" dim="2" size="3">'
        for cell, facet, value in ((1, 0, 4), (1, 3, 5), (0, 0, 0)):
            of_facets += f'<value cell_index="{cell}" local_entity="{facet}" value="{value}" />'
        of_facets += "</mesh_value_collection></mesh_function>"
        text = self.write_dolfin_xml(physical_region=of_cells, facet_region=of_facets)
        mesh = found_mesh("d.xml", self.read("d.xml", text), 1.0)
        np.testing.assert_array_equal(mesh.points, POINTS)
        np.testing.assert_array_equal(mesh.blocks[0].nodes, CELLS)
        expected = ["physical_region:0", "physical_region:7", "facet_region:4", "facet_region:5", "all"]
        self.assertEqual(list(mesh.cells), expected)
        np.testing.assert_array_equal(mesh.cells["physical_region:7"][0], [1])
        second = np.sort(CELLS[1])
        for part, corners in (("facet_region:4", second[1:]), ("facet_region:5", second[:3])):
            self.assertEqual(
                [b.nodes[p].tolist() for b, p in zip(mesh.blocks, mesh.cells[part]) if len(p)], [[[*corners]]]
            )
        # A function within the mesh.
        inside = of_facets.replace("<mesh_function>", "<domains>").replace("</mesh_function>", "</domains></mesh>")
        mesh = found_mesh("d.xml", self.read("d.xml", self.write_dolfin_xml().replace("</mesh>", inside)), 1.0)
        self.assertEqual(list(mesh.cells), ["domains_2:4", "domains_2:5", "all"])

    def test_xml_of_dolfin_whose_facets_only_dolfin_knows_is_said_to_have_them(self):
        numbered = '<mesh_function type="uint" dim="2" size="1"><entity index="0" value="7" /></mesh_function>'
        mesh = found_mesh("d.xml", self.read("d.xml", self.write_dolfin_xml(facet_region=numbered)), 1.0)
        self.assertEqual(list(mesh.cells), ["all"])
        self.assertIn("d_facet_region.xml (values of facets by dolfin's own numbers", mesh.passed_over[0])

    def test_xml_that_is_no_mesh_of_dolfin(self):
        text = self.write_dolfin_xml()
        for wrong, words in (
            (text.replace('index="1"', 'index="9"'), "indices of vertices or cells are not 0, 1, 2"),
            (text.replace('v1="', 'w1="'), "cannot be read as dolfin's XML"),
            (text.replace('celltype="tetrahedron"', 'celltype="hexahedron"'), "no tetrahedra or triangles"),
            (text[:200], "is no XML"),
            ("<a/>", "no other mesh in XML is known"),
            ('<dolfin><mesh_function dim="3" /></dolfin>', "but a function of one; give the mesh, NAME.xml"),
        ):
            self.expect_refusal("d.xml", wrong, words)
        beyond = '<mesh_function type="uint" dim="3" size="1"><entity index="2" value="7" /></mesh_function>'
        self.write_dolfin_xml(physical_region=beyond)
        self.expect_refusal("d.xml", text, "d_physical_region.xml: physical_region: names a cell or side")

    def test_med_of_gmsh(self):
        # Face of a tetrahedron of MED: the fourth node lies on the other side than VTK's.
        mesh = self.med("TE4", CELLS[:, [0, 2, 1, 3]], POINTS, [[0, 1, 2], [1, 2, 4]])
        found = found_mesh("a.med", mesh, 1.0)
        self.assertEqual(sorted(found.cells), ["all", "ends", "family:F_3D_2", "fluid", "inlet"])
        self.assertEqual(found.numbered, {"all", "family:F_3D_2"})
        tetrahedra = next(nodes for kind, nodes in mesh.blocks if kind == "tetra")
        np.testing.assert_array_equal(tetrahedra, CELLS)
        self.assertEqual(sides_at(mesh, "ends"), [[0, 1, 2], [1, 2, 4]])
        self.assertEqual(sides_at(mesh, "inlet"), [[0, 1, 2]])

    def test_med_cells_of_ten_nodes(self):
        # MED's corners 0, 2, 1, 3 of VTK's, then the middles of (0,1), (1,2), (0,2), (0,3), (1,3), (2,3) of MED's own.
        mesh = self.med("T10", np.array([[0, 2, 1, 3, 6, 5, 4, 7, 9, 8]]), CURVED)
        np.testing.assert_array_equal(mesh.blocks[0][1], [np.arange(10)])
        self.expect_middles(mesh)

    def test_med_that_is_wrong(self):
        import h5py

        self.expect_refusal("b.med", "no mesh", "cannot be read as MED")
        with h5py.File(self.base / "c.med", "w") as file:
            file.create_group("ENS_MAA/one")
            file.create_group("ENS_MAA/two")
        self.expect_refusal("c.med", None, "ENS_MAA: holds 2 meshes: one, two")

    # Abaqus

    DECK = """*Heading
 two cells
** a comment
*NODE, NSET=Nall
1, 0, 0, 0
2, 1., 0, 0
3, 0, 1e0, 0
14, 0, 0, 1
15, 1, 1, 1
*Element, type=C3D4H, ELSET=Fluid
5, 1, 2, 3, 14
*ELEMENT, TYPE=C3D4, ELSET=WALL
7, 2, 3, 14,
15
*ELSET, ELSET=both, GENERATE
5, 7, 2
*Elset, elset=_face_S1, internal
5
*NSET, NSET=ends
1, 2, 3
*SURFACE, NAME=inlet, TYPE=ELEMENT
_face_S1, S1
Fluid, S2
*SURFACE, NAME=wall
7, S4
*SURFACE, NAME=corner, TYPE=NODE
ends
*STEP
*END STEP
"""

    def test_abaqus_sets_and_surfaces(self):
        mesh = self.read("a.inp", self.DECK)
        np.testing.assert_array_equal(mesh.blocks[0][1], CELLS)
        self.assertEqual(sorted(mesh.cell_sets), ["Fluid", "WALL", "WALL:surface", "both", "inlet"])
        # Faces by the manual: 1-2-3, 1-4-2, 2-4-3, 3-4-1.
        self.assertEqual(sides_at(mesh, "inlet"), [[0, 1, 2], [0, 1, 3]])
        self.assertEqual(sides_at(mesh, "WALL:surface"), [[1, 3, 4]])
        np.testing.assert_array_equal(mesh.point_sets["ends"], [0, 1, 2])
        np.testing.assert_array_equal(mesh.point_sets["corner"], [0, 1, 2])

    def test_abaqus_includes_and_input_files(self):
        nodes, rest = self.DECK[: self.DECK.index("*Element")], self.DECK[self.DECK.index("*Element") :]
        (self.base / "parts").mkdir(exist_ok=True)
        (self.base / "parts" / "Nodes.inp").write_text(nodes)
        (self.base / "wall.txt").write_text("7, 2, 3, 14, 15\n")
        rest = rest.replace("ELSET=WALL\n7, 2, 3, 14,\n15\n", "ELSET=WALL, INPUT=wall.txt\n")
        mesh = self.read("a.inp", f"*INCLUDE, INPUT=parts/Nodes.inp\n{rest}")
        np.testing.assert_array_equal(mesh.blocks[0][1], CELLS)
        self.expect_refusal("a.inp", "** one\n*INCLUDE, INPUT=none.inp\n", "a.inp: line 2: *INCLUDE, INPUT=none.inp: ")
        self.expect_refusal("a.inp", "*INCLUDE, INPUT=a.inp\n", "more than 20 levels of *INCLUDE")

    def test_abaqus_sets_of_corners_of_quadratic_cells(self):
        nodes = "".join(f"{i + 1}, {x}, {y}, {z}\n" for i, (x, y, z) in enumerate(CURVED))
        cell = "*ELEMENT, TYPE=C3D10, ELSET=fluid\n1, 1, 2, 3, 4, 5, 6, 7,\n8, 9, 10\n"
        surface = "*SURFACE, NAME=side\nfluid, S1\nfluid, S2\nfluid, S3\nfluid, S4\n"
        mesh = self.read("a.inp", f"*NODE\n{nodes}{cell}*NSET, NSET=inlet\n1, 2, 4\n{surface}")
        self.assertEqual([kind for kind, _ in mesh.blocks], ["tetra10", "triangle6"])
        self.expect_middles(mesh)
        (side,) = facets_between(found_mesh("a.inp", mesh, 1.0), mesh.point_sets["inlet"])
        self.assertEqual(sorted(side.nodes[0]), [0, 1, 3, 4, 7, 8])

    def test_abaqus_parts_have_numbers_of_their_own(self):
        part = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, {}\n*ELEMENT, TYPE=C3D4, ELSET={}\n1, 1, 2, 3, 4\n"
        text = ""
        for name, height in (("lumen", 1), ("wall", -1)):
            text += f"*PART, NAME={name}\n{part.format(height, name)}*END PART\n"
        text += "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=L-1, PART=lumen\n*END INSTANCE\n*INSTANCE, NAME=W-1, PART=wall\n"
        text += "*END INSTANCE\n*NSET, NSET=top, INSTANCE=W-1\n4\n*ELSET, ELSET=one, INSTANCE=L-1\n1\n"
        text += "*SURFACE, NAME=s\nL-1.lumen, S1\n*END ASSEMBLY\n"
        mesh = self.read("a.inp", text)
        self.assertEqual(sorted(mesh.cell_sets), ["lumen", "one", "s", "wall"])
        np.testing.assert_array_equal(mesh.point_sets["top"], [7])
        np.testing.assert_array_equal(mesh.cell_sets["one"][0], [0])
        moved = text.replace("PART=wall\n*END INSTANCE", "PART=wall\n0, 0, 5\n*END INSTANCE")
        self.expect_refusal("a.inp", moved, "an instance that is moved or turned is not read")

    def test_abaqus_a_blank_coordinate_is_zero(self):
        text = self.DECK.replace("15, 1, 1, 1", "15, 1., , 1").replace("3, 0, 1e0, 0", "3, , 1e0")
        mesh = self.read("a.inp", text)
        np.testing.assert_array_equal(mesh.points[[2, 4]], [[0, 1, 0], [1, 0, 1]])

    def test_abaqus_a_keyword_may_go_on_in_the_next_line(self):
        text = self.DECK.replace("*Element, type=C3D4H, ELSET=Fluid", "*Element,\n** so\n type=C3D4H,\n ELSET=Fluid")
        np.testing.assert_array_equal(self.read("a.inp", text).cell_sets["Fluid"][0], [0])

    def test_abaqus_sets_of_one_name_in_several_parts_are_several(self):
        part = (
            "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, {}\n*ELEMENT, TYPE=C3D4, ELSET=Set-1\n1, 1, 2, 3, 4\n"
        )
        text = "".join(f"*PART, NAME={n}\n{part.format(h)}*END PART\n" for n, h in (("lumen", 1), ("wall", -1)))
        text += "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=L-1, PART=lumen\n*END INSTANCE\n*INSTANCE, NAME=W-1, PART=wall\n"
        text += "*END INSTANCE\n*ELSET, ELSET=both, INSTANCE=L-1\n1\n*ELSET, ELSET=both, INSTANCE=W-1\n1\n"
        text += "*ELSET, ELSET=SET-1, INSTANCE=W-1\n1\n*SURFACE, NAME=s\nL-1.Set-1, S1\n*END ASSEMBLY\n"
        mesh = self.read("a.inp", text)
        self.assertEqual(sorted(mesh.cell_sets), ["LUMEN/Set-1", "Set-1", "WALL/Set-1", "both", "s"])
        for name, places in (("LUMEN/Set-1", [0]), ("WALL/Set-1", [1]), ("Set-1", [1]), ("both", [0, 1])):
            np.testing.assert_array_equal(mesh.cell_sets[name][0], places, name)
        self.assertEqual(sides_at(mesh, "s"), [[0, 1, 2]])

    def test_abaqus_that_is_wrong_is_refused_with_its_line(self):
        for old, new, words in (
            ("2, 1., 0, 0", "2, 1., zero, 0", "line 6: '2, 1., zero, 0' is no node"),
            ("3, 0, 1e0, 0", "2, 0, 1, 0", "line 7: node 2 is there twice"),
            ("5, 1, 2, 3, 14", "5, 1, 2, 3, 4", "line 11: element 5 has the node 4, which is not there"),
            ("5, 1, 2, 3, 14", "5, 1, 2, 3", "line 11: element 5 has 3 nodes, its type C3D4H 4"),
            ("5, 1, 2, 3, 14", "5, 1, 2, 3, 14, 15", "line 11: element 5 has 5 nodes, its type C3D4H 4"),
            ("type=C3D4H", "type=F3D4", "line 10: elements of the type F3D4 are not known"),  # solids or surfaces
            ("type=C3D4H", "type=XY7", "line 10: elements of the type XY7 are not known"),
            ("5, 7, 2", "5, 7, 1", "line 16: the set both has the element 6, which is not there"),
            ("1, 2, 3\n*SURF", "1, 2, ring\n*SURF", "line 20: there is no set ring"),
            ("Fluid, S2", "fluit, S2", "line 23: there is no set of elements fluit"),
            ("Fluid, S2", "Fluid, S5", "line 23: S5 is no face of a tetra"),
            ("Fluid, S2", "Fluid", "line 23: names no face of its cells"),
            ("*STEP", "*NGEN", "line 28: *NGEN makes or moves nodes"),
            ("*Heading", "words", "line 1: 'words' stands before any keyword"),
        ):
            with self.subTest(new=new):
                self.assertEqual(self.DECK.count(old), 1)
                self.expect_refusal("a.inp", self.DECK.replace(old, new), words)
        self.expect_refusal("a.inp", "*HEADING\n", "holds no *NODE")

    # Several files

    def test_parts_of_one_name_in_two_files_are_refused(self):
        for name in ("l/mesh.inp", "w/mesh.inp", "deck.inp"):
            (self.base / name).parent.mkdir(exist_ok=True)
            (self.base / name).write_text(self.DECK)
        (self.base / "other.inp").write_text(self.DECK.replace("Fluid", "lumen"))
        for sources, words in (
            ([Source("", self.base / "l/mesh.inp"), Source("", self.base / "w/mesh.inp")], "mesh/Fluid"),
            ([Source("Fluid", self.base / "other.inp"), Source("", self.base / "deck.inp")], "Fluid"),
            ([Source("", self.base / "deck.inp"), Source("Fluid", self.base / "other.inp")], "Fluid"),
        ):
            with self.assertRaisesRegex(InputError, f"{words}: two of the files have the part {words}; .*NAME=FILE"):
                read_sources(sources, 1.0)
        named = [Source("a", self.base / "l/mesh.inp"), Source("b", self.base / "w/mesh.inp")]
        self.assertEqual(list(read_sources(named, 1.0)[0].cells)[:2], ["a", "a/Fluid"])

    # Others

    def test_files_that_no_reader_takes_are_refused_with_the_way_in(self):
        for name, words in (
            ("a.unv", "a universal file of I-DEAS, which no reader takes; turn it by gmsh"),
            ("a.neu", "a neutral file of Gambit"),
            ("a.mesh", "meshio cannot read it"),
            ("a.xyz", "meshio cannot read it"),
        ):
            self.expect_refusal(name, "no mesh", words)

    def test_medit_has_its_references(self):
        points = "".join(f"{x} {y} {z} 0\n" for x, y, z in POINTS)
        cells = "".join(f"{' '.join(str(n + 1) for n in row)} {k + 3}\n" for k, row in enumerate(CELLS))
        text = f"MeshVersionFormatted 2\nDimension 3\nVertices\n5\n{points}Tetrahedra\n2\n{cells}End\n"
        found = found_mesh("a.mesh", self.read("a.mesh", text), 1.0)
        self.assertEqual(list(found.cells), ["medit:ref:3", "medit:ref:4", "all"])

        # References of points say little, and hide no part of cells of the same number.
        found = found_mesh("a.mesh", self.read("a.mesh", text.replace(" 0\n", " 3\n")), 1.0)
        self.assertEqual(
            (list(found.cells)[:2], list(found.points_of)), (["medit:ref:3", "medit:ref:4"], ["medit:ref:3:points"])
        )

    def test_a_set_of_points_with_the_name_of_cells_is_a_part_of_its_own(self):
        deck = self.DECK.replace("NSET=ends", "NSET=Fluid").replace("\nends\n", "\nFluid\n")
        found = found_mesh("a.inp", self.read("a.inp", deck), 1.0)
        self.assertIn("Fluid", found.cells)
        self.assertNotIn("Fluid", found.points_of)
        np.testing.assert_array_equal(found.points_of["Fluid:points"], [0, 1, 2])
        # Beside another file, too.
        (self.base / "other.inp").write_text(self.DECK.replace("Fluid", "lumen").replace("WALL", "shell"))
        sources = [Source("", self.base / "a.inp"), Source("", self.base / "other.inp")]
        whole, _ = read_sources(sources, 1.0)
        self.assertIn("Fluid:points", whole.points_of)

    def test_folders_are_refused_with_the_command_for_their_files(self):
        folder = self.base / "mesh-complete"
        (folder / "mesh-surfaces").mkdir(parents=True)
        with self.assertRaisesRegex(InputError, "is a folder; give the files in it: fluid=LUMEN.vtu, "):
            read_mesh(folder)
        for name in (
            "mesh-complete.mesh.vtu",
            "mesh-surfaces/cap in.vtp",
            "mesh-surfaces/wall.vtp",
            "walls_combined.vtp",
        ):
            (folder / name).write_text("")
        words = f"fsi-mesh import fluid={folder}/mesh-complete.mesh.vtu 'cap in={folder}/mesh-surfaces/cap in.vtp' -o "
        with self.assertRaises(InputError) as refused:
            read_mesh(folder)
        self.assertIn(f"{words}mesh-complete.msh", str(refused.exception))

    def test_lagrange_cells_of_vtk_are_quadratic_cells(self):
        ends, kinds = np.array([10, 14]), np.array([71, 10])
        fields = {"region": np.array([7.0, 8.0])}
        corners = np.concatenate([np.arange(10), np.arange(4)])
        mesh = mesh_of(VtkFile(self.base / "a.vtu", CURVED, ends, kinds, corners, cell_fields=fields))
        self.assertEqual([kind for kind, _ in mesh.blocks], ["tetra", "tetra10"])
        self.expect_middles(mesh)
        np.testing.assert_array_equal(mesh.cell_data["region"], [[8], [7]])

    def test_cells_of_vtk_that_are_none_of_ours(self):
        for kind, count, words in (
            (42, 4, "has a cell of VTK's kind 42"),
            (10, 5, "a cell of VTK's kind 10 has not 4 nodes"),
        ):
            file = VtkFile(self.base / "a.vtu", POINTS, np.array([count]), np.array([kind]), np.arange(count))
            with self.assertRaisesRegex(InputError, words):
                mesh_of(file)


if __name__ == "__main__":
    unittest.main()
