"""The check of what pages quote from kept tables must be able to fail: each mistake that it is there for, planted in a small
tree. And the answer page says what its table says."""

import sys
import tempfile
import unittest
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TOP / "scripts/evidence"))

import coupling_kinds  # noqa: E402
from kept_blocks import (  # noqa: E402
    BlockError,
    kinds,
    kinds_answer,
    kinds_by_rung,
    kinds_verdict,
    peers_table,
    references_table,
    references_verdict,
)
from kept_pages import PageError, like, loose_numbers, renewed, stale  # noqa: E402
from kept_tables import read_table  # noqa: E402

TABLE = "# made by a command\nmesh,nodes,error [%]\ncoarse,1032,8.25\nfine,54540,0.104\n"
PAGE = """<!-- numbers: kept -->
# Page of p2p1
Coarse leaves 8.2<!-- errors: mesh=coarse; error [%] --> %, on 54,540<!-- errors: nodes=54540; nodes --> nodes
0.10<!-- errors: mesh=fine, nodes=54540; error [%] --> %, see `--set 1e-3`, [there](theory.md#section-1).

<!-- from: data/errors.csv -->

| mesh | nodes | error [%] |
| --- | --- | --- |
| coarse | 1,032 | 8.25 |
| fine | 54,540 | 0.104 |

<!-- end -->
"""
KINDS = [
    {
        "scene": scene,
        "kind": kind,
        "method": method,
        "seconds at equal error": seconds,
        "MiB": memory,
        "equal error": equal,
    }
    | {"passes a step": passes, "newton iterations a step": newton, "work units a step": work}
    for scene, kind, method, seconds, memory, passes, newton, work, equal in (
        ("Tube", "monolithic", "monolithic", "2.0", "100", "", "3.0", "10", "yes"),
        ("Tube", "block", "block-newton", "3.0", "110", "20.0", "3.0", "20", "yes"),
        ("Tube", "interface", "robin-neumann-inexact", "9.0", "50", "8.0", "20.0", "40", "yes"),
        ("Tube", "interface", "iqn-imvj", "90.0", "900", "9.0", "80.0", "90", "no, 3 times the error"),
        ("Flag", "monolithic", "monolithic", "4.0", "200", "", "5.0", "10", "yes"),
        ("Flag", "block", "block-newton", "4.0", "200", "30.0", "3.0", "20", "yes"),
        ("Flag", "interface", "iqn-ils", "3.0", "200", "4.0", "20.0", "20", "yes"),
        ("Pipe", "monolithic", "monolithic", "1.0", "70", "", "1.0", "5", "yes"),
        ("Pipe", "block", "block-newton", "9.0", "70", "9.0", "1.0", "5", "yes"),
        ("Pipe", "interface", "iqn-ils", "99.0", "70", "2.0", "2.0", "5", "no, 3 times the error"),
    )
]


