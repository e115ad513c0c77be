"""scripts/evidence: the list of what is made, and what is called stale."""

import sys
import unittest
from pathlib import Path
from tempfile import TemporaryDirectory
from unittest import mock

TOP = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TOP / "scripts/evidence"))

import evidence
import random_scenes
import short_runs
from evidence import Age, Item
from short_runs import Value

NOW = Age("0.3.0", "abcdef12", "11111111", "a processor", "2026-01-02")


BY_HAND = {"docs/data/made-by.csv", "docs/data/report-pages.csv"} | {
    f"docs/evidence/{name}.md"  # what stands in them of kept tables kept_pages.py puts there
    for name in ("coupling-kinds", "evidence", "faults", "orders", "peers", "references")
}


class Items(unittest.TestCase):
    def test_each_makes_something_by_a_script_that_is_there(self):
        items = evidence.read_items()
        self.assertGreater(len(items), 10)
        self.assertEqual(len({item.name for item in items}), len(items))
        for item in items:
            self.assertTrue(item.files(), item.name)
            for command in item.commands:
                words = command.split()
                if words[0] == "python3":
                    self.assertTrue((TOP / words[1]).is_file(), command)
                elif words[1] == "study":
                    self.assertTrue((TOP / f"compare/research/studies/{words[2]}.toml").is_file(), command)

    def test_every_table_page_and_picture_is_made_by_one(self):
        made = [file for item in evidence.read_items() for file in item.files()]
        self.assertEqual(len(made), len(set(made)))
        kept = {str(path.relative_to(TOP)) for path in (TOP / "docs").glob("[dep]*/*.*")} - BY_HAND
        self.assertLessEqual(kept, set(made))
        self.assertLessEqual(set(made), kept)


class Stale(unittest.TestCase):
    def setUp(self):
        folder = TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        patch = mock.patch.object(evidence, "TOP", Path(folder.name))
        patch.start()
        self.addCleanup(patch.stop)
        (Path(folder.name) / "table.csv").write_text("# made by hand\n")
        self.item = Item("one", 1, (), ("table.csv",), False, False, (0,), False)

    def told(self, age, item=None):
        ages = {"table.csv": ("one", age)} if age else {}
        return evidence.stale([item or self.item], ages, NOW.version, NOW.results)

    def test_of_this_age(self):
        self.assertEqual(self.told(NOW), [])
        self.assertEqual(
            self.told(NOW._replace(version="0.3.7", commit="1234")), []
        )  # same results, same minor version

    def test_of_another_minor_version(self):
        self.assertRegex(self.told(NOW._replace(version="0.2.0"))[0], "table.csv: made by version 0.2.0")

    def test_of_other_results(self):
        self.assertRegex(self.told(NOW._replace(results="22222222"))[0], "abcdef12, whose results were others")

    def test_of_nobody_knows_which(self):
        self.assertRegex(self.told(None)[0], "made-by.csv does not say")
        self.assertEqual(self.told(None, self.item._replace(due=True)), [])

    def test_what_is_due_may_be_of_an_earlier_version_until_it_is_made(self):
        older = NOW._replace(version="0.2.9")
        self.assertEqual(self.told(older, self.item._replace(due=True)), [])
        text = (
            '[[item]]\nname = "a"\ndue = true\nminutes = 1\n\n[[item]]\nname = "ab"  # long\nminutes = 2\ndue = true\n'
        )
        left = evidence.without_due(text, "ab")
        self.assertEqual(left, text[: -len("due = true\n")])
        self.assertEqual(evidence.without_due(left, "a").count("due"), 0)

    def test_nothing_made(self):
        self.assertRegex(self.told(NOW, self.item._replace(makes=("gone.csv",)))[0], "nothing of gone.csv")

    def test_what_a_command_has_left_as_it_was(self):
        table = evidence.TOP / "table.csv"
        written = table.stat().st_mtime
        self.assertEqual(evidence.not_written(self.item, written - 1), [])
        self.assertEqual(evidence.not_written(self.item, written + 1), ["table.csv"])


class ShortRuns(unittest.TestCase):
    KEPT = [Value("a", "pressure_Pa", 50.0), Value("b", "pressure_Pa", 1.0)]

    def test_the_last_digits_may_differ(self):
        self.assertEqual(short_runs.other_results(self.KEPT, [Value("a", "pressure_Pa", 50.000001), self.KEPT[1]]), [])

    def test_others_may_not(self):
        for found in (50.0001, float("nan")):
            lines = short_runs.other_results(self.KEPT, [Value("a", "pressure_Pa", found), self.KEPT[1]])
            self.assertEqual(len(lines), 1)

    def test_gone_and_new(self):
        lines = short_runs.other_results(self.KEPT, [self.KEPT[0], Value("c", "radial_mm", 1.0)])
        self.assertEqual(lines, ["c: radial_mm is new", "b: there is no pressure_Pa any more"])


class RandomScenes(unittest.TestCase):
    TOLD = (
        "fsi-monolithic: 6 of 100 scenes unsolved\nfsi-partitioned: 7 of 100 scenes unsolved\n"
        "scenes: 101 runs: 90 right, 7 unsolved, 2 without solution, 1 ambiguous, 1 differs (WRONG), 1 too many unsolved (WRONG)\n"
    )

    def test_counts(self):
        self.assertEqual(random_scenes.solved_by(self.TOLD), {"fsi-monolithic": 92, "fsi-partitioned": 91})
        self.assertEqual(random_scenes.wrong_of(self.TOLD), 1)


if __name__ == "__main__":
    unittest.main()
