"""The kind `scenes` of fsi-compare study, and how the benchmark of Turek and Hron is read off a run."""

import contextlib
import io
import unittest
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
from folder_case import FolderCase
from synthetic import parabola, write_run

from fsi_compare.base.errors import InputError
from fsi_compare.gallery.scene import READY, SceneRun, SceneRuns
from known_solutions.turek_hron import Benchmark, Known
from fsi_compare.reporting.report import Report
from fsi_research.scenes import study as scenes
from fsi_compare.study.context import Context
from fsi_compare.study.study_file import read_study
from fsi_compare.study.study_run import DONE, NOT_CONVERGED, StudyRun

STUDY = """
title = "Scenes"
kind = "scenes"
[cases]
flag = { scene = "turek-hron-csm1" }
panel = { scene = "cooks-membrane" }
flutter = { scene = "turek-hron-fsi2" }
[methods.whole]
program = "fsi-monolithic"
[methods.parts]
program = "fsi-partitioned"
[runs.flag]
cases = ["flag"]
quick = true
[runs.others]
cases = ["panel", "flutter"]
quick = { cases = ["flutter"] }
"""


def write_points(folder, times, x, y):
    rows = [f"{t!r},tip,600,200,0,0,{a!r},{b!r}" for t, a, b in zip(*(map(float, c) for c in (times, x, y)))]
    head = "time_ms,point,x_mm,y_mm,z_mm,pressure_Pa,displacement_x_mm,displacement_y_mm"
    (folder / "points.csv").write_text("\n".join([head, *rows]) + "\n")


class Scenes(FolderCase):
    def study(self, text=STUDY, quick=False):
        file = self.base / "study.toml"
        file.write_text(text)
        study = read_study(file, ["scenes"], quick)
        scenes.check(study)
        return study

    def test_a_scene_brings_its_case_mesh_and_drivers(self):
        found = {(r.case, r.method.name): r for r in self.study().requests}
        self.assertEqual(
            list(found),
            [("flag", "whole"), ("flag", "parts"), ("panel", "whole"), ("flutter", "whole"), ("flutter", "parts")],
        )
        flag = found["flag", "whole"]
        self.assertEqual(flag.case_file, READY / "turek-hron-csm1" / "turek-hron-csm1.toml")
        self.assertEqual((flag.mesh.name, flag.mesh.command), ("turek-hron-csm1", "geo"))
        script = Path(flag.mesh.options[0])
        self.assertEqual(script.resolve(), READY / "turek-hron-cfd1" / "channel.geo")
        self.assertEqual(flag.mesh.options[1:], ("--order", "2"))
        self.assertEqual(flag.settings, {})

    def test_its_short_form(self):
        requests = self.study(quick=True).requests
        self.assertEqual([r.case for r in requests], ["flag", "flag", "flutter", "flutter"])
        self.assertEqual(requests[2].settings, {"time.end": 100})
        self.assertEqual(requests[2].mesh.name, "turek-hron-fsi2-quick")
        self.assertIn("flag=14", requests[2].mesh.options)

    def test_what_cannot_be_compared_is_refused(self):
        for old, new, words in (
            ('"turek-hron-csm1"', '"turek-hron-csm9"', ("cases.flag.scene", "'turek-hron-csm9' is unknown", "csm")),
            ('"turek-hron-csm1"', "1", ("cases.flag.scene", "is unknown")),
            ('"turek-hron-csm1"', '"turek-hron-csm1", file = "a.toml"', ("cases.flag.scene", "give one of the two")),
            ('flag = { scene = "turek-hron-csm1" }', 'flag = "study.toml"', ("cases.flag", "is no scene")),
            ('cases = ["panel", "flutter"]\n', "", ("runs.others", "two runs of flag, fsi-monolithic")),
        ):
            with self.subTest(new=new), self.assertRaises(InputError) as caught:
                self.assertIn(old, STUDY)
                self.study(STUDY.replace(old, new))
            for word in words:
                self.assertIn(word, str(caught.exception))

    def evaluate(self, tip_of, status=DONE, long=False):
        study = self.study(STUDY.partition("[runs.others]")[0])
        runs = []
        for i, request in enumerate(study.requests):
            folder = write_run(
                self.base / "runs" / str(i),
                parabola(0.66),
                program=request.method.program,
                mesh={"nodes": 1953},
                totals={"steps": 2, "outer_iterations": 2, "newton_iterations": 9, "wall_s": 1.0},
            )
            (folder / "iterations.csv").write_text("step,time_ms\n1,0.5\n2,1.0\n")
            write_points(folder, [0.5, 1.0], *tip_of(request.method.name))
            runs.append(StudyRun(request, folder, status if i else DONE, "diverged", 3.0 + i, ""))
        if long:
            study = replace(study, scenes={name: replace(scene, long=True) for name, scene in study.scenes.items()})
        self.out.mkdir(exist_ok=True)
        report, said = Report(self.out, study.title), io.StringIO()
        with contextlib.redirect_stdout(said):
            self.code = scenes.evaluate(Context(study, runs, SimpleNamespace(quiet=False), report))
        self.said, self.page = said.getvalue(), report.write().with_suffix(".md").read_text()
        return {(row["quantity"], row["program"]): row for row in self.csv("scenes.csv")}

    def test_both_drivers_stand_side_by_side(self):
        rows = self.evaluate(lambda name: ([-3, -7.187], [-40, -66.10 if name == "whole" else -66.10 * 1.01]))
        self.assertEqual(self.code, 2, "1 % off is more than asked")
        self.assertEqual(len(rows), 4)
        row = rows["u_y", "fsi-partitioned"]
        self.assertAlmostEqual(float(row["relative_error"]), 0.01, 12)
        self.assertEqual((row["nodes"], row["step_ms"], row["steps"]), ("1953", "", "2"))
        self.assertEqual((float(row["seconds"]), float(row["iterations_per_step"])), (4.0, 1.0))
        self.assertEqual(float(rows["u_x", "fsi-monolithic"]["iterations_per_step"]), 4.5)
        self.assertIn("1 % (!)", self.said)
        self.assertIn("3 of 4 numbers", self.page)
        self.assertNotIn("csm1.png", self.page, "the gallery has the pictures of short scenes")

    def test_a_run_that_failed_is_named(self):
        rows = self.evaluate(lambda name: ([-3, -7.187], [-40, -66.10]), NOT_CONVERGED, long=True)
        self.assertEqual(self.code, 2)
        self.assertEqual({program for _, program in rows}, {"fsi-monolithic"})
        self.assertIn("not converged, diverged", self.page)
        self.assertIn("turek_hron_csm1.png", self.page)