class Tree(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.top = Path(temporary.name)
        (self.top / "docs" / "data").mkdir(parents=True)
        (self.top / "README.md").write_text("# Start\n")
        self.write(TABLE, PAGE)

    def write(self, table, page):
        (self.top / "docs" / "data" / "errors.csv").write_text(table)
        (self.top / "docs" / "page.md").write_text(page)

    def test_clean(self):
        self.assertEqual(stale(self.top, write=False), [])

    def test_mistakes(self):
        for table, page, said in (
            (TABLE.replace("8.25", "9.25"), PAGE, "'Coarse leaves 8.2"),
            (TABLE.replace("0.104", "0.114"), PAGE, "0.10"),
            (TABLE, PAGE.replace("leaves 8.2<", "leaves 8.3<"), "'Coarse leaves 8.3"),
            (TABLE, PAGE.replace("| 8.25 |", "| 8.35 |"), "should be '| coarse | 1,032 | 8.25 |'"),
            (
                TABLE,
                PAGE.replace("Page of p2p1", "Page of 7 scenes"),
                "'7' in '# Page of 7 scenes' is from no kept table",
            ),
            (TABLE, PAGE.replace("errors: mesh=coarse", "others: mesh=coarse"), "others.csv"),
            (TABLE, PAGE.replace("mesh=coarse", "grid=coarse"), "no column 'grid'"),
            (TABLE, PAGE.replace("mesh=coarse", "mesh=medium"), "0 rows with mesh=medium"),
            (TABLE, PAGE.replace("8.2<!-- errors: mesh", "8.2 <!-- errors: mesh"), "a mark is not complete"),
            (TABLE, PAGE.replace("<!-- end -->", ""), "a mark is not complete"),
            (TABLE, PAGE.replace("errors.csv -->", "errors.csv, nothing -->"), "'nothing' is no function"),
            (TABLE, PAGE.replace("errors.csv -->", "errors.csv, kinds_answer -->"), "kinds_answer does not understand"),
            (TABLE.replace("# made by a command\n", ""), PAGE, "does not say how it was made"),
            (TABLE.replace("fine,54540", "fine"), PAGE, "row 2 has not as many cells"),
        ):
            with self.subTest(said=said):
                self.write(table, page)
                problems = stale(self.top, write=False)
                self.assertEqual(len(problems), 1, problems)
                self.assertIn(said, problems[0])
                self.assertEqual((self.top / "docs" / "page.md").read_text(), page)

    def test_what_is_stale_is_written_anew(self):
        self.write(TABLE.replace("8.25", "9.36"), PAGE)
        self.assertEqual(stale(self.top, write=True), [])
        page = (self.top / "docs" / "page.md").read_text()
        self.assertIn("Coarse leaves 9.4<!--", page)
        self.assertIn("| coarse | 1,032 | 9.36 |", page)
        self.assertEqual(stale(self.top, write=False), [])


class Numbers(unittest.TestCase):
    def test_digits_as_they_stand_there(self):
        for shown, value, expected in (
            ("8.2", "8.25", "8.2"),
            ("8.2", "9.36", "9.4"),
            ("18", "17.6", "18"),
            ("18", "22.4", "22"),
            ("0.10", "0.1044", "0.10"),
            ("54,540", "54541", "54,541"),
            ("1.0", "0.0441", "0.044"),
            ("64", "114", "114"),
            ("1.72", "1234.6", "1,235"),
            ("18", "0.404", "0.40"),
        ):
            self.assertEqual(like(shown, value), expected)
            self.assertEqual(like(expected, value), expected)  # written anew it stays
        with self.assertRaises(PageError):
            like("1", "yes")

    def test_names_are_no_numbers(self):
        page = "FSI3 and `1e-3` with p2p1, tr-bdf2, [x](y.md#section-9-3)\n"
        self.assertEqual(list(loose_numbers(page)), [])
        self.assertEqual(len(list(loose_numbers(page + "takes 1/8 ms\n"))), 1)

    def test_every_kept_table_says_how_it_was_made(self):
        tables = sorted((TOP / "docs" / "data").glob("*.csv"))
        self.assertGreater(len(tables), 5)
        for path in tables:
            self.assertGreater(len(read_table(path)), 0)

    def test_every_scene_with_both_media_is_measured(self):
        scenes = {path.parent.name: path.read_text(encoding="utf-8") for path in TOP.glob("gallery/*/scene.py")}
        unmeasured = {"flap-in-merging-jets"}  # takes many minutes by each driver
        both = {name for name, text in scenes.items() if "DRIVERS = " not in text and self.has_both(name)} - unmeasured
        self.assertGreater(len(both), 15)
        self.assertLessEqual(both, {scene.case.stem for scene in coupling_kinds.SCENES})
        measured = [scene.title for scene in kinds(read_table(TOP / "docs" / "data" / "coupling-kinds.csv"))]
        self.assertEqual(measured, [scene.title for scene in coupling_kinds.SCENES])

    def has_both(self, name):
        case = (TOP / "gallery" / name / f"{name}.toml").read_text(encoding="utf-8")
        return "\n[fluid]" in case and "\n[structure" in case

    def test_the_answer_page_quotes_what_was_measured(self):
        page = (TOP / "docs" / "guide" / "coupling.md").read_text(encoding="utf-8")
        for block in ("kinds_answer", "kinds_verdict"):
            self.assertIn(f"<!-- from: data/coupling-kinds.csv, {block} -->", page)
        self.assertEqual(renewed(page, TOP / "docs" / "data"), page)


class KindsOfCoupling(unittest.TestCase):
    def test_the_default_stands_for_the_interface_kind(self):
        found = kinds(KINDS)
        self.assertEqual([scene.title for scene in found], ["Tube", "Flag", "Pipe"])
        self.assertEqual(
            [scene.interface["method"] for scene in found], ["robin-neumann-inexact", "iqn-ils", "iqn-ils"]
        )
        self.assertEqual([scene.at_equal_error("interface") for scene in found], [True, True, False])

    def test_verdict(self):
        text = kinds_verdict(KINDS)
        self.assertIn("In 1 of 2 scenes", text)
        self.assertIn('2.6 times as many in the median, 4.5 times at most, in "Tube".', text)
        self.assertIn('It takes fewer in "Flag".', text)
        self.assertIn('Left out, since no tolerance led to the same error: "Pipe".', text)

    def test_answer(self):
        lines = kinds_answer(KINDS).splitlines()
        self.assertEqual(lines[0], "|  | `interface` | `block` | `monolithic` |")
        self.assertIn("| 2 | 3 | 3 |", lines[2])
        self.assertIn("median (least to most) | 2.6 (0.75 to 4.5) | 1.5 (1 to 9) | 1 |", lines[3])
        self.assertIn("| 3 (2 to 4) | 2 (1 to 2) | 1 |", lines[4])
        self.assertIn("| 0.75 (0.5 to 1) | 1 (1 to 1.1) | 1 |", lines[5])
        self.assertIn("6.0 passes", lines[6])
        self.assertIn("20.0 cycles", lines[6])
        self.assertIn("3.0 Newton iterations", lines[6])

    def test_a_kind_that_is_missing(self):
        with self.assertRaises(BlockError):
            kinds_answer(KINDS[:1])

    def test_rungs(self):
        rows = [
            {"element": "p1", "cells": "6-2", "nodes": "1032", "step_ms": "0.0625", "kind": kind}
            | {"error_percent": error, "processor_s": seconds}
            for kind, error, seconds in (
                ("monolithic", "2.5", "1.04"),
                ("interface", "2.5", "2.5"),
                ("block", "2.6", "17"),
            )
        ]
        self.assertEqual(
            kinds_by_rung(rows).splitlines()[2:], ["| p1 | 6-2 | 1,032 | 1/16 | 2.5 %, 2.6 % | 1 | 17 | 2.5 |"]
        )
        with self.assertRaises(BlockError):
            kinds_by_rung(rows[:2])


class ReferencesPage(unittest.TestCase):
    """Known numbers and how far both drivers are from them."""

    def rows(self, **changed):
        rows = []
        for driver, value in (("monolithic", 1.001), ("partitioned", 1.004)):
            row = {
                "scene": "tube",
                "number": "radius",
                "unit": "mm",
                "driver": driver,
                "value": str(value),
                "bar": "0.002",
                "order_mesh": "2.97",
                "order_step": "",
                "known": "1.0",
                "off": str(round(value - 1, 6)),
                "in_bars": str((value - 1) / 0.002),
                "spread": "",
                "model": "",
                "source": "formula",
                "seconds": "3.14",
            }
            rows.append({**row, **changed})
        return rows

    def test_a_value_beyond_its_bar_is_named(self):
        text = references_verdict(self.rows())
        self.assertIn("Of 2 values, each number by each driver, 2 have an error bar.", text)
        self.assertIn("1 of these differ", text)
        self.assertIn("Furthest off is radius of `tube` (partitioned): 0.004 mm, 2 bars", text)

    def test_what_published_values_differ_by_is_allowed(self):
        text = references_verdict(self.rows(spread="0.5"))
        self.assertIn("2 of these differ", text)
        self.assertNotIn("Furthest", text)

    def test_what_another_model_is_worth_is_allowed(self):
        self.assertNotIn("Furthest", references_verdict(self.rows(model="0.5")))
        self.assertIn("Furthest", references_verdict(self.rows(model="0.1")))
        self.assertIn("| formula; another model, worth 0.5 % |", references_table(self.rows(model="0.5")))

    def test_both_drivers_stand_in_one_line(self):
        lines = references_table(self.rows()).splitlines()
        self.assertEqual(len(lines), 3)
        self.assertIn("| 1 | formula | 3, - | 1.001 | 0.002 | 0.5 | 3.1 | 1.004 | 0.002 | 2 | 3.1 |", lines[2])

    def test_a_number_without_a_bar_says_so(self):
        self.assertIn("| none |", references_table(self.rows(bar="")))

    def test_peers_stand_beside_both_drivers_with_bars_and_the_reason(self):
        rows = self.rows(reason="locking")
        line = peers_table(rows).splitlines()[2]
        self.assertEqual(
            line, "| `tube` | formula | radius | mm | 1 | 1.001 +- 0.002 | 1.004 +- 0.002 | +0.4 % | locking |"
        )
        self.assertIn("1.001 (no bar)", peers_table(self.rows(reason="", bar="")))
        with self.assertRaisesRegex(BlockError, "partitioned"):
            peers_table(rows[:1])

    def test_seconds_that_were_not_measured_are_a_dash(self):
        self.assertIn("| 0.5 | - |", references_table(self.rows(seconds="")))


if __name__ == "__main__":
    unittest.main()
