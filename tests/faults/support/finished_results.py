"""Whether two result folders hold the same results: tables, checkpoint, fields, and the run's status."""

from harness import summary
from result_data import differing_arrays, without_seconds


def difference(folder, reference):
    """What tells a finished run from an undisturbed one, "" if nothing does."""
    try:
        if summary(folder).get("status") != "done":
            return "summary.json does not say done"
        for file in sorted(reference.glob("*.csv")):
            if without_seconds(folder / file.name) != without_seconds(file):
                return file.name
        for name in ("fields.xdmf", "fluid.xdmf", "wall.xdmf", "checkpoint.h5"):
            if (folder / name).read_bytes() != (reference / name).read_bytes():
                return name
        if differing_arrays(folder / "fields.h5", reference / "fields.h5"):
            return "fields.h5"
        if not (folder / "run.log").read_text(encoding="utf-8").endswith("info    done\n"):
            return "run.log does not end with done"
    except (OSError, IndexError, KeyError, UnicodeDecodeError) as error:
        return f"{type(error).__name__}: {error}"
    left = [file.name for file in folder.iterdir() if file.suffix == ".tmp"]
    return f"{left[0]} is left" if left else ""
