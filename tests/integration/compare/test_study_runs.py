"""`fsi-compare study` with drivers whose behaviour is known: what is run, what is not run again, what is recorded."""

import json
import os
import re
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

from fake_drivers import behave, build_anew, calls
from study_case import STUDY, StudyCase

from fsi_compare.starting.processes import End, Job, execute, run_jobs
from fsi_compare.study.runner import RECORD, first_not_finite, judge
from fsi_compare.study.study_run import CRASHED, DONE, NOT_CONVERGED, OUT_OF_TIME, REFUSED, WRONG


class Restart(StudyCase):
    def test_finished_runs_are_taken_up(self):
        code, out, err = self.call()
        self.assertEqual(code, 0, err)
        self.assertIn("report.html", out)
        self.assertEqual(len(calls(self.programs)), 2)
        self.assertEqual({status for status, _ in self.outcomes().values()}, {DONE})
        code, _, err = self.call()
        self.assertEqual((code, len(calls(self.programs)), err), (0, 2, ""))

    def test_what_a_run_is_told(self):
        self.call("--threads", "3")
        mono, part = calls(self.programs)
        self.assertIn(f"{self.case_file.resolve()} -o {self.out}/runs/tube-mono-", mono)
        self.assertIn("--threads 3", mono)
        self.assertIn("--set partitioned.scheme=iqn-ils", part)

    def test_a_change_makes_a_run_anew(self):
        tube = 'title = "A tube"\n[time]\nstep = 0.25\n'
        self.call()
        for change, again in (
            (lambda: self.case_file.write_text(tube), 2),
            (lambda: self.case_file.write_text(tube + "[newton]\ntolerance = 1e-6\n"), 2),
            (lambda: self.case_file.write_text(tube + "[monolithic]\nnewton_tolerance = 1e-6\n"), 0),  # the same
            (
                lambda: self.case_file.write_text(
                    tube + '[newton]\ntolerance = 1e-6\n[monolithic]\nlinear_solver = "direct"\n'
                ),
                1,
            ),
            (lambda: self.study.write_text(STUDY.replace("iqn-ils", "aitken")), 1),
            (lambda: self.study.write_text(STUDY.replace("iqn-ils", "aitken") + 'vary = { mesh = ["fine"] }\n'), 2),
            (lambda: behave(self.programs, version="0.2.0"), 2),
        ):
            change()
            before = len(calls(self.programs))
            self.call()
            self.assertEqual(len(calls(self.programs)) - before, again)

    def test_a_change_of_a_file_that_case_or_setting_names_makes_a_run_anew(self):
        table, field = self.base / "beat.csv", self.base / "c10.csv"
        self.case_file.write_text('[[opening]]\nsurface = "inlet"\nflow_rate = { file = "beat.csv" }\n')
        self.study.write_text(STUDY + 'set = { structure.layers.media.c10.file = "c10.csv" }\n')
        self.call()  # neither is there, which is for the drivers to say
        for change, again in (
            (lambda: table.write_text("time_ms,flow\n0,1\n"), 2),
            (lambda: table.write_text("time_ms,flow\n0,2\n"), 2),
            (lambda: table.touch(), 0),
            (lambda: field.write_text("x,y,z,c10\n0,0,0,130\n"), 2),
            (lambda: field.write_text("x,y,z,c10\n0,0,0,140\n"), 2),
        ):
            change()
            before = len(calls(self.programs))
            self.call()
            self.assertEqual(len(calls(self.programs)) - before, again)
        self.case_file.write_text('prestress.file = "/proc/self/mem"\n')  # nobody can read it from its beginning
        code, _, err = self.call()
        self.assertEqual(code, 1)
        self.assertRegex(err, r"error: /proc/self/mem: cannot be read: .*; give a file that can be read\n$")

    def test_what_decides_nothing_makes_no_run_anew(self):
        self.case_file.write_text('title = "A tube"\n[time]\nstep = 0.25\n')
        self.call()
        for text in (
            '# a comment\ntitle = "A tube"\n[time]\nstep = 0.25  # ms\n',
            "time.step = 0.25\n",
            'title = "Another"\n[time]\nstep = 0.25\n',
        ):
            self.case_file.write_text(text)
            self.call()
            self.assertEqual(len(calls(self.programs)), 2, text)

    def test_of_a_case_that_is_no_toml_every_byte_counts(self):
        self.case_file.write_text("tube\n")
        self.call()
        self.case_file.write_text("tube \n")
        self.call()
        self.assertEqual(len(calls(self.programs)), 4)

    def test_a_changed_mesh_makes_a_run_anew(self):
        mesh = self.base / "tube.msh"
        mesh.write_text("a mesh")
        self.case_file.write_text('[mesh]\nfile = "tube.msh"\n')
        self.call()
        self.call()
        self.assertEqual(len(calls(self.programs)), 2)
        mesh.write_text("a finer mesh")
        self.call()
        self.assertEqual(len(calls(self.programs)), 4)

    def test_a_broken_result_is_made_anew(self):
        self.call()
        next(self.out.glob("runs/tube-mono-*/summary.json")).write_text("{")
        self.call()
        self.assertEqual(len(calls(self.programs)), 3)

    def test_fresh(self):
        self.call()
        others = [self.out / name for name in ("runs/notes", "runs/artery-coarse", "linear/runs/artery-coarse")]
        stale = self.out / "runs" / "tube-mono-0123456789ab"  # unfinished, or of the study as it was
        for place in (*others, stale):
            place.mkdir(parents=True)
        self.call("--fresh")
        self.assertEqual(len(calls(self.programs)), 4)
        self.assertEqual([place.is_dir() for place in (*others, stale)], [True, True, True, False])

    def test_help_says_what_fresh_removes(self):
        _, out, _ = self.call("--help")
        self.assertIn("the linear systems in OUTDIR/linear stay", " ".join(out.split()))

    def test_quick_form_and_list(self):
        code, out, _ = self.call("--list")
        self.assertEqual(
            (code, out.split("\n")[:2], calls(self.programs)), (0, ["all: tube, mono", "all: tube, part"], [])
        )
        self.call("--quick")
        self.assertEqual(len(calls(self.programs)), 1)

    def test_a_killed_study_goes_on_where_it_stopped(self):
        self.call("--quick")  # the first run is there
        behave(self.programs, sleep=600)
        for end in (signal.SIGTERM, signal.SIGKILL):
            (self.programs / "pid").unlink(missing_ok=True)
            process = subprocess.Popen(
                [
                    sys.executable,
                    "-E",
                    "-B",
                    "-c",
                    "import sys; sys.path.insert(0, sys.argv[1]); "
                    "from fsi_compare.start import main; sys.exit(main(sys.argv[2:]))",
                    str(Path(__file__).resolve().parents[3] / "compare"),
                    *self.words(),
                ],
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
            driver = self.wait_for_pid()
            process.send_signal(end)
            process.wait(timeout=120)
            self.assertTrue(self.ends(driver), "the driver outlives the study")
        self.assertEqual(list(self.out.glob("runs/tube-part-*/study_run.json")), [])
        behave(self.programs)
        before = len(calls(self.programs))
        code, _, err = self.call()
        self.assertEqual((code, len(calls(self.programs)) - before), (0, 1), err)
        self.assertEqual(self.outcomes()["part"][0], DONE)

    def wait_for_pid(self):
        for _ in range(2400):
            text = (self.programs / "pid").read_text() if (self.programs / "pid").exists() else ""
            if text.endswith("\n"):
                return int(text.split()[-1])
            time.sleep(0.05)
        self.fail("no run has begun")

    @staticmethod
    def ends(pid):
        for _ in range(2400):
            try:
                os.kill(pid, 0)
            except ProcessLookupError:
                return True
            time.sleep(0.05)
        return False


class Builds(StudyCase):
    WARNING = "fsi-compare: warning: 1 of 2 finished runs was made by another build of fsi-partitioned 0.1.0: "

    def note(self):
        return re.search("<strong>Note:</strong> ([^<]*)", (self.out / "report.html").read_text())

    def test_the_same_executable(self):
        self.call()
        _, _, err = self.call()
        self.assertEqual((err, self.note()), ("", None))

    def test_runs_of_another_executable_are_taken_up_with_a_warning(self):
        self.call()
        build_anew(self.programs, "fsi-partitioned")
        code, _, err = self.call()
        self.assertEqual((code, len(calls(self.programs))), (0, 2))
        self.assertEqual(err, self.WARNING + "`--fresh` makes it again\n")
        self.assertIn(self.note()[1], self.WARNING)
        _, _, err = self.call("-q")
        self.assertEqual(err, "")
        self.assertIsNotNone(self.note())

        build_anew(self.programs, "fsi-monolithic")
        _, _, err = self.call()
        self.assertIn(
            "2 of 2 finished runs were made by another build of fsi-monolithic 0.1.0 and fsi-partitioned "
            "0.1.0: `--fresh` makes them again\n",
            err,
        )
        _, _, err = self.call("--fresh")
        self.assertNotIn("another build", err)
        self.assertIsNone(self.note())

    def test_runs_of_two_machines_are_named(self):
        self.call()
        for processor, place in zip("AB", sorted(self.out.glob("runs/tube-*"))):
            summary = json.loads((place / "summary.json").read_text())
            (place / "summary.json").write_text(json.dumps({**summary, "machine": {"processor": processor}}))
        said = "These runs are of 2 processors: A, B; compare work units, not seconds"
        _, _, err = self.call()
        self.assertEqual(err, f"fsi-compare: note: {said}\n")
        self.assertEqual(self.note()[1], f"{said}.")
        for place in self.out.glob("runs/tube-*"):
            text = (place / "summary.json").read_text()
            (place / "summary.json").write_text(text.replace('"processor": "B"', '"processor": "A"'))
        _, _, err = self.call()
        self.assertEqual((err, self.note()), ("", None))

    def test_a_run_made_now_is_of_this_build(self):
        self.call("--quick")
        build_anew(self.programs, "fsi-monolithic", "fsi-partitioned")
        _, _, err = self.call()
        self.assertIn("1 of 1 finished runs was made by another build of fsi-monolithic 0.1.0", err)

    def test_a_run_without_a_record_of_its_executable_is_of_another_build(self):
        self.call()
        for place in self.out.glob("runs/tube-part-*"):
            record = self.record(place)
            del record["executable"]
            (place / RECORD).write_text(json.dumps(record))
        _, _, err = self.call()
        self.assertIn(self.WARNING, err)
        self.assertEqual(len(calls(self.programs)), 2)


class Failures(StudyCase):
    def test_a_failed_run_is_recorded_and_not_silently_tried_again(self):
        behave(self.programs, end={"fsi-partitioned": [2, "step 3 did not converge"]})
        code, _, err = self.call()
        self.assertEqual(code, 0)  # this kind of study needs no run in particular
        self.assertIn("not converged: step 3 did not converge", err)
        self.assertEqual(self.outcomes()["part"], (NOT_CONVERGED, "step 3 did not converge"))
        _, _, err = self.call()
        self.assertEqual(len(calls(self.programs)), 2)
        self.assertIn("2 runs are there already (1 of them failed; --fresh makes all anew)", err)
        self.assertEqual(self.outcomes()["part"], (NOT_CONVERGED, "step 3 did not converge"))
        report = (self.out / "report.html").read_text()
        self.assertIn("step 3 did not converge", report)

    def test_each_bad_end(self):
        for key, what, expected in (
            ("end", [1, "time.step: 0 is not positive"], (REFUSED, "time.step: 0 is not positive")),
            ("signal", 11, (CRASHED, "ended by signal SIGSEGV")),
            ("end", [134, "abort"], (CRASHED, "abort")),
            ("nan", "iterations.csv", (WRONG, "iterations.csv holds a value that is not a finite number")),
        ):
            behave(self.programs, **{key: {"fsi-partitioned": what}})
            self.call("--fresh", "-q")
            self.assertEqual(self.outcomes()["part"], expected)
            self.assertEqual(self.outcomes()["mono"][0], DONE)

    def test_a_run_that_somebody_ended_is_made_anew(self):
        for what in (
            {"end": {"fsi-partitioned": [143, "interrupted by SIGTERM"]}},
            {"signal": {"fsi-partitioned": 15}},
        ):
            behave(self.programs, **what)
            self.call("-q", "--fresh")
            self.assertEqual(self.outcomes()["part"][0], CRASHED)
            behave(self.programs)
            self.call("-q")
            self.assertEqual(self.outcomes()["part"][0], DONE)

    def test_nothing_but_refusals_is_the_users_mistake(self):
        behave(self.programs, end={"fsi-": [1, "mesh.level: 'corse' is unknown"]})
        code, out, err = self.call("-q")
        self.assertEqual((code, out, err.count("\n")), (1, "", 1))
        self.assertIn("mesh.level: 'corse' is unknown", err)
        self.assertFalse((self.out / "report.html").exists())

    def test_out_of_time(self):
        self.study.write_text(STUDY.replace("time_limit = 60", "time_limit = 1"))
        behave(self.programs, sleep=30)
        self.call("-q", "--quick")
        self.assertEqual(self.outcomes()["mono"], (OUT_OF_TIME, "stopped after 1 s"))
        self.call("-q", "--quick")
        self.assertEqual(len(calls(self.programs)), 1)  # the same time would be lost again
        self.study.write_text(STUDY)
        behave(self.programs)
        self.call("-q", "--quick")
        self.assertEqual((len(calls(self.programs)), self.outcomes()["mono"][0]), (2, DONE))

    def test_wrong_use(self):
        for words, expected in (
            (("--jobs", "0"), "--jobs: 0 is not positive"),
            (("--nonsense",), "unrecognized arguments"),
        ):
            code, _, err = self.call(*words)
            self.assertEqual((code, err.count("\n")), (1, 1))
            self.assertIn(expected, err)


class Judging(StudyCase):
    def test_codes(self):
        for code, expected in ((1, REFUSED), (2, NOT_CONVERGED), (3, CRASHED), (-9, CRASHED)):
            self.assertEqual(judge(self.base, End(code, "why", 1.0))[0], expected)
        self.assertEqual(judge(self.base, End(-15, "stopped", 1.0, out_of_time=True)), (OUT_OF_TIME, "stopped"))

    def test_done_without_results_is_no_success(self):
        status, message = judge(self.base, End(0, "", 1.0))
        self.assertEqual(status, CRASHED)
        self.assertIn("summary.json: is missing", message)

    def test_not_finite(self):
        for text, bad in (
            ("a,b\n1,nan\n", True),
            ("a,b\n-inf,2\n", True),
            ("a,b\n1,Infinity\n", True),
            ("a,b\n1,2\n", False),
            ("nano,inf_norm\n1,2\n", False),
        ):
            (self.base / "x.csv").write_text(text)
            self.assertEqual(first_not_finite(self.base) != "", bad, text)
        for summary, bad in (
            ('{"failure": "the residual is nan, the step is inf"}', False),
            ('{"totals": {"wall_s": NaN}}', True),
            ('{"phases": [{"seconds": Infinity}]}', True),
        ):
            (self.base / "summary.json").write_text(summary)
            self.assertEqual(first_not_finite(self.base) != "", bad, summary)


class Jobs(StudyCase):
    def test_parallel(self):
        behave(self.programs, meet=2)  # one after the other they would wait until their time is over
        code, _, err = self.call("--jobs", "2")
        self.assertEqual(code, 0, err)
        self.assertEqual(len(calls(self.programs)), 2)

    def test_no_more_at_once_than_asked(self):
        most, running, ends = [0], set(), []
        jobs = [Job(i, [sys.executable, "-c", "import time; time.sleep(0.3)"]) for i in range(5)]

        def started():
            for job in jobs:
                running.add(job.key)
                most[0] = max(most[0], len(running))
                yield job

        def ended(key, end):
            running.discard(key)
            ends.append((key, end.code))

        run_jobs(started(), 2, ended)
        self.assertEqual(sorted(ends), [(i, 0) for i in range(5)])
        self.assertLessEqual(most[0], 3)  # the next one waits in hand

    def test_a_program_that_is_not_there(self):
        end = execute([self.base / "nothing"])
        self.assertEqual(end.code, 1)
        self.assertTrue(re.search("nothing cannot be started", end.message))


if __name__ == "__main__":
    unittest.main()
