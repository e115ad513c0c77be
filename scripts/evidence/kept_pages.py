"""Puts what pages quote from kept tables (docs/data/*.csv) where they quote it, so that no figure can be stale.

usage: python3 scripts/evidence/kept_pages.py           writes the pages anew
       python3 scripts/evidence/kept_pages.py --check   says what is stale, exit code 1, and writes nothing

How a page of docs/, or the README, quotes:
  <!-- from: data/NAME.csv --> ... <!-- end -->             the table as it is
  <!-- from: data/NAME.csv, FUNCTION --> ... <!-- end -->   what a function of scripts/evidence/kept_blocks.py makes of it
  2.1<!-- NAME: column=value, column=value; COLUMN -->      a number: of the row with these values, with as many digits
  <!-- numbers: kept -->                                    on a page: it has no number but in code, links and what is above
"""

import re
import sys
from decimal import Decimal
from pathlib import Path
from typing import Dict, Iterator, List, NoReturn, Tuple

from kept_blocks import BLOCKS, BlockError
from kept_tables import Row, read_table

BLOCK = re.compile(r"(<!-- from: data/([\w-]+)\.csv(?:, (\w+))? -->\n)(.*?)(<!-- end -->)", re.DOTALL)
QUOTE = re.compile(r"([-+]?\d[\d,]*(?:\.\d+)?(?:e[-+]?\d+)?)(<!-- ([\w-]+): ([^;<>]*); ([^;<>]+?) -->)")
ANY_MARK = re.compile(r"<!-- (?:from: data/|[\w-]+: [^<>]*;)")
ALL_KEPT = "<!-- numbers: kept -->"
# What is no number of a measurement: code, links, comments, headings' anchors, and names that hold digits.
NO_NUMBERS = re.compile(r"`[^`]*`|\]\([^)]*\)|<[^>]*>|\b[A-Za-z][\w-]*")


class PageError(Exception):
    """A mark that cannot be followed."""


def renewed(text: str, data: Path) -> str:
    """The page with everything that it quotes as the tables have it. Raises PageError."""
    tables: Dict[str, List[Row]] = {}

    def table(name: str) -> List[Row]:
        if name not in tables:
            try:
                tables[name] = read_table(data / f"{name}.csv")
            except (OSError, ValueError) as error:
                raise PageError(str(error)) from None
        return tables[name]

    def block(match: "re.Match[str]") -> str:
        begin, name, function, _, end = match.groups()
        rows = table(name)
        if function is not None and function not in BLOCKS:
            raise PageError(f"'{function}' is no function of scripts/evidence/kept_blocks.py")
        try:
            made = BLOCKS[function](rows) if function else as_it_is(rows)
        except (BlockError, KeyError, ValueError, IndexError) as error:
            raise PageError(f"data/{name}.csv: {function} does not understand it: {error}") from None
        return f"{begin}\n{made}\n\n{end}"

    def quote(match: "re.Match[str]") -> str:
        shown, mark, name, where, column = match.groups()
        return like(shown, found(table(name), name, where, column)) + mark

    marks = len(ANY_MARK.findall(text))
    if marks != len(BLOCK.findall(text)) + len(QUOTE.findall(text)):
        raise PageError("a mark is not complete: a number before it, '; COLUMN' or <!-- end --> is missing")
    return QUOTE.sub(quote, BLOCK.sub(block, text))


def found(rows: List[Row], name: str, where: str, column: str) -> str:
    """The one cell that a mark means."""
    wanted: List[Tuple[str, ...]] = [tuple(part.strip() for part in pair.split("=", 1)) for pair in where.split(",")]
    for key in [*(pair[0] for pair in wanted), column]:
        if key not in rows[0]:
            raise PageError(f"data/{name}.csv has no column '{key}'; it has {', '.join(rows[0])}")
    fitting = [row for row in rows if all(row[pair[0]] == pair[-1] for pair in wanted)]
    if len(fitting) != 1:
        raise PageError(f"data/{name}.csv has {len(fitting)} rows with {where}; name one")
    return fitting[0][column]


def like(shown: str, value: str) -> str:
    """`value` with as many significant digits as `shown` has, two where that is a whole number, and never less than its whole
    part."""
    try:
        number, old = Decimal(value), Decimal(shown.replace(",", ""))
    except ArithmeticError:
        raise PageError(f"'{value}' is no number") from None
    digits = len(old.as_tuple().digits) if "." in shown else 2
    rounded = Decimal(f"{number:.{max(digits, number.adjusted() + 1) - 1}e}")
    if old in (number, rounded):
        return shown
    return f"{rounded:,f}" if abs(rounded) >= 1000 else f"{rounded:f}"


def as_it_is(rows: List[Row]) -> str:
    columns = list(rows[0])
    lines = [columns, ["---"] * len(columns), *([row[name] for name in columns] for row in rows)]
    return "\n".join(f"| {' | '.join(map(grouped, line))} |" for line in lines)


def grouped(cell: str) -> str:
    """Whole numbers of four and more digits with commas between thousands."""
    return f"{int(cell):,}" if re.fullmatch(r"[1-9]\d{3,}", cell) else cell


def loose_numbers(text: str) -> Iterator[str]:
    """Numbers of a page that says it has none, by line."""
    rest = QUOTE.sub("", BLOCK.sub("", text))
    for line in rest.splitlines():
        for number in re.findall(r"\d[\d.,/]*", NO_NUMBERS.sub(" ", line)):
            yield f"'{number}' in '{line.strip()[:80]}'"


def pages(top: Path) -> List[Path]:
    return [top / "README.md", *sorted((top / "docs").rglob("*.md"))]


def stale(top: Path, write: bool) -> List[str]:
    """What is wrong with the pages; what is merely stale is mended where `write` is set."""
    problems = []
    for page in pages(top):
        text = page.read_text(encoding="utf-8")
        try:
            new = renewed(text, top / "docs" / "data")
        except PageError as error:
            problems.append(f"{page.relative_to(top)}: {error}")
            continue
        if ALL_KEPT in new:
            problems += [f"{page.relative_to(top)}: {what} is from no kept table" for what in loose_numbers(new)]
        if new != text and write:
            page.write_text(new, encoding="utf-8")
            print(page.relative_to(top))
        elif new != text:
            old, now = next(
                pair for pair in zip(text.splitlines() + [""], new.splitlines() + [""]) if pair[0] != pair[1]
            )
            problems.append(
                f"{page.relative_to(top)}: '{old[:100]}' should be '{now[:100]}'; run scripts/evidence/kept_pages.py"
            )
    return problems


def main(words: List[str]) -> int:
    if words not in ([], ["--check"]):
        print(__doc__, file=sys.stderr)
        return 1
    try:
        problems = stale(Path(__file__).resolve().parents[2], not words)
    except OSError as error:
        fail(str(error))
    for problem in problems:
        print(f"kept_pages: {problem}", file=sys.stderr)
    return 1 if problems else 0


def fail(text: str) -> NoReturn:
    print(f"kept_pages: error: {text[:1000]}", file=sys.stderr)
    sys.exit(1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
