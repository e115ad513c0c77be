"""Parts of `fsi-compare verify`: quantities of curves, scripts and words of meshes, costs, demands, case files."""

import math
import random
import re
import tomllib
import types
import unittest
import unittest.mock
from dataclasses import replace
from pathlib import Path

import numpy as np
from folder_case import FolderCase

from fsi_compare.base.case_names import RENAMED, short_name, with_present_names
from fsi_compare.base.errors import InputError
from fsi_compare.verify import preparing
from fsi_compare.verify.cost import Costs, learn
from fsi_compare.verify.demand import cheapest, refinable, shown_by, tolerance_factor
from fsi_compare.verify.doubt import doubt, on_common_points, step_within
from fsi_compare.verify.family import Member, read_case, with_settings
from fsi_compare.verify.flow_tables import TIMES
from fsi_compare.verify.found_case import write_case
from fsi_compare.verify.geo_sizes import graded_text, read_sizes
from fsi_compare.verify.lean import between, cross, lean, starting_member
from fsi_compare.verify.artery_sizes import LEVELS, RECOMMENDED, SHORT_STEP, artery_words, waves_of
from fsi_compare.verify.mesh_family import ratio_for
from fsi_compare.verify.paying import kind_of, unpaid
from fsi_compare.runs.coupling import chosen_scheme
from fsi_compare.verify.preparing import tell_damped
from fsi_compare.verify.quantities import Asked, Curve, peak, quantities_of
from fsi_compare.verify.results import Judged, about
from fsi_compare.verify.tolerances import (
    DEFAULT_SCHEME,
    ERROR_TOLERANCE,
    GAP_TOLERANCE,
    NEWTON_TOLERANCE,
    WALL_ERROR_TOLERANCE,
    governing,
)
from fsi_compare.verify.verdict import NOT_IN_RANGE, Value, bar_of


SOURCES = Path(__file__).resolve().parents[3]  # of the drivers and of fsi-mesh


def curve(of, step=0.1, end=10.0, name="tip: displacement x"):
    times = np.arange(1, round(end / step) + 1) * step
    return Curve(name, "mm", times, np.array([[of(t)] for t in times]), np.zeros(1))


def values(one, **asked):
    return {q.name.partition(", ")[2]: q.of(one) for q in quantities_of({one.name: one}, Asked(**asked))}


class Quantities(unittest.TestCase):
    def test_of_a_sine_over_two_periods(self):
        found = values(curve(lambda t: 3 + 2 * math.sin(2 * math.pi * t / 5)), period=5.0, times=(2.5,))
        self.assertAlmostEqual(found["largest"], 5, delta=1e-4)
        self.assertNotIn("smallest", found)  # it is positive
        self.assertAlmostEqual(found["at the end"], 3, places=9)
        self.assertAlmostEqual(found["at 2.5 ms"], 3, places=9)
        self.assertAlmostEqual(found["mean of the last period"], 3, places=9)
        self.assertAlmostEqual(found["swing of the last period"], 2, delta=1e-4)
        self.assertAlmostEqual(found["L2 norm"], math.sqrt(9 + 2), delta=0.02)

    def test_last_period_of_a_member_that_ended_earlier(self):
        """As time.periods ends it: a transient has died out in both, and the last periods are alike."""
        own, other = (curve(lambda t: 3 + 2 * math.sin(2 * math.pi * t / 5), end=end) for end in (20.0, 15.0))
        of = {q.name.partition(", ")[2]: q.of for q in quantities_of({own.name: own}, Asked(period=5.0))}
        for name, value in (("mean of the last period", 3), ("swing of the last period", 2)):
            self.assertAlmostEqual(of[name](other), value, delta=1e-4)
            self.assertAlmostEqual(of[name](own), value, delta=1e-4)

    def test_extreme_between_levels_does_not_jump_with_the_step(self):
        exact = [peak(t, np.sin(t)) for t in (np.arange(1, 40) * h for h in (0.2, 0.1, 0.05))]
        for found, h in zip(exact, (0.2, 0.1, 0.05)):
            self.assertAlmostEqual(found, 1, delta=h**3)

    def test_static_case_has_its_end_only(self):
        self.assertEqual(list(values(curve(lambda t: t), static=True)), ["at the end"])

    def test_zeros_are_no_quantities(self):
        zero, big = curve(lambda t: 1e-7, name="rim: displacement x"), curve(lambda t: 1.0)
        names = [q.curve for q in quantities_of({zero.name: zero, big.name: big}, Asked())]
        self.assertNotIn("rim: displacement x", names)

    def test_norm_along_a_line_of_uneven_points(self):
        line = Curve("wall: radial", "mm", np.array([1.0]), np.array([[2.0, 2.0, 2.0]]), np.array([0.0, 1.0, 4.0]))
        self.assertAlmostEqual(values(line)["L2 norm at the end"], 2)

    def test_order_of_what_is_made_of_gradients(self):
        for name, lower in (("a: pressure", True), ("a: velocity z", False), ("a: force x", True), ("p: flow", False)):
            self.assertEqual(curve(abs, name=name).is_pressure, lower)


