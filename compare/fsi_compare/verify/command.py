"""`fsi-compare verify`: how wrong the results of a case are."""

import argparse
from pathlib import Path
from typing import Any, Sequence

from ..base.errors import InputError, printable
from ..base.files import absolute, output_folder, together
from ..base.options import Commands, add_case, add_command, add_drivers, add_time_limit, add_usual
from ..base.options import DRIVERS, positive_number, share
from ..reporting.layout import say_written
from ..reporting.matplotlib_loader import load_matplotlib
from ..reporting.pressure import read_times
from ..study.runner import Runner, sweep_study
from ..base.folder_lock import locked
from ..starting.duration import duration
from ..starting.programs import Program, find_drivers, need_mesh_maker
from .adapting import adapted
from .doubt import step_within
from .family import CaseFacts, Member, Requests, read_case
from .lean import starting_member
from .making import Maker
from .mesh_family import find_recipe
from .preparing import PRINTED, plan, sample, samples_nothing, tell_ends, tell_mesh, tell_other_mesh, tell_unpaid
from .preparing import tell_unrefined, within_budget
from .results import BarsOfRun, Judged, bands, judge
from .search import Demand, Search, by_each_driver, write_found
from .tables import bars_table, counts, write_json

MOST_LEVELS = 6

DESCRIPTION = """\
How wrong the results of a case are: its error bars, from a family of runs around it.
The family has steps twice and half as long, meshes coarser and finer, both at once, and
looser tolerances. Each quantity that the case samples gets a value, what it may be off
by, how much of that is mesh, step and solver, the observed orders, and a verdict:
  converges as its elements do
  converges, bar widened
  not in the range where an error can be given: what to refine
The meshes are made anew by the words of --mesh; without it by what the case or the
gallery says of its mesh, by a script .geo beside the mesh file, or from the mesh file
itself, by fsi-mesh refine. Finished runs are found again: a call that was killed goes
on. Writes to OUTDIR: report.html, report.md, bars.csv, members.csv, verification.json,
and the runs in runs/. Exit code 2: a member of the family is missing.
"""

EXAMPLES = """\
examples:
  fsi-compare verify gallery/cooks-membrane/cooks-membrane.toml
  fsi-compare verify tube.toml --mesh "geo tube.geo --order 2" --drivers monolithic,partitioned
  fsi-compare verify dome.toml --mesh "geo dome.geo | thicken --layer wall=0.3:2"
  fsi-compare verify vessel.toml --mesh "lumen vessel.stl --opening in=1 --opening out=2 \\
    --edges-per-diameter 6 | thicken --thickness-ratio 0.2 --layer wall=100%:2"
  fsi-compare verify tube.toml --of "outlet: flow" --times 5,10
"""


def add_parser(commands: Commands, version: str) -> None:
    help = "error bars on a case of one's own, from a family of runs"
    command = add_command(commands, "verify", verify, help, DESCRIPTION, EXAMPLES)
    add_case(command, "verify")
    text = "of the fsi-mesh command that makes the case's mesh, without -o; several with | between, each of the file of the "
    command.add_argument("--mesh", metavar="WORDS", help=text + "one before")
    text = "monolithic, partitioned (default: %(default)s)"
    command.add_argument("--drivers", metavar="A,B", default="monolithic", help=text)
    text = "quantities whose name holds this; may be repeated"
    command.add_argument("--of", metavar="NAME", action="append", default=[], help=text)
    command.add_argument("--times", metavar="T,T,...", help="times in ms at which curves are verified, too")
    text = "meshes of the family, 3 to 6 (default: %(default)s)"
    command.add_argument("--levels", metavar="N", type=int, default=3, help=text)
    text = "no member finer than the case itself: cheaper, wider bars"
    command.add_argument("--coarser", action="store_true", help=text)
    text = "finer members by fsi-mesh adapt, from the error indicator of the run on the mesh before"
    command.add_argument("--adapt", action="store_true", help=text)
    budget = positive_number("--budget", "min is no time", "give a positive number of minutes")
    text = "that all runs of the family may take together"
    command.add_argument("--budget", metavar="MINUTES", type=budget, help=text)
    add_time_limit(command, "run")
    text = "go on to settings whose bars are within this, like 2%%: see found.toml"
    command.add_argument("--error", metavar="E", type=share("--error"), help=text)
    command.add_argument("--list", action="store_true", help="say which runs would be made, and make none")
    add_drivers(command)
    add_usual(command, version, "of each run (default: 1)")


def verify(options: argparse.Namespace) -> int:
    """Checks everything before the first run."""
    names = _drivers(options.drivers)
    if not 3 <= options.levels <= MOST_LEVELS:
        raise InputError("", "--levels", f"{options.levels} meshes will not do", f"give 3 to {MOST_LEVELS}")
    facts = read_case(options.case)
    times = _times(options.times, facts)
    programs = find_drivers(options, [f"fsi-{name}" for name in names])
    mesh_maker = need_mesh_maker(next(iter(programs.values())))
    recipe = find_recipe(options.case, facts.entries, options.mesh, mesh_maker)
    if options.adapt:
        recipe = adapted(recipe, dimension_of(facts))
    family = plan(recipe, facts, options)
    if options.list:
        print("\n".join(f"{name}: {member.name}" for name in names for member in family))
        return 0
    place = options.output or Path("results", "verify", options.case.stem)
    with output_folder(place), locked(place):
        members_of = names if options.error is None else names[:1]  # the others solve the same equations
        requests = Requests(facts, recipe, place, members_of, options.time_limit)
        return make(options, requests, family, programs, mesh_maker, times)


