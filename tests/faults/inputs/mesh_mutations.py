"""Mesh files that are wrong, in both versions, as text and as binary data."""

import random
import struct

from trial import Trial

WHOLE = (0, 1, -1, 2, 3, 4, 15, 99, 2147483647, 2147483648, -2147483648, 9223372036854775807, 18446744073709551615)
TEXTS = (
    *(str(number) for number in WHOLE),
    "nan",
    "inf",
    "1e300",
    "-1e300",
    "1e-300",
    "1e29",
    "x",
    '"',
    "1.5",
    "",
    "\0",
    "$",
)
DOUBLES = (float("nan"), float("inf"), 1e300, -1e300, 1e29, 5e-324, 0.0, -1.0)


def sections(text):
    """[[name, lines]] of a text file, without the markers."""
    found = []
    for line in text.splitlines():
        if line.startswith("$End"):
            continue
        if line.startswith("$"):
            found.append([line[1:], []])
        elif found:
            found[-1][1].append(line)
    return found


def joined(parts):
    return "".join(f"${name}\n" + "".join(f"{line}\n" for line in lines) + f"$End{name}\n" for name, lines in parts)


def lines_of(parts, name):
    return next(lines for section, lines in parts if section == name)


def edits(text):
    """(what, text) for each way to spoil a text file that can be said in words."""

    def made(change):
        parts = sections(text)
        change(parts)
        return joined(parts)

    names = [section for section, _ in sections(text)]
    for name in names:
        yield f"without ${name}", made(lambda parts, name=name: parts.remove(next(p for p in parts if p[0] == name)))
        yield f"${name} twice", made(lambda parts, name=name: parts.append(next(p for p in parts if p[0] == name)))
        yield f"${name} first", made(lambda parts, name=name: parts.sort(key=lambda part: part[0] != name))
        yield f"${name} empty", made(lambda parts, name=name: lines_of(parts, name).clear())
        yield f"no end of ${name}", text.replace(f"$End{name}", "")
        yield f"half of ${name}", made(lambda parts, name=name: shorten(lines_of(parts, name), 2))
        yield f"last line of ${name} missing", made(lambda parts, name=name: lines_of(parts, name).pop())
        yield f"first line of ${name} missing", made(lambda parts, name=name: lines_of(parts, name).pop(0))
        yield f"a line of ${name} twice", made(
            lambda parts, name=name: lines_of(parts, name).append(lines_of(parts, name)[-1])
        )
        yield f"${name} in reverse", made(lambda parts, name=name: lines_of(parts, name).reverse())
        yield f"an unknown section in ${name}", text.replace(f"$End{name}", f"$Other\n1\n$EndOther\n$End{name}")
        # Every number of the first two lines, which count what follows.
        for row in range(min(2, len(lines_of(sections(text), name)))):
            for column in range(len(lines_of(sections(text), name)[row].split())):
                for value in TEXTS:
                    yield (
                        f"${name}, line {row + 1}, word {column + 1}: {value!r}",
                        made(lambda parts, n=name, r=row, c=column, v=value: put(lines_of(parts, n), r, c, v)),
                    )
    if "PhysicalNames" in names:
        rows = lines_of(sections(text), "PhysicalNames")
        for number in range(1, len(rows)):
            group = rows[number].split()[-1]
            yield f"group {group} missing", made(lambda parts, n=number: drop_name(lines_of(parts, "PhysicalNames"), n))
            yield f"group {group} renamed", text.replace(group, '"other"')
            yield f"group {group} without name", text.replace(group, '""')
            yield f"group {group} with a long name", text.replace(group, f'"{"x" * 100_000}"')
            yield f"group {group} with control characters", text.replace(group, '"a\x1b[31m\nb"')
            for other in range(1, number):
                second = rows[other].split()[-1]
                swap = text.replace(group, "GROUP").replace(second, group).replace("GROUP", second)
                yield f"groups {group} and {second} exchanged", swap
                yield f"group {group} called {second}", text.replace(group, second)
    yield "a crack", crack(text)
    for factor in ("1e-200", "1e-31", "1e-9", "1000", "1e9", "1e29", "1e31", "0", "-1", "nan"):
        yield f"coordinates times {factor}", scaled(text, float(factor))