def line(s, values):
    return Curve("axis: pressure", "Pa", np.array([1.0, 2.0]), np.array([values, values]), np.array(s))


class Doubts(unittest.TestCase):
    """What no sequence of values shows."""

    def test_steps_that_a_flow_asks_for(self):
        facts = types.SimpleNamespace(flow_interval=20.0, adaptive=False, static=False, step=8.0)
        self.assertEqual(step_within(facts), 20 / 4 / 8)
        facts.flow_interval = None
        self.assertIsNone(step_within(facts))

    def test_line_that_goes_another_way_in_each_member(self):
        lines = [line((0.0, 1.0, 2.0), (1.0, 2.0, 3.0)), line((0.0, 1.1, 2.2), (1.0, 2.0, 3.0))]
        one = quantities_of({"axis: pressure": lines[0]}, Asked(static=True))[0]
        facts = types.SimpleNamespace(flow_interval=None)
        self.assertEqual(doubt(one, [lines[0], lines[0]], facts), "")
        self.assertIn("the line is another one in each member", doubt(one, lines, facts))

    def test_points_that_one_mesh_lacks_count_in_none(self):
        whole, lacking = line((0.0, 1.0, 2.0, 3.0), (1.0, 9.0, 1.0, 1.0)), line((0.0, 2.0, 3.0), (1.0, 1.0, 1.0))
        members = {Member(1.0, 1.0): {whole.name: whole}, Member(0.5, 1.0): {whole.name: lacking}}
        for of in on_common_points(members).values():
            self.assertEqual(of[whole.name].s.tolist(), [0.0, 2.0, 3.0])
            self.assertEqual(of[whole.name].largest, 1.0)

    def test_extremes_of_pressure_need_steps_within_the_intervals_of_a_flow(self):
        pressure = curve(lambda t: math.sin(t), step=0.1, name="inlet: mean pressure")
        one = {q.name.partition(", ")[2]: q for q in quantities_of({pressure.name: pressure}, Asked())}
        for interval, forbidden in ((0.1, True), (0.39, True), (0.4, False), (None, False)):
            facts = types.SimpleNamespace(flow_interval=interval)
            self.assertEqual("shorten the step" in doubt(one["largest"], [pressure], facts), forbidden)
            self.assertEqual(doubt(one["L2 norm"], [pressure], facts), "")


