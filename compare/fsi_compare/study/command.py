"""`fsi-compare study`: runs what is missing and writes the report."""

import argparse
import platform
import time
from pathlib import Path
from typing import Any, TYPE_CHECKING

from ..base.errors import InputError, ProgramError, printable, say_note, say_warning
from ..base.files import absolute, folder, output_folder, together
from ..base.options import Commands, add_command, add_count, add_drivers, add_usual
from ..base.folder_lock import locked
from ..starting.duration import duration
from ..starting.programs import Program, find_drivers, find_mesh_maker
from .catalogue import OWN, Catalogue
from .overview import default_output, overview
from .runner import Runner, remove_runs, sweep_study
from .study_file import PROGRAMS, Study, read_study

if TYPE_CHECKING:
    from ..reporting.report import Report  # matplotlib takes a second to load

DESCRIPTION = """\
Makes the runs that a study file lists, each in a folder of its own, and the report from them. A study that was stopped
goes on where it stopped: a finished run is taken up again when case, mesh, settings, processes, threads and program
version are the same; comments and the title of a case file do not count. Where another build of the same version made some of the
runs, a warning and the report tell how many; --fresh makes them anew. Writes to OUTDIR:
  report.html           the report, in one file
  report.md             its text and tables, to be kept; pictures by name
  *.csv                 its tables
  *.png, *.svg          its pictures
  runs/, meshes/        the result folders, each with its command in study_run.json
Exit code 2: a run that the report needs is missing; the report says which."""

EXAMPLES = """\
examples:
  fsi-compare study --list
  fsi-compare study refinement --quick
  fsi-compare study my-study.toml -o results/mine
"""


def add_parser(commands: Commands, version: str, catalogue: Catalogue = OWN) -> None:
    help = "a whole study: runs what is missing, writes an HTML report"
    command = add_command(commands, "study", study, help, DESCRIPTION, EXAMPLES)
    text = f"study file (TOML), or a ready one: {', '.join(catalogue.ready)}"
    command.add_argument("study", metavar="STUDY", nargs="?", help=text)
    command.add_argument("-o", "--output", metavar="OUTDIR", type=folder, help="default: results/studies/NAME")
    command.add_argument("--quick", action="store_true", help="the study's short form")
    text = "say what would be run, and run nothing; without STUDY: the ready studies and what each still has to run"
    command.add_argument("--list", action="store_true", help=text)
    text = "make finished runs anew: removes the study's runs in OUTDIR/runs; of the kind paper, the linear systems in "
    command.add_argument("--fresh", action="store_true", help=text + "OUTDIR/linear stay")
    add_drivers(command)
    text = "of each run, by mpirun (default: the study's); groups that vary them keep their numbers"
    add_count(command, "--processes", text)
    add_count(command, "--jobs", "runs at once (default: the study's); more than one spoils the seconds")
    add_usual(command, version, "of each run (default: the study's)")
    command.set_defaults(catalogue=catalogue)


def study(options: argparse.Namespace) -> int:
    """Checks everything before the first run."""
    catalogue: Catalogue = options.catalogue
    if options.study is None:
        return list_ready(options, catalogue)
    asked = read_study(catalogue.path(options.study), catalogue.kinds, options.quick)
    if not asked.requests:
        problem = "holds nothing to run" + (" in its quick form" if options.quick else "")
        remedy = "add a section [runs.NAME]" + (" with quick = true" if options.quick else "")
        raise InputError(asked.path, "runs", problem, remedy)
    kind = catalogue.kind(asked.kind)
    kind.check(asked)
    programs = find_drivers(options, PROGRAMS)
    if options.list:
        lines = [f"{request.group}: {request.label}" for request in asked.requests]
        print("\n".join(map(printable, [*lines, *getattr(kind, "also_runs", lambda study: [])(asked)])))
        return 0
    folder = options.output or default_output(asked.path, options.quick)
    with output_folder(folder), locked(folder):
        return make(options, asked, kind, folder, programs)


def make(options: argparse.Namespace, asked: Study, kind: Any, folder: Path, programs: dict[str, Program]) -> int:
    """Makes the runs that are missing and the report from all. The folder is locked."""
    if options.fresh:
        remove_runs(folder)
    sweep_study(folder)
    begin = time.monotonic()
    maker = find_mesh_maker(programs["fsi-monolithic"])
    numbers = options.threads, options.jobs, options.quiet, options.processes
    runner = Runner(asked, folder, programs, maker, *numbers)
    runs = runner.run(asked.requests)
    if all(run.status == "refused" for run in runs):
        raise ProgramError(asked.path, runs[0].request.label, runs[0].message, "mend the study or the case")

    from .context import Context
    from ..reporting.report import Report  # matplotlib takes a second to load

    with together(folder) as place:
        report = Report(place, asked.title)
        code = kind.evaluate(Context(asked, runs, runner, report)) or 0
        about(report, asked, runner, programs)
        path = folder / report.write().name
    if not options.quiet:
        if runner.warning:
            say_warning(runner.warning)
        if runner.machines:
            say_note(runner.machines)
        print(f"Runs took {duration(runner.seconds)} in all, this call {duration(time.monotonic() - begin)}.")
        print(f"Report: {printable(str(absolute(path)))}")
    return code


def list_ready(options: argparse.Namespace, catalogue: Catalogue) -> int:
    """Prints a line for each ready study, with what is still missing in its default output folder."""
    if not options.list:
        remedy = f"give a study file, or a ready study: {', '.join(catalogue.ready)}"
        raise InputError("", "STUDY", "is missing", remedy)
    if options.output is not None:
        raise InputError("", "--output", "is of one study, and --list without STUDY is of all", "name the study")
    try:
        programs: dict[str, Program] | None = find_drivers(options, PROGRAMS)
    except InputError as error:
        if options.monolithic or options.partitioned:
            raise
        say_warning(f"finished runs cannot be counted: {error}")
        programs = None
    maker = find_mesh_maker(programs["fsi-monolithic"]) if programs else None
    print("\n".join(overview(catalogue, options.quick, programs, options.threads, maker)))
    return 0


def about(report: "Report", asked: Study, runner: Runner, programs: dict[str, Program]) -> None:
    """How to make the report again, and on what it was made."""
    report.section("About this report")
    report.text(*(f"**Note:** {note}." for note in (runner.warning, runner.machines) if note))
    versions = ", ".join(f"{name} {program.version}" for name, program in programs.items())
    report.text(
        f"Study `{printable(asked.path.name)}`{', quick form' if asked.quick else ''}; {versions}; {runner.threads} "
        f"thread{'s' if runner.threads > 1 else ''} per {'run' if runner.processes == 1 else 'process'}, "
        f"{'' if runner.processes == 1 else f'{runner.processes} processes per run, '}{runner.jobs} "
        f"run{'s' if runner.jobs > 1 else ''} at once, on {processor()}; the runs took "
        f"{duration(runner.seconds)} in all. Written {time.strftime('%Y-%m-%d')}. The command of each run is "
        "in its folder's `study_run.json`, under `runs/`."
    )


def processor() -> str:
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.machine() or "an unknown processor"
