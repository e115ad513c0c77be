"""The last level of a run has the numbers that it has in a longer run, in all tables and fields, and is written anew by a
restart. With `midpoint` and `generalised-alpha` its pressures are interpolated up to a step behind the end."""

import re
import shutil
import unittest
from pathlib import Path

from programs import (
    ARTERY,
    MONOLITHIC,
    PARTITIONED,
    FolderTest,
    arrays,
    attempt,
    differing_arrays,
    restart,
    run,
    summary,
    table,
    without_seconds,
)
from scenes import KINDS, forms, scene

LAGGING = ("midpoint", "generalised-alpha")
OTHERS = ("tr-bdf2", "bdf2", "euler")
END, LATER = 0.5, 0.75  # ms; steps are of 0.125 ms
OPENINGS = """
[[opening]]
surface = "inlet"
flow_rate = [[0, 0], [0.4, 0.5], [1, 0.2]]
[[opening]]
surface = "outlet"
windkessel = { proximal = 0.1, compliance = 0.5, distal = 1.0 }
"""
OF_STEPS = ("iterations.csv", "coupling.csv", "energy.csv")
EVERYTHING = (
    "output.points.lumen=[0.2, 0, 1.1]",
    "output.points.wall=[1.6, 0, 1.4]",
    "output.lines.across.from=[0.05, 0, 1.3]",
    "output.lines.across.to=[1.7, 0, 1.7]",
    "output.lines.across.points=5",
    "output.planes.middle.origin=[0, 0, 1.4]",
    "output.planes.middle.normal=[0, 0, 1]",
    "output.surfaces=['interface', 'inlet']",
    "output.fields=['displacement', 'velocity', 'pressure', 'wall_shear_stress', 'von_mises_stress']",
    "output.statistics=true",
    "output.period=0.25",
    "output.every=2",
)


def tables_of(folder):
    """Rows of all tables but those of the log, as text without seconds, by file."""
    return {file.name: without_seconds(file) for file in Path(folder).glob("*.csv")}


def times_of(folder, name):
    """The levels of a table."""
    return sorted({float(row[1 if name in OF_STEPS else 0]) for row in tables_of(folder)[name][1:]})