class Scripts(FolderCase):
    def script(self, text):
        path = self.base / "shape.geo"
        path.write_text(text)
        return path

    def test_sizes_and_counts_are_told_apart(self):
        text = """// sizes: wall in a comment
        DefineConstant[ size = 0.4, fine = {0.1, Name "finest"}, wall = 0.3, across = 6, along = 20 ];
        Point(1) = {0, wall, 0, 0.6 * size};
        Mesh.MeshSizeMin = fine;
        Transfinite Curve{1} = across + 1 Using Progression 0.8;
        f[] = Extrude { 0, 50, 0 } { Curve{1}; Layers{along}; };
        """
        found = read_sizes(self.script(text))
        self.assertEqual(found.sizes, {"size": 0.4, "fine": 0.1})
        self.assertEqual(found.counts, {"across": 6, "along": 20})
        self.assertEqual(found.settings(2.0, {"across": 8}), {"size": 0.2, "fine": 0.05, "across": 16, "along": 40})

    def test_lengths_of_cells_that_counts_are_made_of_are_sizes(self):
        text = """DefineConstant[ size = 0.4, wall = 0.1, inner = 0.2, length = 12, n = 6 ];
        Mesh.MeshSizeMax = size;
        Transfinite Curve{3} = Round(length / (2 * inner));
        Transfinite Curve{1} = Ceil(2 / wall) + 1;
        Transfinite Curve{2} = n;
        Extrude { 0, length, 0 } { Curve{1}; Layers{ Round(length / size) }; }
        """
        found = read_sizes(self.script(text))
        self.assertEqual((found.sizes, found.counts), ({"size": 0.4, "wall": 0.1, "inner": 0.2}, {"n": 6}))

    def test_grading_keeps_its_shape(self):
        """n cells of ratio q and 2 n of ratio q^(1/2) have the same first to last."""
        path = self.script("DefineConstant[ n = 6 ];\nTransfinite Curve{1} = n + 1 Using Progression 0.8;\n")
        self.assertTrue(read_sizes(path).graded)
        self.assertIn(f"Progression {0.8**0.5:.12g}", graded_text(path, 2.0))

    def test_sizes_that_the_vessel_is_made_of_are_refused(self):
        """Members would be other vessels."""
        radius = "DefineConstant[ radius = 2, size = 0.5 ];\nMesh.MeshSizeMax = radius / 4;\n"
        for text, name in (
            (radius + "Rectangle(1) = {0,0,0,radius,10};\n", "radius"),
            (radius + "Point(1) = {radius, 0, 0, radius};\n", "radius"),
            (radius + "half = radius / 2;\n", "radius"),
            ("DefineConstant[ r = 2, wall = 0.1 * r ];\nMesh.MeshSizeMax = r / 4;\n", "r"),
            ("DefineConstant[ length = 9 ];\nExtrude {0, length, 0} { Curve{1}; Layers{ length / 2 }; }\n", "length"),
            ("DefineConstant[ n = 2 ];\nExtrude {0, 1, 0} { Curve{1}; Layers{ {4, n}, {n / 9, 1} }; }\n", "n"),
        ):
            with self.subTest(text), self.assertRaisesRegex(InputError, f": {name}: is a size.* constant of its own"):
                read_sizes(self.script(text))

    def test_sizes_of_fields_and_nested_entities_are_no_vessel(self):
        text = """DefineConstant[ size = 0.4, n = 6, e = 0.2 ];
        a = 1e-3;  // "e" is no part of a number
        Point(p[0]) = {0, 0, 0, e};
        Printf("size", size);
        Field[1].VIn = size / 2; Field[2].SizeMin = size / 4; Field[3].F = Sprintf("%g * x", size);
        MeshSize{ PointsOf{ Volume{1}; } } = size;
        Transfinite Curve{ Boundary{ Surface{1}; } } = n + 1;
        """
        found = read_sizes(self.script(text))
        self.assertEqual((found.sizes, found.counts), ({"size": 0.4, "e": 0.2}, {"n": 6}))

    def test_sizes_given_by_expressions_are_refused(self):
        """Of 0.25 * radius the first number would be taken for the size."""
        for value in ("0.25 * radius", "1/2", "{0.25 * radius, Min 0.1}", "Pi / 20", "-radius"):
            text = f"DefineConstant[ radius = 2, size = {value} ];\nMesh.MeshSizeMax = size;\n"
            with self.subTest(value), self.assertRaisesRegex(InputError, ": size: .* is an expression"):
                read_sizes(self.script(text))
        for value in ("5e-1", '{ 0.5, Name "size = h" }', "0.5 /* 1 */", "+.5 // mm\n"):
            text = f"DefineConstant[ ratio = 1 / 3, size = {value} ];\nMesh.MeshSizeMax = size;\n"
            self.assertEqual(read_sizes(self.script(text)).sizes, {"size": 0.5}, value)

    def test_families_of_the_gallery(self):
        """Each script of a scene with the constants that its family has; nothing else changes between members."""
        without = {"gallery/flap-in-merging-jets/jets.geo"}  # its sizes are those of fields alone
        for path in sorted((SOURCES / "gallery").rglob("*.geo")):
            if path.relative_to(SOURCES).as_posix() not in without:
                found = read_sizes(path)
                self.assertTrue(found.sizes or found.counts, path)

    def test_what_cannot_be_refined_is_refused(self):
        for text, said in (
            ("DefineConstant[ wall = 0.3 ];\n", "no constant"),
            ("DefineConstant[ n = 3 ];\nMesh.MeshSizeMax = n;\nTransfinite Curve{1} = n;\n", "both a size and a count"),
            (
                'DefineConstant[ n = 3 ];\nMerge "a.step";\nTransfinite Curve{1} = n Using Progression 1.1;\n',
                "other files",
            ),
        ):
            with self.assertRaisesRegex(InputError, said):
                read_sizes(self.script(text))


