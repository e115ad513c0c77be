"""Case files that are wrong: keys removed, doubled and of all values; bytes changed; files that are no files."""

import random
import re
import tomllib

from harness import CASES, TOP, execute
from trial import Trial

#: Values of all types and sizes. Those that are valid somewhere run there.
VALUES = (
    "0", "-1", "1", "2", "1.5", "-0.0", "1e300", "-1e300", "1e-300", "5e-324", "1e31", "1e-31", "1e101", "1e-101", "nan", "inf", "-inf",
    "2147483647", "2147483648", "-2147483648", "-2147483649", "9223372036854775807", "-9223372036854775808",
    "9223372036854775808", "true", "false", '""', '" "', '"a"', '"1"', f'"{"x" * 5000}"', '"\\u001b[31m\\u0007\\n\\u0000"',
    '"\u202e\u00e9\u4e2d"', '"../../../../../../etc/passwd"', '"/dev/zero"', "[]", "[[]]", "[1, 2, 3]", "[0, 0, 0]",
    "[1e30, 1e30, 1e30]", "[1e-30, 0, 0]", "[[0, 1], [1, 2]]", "[[1, 1], [0, 2]]", "[[0, 1], [0, 2], [0, 3]]",
    "[[0, nan]]", "[[0, 1e30], [1e-30, -1e30]]", '["a", 1]', "[" * 300 + "]" * 300, "[" * 100_000, "{}", "{ a = 1 }",
    "{ a = { b = { c = 1 } } }", "1979-05-27", "07:32:00", "0x7fffffff", "1_000", "+5", "", "=", "'", '"', '"""',
)  # fmt: skip

SYNTHETIC = {
    "plane.toml": """title = "a plane channel"
geometry = "axisymmetric"
element = "p1"
[mesh]
file = "tiny.msh"
[fluid]
density = 1.0
viscosity = 3.5e-3
[inlet]
pressure = [[0, 0], [1, 2.5], [1, 0], [3, 1]]
[time]
step = "adaptive"
end = 0.5
"""
}


#: Names of what is no file to read; "pipe" is made where the run is.
ODD_PATHS = (".", "/dev/null", "/dev/zero", "/proc/self/mem", "pipe", "x" * 5000, "\x1b[31m")


