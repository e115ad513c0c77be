"""`fsi-compare tune`: Windkessels of a case for given pressures and flow splits."""

import argparse
import shlex
from pathlib import Path
from typing import Any, Mapping

from ..base.errors import InputError, ProgramError, printable, say_note, say_warning
from ..base.files import absolute, is_file, output_folder, read_toml, remove_tree, together
from ..base.options import DRIVERS, Commands, add_case, add_command, add_drivers, add_time_limit, add_usual, share
from ..reporting.layout import say_written
from ..results.run import open_run
from ..gallery.mesh_chain import with_places
from ..gallery.scene import read_scene as read_gallery_scene
from ..study.runner import Runner, sweep_study
from ..study.study_file import Request, StudyMesh, mesh_of_scene, method_of, study_of_case
from ..base.folder_lock import locked
from ..starting.programs import find_mesh_maker, find_program, no_mesh_maker
from ..verify.found_case import write_case
from ..verify.mesh_family import find_recipe, words_beside
from .curves import curves_of
from .scene import Scene, checked_targets, read_scene
from .solving import Rule
from .tables import write_results
from .targets import read_targets
from .tuning import BeatFailed, Demand, Outcome, Ran, tune

ONE_BEAT, TUNED = "one-beat.toml", "tuned.toml"
GIVE = "give a case file that a driver runs"
MOST_BEATS = 10

DESCRIPTION = """\
Finds the resistances and compliances of a case's Windkessels for pressures and flow
splits that are asked for. One beat is run as the case stands. A model without
dimensions of the vessel is fitted to its curves; the values are those with which the
model's periodic state has what is asked for. The next beat begins from them, and
from the model's pressures, and is fitted again.
A target is met where a beat itself shows it within the tolerance, and begins within
that of its periodic state. Finished beats are found again: a call that was killed
goes on. Writes to OUTDIR: tuned.toml, the case with the values found, where all
targets are met; targets.csv, values.csv, tune.md, tune.json, and the runs in runs/.
Exit code 2: not all targets are met.
"""

EXAMPLES = """\
examples:
  fsi-compare tune carotid.toml --pressure inlet=80/120mmHg --split ica=60% --split eca=40%
  fsi-compare tune tube.toml --mean-pressure outlet=12.4kPa --proximal kept
  fsi-compare tune carotid.toml --targets targets.toml --driver partitioned

a table of targets:
  [pressure]
  inlet = "80/120mmHg"
  [split]
  ica = "60%"
  eca = "40%"
"""


def add_parser(commands: Commands, version: str) -> None:
    help = "Windkessels for given pressures and flow splits"
    command = add_command(commands, "tune", run, help, DESCRIPTION, EXAMPLES)
    add_case(command, "tune")
    for option, metavar, text in (
        ("--pressure", "NAME=LOW/HIGH", "of one opening, diastolic and systolic, in kPa or mmHg"),
        ("--mean-pressure", "NAME=P", "in place of them"),
        ("--split", "NAME=N%", "share of the mean flow of an outlet"),
        ("--flow", "NAME=Q", "mean flow outwards, in ml/s, ml/min, l/min, mm3/ms"),
    ):
        command.add_argument(option, metavar=metavar, action="append", default=[], help=text)
    command.add_argument("--targets", metavar="FILE.toml", type=Path, help="the same in a table")
    text = "of an outlet's resistance that is before its compliance; kept: as in the case (default: 8%%)"
    command.add_argument("--proximal", metavar="N%", default="8%", help=text)
    text = "of each target (default: 1%%)"
    command.add_argument("--tolerance", metavar="N%", type=share("--tolerance"), default="1%", help=text)
    command.add_argument("--beats", metavar="N", type=int, default=3, help="at most (default: %(default)s)")
    text = "monolithic or partitioned (default: %(default)s)"
    command.add_argument("--driver", metavar="NAME", default="monolithic", help=text)
    command.add_argument("--mesh", metavar="WORDS", help="of the fsi-mesh command that makes the mesh, without -o")
    add_time_limit(command, "beat")
    add_drivers(command)
    add_usual(command, version, "of each run (default: 1)")


def run(options: argparse.Namespace) -> int:
    """Checks everything before the first beat."""
    given = {key: getattr(options, key) for key in ("pressure", "mean_pressure", "split", "flow")}
    targets = read_targets(given, options.targets)
    if options.driver not in DRIVERS:
        raise InputError("", "--driver", f"'{options.driver}' is no driver", f"give {' or '.join(DRIVERS)}")
    if not 1 <= options.beats <= MOST_BEATS:
        raise InputError("", "--beats", f"{options.beats} beats will not do", f"give 1 to {MOST_BEATS}")
    rule = Rule(None if options.proximal == "kept" else share("--proximal")(options.proximal))
    scene = read_scene(options.case, read_toml(options.case, GIVE, GIVE))
    demand = Demand(checked_targets(scene, targets), rule, options.tolerance, options.beats)
    place = options.output or Path("results", "tune", options.case.stem)
    with output_folder(place), locked(place):
        sweep_study(place)
        beats = Beats(options, scene, place)
        say = (lambda text: None) if options.quiet else say_note
        for line in decided(scene, demand):
            say(line)
        if scene.elastic and "prestress" not in scene.entries:
            words = "under a pressure like the one asked for it is thrown outwards first"
            say_warning(f"the wall has no [prestress]: {words}")
        return _write(options, scene, demand, tune(scene, demand, beats.run, say), beats)