class LeanFamilies(unittest.TestCase):
    """On the way to a demanded error."""

    def test_centre_is_the_dearest_member(self):
        found = lean([2.25, 1.5, 1.0], False)
        self.assertEqual({(m.mesh, m.step) for m in found if m.step == 1}, {(2.25, 1), (1.5, 1), (1, 1)})
        self.assertEqual({(m.mesh, m.step) for m in found if m.step != 1}, {(1.5, 2), (1.5, 4), (2.25, 2)})
        self.assertEqual(sum(m.looser for m in found), 1)
        seconds = [m.mesh**-4.2 / m.step for m in found]
        self.assertLess(sum(seconds), 1.5 * max(seconds))
        self.assertEqual({m.step for m in lean([1.5, 1.0], True)}, {1.0})

    def test_bar_holds_with_steps_on_the_coarser_mesh(self):
        """The part of the product is more than what the step's parts on the two meshes differ by."""

        def y(h, dt, tolerance=0.0):
            return 1 + 0.02 * h**2 + 0.03 * dt**2 - 0.002 * h**2 * dt**2 + tolerance

        family = [Value(m.mesh, m.step, y(m.mesh, m.step), m.looser) for m in lean([2.25, 1.5, 1.0], False)]
        bar = bar_of(family, 1.0, 2.0, 2.0)
        self.assertTrue(bar.given)
        self.assertGreater(bar.total, abs(y(1, 1) - 1))
        self.assertGreater(bar.step.bar + bar.together, 0.03)
        self.assertAlmostEqual(bar.step.order, 2, delta=1e-3)
        self.assertAlmostEqual(bar.together, 2 * 0.002 * 1.5**2, delta=1e-6)

    def test_cross_costs_half_of_its_centre(self):
        for dimension_power, most in ((4.2, 0.6), (2.6, 0.9)):
            found = cross([2.25, 1.5, 1.0], [4.0, 2.0, 1.0])
            self.assertNotIn((1.0, 1.0), {(m.mesh, m.step) for m in found})
            self.assertLess(sum(m.mesh**-dimension_power / m.step for m in found), most)
        np.testing.assert_allclose(between(2.25, 1.0, 1.5), [2.25, 1.5, 1.0], rtol=1e-12)
        self.assertEqual(between(1.0, 1.0, 1.5), [1.0])

    def test_bar_of_a_cross_holds_with_its_centre_and_without(self):
        """Mesh and step may help or hinder each other. The bar is that of the centre, whether it has run or not."""
        chance, given = random.Random(7), 0
        for _ in range(60):
            p, q = chance.choice((1.0, 2.0, 3.0)), chance.choice((1.0, 2.0))
            a, b = chance.uniform(-1, 1), chance.uniform(-1, 1)
            c = chance.uniform(-0.1, 0.1) * min(abs(a), abs(b))
            levels = chance.choice((3, 4))
            meshes = [1.5 ** (levels - 1 - k) for k in range(levels)]
            family = cross(meshes, [4.0, 2.0, 1.0])

            def y(m):
                return 3 + 0.01 * (a * m.mesh**p + b * m.step**q + c * m.mesh**p * m.step**q)

            for members, additive in ((family, True), ([*family, Member(1.0, 1.0)], False)):
                bar = bar_of([Value(m.mesh, m.step, y(m), m.looser) for m in members], 3.0, p, q, "p2p1", additive)
                if bar.given:
                    self.assertGreaterEqual(bar.total, abs(y(Member(1.0, 1.0)) - 3))
                    given += 1
            self.assertIsNone(bar_of([Value(m.mesh, m.step, y(m), m.looser) for m in family], 3.0, p, q))
        self.assertGreater(given, 90)  # of 120

    def test_begins_coarser_where_that_makes_another_mesh(self):
        recipe = types.SimpleNamespace(coarsens=True, counts=[])
        for nodes, mesh in (
            (lambda size: round(1e4 / size**3), 1.5),
            (lambda size: 300, 1.0),
            (lambda size: None, 1.0),
        ):
            self.assertEqual(starting_member(recipe, False, 1.5, 3, nodes), Member(mesh, 2.0))
        within = starting_member(recipe, False, 1.5, 3, lambda size: 300, 0.3)
        self.assertEqual(within, Member(1.0, 0.25))  # a table of a flow asks for shorter steps
        few = types.SimpleNamespace(coarsens=True, counts=[2.0])
        self.assertEqual(starting_member(few, True, 1.5, 3, lambda size: 1), Member(1.0, 1.0))