class Readings(FolderCase):
    def runs(self, times, x, y, quick=False):
        folder = write_run(self.base / "run", parabola(0.66))
        write_points(folder, times, x, y)
        return SceneRuns({"fsi-monolithic": SceneRun(folder, "fsi-monolithic", {}, 1.0)}, quick)

    def test_of_a_swing(self):
        times = np.arange(1, 2001) * 5.0
        growing = np.minimum(1, times / 5000)
        runs = self.runs(times, 0 * times, 1.5 + 80 * growing * np.sin(2 * np.pi * 1.9e-3 * times))
        known = Known("u_y", 1.0, 82.0, tolerance=0.012, mean_tolerance=0.03, spread=0.01)
        numbers = {n.what: n for n in Benchmark(known, frequency=2.0).numbers(runs)}
        mean, amplitude, rate = (numbers[f"{what} of u_y"] for what in ("mean", "amplitude", "frequency"))
        self.assertAlmostEqual(mean.value, 1.5, 1)
        self.assertAlmostEqual(mean.error, 0.5 / 82, 3)
        self.assertTrue(mean.holds)
        self.assertAlmostEqual(amplitude.value, 80, 1)
        self.assertEqual(amplitude.spread, 0.01)
        self.assertFalse(amplitude.holds)
        self.assertAlmostEqual(rate.value, 1.9, 4)
        self.assertEqual(rate.unit, "1/s")

    def test_of_what_becomes_steady(self):
        (number,) = Benchmark(Known("u_x", 2.0, tolerance=0.1)).numbers(self.runs([1, 2], [5, 2.1], [0, 0]))
        self.assertAlmostEqual(number.error, 0.05)
        self.assertEqual(number.unit, "mm")


if __name__ == "__main__":
    unittest.main()
