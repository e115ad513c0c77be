"""The ready studies, and what each still has to run: `fsi-compare study --list` without a name."""

from pathlib import Path

from ..starting.programs import Program
from .catalogue import Catalogue
from .runner import Runner
from .study_file import read_study

OUTPUTS = Path("results/studies")


def default_output(path: Path, quick: bool) -> Path:
    """Where a study writes unless it is told otherwise."""
    return OUTPUTS / (path.stem + ("-quick" if quick else ""))


def overview(
    catalogue: Catalogue, quick: bool, programs: dict[str, Program] | None, threads: int | None, mesh_maker: Path | None
) -> list[str]:
    """A line for each ready study: name, title, and how its default output folder stands. `programs`: by name; None:
    they are not built, and nothing is known of finished runs. Makes nothing."""
    paths = list(catalogue.ready.values())
    width = max((len(path.stem) for path in paths), default=0)
    lines = []
    for path in paths:
        study = read_study(path, catalogue.kinds, quick)
        output = default_output(path, quick)
        if not study.requests:
            state = "has no quick form" if quick else "holds nothing to run"
        elif programs is None:
            state = f"{len(study.requests)} runs asked for"
        else:
            runner = Runner(study, output, programs, mesh_maker, threads, quiet=True)
            standings = [runner.standing(study.requests)]
            also = getattr(catalogue.kind(study.kind), "also_standing", None)
            if also is not None:
                standings.append(also(study, runner))
            asked, finished, failed = (sum(numbers) for numbers in zip(*standings))
            bad = f" ({failed} failed)" if failed else ""
            state = f"{output}: {finished} of {asked} runs finished{bad}, {asked - finished} to run"
        lines.append(f"{path.stem:<{width}}  {study.title} ({state})")
    return lines