class Tolerances(unittest.TestCase):
    BOTH = ("fsi-monolithic", "fsi-partitioned")

    def keys(self, program, **entries):
        return sorted(governing(program, entries))

    def test_case_without_a_scheme_governs_both_drivers_alike(self):
        for newton in ({}, {"tolerance": 1e-5}, {"error_tolerance": 1e-3}):
            monolithic, partitioned = (governing(program, {"newton": newton}) for program in self.BOTH)
            self.assertEqual(monolithic, partitioned)
        self.assertEqual(governing(self.BOTH[1], {}), {"newton.tolerance": 1e-3})
        residual = {"newton": {"residual_tolerance": 1e-8}}
        demanded = {"newton.tolerance": 1e-3, "newton.residual_tolerance": 1e-8}
        self.assertEqual(governing("fsi-monolithic", residual), demanded)
        block = {**residual, "partitioned": {"scheme": "block-newton"}}
        self.assertEqual(governing("fsi-partitioned", block), demanded)
        del demanded["newton.residual_tolerance"]  # an interface iteration has no residual of both media
        self.assertEqual(governing("fsi-partitioned", residual), demanded)

    def test_case_without_a_tolerance_stops_by_its_error_in_fixed_steps(self):
        for program in self.BOTH:
            self.assertEqual(governing(program, {"time": {"step": 0.5}}), {"newton.error_tolerance": 3e-4})
            flow = {"time": {"step": 0.5}, "fluid": {"density": 1}}
            self.assertEqual(governing(program, flow), {"newton.error_tolerance": 3e-3})
            self.assertEqual(governing(program, {"time": {"step": "adaptive"}}), {"newton.tolerance": 1e-3})
            named = {"time": {"step": 0.5}, "newton": {"tolerance": 1e-5}}
            self.assertEqual(governing(program, named), {"newton.tolerance": 1e-5})
            off = {"time": {"step": 0.5}, "newton": {"error_tolerance": 0}}
            self.assertEqual(governing(program, off), {"newton.tolerance": 1e-3})

    def test_demanded_error_and_residual(self):
        newton = {"tolerance": 1e-5, "error_tolerance": 1e-3, "residual_tolerance": 1e-8}
        self.assertEqual(
            governing("fsi-monolithic", {"newton": newton}),
            {"newton.error_tolerance": 1e-3, "newton.residual_tolerance": 1e-8},
        )
        self.assertEqual(self.keys("fsi-monolithic", newton={"error_tolerance": 0}), ["newton.tolerance"])

    def test_tolerance_that_a_case_names_is_the_partitioned_driver_s(self):
        for coupling in ({}, {"scheme": "robin-neumann-inexact"}, {"scheme": "block-newton"}):
            entries = {"partitioned": {**coupling, "tolerance": 1e-7}, "newton": {"tolerance": 1e-5}}
            self.assertEqual(governing("fsi-partitioned", entries), {"partitioned.tolerance": 1e-7})
            self.assertEqual(governing("fsi-monolithic", entries), {"newton.tolerance": 1e-5})

    def test_other_schemes_stop_by_the_gap(self):
        entries = {"partitioned": {"scheme": "iqn-ils"}, "newton": {"error_tolerance": 1e-3}}
        self.assertEqual(governing("fsi-partitioned", entries), {"partitioned.tolerance": 1e-6})
        self.assertEqual(
            self.keys("fsi-partitioned", partitioned={"scheme": "aitken", "force_tolerance": 1e-4}),
            ["partitioned.force_tolerance", "partitioned.tolerance"],
        )

    def test_scheme_that_the_driver_has_chosen(self):
        flow = {"time": {"step": 0.5}, "fluid": {"density": 1}}
        for scheme in ("iqn-ils", "robin-neumann-iqn"):
            summary = {"choices": {"partitioned.scheme": {"value": scheme, "reason": "the wall stands in the fluid"}}}
            found = governing("fsi-partitioned", flow, chosen_scheme(summary))
            self.assertEqual(found, {"partitioned.tolerance": 1e-6})
        named = {**flow, "partitioned": {"scheme": "block-newton"}}  # the case's word counts
        self.assertEqual(governing("fsi-partitioned", named, "iqn-ils"), {"newton.error_tolerance": 3e-3})
        for silent in ({}, {"choices": {}}, {"choices": {"partitioned.scheme": {"reason": "none"}}}):
            self.assertIsNone(chosen_scheme(silent))

    def test_defaults_are_those_of_the_drivers(self):
        data = (SOURCES / "common/case/case.hpp").read_text()
        newton = re.search(r" options\(\) \{\s*NewtonOptions options;\s*options\.tolerance = (\S+);", data)
        gap = re.search(r" standard_tolerance = (\S+);", data)
        error = re.search(r" error_tolerance = (\S+);", data)
        wall = re.search(r" error_tolerance_of_wall = (\S+);", data)
        self.assertEqual((float(error[1]), float(wall[1])), (ERROR_TOLERANCE, WALL_ERROR_TOLERANCE))
        self.assertEqual((float(newton[1]), float(gap[1])), (NEWTON_TOLERANCE, GAP_TOLERANCE))
        choice = (SOURCES / "partitioned/scheme_choice.cpp").read_text()
        self.assertIn(f'return {{"{DEFAULT_SCHEME}", "the case names none"}};', choice)


class FormerNames(FolderCase):
    def test_table_is_that_of_the_drivers(self):
        rows = re.findall(
            r'\{"(\w+)", "(\w+)", "(\w+)", "(\w+)"\}', (SOURCES / "common/case/renamed_keys.cpp").read_text()
        )
        self.assertEqual({f"{a}.{b}": f"{c}.{d}" for a, b, c, d in rows}, RENAMED)

    def test_entries_get_their_present_names(self):
        former = {
            "monolithic": {"newton_tolerance": 1e-5, "linear_solver": "direct"},
            "partitioned": {"direct_below": 7},
        }
        present = {
            "monolithic": {"linear_solver": "direct"},
            "newton": {"tolerance": 1e-5},
            "linear": {"direct_below": 7},
        }
        self.assertEqual(with_present_names(former), present)
        self.assertEqual(with_present_names(present), present)
        self.assertEqual(former["monolithic"]["newton_tolerance"], 1e-5)  # the given one stays as it is
        for broken in ({"monolithic": 3}, {"monolithic": {"mode": "full"}, "newton": 3}):
            self.assertEqual(with_present_names(broken), broken)  # the driver says what is wrong

    def test_verify_reads_either(self):
        case = self.base / "case.toml"
        case.write_text("[time]\nstep = 0.5\nend = 1\n[monolithic]\nnewton_tolerance = 1e-5\n")
        self.assertEqual(governing("fsi-monolithic", read_case(case).entries), {"newton.tolerance": 1e-5})

    def test_labels_say_whose_tolerance_it_is(self):
        self.assertEqual(short_name("newton.tolerance"), "newton_tolerance")
        self.assertEqual(short_name("partitioned.tolerance"), "tolerance")
        self.assertEqual(short_name("title"), "title")


