"""The kind `scaling` of fsi-compare study: runs of several processes, what is counted of them, and the model."""

import math
import os
import shutil
import unittest
import unittest.mock
from dataclasses import replace
from pathlib import Path

from fake_drivers import calls, install_mpirun
from folder_case import FolderCase
from study_case import StudyCase
from synthetic import parabola, write_run

from fsi_compare.base.errors import InputError
from fsi_compare.starting.launch import launched, without_chatter
from fsi_compare.starting.processes import execute, message_of
from fsi_compare.study.fingerprint import fingerprint
from fsi_compare.study.study_file import Method, Request
from fsi_compare.study.study_run import DONE, StudyRun
from fsi_research.scaling import model, study as scaling
from fsi_research.scaling.measured import Spread, measure
from fsi_research.scaling.model import Counted, Growth, Machine, counted, growth, step
from fsi_research.scaling.tables import weak_efficiency
from fsi_compare.starting.programs import Program

TUBE = Counted(
    nodes=8000,
    dimension=3,
    assembly=1e-5,
    algebra=3e-5,
    output=0.01,
    linear=100.0,
    growth=Growth(0.0, 1),
    imbalance=1.0,
    halo=1.0,
    messages=50.0,
    bytes=640.0,
    reductions=200.0,
    solver_counted=True,
    memory=None,
)
FREE = Machine(latency=0.0, bandwidth=math.inf, hop=0.0)


class Model(unittest.TestCase):
    """Against values by hand."""

    def test_one_process(self):
        one = step(TUBE, Machine(), 8000, 1)
        self.assertAlmostEqual(one.seconds, 8000 * 4e-5 + 0.01, 12)
        self.assertEqual((one.halo, one.messages, one.megabytes, one.reduction_count), (0, 0, 0, 0))

    def test_work_without_halo_and_messages_is_shared_out_evenly(self):
        bare = replace(TUBE, halo=0.0, output=0.0)
        for processes in (2, 64, 1024):
            self.assertAlmostEqual(step(bare, FREE, 8000, processes).seconds, 0.32 / processes, 12)

    def test_writing_is_not_shared_out(self):
        self.assertAlmostEqual(step(TUBE, FREE, 8000, 10**6).seconds, 0.01, 5)

    def test_halo_grows_as_the_surface(self):
        # 1000 own nodes, six faces of 100 copies; in the plane 1024 own nodes, four of 32.
        self.assertAlmostEqual(step(TUBE, FREE, 8000, 8).halo, 600)
        self.assertAlmostEqual(step(replace(TUBE, dimension=2), FREE, 8 * 1024, 8).halo, 128)
        # Two parts have one face between them, and no part has more copies than there are other nodes.
        self.assertAlmostEqual(step(TUBE, FREE, 2000, 2).halo, 100)
        self.assertAlmostEqual(step(TUBE, FREE, 20, 4).halo, min(3 * 5 ** (2 / 3), 15))

    def test_messages_bytes_and_reductions(self):
        machine = Machine(latency=2e-6, bandwidth=1e9, hop=3e-6, neighbours=10)
        many = step(TUBE, machine, 8000 * 1024, 1024)
        self.assertAlmostEqual(many.latency, 10 * 50 * 2e-6, 12)
        own = 8000.0
        self.assertAlmostEqual(many.transfer, 6 * own ** (2 / 3) * 640 / 1e9, 12)
        self.assertAlmostEqual(many.reductions, 200 * 10 * 3e-6, 12)
        self.assertAlmostEqual(many.seconds, many.work + many.latency + many.transfer + many.reductions + 0.01, 12)
        # log2 of what is no power of two is rounded up
        self.assertAlmostEqual(step(TUBE, machine, 8000, 5).reductions, 200 * 3 * 3e-6, 12)

    def test_what_the_solver_does_not_count_is_assumed(self):
        plain = replace(TUBE, solver_counted=False)
        machine = Machine(solver_exchanges=20, solver_halos=4, solver_reductions=2)
        counted_step, assumed = step(TUBE, machine, 8000, 2), step(plain, machine, 8000, 2)
        self.assertAlmostEqual(assumed.messages - counted_step.messages, 20 * 100)
        self.assertAlmostEqual(assumed.reduction_count - counted_step.reduction_count, 2 * 100)
        self.assertAlmostEqual(1e6 * (assumed.megabytes - counted_step.megabytes), 4 * 100 * assumed.halo * 32, 6)
        self.assertTrue(any("not counted" in line for line in model.assumptions(plain, machine, 2)))

    def test_iterations_that_grow(self):
        rising = replace(TUBE, growth=Growth(0.05, 8), halo=0.0, output=0.0)
        found = step(rising, FREE, 8000, 1024)
        self.assertAlmostEqual(found.iterations, 150.0)
        self.assertAlmostEqual(found.work, (1e-5 + 1.5 * 3e-5) * 8000 / 1024, 12)


