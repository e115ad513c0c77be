"""Reads the part of a Containerfile's language that containers/Containerfile keeps to, and refuses the rest.

    containerfile.py FILE [NAME=VALUE...]

prints one instruction a line, its words separated by tabs: `root NAME`, `environment NAME=VALUE`, `folder PATH`,
`copy STAGE SOURCE... TARGET` (`.` for the sources in place of a stage), `run COMMAND`, `entry WORD...`. The values
given take the place of the defaults of ARG.
"""

import json
import re
import shlex
import sys
from pathlib import Path
from typing import Iterator, List, Sequence, Tuple

BASE = "debian:12"
NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")


class Refused(Exception):
    """What stands there is not part of the language, or wrong."""


def instructions(text: str) -> Iterator[Tuple[int, str, str]]:
    """Number of the first line, keyword and the rest, with lines joined that end in a backslash; comments left out."""
    first, joined = 0, ""
    for number, line in enumerate(text.splitlines(), start=1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        first = first if joined else number
        joined += line.strip()
        if joined.endswith("\\"):
            joined = joined[:-1].rstrip() + " "
            continue
        keyword, _, rest = joined.partition(" ")
        yield first, keyword, rest.strip()
        joined = ""
    if joined:
        raise Refused(f"{first}: the file ends within this instruction")


class Reader:
    """The instructions so far: which stages there are, and what the next one may refer to."""

    def __init__(self, arguments: Sequence[str]) -> None:
        self.arguments = dict(word.split("=", 1) for word in arguments)
        self.stages: List[str] = []
        self.entry = False

    def read(self, keyword: str, rest: str) -> List[str]:
        readers = {
            "FROM": self.read_from,
            "ARG": self.read_argument,
            "ENV": self.read_environment,
            "WORKDIR": self.read_folder,
            "COPY": self.read_copy,
            "RUN": self.read_run,
            "ENTRYPOINT": self.read_entry,
        }
        if keyword not in readers:
            raise Refused(f"'{keyword}' is not known here; known are {', '.join(readers)}")
        if keyword != "FROM" and not self.stages:
            raise Refused(f"{keyword} before the first FROM")
        if keyword != "RUN" and "$" in rest:
            raise Refused(f"{keyword} with a variable; those are known in RUN alone")
        return readers[keyword](rest)

    def read_from(self, rest: str) -> List[str]:
        words = rest.split()
        if words[:1] != [BASE] or len(words) not in (1, 3) or (len(words) == 3 and words[1].upper() != "AS"):
            raise Refused(f"FROM {rest}: only '{BASE}', or '{BASE} AS name'")
        self.stages.append(words[2] if len(words) == 3 else str(len(self.stages)))
        self.entry = False
        return ["root", self.stages[-1]]

    def read_argument(self, rest: str) -> List[str]:
        name, sign, value = rest.partition("=")
        if not NAME.fullmatch(name) or not sign:
            raise Refused(f"ARG {rest}: 'NAME=default', the default may be empty")
        return ["environment", f"{name}={self.arguments.get(name, value)}"]

    def read_environment(self, rest: str) -> List[str]:
        words = shlex.split(rest)
        if not words or not all(NAME.fullmatch(word.partition("=")[0]) and "=" in word for word in words):
            raise Refused(f"ENV {rest}: 'NAME=value', one or more")
        return ["environment", *words]

    def read_folder(self, rest: str) -> List[str]:
        if not rest.startswith("/"):
            raise Refused(f"WORKDIR {rest}: a path from the root")
        return ["folder", rest]

    def read_copy(self, rest: str) -> List[str]:
        words, stage = rest.split(), "."
        if words and words[0].startswith("--"):
            option, _, stage = words.pop(0).partition("=")
            if option != "--from" or stage not in self.stages[:-1]:
                raise Refused(f"COPY {rest}: the only option is --from=STAGE, with a stage above")
        if len(words) < 2 or not words[-1].startswith("/") or "*" in rest:
            raise Refused(f"COPY {rest}: paths without wildcards, the last one from the root")
        if len(words) > 2 and not words[-1].endswith("/"):
            raise Refused(f"COPY {rest}: several are copied into a folder, whose path ends in /")
        return ["copy", stage, *words]

    def read_run(self, rest: str) -> List[str]:
        if not rest or rest.startswith(("[", "--", "<<")):
            raise Refused(f"RUN {rest}: a shell's command without options")
        return ["run", rest]

    def read_entry(self, rest: str) -> List[str]:
        try:
            words = json.loads(rest)
        except json.JSONDecodeError:
            words = None
        if not isinstance(words, list) or not words or not all(isinstance(word, str) for word in words):
            raise Refused(f'ENTRYPOINT {rest}: ["PROGRAM", "ARGUMENT", ...]')
        self.entry = True
        return ["entry", *words]


def read(text: str, arguments: Sequence[str] = ()) -> List[List[str]]:
    """All instructions, as words."""
    reader, result = Reader(arguments), []
    for line, keyword, rest in instructions(text):
        try:
            words = reader.read(keyword, rest.replace("\t", " "))
        except Refused as refusal:
            raise Refused(f"{line}: {refusal}") from None
        result.append(words)
    if not reader.entry:
        raise Refused("1: the last stage has no ENTRYPOINT")
    return result


def main() -> None:
    file, *arguments = sys.argv[1:]
    try:
        for words in read(Path(file).read_text(encoding="utf-8"), arguments):
            print("\t".join(words))
    except Refused as refusal:
        sys.exit(f"{file}:{refusal}")
    except OSError as error:
        sys.exit(f"{file}: {error.strerror}")


if __name__ == "__main__":
    main()