def emitted(value):
    """A value as TOML."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, list):
        return "[" + ", ".join(emitted(entry) for entry in value) + "]"
    return repr(value)


def flat(table, prefix=()):
    """(path, TOML text) of each key that is no section."""
    for name, value in table.items():
        if isinstance(value, dict):
            yield from flat(value, (*prefix, name))
        else:
            yield (*prefix, name), emitted(value)


def written(keys):
    """A case file from {path: TOML text}: each section once, in the order in which it comes first."""
    sections: dict[tuple, list[str]] = {}
    for path, text in keys.items():
        sections.setdefault(path[:-1], []).append(f"{path[-1]} = {text}")
    order = sorted(sections, key=lambda section: section != ())
    return "".join(
        ("" if section == () else "[" + ".".join(section) + "]\n") + "\n".join(sections[section]) + "\n"
        for section in order
    )


def ready_cases():
    """{name: keys} of the ready cases, each with the tiny mesh and one step."""
    cases = {}
    for file in sorted([*CASES.rglob("*.toml"), *(TOP / "compare/research/studies").glob("*.toml")]):
        table = tomllib.loads(file.read_text(encoding="utf-8"))
        if "mesh" not in table or not isinstance(table["mesh"], dict):
            continue  # a study file
        cases[str(file.relative_to(TOP))] = table
    for name, text in SYNTHETIC.items():
        cases[name] = tomllib.loads(text)
    quick = {}
    for name, table in cases.items():
        keys = dict(flat(table))
        keys = {path: text for path, text in keys.items() if path[0] != "mesh"}
        keys[("mesh", "file")] = '"tiny.msh"'
        if isinstance(table.get("time", {}).get("step"), float):
            keys[("time", "end")] = keys[("time", "step")]
        if ("static", "load_steps") in keys:
            keys[("static", "load_steps")] = "1"
        quick[name] = keys
    return quick


def known_keys(program):
    """Paths of all keys that a case file has, from --help-keys."""
    text = execute(program, "--help-keys").stdout
    paths = re.findall(r"^[* ] \[?([\w.]+)\]?", text, re.MULTILINE)
    return [tuple(path.replace("NAME", "media").split(".")) for path in dict.fromkeys(paths)]


def dimension(keys):
    return 2 if keys.get(("geometry",)) in ('"axisymmetric"', '"plane"') else 3


def trial(name, text, keys, meshes, program, keyed=False, options=()):
    content = text if isinstance(text, bytes) else text.encode("utf-8", "surrogatepass")
    return Trial(
        name,
        program,
        ["case.toml", "-o", "out", "-q", "--threads", "1", *options],
        {"case.toml": content, "tiny.msh": meshes[dimension(keys)]},
        ("case.toml", "tiny.msh", "--set"),
        keyed,
    )


def structural(cases, known, meshes, drivers):
    """Each key of each case: removed, doubled, and with each of the values, in the file and by --set."""
    for number, (name, keys) in enumerate(cases.items()):
        paths = list(dict.fromkeys([*known, *keys]))
        for path in paths:
            key = ".".join(path)
            driver = drivers[number % 2] if path[0] != "partitioned" else "fsi-partitioned"
            if path in keys:
                less = {other: text for other, text in keys.items() if other != path}
                yield trial(f"{name}: without {key}", written(less), keys, meshes, driver, True)
                text = written(keys)
                line = f"{path[-1]} = {keys[path]}\n"
                yield trial(f"{name}: {key} twice", text.replace(line, 2 * line, 1), keys, meshes, driver)
            for value in VALUES:
                more = {other: text for other, text in keys.items() if other[: len(path)] != path}
                more[path] = value
                # A value that is no TOML has a line, not a key.
                given = trial(f"{name}: {key} = {value[:40]}", written(more), keys, meshes, driver, parses(value))
                if path == ("mesh", "file"):
                    given.culprits = ()  # whatever file that is
                yield given
            value = VALUES[(len(key) + number) % len(VALUES)].replace("\0", "")
            yield trial(
                f"{name}: --set {key}={value[:40]}",
                written(keys),
                keys,
                meshes,
                driver,
                False,
                ["--set", f"{key}={value}"],
            )


def parses(value):
    try:
        tomllib.loads(f"a = {value}")
        return len(value) < 200
    except (tomllib.TOMLDecodeError, RecursionError):
        return False


def of_bytes(cases, meshes, drivers, seed):
    """Random bytes and lines changed, without end."""
    chance = random.Random(seed)
    alphabet = b"0123456789-+.eE\"'[]{}=#,\n \tabnix_\\\x00\x01\x1b\x7f\xc3\xff"
    names = list(cases)
    while True:
        name = chance.choice(names)
        text = bytearray(written(cases[name]).encode())
        for _ in range(chance.choice((1, 1, 2, 5))):
            at = chance.randrange(len(text))
            kind = chance.randrange(6)
            if kind == 0:
                text[at] = chance.choice(alphabet)
            elif kind == 1:
                text[at:at] = bytes([chance.choice(alphabet)])
            elif kind == 2:
                del text[at : at + chance.choice((1, 1, 10))]
            elif kind == 3:
                text[at:at] = text[at : at + 40]
            elif kind == 4:
                text[at] ^= 1 << chance.randrange(8)
            else:
                lines = bytes(text).split(b"\n")
                chance.shuffle(lines)
                text = bytearray(b"\n".join(lines))
            text = text or bytearray(b"\n")
        yield trial(
            f"{name}: bytes {chance.randrange(1 << 30)}", bytes(text), cases[name], meshes, chance.choice(drivers)
        )


def whole_files(cases, meshes, drivers):
    """What is wrong with a file as a whole."""
    name, keys = next(iter(cases.items()))
    text = written(keys)
    deep = {
        "empty": "",
        "a byte order mark": "\ufeff" + text,
        "carriage returns": text.replace("\n", "\r\n"),
        "carriage returns alone": text.replace("\n", "\r"),
        "zero bytes": "\0" * 10_000,
        "zeros behind": text + "\0",
        "Latin-1": b"title = \"caf\xe9\"\n" + text.encode(),
        "UTF-16": text.encode("utf-16"),
        "a surrogate": b"title = \"\xed\xa0\x80\"\n" + text.encode(),
        "a key of 100,000 parts": ".".join(["a"] * 100_000) + " = 1\n" + text,
        "a section of 100,000 parts": text + "[" + ".".join(["a"] * 100_000) + "]\n",
        "a quoted key of 100,000 parts": '"a".' * 100_000 + "a = 1\n" + text,
        "a key of 15 parts": text + ".".join(["a"] * 15) + " = 1\n",
        "inline tables in each other": text + "x = " + "{a=" * 10_000 + "1" + "}" * 10_000 + "\n",
        "inline tables with deep keys": text + "x = " + "{a.b.c.d.e.f.g=" * 250 + "1" + "}" * 250 + "\n",
        "dots in a string": text.replace("title", f'title = "{"." * 100}"\n#', 1),
        "a million comments": "#\n" * 1_000_000 + text,
        "a long line": "# " + "x" * 5_000_000 + "\n" + text,
        "too large": "#" * (17 << 20) + "\n" + text,
        "100,000 sections": text + "".join(f"[s{i}]\n" for i in range(100_000)),
        "100,001 rows": text.replace("[inlet]", "[inlets]") + f"[inlet]\npressure = {[[i, 1] for i in range(100_001)]}\n",
        "1,000 layers": text + "".join(f'[structure.layers.l{i}]\nmaterial = "neo-hookean"\nc10 = 1\n' for i in range(1000)),
        "a layer without name": text + '[structure.layers.""]\nmaterial = "neo-hookean"\nc10 = 1\n',
        "a layer of control characters": text + '[structure.layers."a\\nb\\u001b"]\nmaterial = "neo-hookean"\nc10 = 1\n',
        "an array of sections": text.replace("[fluid]", "[[fluid]]"),
    }  # fmt: skip
    for kind, content in deep.items():
        for driver in drivers:
            yield trial(f"{name}: {kind}", content, keys, meshes, driver)
    for path in (*ODD_PATHS, "case.toml/", "case.toml/x", ""):
        given = Trial(f"case file {path[:20]!r}", drivers[0], [path, "-o", "out"], {"case.toml": text.encode()})
        given.pipe = "pipe" if path == "pipe" else ""
        given.culprits = (path[:40],) if path.isprintable() and path != "" else ()
        yield given
    for path in (*ODD_PATHS, "case.toml", "tiny.msh/x"):
        options = ["--set", f"mesh.file={path}"]
        given = trial(f"mesh file {path[:20]!r}", text, keys, meshes, drivers[0], False, options)
        given.pipe = "pipe" if path == "pipe" else ""
        given.culprits = ()
        yield given
    for setting in ("", "=", "=1", "a", "a=", "time.end", "time.end=", "time..end=1", ".=1", "time=1", "time.end.x=1",
                    ".".join(["a"] * 50_000) + "=1", "time." * 20 + "end=1", "time.end=1\nx=2", "time.end=[[[[", "fluid=",
                    "structure.layers=[]", "title=\x1b[31m", "mesh.file=", "mesh.level=fine", "=" * 1000):  # fmt: skip
        yield trial(f"--set {setting[:40]!r}", text, keys, meshes, drivers[1], False, ["--set", setting])
