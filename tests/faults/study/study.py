"""Disturbs fsi-compare: damaged result folders and study files, strange environments, streams that are closed or full,
small disks, signals, kills, and several calls in one folder. Each must be refused with one message, go unharmed, or
end as asked; nothing half written and no process may be left.

    python3 tests/faults/run.py study --programs build/release/bin --full [--parts contents,studies,...]
"""

import itertools
import json
import random
import shutil
import time
import tomllib

from harness import Harness, is_one_message

import mutations
import outside
from stand import PLAIN, READY, Stand, write_run

REFUSED, UNHARMED, INTERRUPTED, ENDED = "refused with one message", "unharmed", "interrupted with one message", "ended"
GOOD = (REFUSED, UNHARMED, INTERRUPTED, ENDED)
PROGRAM = "fsi-compare"
RESULTS = ("skip", "coupling", "stability", "accuracy-cost", "paper")  # kinds of ready studies


def verdict(harness, stand, what, result, arguments):
    """Counts one call in this process; a refusal must leave nothing."""
    code, out, err = result
    problem = ""
    if "unexpected:" in err:
        problem = "unexpected exception"
    elif not isinstance(code, int):
        problem = "did not end" if code is None else "escaped exception"
    elif stand.left_over():
        problem = f"left {stand.left_over()[:3]}"
    elif code == 1 and (not is_one_message(err, PROGRAM) or out or stand.out.exists() and "study" not in arguments):
        problem = "not one message and nothing else"
    elif code not in (0, 1, 2):
        problem = f"exit code {code}"
    elif not all(line.isprintable() and line.startswith(f"{PROGRAM}: ") for line in err.splitlines()):
        problem = "said what it should not"
    elif code == 0 and not_finite(stand.out):
        problem = f"exit code 0 with {not_finite(stand.out)}"
    if problem:
        harness.count(problem, f"{what}: {arguments[0]}: {code} {err.strip()[-300:]}")
    else:
        harness.count(REFUSED if code == 1 else UNHARMED, what)
    stand.clear()


def not_finite(folder):
    """The first CSV of a result that holds a value that is not finite."""
    if folder.is_dir():
        for path in sorted(folder.glob("*.csv")):
            fields = set(path.read_text(encoding="utf-8").lower().replace("\n", ",").split(","))
            if fields & {"nan", "inf", "-inf"}:
                return path.name
    return ""


def chosen(harness, items, short, full=None):
    """Some at random; `full`: how many in the full form, None: all."""
    items = list(items)
    count = min(len(items), short if not harness.full else len(items) if full is None else full)
    latest = time.monotonic() + 60 * harness.options.minutes
    for done, item in enumerate(random.Random(harness.options.seed).sample(items, count)):
        if time.monotonic() > latest:
            print(f"time is over: {done} of {count} made", flush=True)
            return
        yield item


def contents(harness, stand):
    """Every file of a result folder that a command reads, damaged as a whole and in its values."""
    good = write_run(stand.base / "good", "fsi-partitioned")
    reference = stand.base / "reference"
    shutil.copytree(READY / "references" / "neo-hookean", reference)
    for file in reference.glob("*.csv"):  # shorter: what matters is that it is read
        lines = file.read_text().splitlines()
        file.write_text("\n".join(lines[: 1 + 181 * 4]) + "\n")
    run = stand.base / "run"
    times = ("--times", "0.5,1.5", "-q", "-o", stand.out)
    commands = {
        "pressure": ("pressure", good, run, *times),
        "cost": ("cost", run, good, "-q", "-o", stand.out),
        "accuracy": ("accuracy", good, run, *times),
        "kept": ("accuracy", reference, good, "--times", "1.6", "-q", "-o", stand.out),
    }
    files = {
        "pressure": (run / "summary.json", run / "centerline_pressure.csv"),
        "cost": (run / "summary.json", run / "iterations.csv", run / "coupling.csv"),
        "accuracy": (
            run / "summary.json",
            run / "iterations.csv",
            run / "centerline_pressure.csv",
            run / "wall_displacement.csv",
        ),
        "kept": (reference / "reference.json", reference / "averaged_pressure.csv"),
    }
    write_run(run, "fsi-partitioned")
    cases = []
    for name, paths in files.items():
        for path in paths:
            text = path.read_text()
            damages = (
                mutations.json_damages(json.loads(text)) if path.suffix == ".json" else mutations.csv_damages(text)
            )
            cases += [(name, path, what, data) for what, data in damages]
            cases += [(name, path, what, None) for what, _ in mutations.file_damages(path)]
    for name, path, what, data in chosen(harness, cases, 40):
        kept = path.read_bytes()
        if data is None:
            dict(mutations.file_damages(path))[what]()
        else:
            data = data() if callable(data) else data
            path.write_text(data, encoding="utf-8", errors="surrogatepass", newline="")
        result = stand.call(*commands[name])
        mutations.remove(path)
        path.write_bytes(kept)
        verdict(harness, stand, f"{path.parent.name}/{path.name}: {what}", result, commands[name])


