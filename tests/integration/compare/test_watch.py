"""`fsi-compare watch`: what it shows of a run that goes on, and of one that has ended."""

import fcntl
import json
import socket
import threading
import time
import unittest

import numpy as np
from folder_case import FolderCase
from synthetic import write_run

from fsi_compare.reporting.watched import BLOCKS, lines_of, sparkline, state_of, thinned_to

HEADER = "step,time_ms,outer_iterations,newton_iterations,linear_iterations,wall_s,solver_error\n"


class Sparklines(unittest.TestCase):
    def test_marks(self):
        self.assertEqual(sparkline(np.arange(8.0), 20), BLOCKS)
        self.assertEqual(sparkline(np.array([2.0, np.nan, 2.0]), 20), BLOCKS[0] * 2)
        self.assertEqual(sparkline(np.array([]), 20), "")
        self.assertEqual(thinned_to(np.arange(100.0), 10).tolist(), [10 * i + 4.5 for i in range(10)])


class Watching(FolderCase):
    def setUp(self):
        super().setUp()
        self.folder = write_run(self.base / "run", lambda t, z: z + t, title="A <b>run</b>")
        (self.folder / "run.log").write_text("a title | 10 nodes, 1 threads, 8 steps\nmore\n")

    def rows(self, count, status):
        lines = [f"{i},{0.5 * i},1,{3 + i},9,0.25,0\n" for i in range(1, count + 1)]
        cut = f"{count + 1},{0.5 * (count + 1)},1" if status == "running" else ""  # a row that is being written
        (self.folder / "iterations.csv").write_text(HEADER + "".join(lines) + cut)
        lines = [f"{0.5 * i},in,{-i},{1000 * i},0\n" for i in range(1, count + 1)]
        head = "time_ms,opening,flow_mm3_per_ms,mean_pressure_Pa,windkessel_pressure_Pa\n"
        (self.folder / "openings.csv").write_text(head + "".join(lines))
        summary = json.loads((self.folder / "summary.json").read_text())
        new = self.folder / "summary.new"
        new.write_text(json.dumps({**summary, "status": status}))
        new.replace(self.folder / "summary.json")

    def test_where_a_run_stands(self):
        self.rows(3, "running")
        state = state_of(self.folder)
        self.assertEqual((state.steps, state.planned, state.time, state.over), (3, 8, 1.5, False))
        self.assertEqual((state.step_seconds, state.seconds_left), (0.25, 1.25))
        lines = lines_of(state, "", 80)
        self.assertEqual(lines[0], "fsi-monolithic, running: step 3 of 8, t = 1.5 ms, 0.25 s a step")
        self.assertRegex(lines[1], r"Newton iterations +▁▅█  6 \(4 to 6\)")
        self.assertRegex(lines[2], r"pressure, in +▁▅█  3 \(1 to 3 kPa\)")
        self.assertTrue(all(len(line) <= 80 for line in lines))

    def test_static_run_and_numbered_opening(self):
        self.rows(2, "running")
        (self.folder / "energy.csv").write_text("step,time_ms,wall_isochoric_energy_uJ\n1,0.5,2\n2,1,4\n")
        table = self.folder / "openings.csv"
        table.write_text(table.read_text().replace(",in,", ",1,"))
        lines = lines_of(state_of(self.folder), "", 80)
        self.assertEqual(lines[0], "fsi-monolithic, running: step 2 of 8, 1 of the load, 0.25 s a step")
        self.assertIn("pressure, 1 ", lines[2])
        self.rows(8, "done")
        page = self.base / "watch.html"
        self.assertEqual(self.call("watch", self.folder, "--page", page)[0], 0)
        self.assertIn("step 8 of 8, 4 of the load", page.read_text())

    def test_before_the_first_step(self):
        self.rows(0, "running")
        self.assertEqual(state_of(self.folder).steps, 0)
        (self.folder / "iterations.csv").unlink()
        self.assertEqual(state_of(self.folder).curves, [])

    def test_follows_until_the_end(self):
        self.rows(2, "running")
        page, seen = self.base / "pages" / "watch.html", []

        def go_on():
            while not page.exists():
                time.sleep(0.01)
            seen.append(page.read_text())
            self.rows(5, "running")
            while "step 5" not in page.read_text():
                time.sleep(0.01)
            self.rows(8, "done")

        run = threading.Thread(target=go_on)
        run.start()
        code, out, err = self.call("watch", self.folder, "--every", "0.02", "--page", page)
        run.join()
        self.assertEqual((code, err), (0, ""))
        self.assertEqual(
            [line.split(": ")[1].split(",")[0] for line in out.splitlines()], [f"step {n} of 8" for n in (2, 5, 8)]
        )
        self.assertIn('http-equiv="refresh"', seen[0])
        self.assertIn("<h1>A &lt;b&gt;run&lt;/b&gt;</h1>", seen[0])
        self.assertEqual(seen[0].count("<polyline"), 3)
        self.assertNotIn("refresh", page.read_text())
        self.assertIn("The run has ended.", page.read_text())
        self.assertEqual(sorted(p.name for p in page.parent.iterdir()), ["watch.html"])

    def test_run_that_was_killed_is_over(self):
        self.rows(3, "running")
        lock = self.folder / "run.lock"
        lock.write_text(f"fsi-monolithic, process 1 on host {socket.gethostname()}\n")
        with open(lock) as held:
            fcntl.flock(held, fcntl.LOCK_EX)
            self.assertFalse(state_of(self.folder).over)
        self.assertEqual((state_of(self.folder).status, state_of(self.folder).over), ("killed", True))
        code, out, err = self.call("watch", self.folder)
        self.assertEqual((code, err), (0, ""))
        self.assertIn("fsi-monolithic, killed: step 3 of 8", out)
        lock.write_text("fsi-monolithic, process 1 on host elsewhere\n")  # from here it cannot be seen
        self.assertFalse(state_of(self.folder).over)

    def test_wrong_use(self):
        for arguments, problem in (
            ([self.base / "none"], "no such folder"),
            ([self.folder, "--every", "0"], "--every: 0.0 is not positive"),
            ([self.folder, "--page", "a.txt"], "--page: is no page's name"),
        ):
            code, out, err = self.call("watch", *arguments)
            self.assertEqual((code, out), (1, ""))
            self.assertIn(problem, err)


if __name__ == "__main__":
    unittest.main()
