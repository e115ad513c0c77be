"""Mutated inputs: case files, meshes and command lines that are wrong in some way, run by the programs.

A run may refuse its input (exit 1, one message with the file, and the key where there is one, nothing written), run
(exit 0, finite numbers only), end without convergence (exit 2, one message), or be stopped when it has much to do.
Everything else is wrong: signals, hangs, several lines, a sanitizer's report.
"""

import concurrent.futures
import itertools
import shutil

import case_mutations
import command_lines
import mesh_mutations
from harness import DRIVERS, Harness, execute
from trial import GOOD, run

AXISYMMETRIC = "meshes/artery/axisymmetric/neo-hookean.toml"
CUBIC = "meshes/artery/neo-hookean.toml"


def options(parser):
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time")
    parser.add_argument("--sanitized", action="store_true", help="the programs are a build with sanitizers")
    parser.add_argument("--count", type=int, help="this many runs in place of the full form's")
    parser.add_argument("--only", default="", help="runs whose name holds this text")


def mesh(harness, *arguments):
    file = harness.base / "made.msh"
    small = ("--size", 2, "--axial-size", 1, "--length", 2)
    made = execute(harness.program("fsi-mesh"), "artery", "-q", *small, *arguments, "-o", file)
    if made.returncode != 0:
        raise SystemExit(f"inputs: cannot make a mesh: {made.stderr}")
    return file.read_bytes()


def made_meshes(harness):
    """{name: bytes}: dimension, order, version, text or binary."""
    meshes = {}
    for shape, kind in (("3d", ()), ("axisymmetric", ("--axisymmetric",))):
        for order in ("1", "2"):
            for version in ("2.2", "4.1"):
                for data in ("text", "binary"):
                    flags = (*kind, "--order", order, "--format", version, *(("--binary",) if data == "binary" else ()))
                    meshes[f"{shape} order {order} {version} {data}"] = mesh(harness, *flags)
    return meshes


def trials(harness):
    """(kind, trials, share of the runs) for each kind; the shares add up to 1."""
    meshes = made_meshes(harness)
    tiny = {3: meshes["3d order 1 4.1 text"], 2: meshes["axisymmetric order 1 4.1 text"]}
    cases = case_mutations.ready_cases()
    known = case_mutations.known_keys(harness.program(DRIVERS[0]))
    seed = harness.options.seed

    def case_of(name):
        return case_mutations.written(cases[CUBIC if name.startswith("3d") else AXISYMMETRIC]).encode()

    structural = list(case_mutations.structural(cases, known, tiny, DRIVERS))
    whole = list(case_mutations.whole_files(cases, tiny, DRIVERS))
    in_words, cut, by_chance = mesh_mutations.mutations(meshes, case_of, DRIVERS, seed)
    mesh_options = list(itertools.islice(command_lines.mesh_lines(seed), 1200))
    driver_lines = command_lines.drivers_lines(case_of("axisymmetric"), tiny[2], DRIVERS, seed)
    return [
        (structural, 0.34),
        (whole, 0.02),
        (case_mutations.of_bytes(cases, tiny, DRIVERS, seed), 0.12),
        (in_words, 0.2),
        (cut, 0.03),
        (by_chance, 0.15),
        (mesh_options, 0.06),
        (driver_lines, 0.08),
    ]


def chosen(kinds, total):
    """Evenly from each finite kind, the first ones of each endless kind."""
    for some, share in kinds:
        count = max(1, round(share * total))
        if isinstance(some, list):
            step = max(1.0, len(some) / count)
            yield from (some[int(i * step)] for i in range(min(count, len(some))))
        else:
            yield from itertools.islice(some, count)


def main():
    harness = Harness("inputs", __doc__, GOOD, options)
    total = harness.options.count or (6000 if harness.full else 60)
    selected = [trial for trial in chosen(trials(harness), total) if harness.options.only in trial.name]

    def one(number, trial):
        folder = harness.base / f"{number}"
        verdict, seen = run(trial, harness.program(trial.program), folder, harness.options.sanitized)
        if verdict in GOOD or not harness.options.keep:
            shutil.rmtree(folder, ignore_errors=True)
        return verdict, f"{number} {trial.program} {trial.name}: {seen}"

    with concurrent.futures.ThreadPoolExecutor(harness.options.jobs) as pool:
        for verdict, what in pool.map(one, range(len(selected)), selected):
            harness.count(verdict, what)
    harness.finish()


if __name__ == "__main__":
    main()