class Measurements(FolderCase):
    def run_of(self, name, processes, seconds=8.0, linear=800, solver="petsc", **own):
        spread = {key: {"minimum": v[0], "mean": v[1], "maximum": v[2]} for key, v in own.items()}
        folder = write_run(
            self.base / name,
            parabola(0.66),
            [0.125 * n for n in range(1, 9)],
            totals={"steps": 8, "wall_s": seconds, "newton_iterations": 24, "linear_iterations": linear},
            phases={
                "assembly: coupled": {"seconds": seconds / 4, "calls": 24},
                "solve: coupled": {"seconds": seconds / 2, "calls": 24},
                "output": {"seconds": seconds / 8, "calls": 8},
            },
            mesh={"nodes": 1000},
            unknowns={"coupled": 4000},
            processes=processes,
            peak_memory_MiB=90.0,
            linear_solver=solver,
            **({"per_process": spread} if spread else {}),
        )
        method = Method("petsc", "petsc", "fsi-monolithic", {})
        request = Request("strong", "tube", method, {}, self.base, None, {}, 60, processes)
        return StudyRun(request, folder, DONE, "", 1.0, "")

    def measured(self, *arguments, cores=2, **own):
        run = self.run_of(*arguments, **own)
        return measure(run, "petsc", run.request.processes, 1, cores)

    def test_per_step(self):
        one = self.measured("one", 1)
        self.assertEqual((one.seconds, one.newton, one.linear, one.crowded), (1.0, 3.0, 100.0, False))
        self.assertAlmostEqual(one.assembly, 0.25)
        self.assertAlmostEqual(one.algebra, 0.625)  # the solve, and what is in no phase
        self.assertAlmostEqual(one.output, 0.125)
        self.assertEqual((one.owned, one.halo.mean, one.memory.maximum), (Spread(1000, 1000, 1000), 0, 90))

    def test_several(self):
        both = self.measured(
            "two",
            2,
            owned_nodes=(480, 500, 520),
            halo_nodes=(50, 60, 70),
            neighbours=(1, 1, 1),
            messages_per_step=(10, 12, 14),
            bytes_per_step=(1e6, 2e6, 3e6),
        )
        self.assertEqual((both.messages.mean, both.messages.maximum, both.megabytes.mean), (12, 14, 2.0))
        self.assertFalse(both.solver_counted)  # by PETSc
        self.assertTrue(self.measured("own", 2, solver="fast, where it iterates").solver_counted)
        self.assertAlmostEqual(both.owned.imbalance, 1.04)
        self.assertTrue(self.measured("three", 3).crowded)

    def test_made_by_another_number_of_processes(self):
        run = self.run_of("one", 1)
        with self.assertRaises(InputError) as caught:
            measure(run, "petsc", 2, 1, 2)
        self.assertIn("processes: is 1, not 2; build the programs with MPI", str(caught.exception))

    def test_what_the_model_takes_from_runs(self):
        one = self.measured("one", 1)
        two = self.measured(
            "two",
            2,
            5.0,
            840,
            owned_nodes=(480, 500, 520),
            halo_nodes=(50, 60, 70),
            neighbours=(1, 1, 1),
            messages_per_step=(10, 12, 14),
            bytes_per_step=(60000, 60000, 60000),
            peak_memory_MiB=(60, 60, 60),
            reading_memory_MiB=(70, 70, 70),
        )
        found = counted([one, two], 3)
        self.assertAlmostEqual(found.assembly, 0.25e-3)
        self.assertAlmostEqual(found.algebra, 0.625e-3)
        self.assertAlmostEqual(found.growth.rate, 0.05)
        self.assertAlmostEqual(found.halo, 60 / 500 ** (2 / 3))
        self.assertAlmostEqual((found.messages, found.bytes), (12, 1000))
        # Memory: 90 MiB with 1000 nodes, 60 with 560; 70 while the whole mesh is there.
        slope = 30 / 440
        self.assertAlmostEqual(found.memory.local, slope)
        self.assertAlmostEqual(found.memory.base, 90 - 1000 * slope)
        self.assertIsNone(found.memory.to_read(1000))  # one mesh does not tell what others take
        larger = replace(two, nodes=3000, reading=Spread(100, 100, 110))
        self.assertAlmostEqual(counted([one, two], 3, [larger]).memory.to_read(5000), 150)
        # The model gives back what it was made from.
        again = step(found, FREE, 1000, 2)
        self.assertAlmostEqual(again.halo, 60)
        self.assertAlmostEqual(again.memory, 60)
        self.assertIsNone(counted([one], 3))

    def test_growth_is_least_squares_and_never_a_fall(self):
        runs = [self.measured(str(n), n, 8.0, linear) for n, linear in ((1, 800), (2, 840), (4, 840), (8, 920))]
        # rises 0.05, 0.05, 0.15 over 1, 2, 3 doublings: (0.05 + 0.1 + 0.45) / 14
        self.assertAlmostEqual(growth(runs).rate, 0.6 / 14)
        self.assertEqual(growth(runs).most, 8)
        fewer = [self.measured(f"f{n}", n, 8.0, linear) for n, linear in ((1, 800), (2, 700))]
        self.assertEqual(growth(fewer).rate, 0.0)

    def test_weak_efficiency_is_by_nodes(self):
        one, two = self.measured("one", 1, 8.0), self.measured("two", 2, 10.0)
        self.assertAlmostEqual(
            weak_efficiency(one, two), 0.4
        )  # the same nodes on twice the processes, 1.25 times slower


