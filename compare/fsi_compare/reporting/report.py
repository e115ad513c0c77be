"""A report in one HTML file: text, tables and pictures in reading order, nothing loaded from elsewhere. Every table is
written as CSV beside it, every picture as PNG and SVG, and the whole as Markdown, to be kept under version control."""

import base64
import html
import re
from pathlib import Path
from typing import Callable, List, Sequence

from matplotlib.figure import Figure

from ..base.files import replacing
from .layout import Table
from . import player as playing
from .pictures import write_figure

STYLE = """
:root { color-scheme: light; }
body { font: 16px/1.5 "DejaVu Sans", "Helvetica Neue", Arial, sans-serif; color: #111; background: #fff;
  max-width: 68rem; margin: 2rem auto; padding: 0 1.5rem; }
h1 { font-size: 1.7rem; line-height: 1.2; } h2 { font-size: 1.3rem; margin-top: 2.5rem; border-bottom: 1px solid #bbb; }
h3 { font-size: 1.05rem; margin-top: 1.6rem; }
.wide { overflow-x: auto; width: fit-content; max-width: min(100vw - 4rem, 50vw + 31rem); }
table { border-collapse: collapse; font-size: .85rem; margin: .6rem 0; }
caption { text-align: left; font-weight: bold; padding: .3rem 0; }
th, td { padding: .2rem .6rem; border-bottom: 1px solid #ddd; text-align: right; vertical-align: top; }
td { white-space: nowrap; } td.l { white-space: normal; }
th.l, td.l { text-align: left; } thead th { border-bottom: 1px solid #333; }
thead tr.groups th { border-bottom: none; text-align: center; }
figure { margin: 1.2rem 0; } figure img { max-width: 100%; height: auto; }
figcaption, .note { font-size: .85rem; color: #333; }
ol.answer { padding-left: 1.4rem; } ol.answer li { margin: .35rem 0; }
details { margin: 1.2rem 0; } summary { cursor: pointer; font-weight: bold; }
nav { font-size: .9rem; } code { font-family: "DejaVu Sans Mono", monospace; font-size: .85em; }
@media print { body { max-width: none; margin: 0; } figure, tr { break-inside: avoid; }
  .wide { max-width: 100%; overflow: visible; } .wide table { font-size: .6rem; }
  .wide td, .wide th { padding: .1rem .25rem; } }
"""