class Paying(unittest.TestCase):
    """Three meshes, each adapted from the one before: what the last has changed against what the one before has."""

    NAMES = ("trunk: mean pressure", "trunk: area", "outlet: flow")
    FACTS = types.SimpleNamespace(asked=lambda times: Asked())

    def found(self, *factors, names=()):
        """`factors`: those of a sine by curve, on each of the meshes."""
        meshes = [
            {name: curve(lambda t, f=f: f * math.sin(t), name=name) for name, f in zip(self.NAMES, of)}
            for of in zip(*factors)
        ]
        return unpaid(meshes, self.FACTS, names)

    def test_kinds_are_judged_apart(self):
        """A pressure that moves by 5 and then by 9 %, beside an area and a flow that gain."""
        found = self.found((1.0, 1.05, 1.14), (1.0, 1.04, 1.05), (1.0, 0.9, 0.88))
        (one,) = found
        self.assertEqual(one.kind, "pressure")
        self.assertAlmostEqual(one.before, 0.05 / 1.05, places=9)
        self.assertAlmostEqual(one.now, 0.09 / 1.14, places=9)

    def test_what_is_not_asked_for_does_not_count(self):
        factors = ((1.0, 1.05, 1.14), (1.0, 1.04, 1.05), (1.0, 0.9, 0.88))
        self.assertEqual(self.found(*factors, names=("area", "flow")), [])
        self.assertEqual([one.kind for one in self.found(*factors, names=("trunk",))], ["pressure"])

    def test_less_than_a_thousandth_is_converged(self):
        self.assertEqual(self.found((1.0, 1.0001, 1.0005), (1.0, 1.0, 1.0), (1.0, 1.0, 1.0)), [])
        kinds = [one.kind for one in self.found((1.0, 1.0, 1.0), (1.0, 1.01, 1.03), (1.0, 0.99, 0.96))]
        self.assertEqual(kinds, ["velocity", "displacement"])

    def test_what_curves_are_of(self):
        for name, kind in (
            ("tip: displacement x", "displacement"),
            ("plane: area", "displacement"),
            ("inlet: flow", "velocity"),
            ("tip: velocity z", "velocity"),
            ("inlet: mean pressure", "pressure"),
            ("body: force x", "pressure"),
        ):
            self.assertEqual(kind_of(curve(math.sin, name=name)), kind)


class MeshWords(unittest.TestCase):
    def test_waves_of_a_recommended_mesh_follow_from_the_steps(self):
        """As the drivers take them (test_unit_warnings.cpp)."""

        def waves(mesh=None, **time):
            return waves_of({"mesh": {"error": "10%", **(mesh or {})}, "time": time})

        for short in ({"step": 0.03125}, {"step": 0.1}, {"step": "adaptive"}, {"step": 0.05, "scheme": "bdf2"}):
            self.assertEqual(waves(**short), "resolved", short)
        for other in ({"step": 0.125}, {"step": 0.03125, "scheme": "euler"}, {"step": "adaptive", "scheme": "euler"}):
            self.assertEqual(waves(**other), "damped", other)
        self.assertEqual(waves({"waves": "damped"}, step=0.03125), "damped")
        self.assertEqual(waves_of({"mesh": {"error": "3%"}, "static": {}}), "damped")
        source = (SOURCES / "common/case/case_reader.cpp").read_text()
        self.assertEqual(float(re.search(r"double short_step = ([\d.]+)", source)[1]), SHORT_STEP)

    def test_says_where_the_error_of_a_recommended_mesh_does_not_hold(self):
        def said(mesh, **time):
            facts = types.SimpleNamespace(entries={"mesh": mesh, "time": {"step": 0.03125, **time}})
            notes = []
            tell_damped(types.SimpleNamespace(requests=types.SimpleNamespace(facts=facts), note=notes.append))
            return notes

        damped = {"error": "10%", "waves": "damped"}
        self.assertIn("mesh.error = 10% is for damped waves", said(damped)[0])
        for quiet in (
            said({"error": "10%", "waves": "resolved"}),
            said({"error": "10%"}),
            said(damped, scheme="euler"),
            said(damped, step=0.125),
            said({"file": "a.msh"}),
        ):
            self.assertEqual(quiet, [])

    def test_sizes_of_levels_are_those_of_fsi_mesh(self):
        source = (SOURCES / "common/mesher/artery/options.cpp").read_text()
        table = re.search(r"constexpr Level levels\[\] = \{(.*)\};", source)[1]
        found = re.findall(r'\{"(\w+)", ([\d.]+), ([\d.]+)\}', table)
        self.assertEqual({name: (float(size), float(along)) for name, size, along in found}, LEVELS)

    def test_artery_by_numbers_sizes_and_level(self):
        words = artery_words(("--lumen-cells", "4", "--axial-cells=24", "--order", "2"), 1.5)
        self.assertEqual(words, ["--order", "2", "--lumen-cells", "6", "--axial-cells", "36"])
        self.assertEqual(artery_words(("--size", "0.5"), 2.0), ["--size", "0.25"])
        self.assertEqual(artery_words(("--level", "coarse"), 2.0), ["--size", "0.375", "--axial-size", "0.39"])

    def test_numbers_of_a_recommended_mesh(self):
        said = "p2p1: cells through lumen 4 (graded 2 to the wall), media 1, adventitia 1, along the axis 24 (graded 8 to the inlet)"
        self.assertEqual(RECOMMENDED.search(said).groups(), ("4", "2", "1", "1", None, "24", "8"))

    def test_ratio_leaves_numbers_whole(self):
        self.assertEqual(ratio_for([16, 4], [1, -1]), 2.0)
        self.assertEqual(ratio_for([6, 12], [1, -1]), 1.5)
        self.assertEqual(ratio_for([], [1, -1]), 1.5)


