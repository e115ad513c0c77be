"""Damage to the files that fsi-compare reads: to values of JSON and TOML, to columns and lines of CSV, to whole files."""

import copy
import datetime
import json
import math
import os
import shutil
from functools import partial

LONG = "a" * 5000
DEEP = 100_000  # levels


def nested(depth):
    value = []
    for _ in range(depth):
        value = [value]
    return value


VALUES = (
    None,
    [],
    [[]],
    {},
    {"a": {"b": [1]}},
    "x",
    "",
    True,
    0,
    -1,
    0.5,
    -2.5e-7,
    1e308,
    10**400,
    -(10**30),
    math.nan,
    math.inf,
    "\x1b[31mred\x07\r\n",
    "a/../../b",
    LONG,
    nested(60),
)
ONLY_JSON = ("\ud800", "\0")
ONLY_TOML = (datetime.date(1979, 5, 27), datetime.time(7, 32))


def places(value, path=()):
    """Paths of all entries below the top."""
    pairs = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, entry in pairs:
        yield (*path, key)
        yield from places(entry, (*path, key))


def replaced(tree, path, value):
    """A copy with another value at the path; `value` None: without the entry."""
    tree = copy.deepcopy(tree)
    owner = tree
    for key in path[:-1]:
        owner = owner[key]
    if value is None:
        del owner[path[-1]]
    else:
        owner[path[-1]] = value
    return tree


def renamed(tree, path, name):
    tree = copy.deepcopy(tree)
    owner = tree
    for key in path[:-1]:
        owner = owner[key]
    if isinstance(owner, dict):
        owner[name] = owner.pop(path[-1])
    return tree


NAMES = ("", " ", "A" + LONG, "a/b", "..", "x\ny", "\x1b[2J", "ä", "TUBE", "__proto__")


def json_damages(tree):
    """(what, function that gives the text) of a JSON file with one entry replaced, missing or renamed."""
    for path in places(tree):
        where = ".".join(map(str, path))
        yield f"{where} missing", partial(_json, replaced, tree, path, None)
        yield f"{where} null", partial(_json, _with_null, tree, path)
        for value in (*VALUES[1:], *ONLY_JSON):
            yield f"{where} = {_shown(value)}", partial(_json, replaced, tree, path, value)


def _json(change, *arguments):
    return json.dumps(change(*arguments))


def _with_null(tree, path):
    tree = replaced(tree, path, 0)
    owner = tree
    for key in path[:-1]:
        owner = owner[key]
    owner[path[-1]] = None
    return tree


def toml_damages(tree):
    """The same of a TOML file."""
    for path in places(tree):
        where = ".".join(map(str, path))
        yield f"{where} missing", partial(_changed_toml, replaced, tree, path, None)
        for value in (*VALUES[1:], *ONLY_TOML):
            yield f"{where} = {_shown(value)}", partial(_changed_toml, replaced, tree, path, value)
        if isinstance(path[-1], str):
            for name in NAMES:
                yield f"{where} named {_shown(name)}", partial(_changed_toml, renamed, tree, path, name)


def _changed_toml(change, *arguments):
    return toml_text(change(*arguments))


def _shown(value):
    return ascii(value)[:40] if not isinstance(value, int) or abs(value) < 10**30 else "huge"


def toml_text(tree):
    return "".join(f"{_toml_key(key)} = {_toml(value)}\n" for key, value in tree.items())


def _toml_key(key):
    return json.dumps(key, ensure_ascii=True)


def _toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_toml_key(key)} = {_toml(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return repr(value)
    return json.dumps(value, ensure_ascii=True) if isinstance(value, str) else str(value)


def csv_damages(text):
    """(what, text) of a CSV file."""
    lines = text.splitlines()
    head, rows = lines[0].split(","), [line.split(",") for line in lines[1:]]

    def joined(head, rows):
        return "\n".join([",".join(head), *(",".join(row) for row in rows)]) + "\n"

    middle = len(rows) // 2
    for i, name in enumerate(head):
        yield f"no column {name}", joined(head[:i] + head[i + 1 :], [row[:i] + row[i + 1 :] for row in rows])
        yield f"{name} renamed", joined([*head[:i], "other", *head[i + 1 :]], rows)
        yield f"{name} twice", joined([*head, name], [[*row, row[i]] for row in rows])
        for word in (
            "x",
            "",
            " ",
            "nan",
            "-inf",
            "1e999",
            "1_0",
            "-1",
            "0",
            "1e300",
            "-1e300",
            "\x1b[1m",
            "0x10",
            "1;2",
        ):
            changed = [list(row) for row in rows]
            changed[middle][i] = word
            yield f"{name} {word!r} in line {middle + 2}", joined(head, changed)
            yield f"{name} {word!r} in all lines", joined(head, [[*row[:i], word, *row[i + 1 :]] for row in rows])
    yield "header only", lines[0] + "\n"
    yield "one row", joined(head, rows[:1])
    yield "two rows", joined(head, rows[:2])
    yield "half", text[: len(text) // 2]
    yield "half of the rows", joined(head, rows[:middle])
    yield "rows doubled", joined(head, [row for row in rows for _ in range(2)])
    yield "rows twice over", joined(head, rows + rows)
    yield "rows reversed", joined(head, rows[::-1])
    yield "a row missing", joined(head, rows[:middle] + rows[middle + 1 :])
    yield "a field missing", joined(head, [*rows[:middle], rows[middle][:-1], *rows[middle + 1 :]])
    yield "a field more", joined(head, [*rows[:middle], [*rows[middle], "1"], *rows[middle + 1 :]])
    yield "an empty line", joined(head, [*rows[:middle], [""], *rows[middle:]])
    yield "a long line", joined(head, [*rows[:middle], ["9" * 1_000_000] * len(head), *rows[middle:]])
    yield "no header", joined(rows[0], rows[1:])
    yield "Windows line ends", text.replace("\n", "\r\n")
    yield "a byte order mark", "\ufeff" + text
    yield "semicolons", text.replace(",", ";")


def file_damages(path):
    """(what, act) where `act()` puts something else in the place of a file."""
    content = path.read_bytes()

    def put(data):
        return lambda: path.write_bytes(data)

    def instead(make):
        def act():
            path.unlink()
            make()

        return act

    yield "missing", path.unlink
    yield "empty", put(b"")
    yield "blank", put(b" \n\n")
    yield "not UTF-8", put(b"\xff\xfe" + content)
    yield "random bytes", put(bytes((7 * i * i + 3) % 256 for i in range(5000)))
    yield "zeros", put(bytes(5000))
    yield "half", put(content[: len(content) // 2])
    yield "deep lists", put(b"[" * DEEP)
    yield "deep objects", put(b'{"a":' * DEEP)
    yield "deep TOML", put(b"a = " + b"[" * DEEP)
    yield "a number of 5000 digits", put(b'{"program": ' + b"9" * 5000 + b"}")
    yield "a folder", instead(path.mkdir)
    yield "a pipe", instead(lambda: os.mkfifo(path))
    yield "a link to itself", instead(lambda: path.symlink_to(path.name))
    yield "a link to nothing", instead(lambda: path.symlink_to("nothing"))
    yield "/dev/zero", instead(lambda: path.symlink_to("/dev/zero"))
    yield "/dev/full", instead(lambda: path.symlink_to("/dev/full"))


def remove(path):
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    elif path.is_symlink() or path.exists():
        path.unlink()
