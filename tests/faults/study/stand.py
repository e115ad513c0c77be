"""Result folders and studies to be damaged, and fsi-compare called on them within this process, drivers included."""

import contextlib
import io
import json
import os
import shutil
import signal
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[3]
sys.path[:0] = [str(TOP / "compare"), str(TOP / "compare/research"), str(TOP / "tests/integration/compare")]

import fake_drivers  # noqa: E402
from fsi_research import start  # noqa: E402
from fsi_research.linear import command as linear_command, study as linear_study  # noqa: E402
from fsi_research.paper import linear as paper_linear  # noqa: E402
from fsi_compare.reporting import matplotlib_loader  # noqa: E402
from fsi_compare.starting.processes import End  # noqa: E402
from fsi_compare.starting.programs import Program  # noqa: E402
from fsi_compare.study import command as study_command  # noqa: E402
from fsi_compare.study import runner  # noqa: E402

READY = TOP / "compare" / "research" / "studies"
STEPS, STEP = 24, 0.125

PLAIN = {
    "title": "Two runs",
    "kind": "runs",
    "threads": 1,
    "jobs": 1,
    "time_limit": 60,
    "repeats": 2,
    "repeat_below": 5.0,
    "set": {"time": {"end": 3.0}, "output.every": 0},
    "cases": {"tube": "tube.toml", "pipe": {"file": "pipe.toml", "set": {"fluid.density": 1.0}}},
    "methods": {
        "mono": {"program": "fsi-monolithic", "label": "monolithic"},
        "part": {"program": "fsi-partitioned", "set": {"partitioned": {"scheme": "iqn-ils"}}},
    },
    "meshes": {"mine": {"options": ["--size", "0.5"], "label": "my own"}},
    "runs": {
        "all": {
            "cases": ["tube"],
            "methods": ["mono", "part"],
            "quick": {"methods": ["mono"]},
            "vary": {"mesh": ["coarse", "mine"], "time.step": [0.125, 0.25]},
        },
        "one": {
            "cases": ["pipe"],
            "methods": ["mono"],
            "set": {"newton.mode": "full"},
            "vary": {"word": [{"label": "a", "set": {"title": "b"}}]},
        },
    },
    "report": {},
}


def write_run(folder, program="fsi-monolithic"):
    """A whole result folder, as the commands read it."""
    folder.mkdir(parents=True)
    return write_results(folder, program, STEPS, STEP)


def write_results(folder, program, steps, step):
    fake_drivers.write_results(folder, program, steps=steps, step=step)
    rows = ["time_ms,z_mm,radial_mm,axial_mm"]
    for n in range(1, steps + 1):
        rows += [f"{n * step!r},{0.2 * i!r},{1e-3 * n * (1 + i)!r},0.0" for i in range(91)]
    (folder / "wall_displacement.csv").write_text("\n".join(rows) + "\n")
    if program == "fsi-partitioned":
        lines = ["step,time_ms,displacement_residual,force_residual,coupling_s"]
        lines += [f"{n},{n * step!r},1e-7,1e-6,0.01" for n in range(1, steps + 1)]
        (folder / "coupling.csv").write_text("\n".join(lines) + "\n")
    file = folder / "summary.json"
    summary = json.loads(file.read_text())
    summary.update(
        peak_memory_MiB=81.5,
        restarted_from_step=3,
        unknowns={"coupled": 4662},
        counters={"fluid elements": 100},
        case="tube.toml",
        element="p1",
        geometry="3d",
    )
    summary["mesh"]["hash"] = "03"
    file.write_text(json.dumps(summary))
    return folder


class Stand:
    """`base`: a folder of its own. Drivers and fsi-mesh are functions here; `spoil(folder)`, where it is set, is called
    on each result folder that a driver has just written."""

    def __init__(self, base):
        self.base = base
        base.mkdir()
        self.out = base / "out"
        self.spoil = None
        self.size = (STEPS, STEP)  # of the results of a run; the ready studies need 96 steps
        programs = fake_drivers.install(base / "bin")
        self.options = [
            "--monolithic",
            str(programs / "fsi-monolithic"),
            "--partitioned",
            str(programs / "fsi-partitioned"),
        ]
        for name in ("tube", "pipe"):
            (base / f"{name}.toml").write_text('title = "A tube"\n')
        known = {name: Program(programs / name, "0.1.0", "00") for name in fake_drivers.DRIVERS}
        single = Program(programs / fake_drivers.LINEAR_STUDY, "0.1.0", "00")
        study_command.find_drivers = lambda options, names: known
        study_command.find_mesh_maker = lambda program: programs / "fsi-mesh"
        linear_command.find_linear_study = lambda named: single
        paper_linear.linear_study_beside = lambda monolithic: single
        linear_study.execute = self._execute
        runner.execute = self._execute
        runner.run_jobs = self._run_jobs
        matplotlib_loader.load_matplotlib()
        from fsi_compare.reporting import pictures

        pictures.DPI = 30  # what is drawn matters, not how finely

    def _execute(self, command, tick=lambda: None):
        words = [str(word) for word in command]
        if Path(words[0]).name == "fsi-mesh":
            Path(words[-1]).write_text("a mesh")
            return End(0, "", 0.1)
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            code = self._drive(words)
        if self.spoil and "-o" in words:
            self.spoil(Path(words[words.index("-o") + 1]))
        return End(code, said.getvalue().strip(), 0.1)

    def _drive(self, words):
        if Path(words[0]).name == fake_drivers.LINEAR_STUDY:
            return fake_drivers.main(words)
        folder = Path(words[words.index("-o") + 1])
        folder.mkdir(parents=True, exist_ok=True)
        write_results(folder, Path(words[0]).name, *self.size)
        return 0

    def _run_jobs(self, jobs, at_once, ended, tick=lambda running: None):
        for job in jobs:
            ended(job.key, self._execute(job.command))

    def call(self, *arguments, limit=60):
        """(exit code, output, error output); code None: it did not end in `limit` seconds."""
        out, err = io.StringIO(), io.StringIO()

        def late(number, frame):
            raise TimeoutError

        signal.signal(signal.SIGALRM, late)
        signal.alarm(limit)
        try:
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
                code = start.main([str(word) for word in arguments])
        except TimeoutError:
            code = None
        except BaseException as error:  # it has got past the last resort
            code = f"{type(error).__name__}: {error}"
        finally:
            signal.alarm(0)
        return code, out.getvalue(), err.getvalue()

    def clear(self):
        shutil.rmtree(self.out, ignore_errors=True)

    def left_over(self):
        """Temporary files and locks in the output folder, or the folder itself where it is empty."""
        if not self.out.is_dir():
            return []
        names = [str(path.relative_to(self.out)) for path in self.out.rglob("*")]
        bad = [name for name in names if os.path.basename(name).startswith(".") or name == "run.lock"]
        return bad if names else ["the empty folder"]