def shorten(lines, part):
    del lines[len(lines) // part :]


def put(lines, row, column, value):
    words = lines[row].split()
    words[column] = value
    lines[row] = " ".join(words)


def drop_name(lines, number):
    del lines[number]
    lines[0] = str(int(lines[0]) - 1)


def coordinate_rows(lines):
    """Numbers of the lines that hold three coordinates, in both versions."""
    return [
        row for row, line in enumerate(lines) if len(line.split()) in (3, 4) and "." in line or line.endswith(" 0 0")
    ]


def scaled(text, factor):
    parts = sections(text)
    lines = lines_of(parts, "Nodes")
    for row in coordinate_rows(lines):
        words = lines[row].split()
        lines[row] = " ".join([*words[:-3], *(repr(float(word) * factor) for word in words[-3:])])
    return joined(parts)


def crack(text):
    """The last node in the place of the first."""
    parts = sections(text)
    lines = lines_of(parts, "Nodes")
    rows = coordinate_rows(lines)
    if len(rows) > 1:
        lines[rows[-1]] = " ".join([*lines[rows[-1]].split()[:-3], *lines[rows[0]].split()[-3:]])
    return joined(parts)


def random_text(text, chance):
    """Words, lines and characters changed by chance."""
    lines = text.splitlines()
    for _ in range(chance.choice((1, 1, 2))):
        at = chance.randrange(len(lines))
        words = lines[at].split()
        kind = chance.randrange(7)
        if kind <= 2 and words:
            words[chance.randrange(len(words))] = chance.choice(TEXTS)
            lines[at] = " ".join(words)
        elif kind == 3 and len(words) > 1:
            first, second = chance.randrange(len(words)), chance.randrange(len(words))
            words[first], words[second] = words[second], words[first]
            lines[at] = " ".join(words)
        elif kind == 4:
            del lines[at]
        elif kind == 5:
            lines.insert(at, lines[at])
        elif kind == 6:
            other = chance.randrange(len(lines))
            lines[at], lines[other] = lines[other], lines[at]
        lines = lines or [""]
    return "\n".join(lines) + "\n"


def random_binary(data, chance):
    data = bytearray(data)
    for _ in range(chance.choice((1, 1, 2, 4))):
        at = chance.randrange(len(data) - 8)
        kind = chance.randrange(5)
        if kind == 0:
            data[at] ^= 1 << chance.randrange(8)
        elif kind == 1:
            data[at : at + 4] = struct.pack("<I", chance.choice(WHOLE) & 0xFFFFFFFF)
        elif kind == 2:
            data[at : at + 8] = struct.pack("<Q", chance.choice(WHOLE) & 0xFFFFFFFFFFFFFFFF)
        elif kind == 3:
            data[at : at + 8] = struct.pack("<d", chance.choice(DOUBLES))
        else:
            del data[at : at + chance.choice((1, 4, 8))]
    return bytes(data)


def mutations(meshes, case_of, drivers, seed):
    """Trials of each kind: in words, truncated, and by chance without end. `meshes`: {(name): bytes}."""

    def trial(what, name, content, number):
        return Trial(
            f"{name}: {what}",
            drivers[number % 2],
            ["case.toml", "-o", "out", "-q", "--threads", "1"],
            {"case.toml": case_of(name), "tiny.msh": content},
            ("tiny.msh", "case.toml"),
            True,
        )

    in_words, cut = [], []
    for name, content in meshes.items():
        if not name.endswith("binary"):
            for number, (what, text) in enumerate(edits(content.decode())):
                in_words.append(trial(what, name, text.encode(), number))
        for size in [*range(0, len(content), 1024), *range(1, 60, 7), len(content) - 1, len(content) - 12]:
            cut.append(trial(f"first {size} bytes", name, content[:size], size))
    return in_words, cut, by_chance(meshes, trial, seed)


def by_chance(meshes, trial, seed):
    chance = random.Random(seed)
    while True:
        name = chance.choice(list(meshes))
        change = random_binary if name.endswith("binary") else lambda data, c: random_text(data.decode(), c).encode()
        number = chance.randrange(1 << 30)
        yield trial(f"by chance {number}", name, change(meshes[name], chance), number)