def dimension_of(facts: CaseFacts) -> int:
    return 3 if facts.entries.get("geometry", "3d") == "3d" else 2


def _times(text: str | None, facts: CaseFacts) -> list[float]:
    """Times in ms. Raises InputError for those that the case has not."""
    times = read_times(text)
    first = 0.0 if facts.adaptive else facts.step
    if times and facts.static:
        raise InputError("", "--times", "a static case has none", "leave it out: its last load counts")
    for time in times:
        if not first * (1 - 1e-9) <= time <= facts.end * (1 + 1e-9):
            problem = f"{time:g} ms is before the first step of the case, or after its end"
            raise InputError("", "--times", problem, f"give times from {first:g} to {facts.end:g} ms")
    return times


def _drivers(text: str) -> list[str]:
    names = [name.strip() for name in text.split(",")]
    for name in names:
        if name not in DRIVERS:
            raise InputError("", "--drivers", f"'{name}' is no driver", f"give {' or '.join(DRIVERS)}, or both")
    return list(dict.fromkeys(names))


def make(
    options: argparse.Namespace,
    requests: Requests,
    family: Sequence[Member],
    programs: dict[str, Program],
    mesh_maker: Path,
    times: Sequence[float],
) -> int:
    """The folder is locked."""
    place = requests.folder
    sweep_study(place)
    study = requests.study(options.threads or 1)
    runner = Runner(study, place, programs, mesh_maker, options.threads, 1, options.quiet)
    facts = requests.facts
    maker = Maker(runner, requests, dimension_of(facts), options.quiet, options.of)
    tell_mesh(maker, requests.recipe)
    tell_other_mesh(maker)
    if options.error is not None:
        return seek(options, maker, times, programs)
    sample(maker)
    if options.budget is not None:
        family = within_budget(options, maker, family)
    maker.run(family)
    sets, waves = look(maker, facts, times, options.of)
    return write(options, maker, [one for each in sets for one in each.judged], waves, sets)


def seek(options: argparse.Namespace, maker: Maker, times: Sequence[float], programs: dict[str, Program]) -> int:
    """--error: on to settings that reach it."""
    requests = maker.requests
    demand = Demand(options.error, options.budget and 60 * options.budget, options.of, times)
    ratio = requests.recipe.ratio(list(range(-1, options.levels + 1)))
    facts, longest = requests.facts, step_within(requests.facts)
    start = starting_member(requests.recipe, facts.static, ratio, options.levels, maker.nodes, longest)
    search = Search(maker, demand, ratio, options.levels, start)
    first = search.corner if search.crosses else start
    if sample(maker, first) != first:
        search = Search(maker, demand, ratio, options.levels, Member(1.0, 1.0))
    outcome = search.go()
    seconds = by_each_driver(maker, outcome, [name.removeprefix("fsi-") for name in programs])
    for name, run in seconds.items():
        took = duration(run.seconds) if run.done else f"{run.status}, {run.message}"
        outcome.lines.append(f"fsi-{name} with these settings: {took}.")
    outcome.lines.append(f"All runs took {duration(maker.seconds)}.")
    maker.notes += outcome.lines
    with together(requests.folder) as inside:
        written = [path.name for path in write_found(inside, maker, outcome, seconds)]
    code = write(options, maker, outcome.judged, [], list(search.sets.values()))
    if not options.quiet:
        print("\n".join(map(printable, outcome.lines)))
        if written:
            print(f"The case with these settings: {printable(str(requests.folder / written[0]))}")
    return code if outcome.reached else 2


def look(
    maker: Maker, facts: CaseFacts, times: Sequence[float], names: Sequence[str]
) -> tuple[list[BarsOfRun], list[Any]]:
    """All bars, by driver, and bands. Raises InputError where nothing is sampled, or nothing of that name."""
    sets: list[BarsOfRun] = []
    waves: list[Any] = []
    for family in maker.families.values():
        curves = family.read()
        found = judge(family, curves, facts, times, names)
        if family.own is not None and found:
            sets.append(BarsOfRun(family.driver, family.own, found))
        waves += bands(family, curves, found)
    if not sets:
        if names:
            problem = "no quantity has this in its name"
            raise InputError("", f"--of {' '.join(names)}", problem, "leave it out to see all names")
        raise samples_nothing(facts)
    return sets, waves


def write(
    options: argparse.Namespace, maker: Maker, judged: Sequence[Judged], waves: Sequence[Any], sets: Sequence[BarsOfRun]
) -> int:
    """`judged`: the bars to show; `sets`: all that were made, each with its run."""
    facts = maker.requests.facts
    place = maker.requests.folder
    families = list(maker.families.values())
    tell_unpaid(maker, judged)
    tell_ends(maker, families, read_times(options.times))
    unrefined = tell_unrefined(maker, families)
    maker.notes += unrefined
    title = printable(str(facts.entries.get("title") or facts.path.stem))
    with together(place) as inside:
        load_matplotlib()
        from .page import write_page

        report = write_page(inside, title, [printable(note) for note in maker.notes], judged, waves, families)
        about = {"case": str(absolute(facts.path)), "title": title, "notes": maker.notes}
        report.written.append(write_json(inside, about, sets, families))
    if not options.quiet:
        print(bars_table(judged).text())
        print("\n".join([*counts(judged), *(note for note in maker.notes if note in (*PRINTED, *unrefined))]))
        say_written(place, [path for path in report.written if path.suffix in (".csv", ".html", ".json", ".md")])
    return 2 if any(family.failures for family in families) else 0