def studies(harness, stand):
    """Study files: the plain kind is run, the ready ones are checked."""
    trees = {"plain": PLAIN}
    trees.update((path.stem, tomllib.loads(path.read_text())) for path in READY.glob("*.toml"))
    trees = {name: tree for name, tree in trees.items() if "kind" in tree}
    file = stand.base / "study.toml"
    for name, tree in trees.items():
        _absolute(tree, READY if name != "plain" else stand.base)
        cases = list(mutations.toml_damages(tree))
        file.write_text(mutations.toml_text(tree))
        cases += [(what, None) for what, _ in mutations.file_damages(file)]
        for what, text in chosen(harness, cases, 10 if name == "plain" else 5, 500):
            file.write_text(mutations.toml_text(tree) if text is None else text(), encoding="utf-8")
            if text is None:
                dict(mutations.file_damages(file))[what]()
            words = ("study", file, "-o", stand.out, "-q", *(() if name == "plain" else ("--list",)))
            code, out, err = stand.call(*words)
            mutations.remove(file)
            verdict(harness, stand, f"{name}.toml: {what}", (code, "" if code == 1 else out, err), words)


def _absolute(tree, folder):
    """Files are named relative to a study file, which lies elsewhere here."""
    for name, entry in tree["cases"].items():
        if isinstance(entry, dict):
            if "file" not in entry:
                continue  # a scene of the gallery
            entry["file"] = str((folder / entry["file"]).resolve())
        else:
            tree["cases"][name] = str((folder / entry).resolve())
    for case, reference in tree.get("report", {}).get("references", {}).items() if tree["kind"] != "stability" else ():
        tree["report"]["references"][case] = str((folder / reference).resolve())


def results(harness, stand):
    """Ready studies in their quick form, and one run of theirs that leaves a damaged file."""
    stand.size = (96, 0.125)
    for kind in RESULTS if harness.full else RESULTS[:1]:
        chance = random.Random(harness.options.seed)
        for _ in chosen(harness, range(10), 1):
            state = {"left": chance.randrange(12), "what": "nothing"}

            def spoil(folder):
                state["left"] -= 1
                if state["left"] != -1:
                    return
                files = sorted(path for path in folder.iterdir() if path.suffix in (".json", ".csv") and path.is_file())
                path = chance.choice(files)
                damages = dict(mutations.file_damages(path))
                text = path.read_text()
                make = (
                    mutations.json_damages(json.loads(text)) if path.suffix == ".json" else mutations.csv_damages(text)
                )
                contents = dict(make)
                what = chance.choice([*damages, *contents])
                state["what"] = f"{path.name}: {what}"
                if what in damages:
                    damages[what]()
                else:
                    data = contents[what]() if callable(contents[what]) else contents[what]
                    path.write_text(data, encoding="utf-8", errors="surrogatepass", newline="")

            stand.spoil = spoil
            words = ("study", kind, "--quick", "-q", "-o", stand.out)
            result = stand.call(*words, limit=120)
            stand.spoil = None
            verdict(harness, stand, f"{kind}, {state['what']}", result, words)


PARTS = {"contents": contents, "studies": studies, "results": results}


def main():
    outer = {name: getattr(outside, name) for name in outside.PARTS}

    def prepare(parser):
        parser.add_argument("--parts", help=f"some of {', '.join((*PARTS, *outer))}, separated by commas")
        parser.add_argument("--minutes", type=float, default=1e9, help="of each corpus; what is left is left out")

    harness = Harness("study", __doc__.split("\n\n")[0], GOOD, prepare)
    parts = harness.options.parts.split(",") if harness.options.parts else [*PARTS, *outer]
    stand = Stand(harness.base / "inside") if any(part in PARTS for part in parts) else None
    for part in parts:
        before = harness.counts.total()
        if part in PARTS:
            PARTS[part](harness, stand)
        else:
            outer[part](harness)
        print(f"{part}: {harness.counts.total() - before} runs", flush=True)
    harness.finish()


if __name__ == "__main__":
    main()