def run(nodes, seconds, memory=100.0, done=True):
    summary = {"mesh": {"nodes": nodes, "triangles": 2 * nodes}, "peak_memory_MiB": memory}
    return types.SimpleNamespace(done=done, seconds=seconds, summary=summary)


def judged(a, b, scale=1.0, name="tip: displacement x, largest"):
    family = ((2, 1), (1, 1), (0.5, 1), (1, 2), (1, 0.5))
    data = tuple(Value(h, s, 1 + a * h**2 + b * s**2) for h, s in family)
    quantity = types.SimpleNamespace(name=name, curve="tip: displacement x", scale=scale)
    return Judged("monolithic", quantity, bar_of(data, scale, 2, 2), data)


class Demands(unittest.TestCase):
    COSTS = Costs(10.0, 3.0, 100.0, 2.0, 1.0)

    def test_costs_follow_the_members(self):
        runs = {Member(1.0, 1.0): run(1000, 10.0), Member(2.0, 1.0): run(250, 1.25), Member(1.0, 0.5): run(1000, 20.0)}
        costs = learn(runs, 2)
        self.assertAlmostEqual(costs.power, 3)
        self.assertAlmostEqual(costs.seconds(0.5, 0.5), 160, delta=1)
        self.assertIsNone(learn({Member(1.0, 1.0): run(1, 1.0, done=False)}, 2))

    def test_refines_what_dominates(self):
        of_mesh = cheapest([judged(0.1, 0.001)], self.COSTS, 0.05, 2.0, False, True)
        self.assertLess(of_mesh.mesh, 1)
        self.assertGreaterEqual(of_mesh.step, 1)
        of_step = cheapest([judged(0.001, 0.1)], self.COSTS, 0.05, 2.0, False, True)
        self.assertLess(of_step.step, 1)
        self.assertGreaterEqual(of_step.mesh, 1)

    def test_coarser_where_the_case_is_better_than_asked(self):
        found = cheapest([judged(0.001, 0.001)], self.COSTS, 0.1, 2.0, False, True)
        self.assertTrue(found.mesh > 1 and found.step > 1)
        self.assertEqual(cheapest([judged(0.001, 0.001)], self.COSTS, 0.1, 2.0, False, False).mesh, 1)

    def test_refines_only_for_what_gets_a_bar_by_it(self):
        one = judged(0.1, 0.02)
        for advice, moves in (("shorten the step", 1), ("refine the mesh", 1), ("the line is another one", 0)):
            without = replace(one, bar=replace(one.bar, verdict=NOT_IN_RANGE, advice=advice))
            self.assertEqual(len(refinable([one, without])), moves)

    def test_bar_of_another_run_counts_its_distance(self):
        one = judged(0.1, 0.02)
        one = replace(one, quantity=types.SimpleNamespace(**{**vars(one.quantity), "of": lambda v: v, "whole": None}))
        self.assertAlmostEqual(shown_by(one, one.bar.value + 0.3).bar.total, one.bar.total + 0.3)

    def test_solver_gets_a_tenth(self):
        loose = bar_of([*judged(0.1, 0.0).values, Value(1, 1, 1.1 + 0.03, True)], 1.0, 2, 2)
        one = Judged("monolithic", judged(0.1, 0.0).quantity, loose, ())
        self.assertAlmostEqual(tolerance_factor([one], 0.02) * loose.solver, 0.1 * 0.02)
        self.assertEqual(tolerance_factor([judged(0.1, 0.0)], 0.02), 10.0)

    def test_family_about_another_member(self):
        family = types.SimpleNamespace(driver="monolithic", runs={Member(0.5, 0.25): 1, Member(1.0, 0.25, True): 2})
        self.assertEqual(set(about(family, Member(0.5, 0.25)).runs), {Member(1.0, 1.0), Member(2.0, 1.0, True)})