def decided(scene: Scene, demand: Demand) -> list[str]:
    """Sentences on what was decided without the call saying it."""
    lines = [f"tuned: the Windkessels of {', '.join(scene.windkessels)}; a beat takes {scene.period:g} ms"]
    lines.append(f"proximal resistance: {demand.rule.words}; compliance: shared out like the mean flow")
    for target in demand.targets:
        if target.unit == "1":
            lines.append(f"{target.opening}: {100 * target.value:.4g} % of the flow")
    others = [name for name in scene.openings if name not in scene.windkessels]
    if others:
        lines.append(f"as the case has them: {', '.join(others)}")
    return lines


class Beats:
    """Runs them. The folder is locked."""

    def __init__(self, options: argparse.Namespace, scene: Scene, place: Path) -> None:
        self.scene, self.place, self.limit = scene, place, options.time_limit
        self.name = f"fsi-{options.driver}"
        program = find_program(self.name, getattr(options, options.driver), f"--{options.driver}")
        mesh_maker = find_mesh_maker(program)
        self.mesh = mesh_of_beats(scene, options.mesh, mesh_maker, place)
        self.method = method_of(options.driver)
        self.case = self._case()
        methods = {options.driver: self.method}
        name, threads = scene.path.stem, options.threads or 1
        study = study_of_case(scene.path, "tune", name, self.case, methods, threads, self.limit)
        self.runner = Runner(study, place, {self.name: program}, mesh_maker, options.threads, 1, options.quiet)

    def _case(self) -> Path:
        """The user's file, or one without what ends a run by its periods, which one beat has not."""
        time = dict(self.scene.entries["time"])
        if "periods" not in time:
            return self.scene.path
        del time["periods"]
        if time.get("start") != "lumped":
            time.pop("period", None)
        path = self.place / ONE_BEAT
        words = f"{printable(str(self.scene.path))} without time.periods, for single beats"
        write_case(path, {**self.scene.entries, "time": time}, absolute(self.scene.path.parent), [words])
        return path

    def run(self, number: int, settings: Mapping[str, Any]) -> Ran:
        """Runs one beat. Raises InputError where the first one fails, BeatFailed where a later one does."""
        name, merged = self.scene.path.stem, {"time.end": self.scene.period, **settings}
        request = Request("beats", name, self.method, {"beat": number}, self.case, self.mesh, merged, self.limit)
        done = self.runner.run([request])[0]
        if not done.done:
            message = done.message or done.status
            if number > 1:
                raise BeatFailed(message)
            raise ProgramError(self.scene.path, f"beat {number}", message, "mend the case first")
        return Ran(curves_of(open_run(done.folder).openings), done.seconds)


def mesh_of_beats(scene: Scene, words: str | None, mesh_maker: Path | None, place: Path) -> StudyMesh | None:
    """How it is made; None: it is the case's own file or level. Raises InputError."""
    section = scene.entries.get("mesh", {})
    own = section.get("file") if isinstance(section, dict) else None
    if words is None and (own is None or is_file(scene.path.parent / str(own))):
        return None
    if mesh_maker is None:
        raise no_mesh_maker()
    folder = scene.path.parent
    if words is None and is_file(folder / "scene.py") and folder.name == scene.path.stem:
        return mesh_of_scene(read_gallery_scene(folder), False)
    made = words_beside(scene.path, scene.entries) if words is None else shlex.split(words)
    if made:
        command, *others = with_places(made, folder if words is None else Path("."))
        return StudyMesh(scene.path.stem[:40], "", tuple(others), command)
    return find_recipe(scene.path, scene.entries, words, mesh_maker).mesh(1.0, place, scene.path.stem)


def _write(options: argparse.Namespace, scene: Scene, demand: Demand, outcome: Outcome, beats: Beats) -> int:
    with together(beats.place) as inside:
        tables, written = write_results(inside, scene, demand, outcome, beats.name)
        if outcome.reached:
            written.insert(0, _write_tuned(inside, scene, outcome, beats))
    if not outcome.reached:
        remove_tree(beats.place / TUNED)  # of an earlier call
    if not options.quiet:
        print("\n".join([*(table.text() for table in tables[:2]), *map(printable, outcome.lines)]))
        say_written(beats.place, written)
    return 0 if outcome.reached else 2


def _write_tuned(inside: Path, scene: Scene, outcome: Outcome, beats: Beats) -> Path:
    """`tuned.toml`: the case with the values of the beat that shows what is asked for."""
    last = outcome.beats[-1]
    entries = dict(scene.entries)
    entries["opening"] = [_tuned(one, last.values, last.starts) for one in scene.entries["opening"]]
    if last.starts and "start" in entries["time"]:
        entries["time"] = {**entries["time"], "start": "given"}
    mesh = beats.runner.mesh_file(beats.mesh)
    if mesh is not None:
        entries["mesh"] = {"file": str(absolute(mesh))}
    words = f"{printable(str(scene.path))} with the Windkessels that fsi-compare tune has found:"
    path = inside / TUNED
    write_case(path, entries, absolute(scene.path.parent), [words, *outcome.lines])
    return path


def _tuned(opening: Mapping[str, Any], values: Mapping[str, Any], starts: Mapping[str, float]) -> dict[str, Any]:
    name = str(opening.get("surface"))
    if name not in values:
        return dict(opening)
    found = {**opening["windkessel"], **values[name].values}
    if name in starts:
        found["initial_pressure"] = starts[name]
    return {**opening, "windkessel": found}
