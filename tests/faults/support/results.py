"""What the harnesses ask of a result folder."""

from pathlib import Path

TIMED = ("iterations.csv", "coupling.csv")  # hold seconds, which differ from run to run
OTHERS = ("summary.json", "run.log", "run.lock")  # likewise


def broken_tables(folder):
    """Names of the CSV files in which something is no row of numbers, or a row is not whole."""
    broken = []
    for file in sorted(Path(folder).glob("*.csv")):
        header, *rows = file.read_bytes().split(b"\n")
        columns = header.count(b",")
        whole = bool(rows) and rows[-1] == b"" and all(row.count(b",") == columns for row in rows[:-1])
        try:
            for row in rows[:-1]:
                [float(cell) for cell in row.split(b",")]
        except ValueError:
            whole = False
        if not whole:
            broken.append(file.name)
    return broken


def differences(folder, reference):
    """Names of the files that a run should have left with other contents than the reference."""
    folder, reference = Path(folder), Path(reference)
    names = sorted(file.name for file in reference.iterdir())
    if sorted(file.name for file in folder.iterdir()) != names:
        return ["the list of files"]
    found = broken_tables(folder)
    for name in names:
        if name in OTHERS:
            continue
        one, other = (place / name for place in (folder, reference))
        if name in TIMED:
            if one.read_bytes().count(b"\n") != other.read_bytes().count(b"\n"):
                found.append(name)
        elif one.read_bytes() != other.read_bytes():
            found.append(name)
    return found


def contents(folder):
    """All files of a folder with what they hold, for "nothing was changed"; {} where there is none."""
    folder = Path(folder)
    if not folder.is_dir():
        return {}
    return {
        file.name: file.read_bytes() for file in sorted(folder.iterdir()) if file.is_file() and not file.is_symlink()
    }