class Launching(FolderCase):
    def test_one_process_needs_no_launcher(self):
        with unittest.mock.patch.dict(os.environ, PATH=str(self.base)):
            self.assertEqual(launched(["a", 3], 1), ["a", "3"])
            with self.assertRaises(InputError) as caught:
                launched(["a"], 2)
        self.assertIn("mpirun: is not on the path; install the Debian package openmpi-bin", str(caught.exception))

    def test_words(self):
        with unittest.mock.patch.dict(os.environ, PATH=str(install_mpirun(self.base))):
            words = launched(["a", "-n"], 2)
        self.assertEqual(words[words.index("mpi_yield_when_idle") + 1], "1")
        self.assertEqual((words[1:3], words[-2:]), (["-n", "2"], ["a", "-n"]))
        self.assertEqual("--allow-run-as-root" in words, os.geteuid() == 0)

    def test_mpirun_s_own_words_are_no_message(self):
        line = "-" * 74
        said = f"fsi-monolithic: error: a.toml: b; c\n{line}\nPrimary job terminated\n{line}\n{line}\nmpirun detected\n{line}\n"
        self.assertEqual(without_chatter(said), "fsi-monolithic: error: a.toml: b; c")
        self.assertEqual(message_of(1, said), "a.toml: b; c")

    @unittest.skipUnless(shutil.which("mpirun"), "no mpirun here")
    def test_the_message_of_a_real_launch(self):
        program = self.base / "fails"
        program.write_text('#!/bin/sh\n[ "$OMPI_COMM_WORLD_RANK" = 0 ] && echo "fsi-x: error: a: b; c" >&2\nexit 2\n')
        program.chmod(0o755)
        end = execute(launched([program], 2))
        self.assertEqual((end.code, end.message), (2, "a: b; c"))

    def test_runs_of_one_process_keep_their_digest(self):
        case = self.base / "tube.toml"
        case.write_text("")
        method = Method("m", "m", "fsi-monolithic", {})
        request = Request("g", "tube", method, {}, case, None, {}, 60)
        digests = [fingerprint(request, Program(Path("fsi-monolithic"), "1"), None, 1, n) for n in (1, 2, 3)]
        self.assertEqual(len(set(digests)), 3)
        self.assertEqual(
            digests[0], "8c4b81dd3e9fa144e6f960037be3772e2a3ba2166252f837886d1d6992fec771"
        )  # by a version that knew one process