class LastLevel:
    """Of one driver, on half a section of a short artery."""

    settings = ()
    processes = None

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.settings = (*scene(cls.base, "p2p1", "axisymmetric"), *EVERYTHING, *cls.settings)

    def march(self, name, end, *settings, case=ARTERY):
        """A run to an end, in a folder of its own."""
        return run(self.program, case, self.base / name, *self.to(end, *settings), processes=self.processes)

    def to(self, end, *settings):
        return (*self.settings, f"time.end={end}", *settings)

    def go_on(self, folder, end, *settings, into=None, case=ARTERY):
        return restart(self.program, case, folder, *self.to(end, *settings), into=into, processes=self.processes)

    def assertBegins(self, folder, whole):
        """Every level of a run is in a longer one with the same bits: rows of all tables, entries of fields."""
        longer = tables_of(whole)
        for name, rows in tables_of(folder).items():
            self.assertEqual(rows, longer[name][: len(rows)], name)
        ours, theirs = (arrays(one / "fields.h5") for one in (folder, whole))
        for name, values in ours.items():
            if not name.startswith("steps/"):
                self.assertEqual(values.tobytes(), theirs[name].tobytes(), name)

    def assertSame(self, folder, whole):
        self.assertEqual(tables_of(folder), tables_of(whole))
        for name in ("fields.h5", "checkpoint.h5"):
            self.assertEqual(differing_arrays(folder / name, whole / name), [], name)

    def check(self, scheme, *settings, case=ARTERY):
        """Run to the end, and from there to a later one, against a run to the later one."""
        name = "-".join((scheme, case.stem, *(re.sub(r"\W", "", one) for one in settings)))
        settings = (f"time.scheme={scheme}", *settings)
        whole = self.march(f"{name}-whole", LATER, *settings, case=case)
        folder = self.march(f"{name}-part", END, *settings, case=case)
        for table_name in tables_of(folder):
            if table_name != "surfaces.csv":  # at the times of balances
                self.assertEqual(times_of(folder, table_name)[-1], END, table_name)
        self.assertIn(END, arrays(folder / "fields.h5")["steps/time"])
        self.assertBegins(folder, whole)
        elsewhere = self.base / f"{name}-elsewhere"
        self.assertSame(self.go_on(folder, LATER, *settings, into=elsewhere, case=case), whole)
        self.assertSame(self.go_on(folder, LATER, *settings, case=case), whole)
        return folder

    def test_pressures_that_lag(self):
        for scheme in LAGGING:
            with self.subTest(scheme=scheme):
                self.assertGreaterEqual(len(tables_of(self.check(scheme))), 9)

    def test_pressures_at_levels(self):
        for scheme in OTHERS:
            with self.subTest(scheme=scheme):
                folder = self.check(scheme)
                self.assertNotIn("step_behind_the_end", summary(folder))

    def test_adaptive_steps(self):
        """A run ends where a longer one has a step's end for its output. (In between, its steps lead elsewhere.)"""
        self.check("midpoint", "time.step=adaptive", "output.interval=0.25")

    def test_openings(self):
        """A given flow, and a Windkessel whose pressure is kept from level to level."""
        text = re.sub(r"\[inlet\]\n.*\n.*\n", "", ARTERY.read_text())
        case = self.base / "openings.toml"
        case.write_text(text + OPENINGS)
        self.assertIn("openings.csv", tables_of(self.check("midpoint", case=case)))

    def test_the_step_behind_the_end_counts_apart(self):
        folder = self.march("counted", END, "time.scheme=midpoint")
        found = summary(folder)
        rows = table(folder, "iterations.csv")
        self.assertEqual(found["totals"]["steps"], len(rows))
        self.assertEqual(found["totals"]["newton_iterations"], rows[:, 3].sum())
        self.assertEqual(found["totals"]["outer_iterations"], rows[:, 2].sum())
        self.assertGreater(found["step_behind_the_end"]["newton_iterations"], 0)

    def test_a_load_that_jumps_at_the_end_settles_the_pressures(self):
        """Nothing is interpolated across a jump, and no step is needed behind it."""
        settings = ("time.scheme=midpoint", f"inlet.until={END}")
        folder = self.march("jump", END, *settings)
        self.assertNotIn("step_behind_the_end", summary(folder))
        self.assertBegins(folder, self.march("jump-whole", LATER, *settings))

    def test_a_kill_before_the_step_behind_the_end(self):
        """All is saved by then but the rows of the last level, of which some may be there in part: a restart writes them."""
        for scheme in LAGGING:
            folder = self.march(f"killed-{scheme}", END, f"time.scheme={scheme}")
            whole = self.base / f"whole-{scheme}"
            shutil.copytree(folder, whole)
            for name in tables_of(folder):
                if name not in (*OF_STEPS, "surfaces.csv"):
                    lines = (folder / name).read_text().splitlines(keepends=True)
                    kept = [line for line in lines if not line.startswith(f"{END},")]
                    self.assertLess(len(kept), len(lines), name)
                    torn = lines[len(kept)][:-3] if name == "flow.csv" else ""
                    (folder / name).write_text("".join(kept) + torn)
            self.assertSame(self.go_on(folder, END, f"time.scheme={scheme}"), whole)

    def test_a_restart_with_another_step_leaves_the_rows_before(self):
        """The last level is then interpolated up to the first balance of the new steps."""
        folder = self.march("step", END, "time.scheme=midpoint")
        before = tables_of(folder)
        self.go_on(folder, LATER, "time.scheme=midpoint", "time.step=0.0625")
        for name, rows in tables_of(folder).items():
            keep = [row for row in before[name] if name in OF_STEPS or not row[0].startswith(str(END))]
            self.assertEqual(rows[: len(keep)], keep, name)
        whole = self.march("step-whole", LATER, "time.scheme=midpoint", "time.step=0.0625")
        self.assertEqual(times_of(folder, "flow.csv")[-4:], times_of(whole, "flow.csv")[-4:])

    def test_what_cannot_be_had_is_left_out(self):
        """The load rises behind the end as no step can follow: tables and fields end one level before, and say so."""
        settings = ("time.scheme=midpoint", "time.retries=0", "partitioned.max_iterations=12")
        table_of_load = f"pressure = [[0, 1.332], [{END}, 1.332], [0.626, 1e8]]"
        case = self.base / "rises.toml"
        text = ARTERY.read_text().replace("pressure = 1.332", table_of_load)
        case.write_text(re.sub(r"until = 0.125.*", "", text))
        folder = self.base / "left-out"
        ended = attempt(self.program, case, "-q", folder=folder, settings=self.to(END, *settings))
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn(f"lack the last level, t = {END:g} ms", ended.stderr)
        self.assertIn(f"lack the last level, t = {END:g} ms", (folder / "run.log").read_text())
        self.assertIn("failure", summary(folder)["step_behind_the_end"])
        self.assertEqual(summary(folder)["status"], "done")
        for name in ("centerline_pressure.csv", "wall_displacement.csv", "flow.csv", "points.csv", "lines.csv"):
            self.assertEqual(times_of(folder, name)[-1], END - 0.125, name)
        for name in ("iterations.csv", "energy.csv"):
            self.assertEqual(times_of(folder, name)[-1], END, name)
        written = arrays(folder / "fields.h5")
        self.assertEqual(written["steps/written/fluid.pressure"].tolist()[-1], 0)


class Monolithic(LastLevel, FolderTest):
    program = MONOLITHIC


class Partitioned(LastLevel, FolderTest):
    program = PARTITIONED


class Elements(FolderTest):
    """Every element and geometry, by the monolithic driver."""

    def test_last_rows(self):
        for element, geometry in KINDS:
            with self.subTest(element=element, geometry=geometry):
                settings = (
                    *scene(self.base, element, geometry),
                    *forms(ARTERY),
                    "time.scheme=midpoint",
                    "output.every=2",
                )
                part, whole = (
                    run(MONOLITHIC, ARTERY, self.base / f"{element}-{geometry}-{end}", *settings, f"time.end={end}")
                    for end in (END, LATER)
                )
                longer = tables_of(whole)
                for name, rows in tables_of(part).items():
                    self.assertEqual(rows, longer[name][: len(rows)], name)
                    self.assertEqual(times_of(part, name)[-1], END, name)
                ours, theirs = (arrays(folder / "fields.h5") for folder in (part, whole))
                for name, values in ours.items():
                    if not name.startswith("steps/"):
                        self.assertEqual(values.tobytes(), theirs[name].tobytes(), name)


class Shared(LastLevel, FolderTest):
    """On two processes."""

    program = MONOLITHIC
    processes = 2
    test_pressures_at_levels = test_adaptive_steps = test_what_cannot_be_had_is_left_out = None
    test_a_restart_with_another_step_leaves_the_rows_before = None
    test_a_load_that_jumps_at_the_end_settles_the_pressures = test_openings = None
    test_a_kill_before_the_step_behind_the_end = None


if __name__ == "__main__":
    unittest.main()
