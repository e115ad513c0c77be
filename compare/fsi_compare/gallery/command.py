"""`fsi-compare gallery`: runs the scenes of the gallery with both drivers and makes its page."""

import argparse
import sys

from ..base.errors import printable, say_error
from ..base.files import folder, make_folder
from ..base.options import Commands, add_command, add_count, add_drivers, add_output, add_usual
from ..base.folder_lock import locked
from ..starting.programs import find_drivers, need_mesh_maker
from .running import make_runs
from .scene import BOTH, PEERS, READY, Number, find_scenes

DESCRIPTION = """\
Runs scenes of the gallery with both drivers, holds what they compute against what is known, and writes to OUTDIR:
  report.html           the page, in one file
  report.md             its text and tables, pictures by name
  NAME/                 of each scene: its mesh and its result folders
Exit code 2: a run failed, or a number is further from what is known than it may be."""


def add_parser(commands: Commands, version: str) -> None:
    help = "runs the scenes of the gallery and makes its page"
    command = add_command(commands, "gallery", gallery, help, DESCRIPTION)
    command.add_argument("scenes", metavar="SCENE", nargs="*", help="names of scenes (default: all but the long ones)")
    add_output(command, "results/gallery")
    text = "a gallery of your own"
    command.add_argument("--from", metavar="FOLDER", type=folder, dest="source", default=READY, help=text)
    text = "cases of other programs (docs/evidence/peers.md)"
    command.add_argument("--peers", action="store_const", const=READY / PEERS, dest="source", help=text)
    command.add_argument("--long", action="store_true", help="all scenes, those that take minutes, too")
    command.add_argument("--quick", action="store_true", help="the short forms, a second or two each")
    command.add_argument("--list", action="store_true", help="say what there is, and run nothing")
    add_count(command, "--jobs", "runs at once (default: 2)", 2)
    add_count(command, "--processes", "of each run, by mpirun (default: 1, without mpirun)", 1)
    add_drivers(command)
    add_usual(command, version, "accepted as by all programs; a run has one thread")


def gallery(options: argparse.Namespace) -> int:
    """The command. Raises InputError."""
    scenes = find_scenes(options.scenes, options.source)
    if options.list:
        for scene in scenes:
            print(f"{scene.name:<24} {scene.title}{' (long)' if scene.long else ''}")
        return 0
    if not options.scenes and not options.long:
        scenes = [scene for scene in scenes if not scene.long]
    drivers = find_drivers(options, BOTH)
    mesh_maker = need_mesh_maker(drivers["fsi-monolithic"])

    def said(text: str) -> None:
        if not options.quiet:
            print(printable(text), file=sys.stderr, flush=True)

    make_folder(options.output)
    with locked(options.output):
        how = options.quick, options.jobs, options.processes
        outcomes = make_runs(scenes, options.output, mesh_maker, drivers, *how, said)
        from .page import write_page  # matplotlib takes a second to load

        report, numbers = write_page(options.output, outcomes, options.quick, options.jobs)
    failed = [f"{o.scene.name}: {program}: {why}" for o in outcomes for program, why in o.failures.items()]
    wrong = [_too_far(number) for number in numbers if not number.holds]
    for text in failed + wrong:
        say_error(text)
    if not options.quiet:
        print(f"{len(numbers) - len(wrong)} of {len(numbers)} numbers as known; {options.output / 'report.html'}")
    return 2 if failed or wrong else 0


def _too_far(number: Number) -> str:
    return (
        f"{number.what}: {number.value:.6g} {number.unit} by {number.program} differs by {100 * number.error:.2g} % from "
        f"{number.reference:.6g}, may by {100 * number.tolerance:.2g} %"
    )