class Report:
    """`folder` must exist. Text may hold `code` and **bold** marks; everything else is shown as it stands."""

    def __init__(self, folder: Path, title: str):
        self.folder, self.title = folder, title
        self.written: List[Path] = []
        self._body: List[str] = []
        self._markdown: List[str] = [f"# {title}"]  # blocks with an empty line between them
        self._sections: List[str] = []
        self._plays = False

    def section(self, heading: str) -> None:
        self._sections.append(heading)
        self._body.append(f'<h2 id="s{len(self._sections)}">{_inline(heading)}</h2>')
        self._markdown.append(f"## {heading}")

    def subsection(self, heading: str) -> None:
        self._body.append(f"<h3>{_inline(heading)}</h3>")
        self._markdown.append(f"### {heading}")

    def text(self, *paragraphs: str) -> None:
        self._body += [f"<p>{_inline(paragraph)}</p>" for paragraph in paragraphs]
        self._markdown += paragraphs

    def list(self, items: Sequence[str]) -> None:
        if items:
            self._body.append("<ul>" + "".join(f"<li>{_inline(item)}</li>" for item in items) + "</ul>")
            self._markdown.append("\n".join(f"- {item}" for item in items))

    def answer(self, lines: Sequence[str]) -> None:
        """What was found, in words, one numbered sentence or two a line: the first section of a report."""
        self.section("The answer")
        self._body.append('<ol class="answer">' + "".join(f"<li>{_inline(line)}</li>" for line in lines) + "</ol>")
        self._markdown.append("\n".join(f"{number}. {line}" for number, line in enumerate(lines, 1)))

    def folded(self, heading: str, tables: Sequence[Table]) -> None:
        """Tables to look things up in: shut until the reader opens them."""
        self._body.append(f"<details><summary>{_inline(heading)}</summary>")
        self._markdown.append(f"<details><summary>{html.escape(heading, quote=False)}</summary>")
        for table in tables:
            self.table(table)
        self._body.append("</details>")
        self._markdown.append("</details>")

    def table(self, table: Table) -> None:
        self.written.append(table.write_csv(self.folder))
        self._body.append(_html_table(table))
        self._markdown.append(table.markdown("**{}**").strip())

    def figure(self, stem: str, draw: Callable[[], Figure], caption: str) -> None:
        """`draw` makes the figure under the common style (see pictures.write_figure)."""
        png, svg = write_figure(self.folder, stem, draw)
        self.written += [png, svg]
        self.image(png, caption)

    def player(self, player: playing.Player) -> None:
        """What a reader with JavaScript can move through. It does not print: pictures of the same belong beside it, or word of
        how to get them."""
        self._body.append(player.html())
        self._plays = True

    def image(self, png: Path, caption: str) -> None:
        data = base64.b64encode(png.read_bytes()).decode("ascii")
        text = re.sub(r"[`*]", "", caption)
        self._body.append(
            f'<figure><img alt="{html.escape(text, quote=True)}" src="data:image/png;base64,{data}">'
            f"<figcaption>{_inline(caption)}</figcaption></figure>"
        )
        self._markdown += [f"![{png.stem.replace('_', ' ')}]({png.name})", caption]

    def write(self) -> Path:
        """Writes `report.md` and `report.html`; the latter's path."""
        with replacing(self.folder / "report.md") as temporary:
            temporary.write_text("\n\n".join(self._markdown) + "\n", encoding="utf-8")
        links = " &middot; ".join(f'<a href="#s{i}">{_inline(name)}</a>' for i, name in enumerate(self._sections, 1))
        page = "\n".join(
            [
                "<!DOCTYPE html>",
                '<html lang="en">',
                "<head>",
                '<meta charset="utf-8">',
                '<meta name="viewport" content="width=device-width, initial-scale=1">',
                '<link rel="icon" href="data:,">',  # browsers ask for one otherwise
                f"<title>{html.escape(self.title)}</title>",
                f"<style>{STYLE}{playing.STYLE if self._plays else ''}</style>",
                "</head>",
                "<body>",
                f"<h1>{_inline(self.title)}</h1>",
                f"<nav>{links}</nav>",
                *self._body,
                *([playing.program()] if self._plays else []),
                "</body>",
                "</html>",
                "",
            ]
        )
        path = self.folder / "report.html"
        with replacing(path) as temporary:
            temporary.write_text(page, encoding="utf-8")
        self.written.append(path)
        return path


def _inline(text: str) -> str:
    text = html.escape(text, quote=False)
    text = re.sub(r"`([^`]+)`", r"<code>\1</code>", text)
    return re.sub(r"\*\*([^*]+)\*\*", r"<strong>\1</strong>", text)


def _html_table(table: Table) -> str:
    names = [name for _, name in table.heads]
    groups = [group for group, _ in table.heads]
    rows = [f"<caption>{_inline(table.title)}</caption>", "<thead>"]
    if any(groups):
        cells, i = [], 0
        while i < len(groups):
            span = 1
            while groups[i] and i + span < len(groups) and groups[i + span] == groups[i]:
                span += 1
            cells.append(f'<th colspan="{span}">{_inline(groups[i])}</th>')
            i += span
        rows.append('<tr class="groups">' + "".join(cells) + "</tr>")

    def line(cells: Sequence[str], tag: str) -> str:
        shown = []
        for column, cell in zip(table.shown, cells):
            side = ' class="l"' if column.left else ""
            shown.append(f"<{tag}{side}>{_inline(cell)}</{tag}>")
        return "<tr>" + "".join(shown) + "</tr>"

    rows += [line(names, "th"), "</thead>", "<tbody>", *(line(row, "td") for row in table.rows), "</tbody>"]
    notes = "".join(f'<p class="note">{_inline(note)}</p>' for note in table.notes)
    return '<div class="wide"><table>' + "".join(rows) + "</table></div>" + notes