class CaseFiles(FolderCase):
    TEXT = """\
title = "A \\"tube\\""
[mesh]
file = "tube.msh"
[structure.layers.media]
c10 = 3.0
[[opening]]
surface = "inlet"
flow_rate = { file = "beat.csv" }
[[opening]]
surface = "outlet"
pressure = [[0.0, 0.0], [1.0, 2.0]]
[time]
step = 0.5
end = 2
[output.points]
tip = [0, 1, 2]
"""

    def test_comes_back_as_it_went_with_full_names(self):
        entries = tomllib.loads(self.TEXT)
        write_case(self.base / "found.toml", with_settings(entries, {"time.step": 0.25}), self.base, ["note"])
        found = tomllib.loads((self.base / "found.toml").read_text())
        entries["time"]["step"] = 0.25
        entries["mesh"]["file"] = str((self.base / "tube.msh").resolve())
        entries["opening"][0]["flow_rate"]["file"] = str((self.base / "beat.csv").resolve())
        self.assertEqual(found, entries)

    def test_facts_of_a_case(self):
        path = self.base / "case.toml"
        path.write_text(self.TEXT.replace("step = 0.5", 'step = "adaptive"\nscheme = "euler"\ntolerance = 0.02'))
        facts = read_case(path)
        self.assertTrue(facts.adaptive)
        self.assertEqual((facts.step, facts.time_order, facts.space_order(True)), (0.02, 1.0, 2.0))
        self.assertEqual(read_case(path, {"time.scheme": "bdf2"}).time_order, 2.0)
        self.assertIsNone(facts.flow_interval)  # beat.csv is not there: the driver says so
        (self.base / "beat.csv").write_text("time_ms,flow_mm3_per_ms\n0,1\n2.5,3\n5,1\n")
        self.assertEqual(read_case(path).flow_interval, 2.5)
        given = {"opening": [{"surface": "inlet", "flow_rate": [[0, 0], [4, 1.5], [10, 1.5]]}]}
        self.assertEqual(read_case(path, given).flow_interval, 5)
        source = {"name": "pump", "kind": "flow", "between": ["ground", "inlet"], "flow_rate": [[0, 0], [1, 2], [2, 0]]}
        self.assertEqual(read_case(path, {**given, "network": {"element": [source]}}).flow_interval, 1)

    def test_tables_of_flows_are_read_as_the_drivers_read_them(self):
        path, table = self.base / "case.toml", self.base / "beat.csv"
        rows = "0,1\n\n0.25,3\r\n0.5,1\n"

        def interval(text, flow='{ file = "beat.csv" }'):
            table.write_bytes(text.encode())
            path.write_text(self.TEXT.replace('{ file = "beat.csv" }', flow))
            return read_case(path).flow_interval

        for header, expected in (
            ("time_ms,flow_ml_per_s", 0.25),
            ("time_s,flow_ml_per_s", 250),
            ("s;ml/s", 250),
            ('"Time [s]",flow', 250),
            ("t (min),flow", 15000),
            ("time µs,flow", 2.5e-4),
            ("TIME_SEC,flow", 250),
            ("seconds,flow", 250),
            ("\ufeffs,flow", 250),
            ("hours,flow", 0.25),
        ):
            with self.subTest(header):
                self.assertEqual(interval(f"{header}\n{rows}"), expected)
        self.assertEqual(interval("a;b\n" + rows.replace(",", ";")), 0.25)
        self.assertEqual(interval("time,flow\n" + rows, '{ file = "beat.csv", time_unit = "s" }'), 250)
        in_rows = "rows = [[0, 1], [0.25, 3], [0.5, 1]]"
        self.assertEqual(interval("", "{ " + in_rows + ' , time_unit = "s" }'), 250)
        self.assertEqual(interval("", "{ " + in_rows + " }"), 0.25)
        for wrong in ("0 1\n0.25 3\n0.5 1\n", "0,1\nnan,3\n0.5,1\n", "0,1\n0,2\n0,3\n", "0,1\n-inf,3\ninf,1\n", ""):
            self.assertIsNone(interval("time_s,flow\n" + wrong), wrong)
        for wrong in (
            "3.0",
            '"a"',
            "[]",
            "{ file = 3 }",
            "{ rows = 3 }",
            "[[0, 1], [], [2, 3]]",
            f"[[1{400 * '0'}, 1]]",
        ):
            self.assertIsNone(interval("time_s,flow\n" + rows, wrong), wrong)

    def test_units_of_time_are_those_of_the_drivers(self):
        text = (SOURCES / "common" / "case" / "table_units.cpp").read_text()
        found = re.findall(r'Unit\{ColumnKind::time, "(\w+)", ([\d.e-]+)\}', text)
        self.assertEqual(TIMES, {name: float(factor) for name, factor in found})


class StandardPoints(unittest.TestCase):
    def test_lies_where_most_happens(self):
        wall = types.SimpleNamespace(
            names=["displacement"],
            cells=np.array([[0, 1, 2], [1, 2, 3]]),
            points=np.array([[0.0, 0, 0], [3, 0, 0], [0, 3, 0], [3, 3, 0]]),
            times_of=lambda field: np.array([1.0]),
            at=lambda time, field: np.array([[0.0, 0, 0], [0, 0, 1], [0, 0, 1], [0, 0, 5]]),
        )
        with unittest.mock.patch.object(preparing, "read_fields", lambda folder: {"wall": wall}):
            self.assertEqual(preparing.standard_points(Path(".")), {"output.points.wall_most": [2.0, 2.0, 0.0]})


if __name__ == "__main__":
    unittest.main()