class WholeStudy(StudyCase):
    """With drivers that answer at once, behind an mpirun that starts them once."""

    STUDY = """\
title = "Scaling"
kind = "scaling"
time_limit = 60
[cases]
tube = "tube.toml"
[methods.petsc]
program = "fsi-monolithic"
[runs.strong]
methods = ["petsc"]
vary = { processes = "cores" }
[runs.weak]
methods = ["petsc"]
[runs.weak.vary]
tube = [{ label = 1, processes = 1, set = { time.end = 2.0 } }, { label = 2, processes = 2, set = { time.end = 2.0 } }]
[runs.counts]
methods = ["petsc"]
vary = { processes = [3, 8] }
[report.model]
nodes = [1000000]
"""

    def setUp(self):
        super().setUp()
        self.study.write_text(self.STUDY)
        path = f"{install_mpirun(self.base / 'mpi')}:{os.environ['PATH']}"
        for patch in (
            unittest.mock.patch.dict(os.environ, PATH=path),
            unittest.mock.patch("fsi_compare.study.study_file.usable_cores", lambda: 2),
            unittest.mock.patch.object(scaling, "usable_cores", lambda: 2),
        ):
            patch.start()
            self.addCleanup(patch.stop)

    def test_report(self):
        code, _, err = self.call()
        self.assertEqual((code, err), (0, err))
        self.assertEqual(len(calls(self.programs)), 6)
        rows = self.csv("strong.csv")
        self.assertEqual([int(row["processes"]) for row in rows], [1, 2])
        self.assertEqual([float(row["speed_up"]) for row in rows], [1.0, 2.0])
        self.assertEqual([float(row["efficiency"]) for row in self.csv("weak.csv")], [1.0, 1.0])
        counts = self.csv("counts.csv")
        self.assertEqual([float(row["halo_nodes_mean"]) for row in counts], [57 * (2 - 2 / n) for n in (3, 8)])
        modelled = self.csv("model.csv")
        self.assertEqual([(int(r["nodes"]), int(r["processes"])) for r in modelled[1:3]], [(1032, 1024), (1000000, 64)])
        for row in modelled:
            parts = [float(row[f"{name}_s"]) for name in ("work", "latency", "transfer", "reductions", "output")]
            self.assertAlmostEqual(float(row["step_s"]), sum(parts), 12)
        page = (self.out / "report.md").read_text()
        for text in (
            "a step on 2 processes takes 0.50 of the time on one (speed-up 2.00)",
            "A model, not a measurement.",
            "A message costs 2 us",
            "seconds mean nothing",
            "not counted by the runs",
        ):
            self.assertIn(text, page)
        for stem in ("scaling", "counts", "model"):
            self.assertGreater((self.out / f"{stem}.png").stat().st_size, 5000, stem)

    def test_seconds_on_too_few_cores_are_not_told(self):
        with unittest.mock.patch.object(scaling, "usable_cores", lambda: 1):
            code, _, _ = self.call()
        self.assertEqual(code, 0)
        self.assertEqual([row["speed_up"] for row in self.csv("strong.csv")], ["1.0", ""])
        self.assertIn("there is one core, so that no speed-up can be measured", (self.out / "report.md").read_text())

    def test_processes_of_all_other_runs(self):
        code, _, err = self.call("--processes", "3", "--list")
        self.assertEqual(code, 0, err)
        code, _, err = self.call("--processes", "0")
        self.assertEqual(code, 1)
        self.assertIn("--processes: 0 is not positive", err)

    def test_refusals(self):
        for expected, old, new in (
            ("report.scaling.strong: 'strong' is no group", "[runs.strong]", "[runs.stronger]"),
            ("runs.strong.vary: does not vary processes", 'processes = "cores"', '"time.step" = [0.1]'),
            ("report.model.nodes: 1.5 is no whole number", "nodes = [1000000]", "nodes = [1.5]"),
            ("report.model.latency: is unknown", "nodes = [1000000]", "latency = 1"),
        ):
            self.study.write_text(self.STUDY.replace(old, new))
            code, _, err = self.call()
            self.assertEqual(code, 1)
            self.assertIn(expected, err)


if __name__ == "__main__":
    unittest.main()
