"""A report in one HTML file: text, tables and pictures in reading order, nothing loaded from elsewhere. Every table is
written as CSV beside it, every picture as PNG and SVG, and the whole as Markdown, to be kept under version control."""

import base64
from pathlib import Path
from typing import Any, Callable, Sequence

from matplotlib.figure import Figure

from ..base.files import write_text
from .layout import Table
from .coinciding import sentence_of_coinciding
from .pictures import write_figure, write_plot
from .player import Player
from .scene import ReportScene
from .templating import render
from .vessel_library import library


class Report:
    """`folder` must exist. Text may hold `code` and **bold** marks; everything else is shown as it stands."""

    def __init__(self, folder: Path, title: str):
        self.folder, self.title = folder, title
        self.written: list[Path] = []
        self._sections: list[str] = []
        self._blocks: list[tuple[str, dict[str, Any]]] = []  # name and values of macros in templates/blocks.*

    def _add(self, kind: str, **values: Any) -> None:
        self._blocks.append((kind, values))

    def section(self, heading: str) -> None:
        self._sections.append(heading)
        self._add("section", heading=heading, number=len(self._sections))

    def subsection(self, heading: str) -> None:
        self._add("subsection", heading=heading)

    def text(self, *paragraphs: str) -> None:
        for paragraph in paragraphs:
            self._add("text", paragraph=paragraph)

    def list(self, items: Sequence[str]) -> None:
        if items:
            self._add("list", items=items)

    def answer(self, lines: Sequence[str]) -> None:
        """The findings, one numbered sentence or two a line: the first section of a report."""
        self.section("The answer")
        self._add("answer", lines=lines)

    def folded(self, heading: str, tables: Sequence[Table]) -> None:
        """Tables to look things up in: shut until the reader opens them."""
        self.written += [table.write_csv(self.folder) for table in tables]
        self._add("folded", heading=heading, tables=tables)

    def table(self, table: Table) -> None:
        self.written.append(table.write_csv(self.folder))
        self._add("table", table=table)

    def places(self, table: Table, looks: Sequence[dict[str, Any]]) -> None:
        """A table whose rows turn the view of the scene, to what `looks` says of each."""
        self.written.append(table.write_csv(self.folder))
        self._add("places", table=table, looks=looks)

    def figure(self, stem: str, draw: Callable[[], Figure], caption: str) -> None:
        """`draw` makes the figure under the common style (see pictures.write_figure). The caption goes on with what
        lies on each other in it."""
        drawn: list[Figure] = []

        def keep() -> Figure:
            drawn.append(draw())
            return drawn[-1]

        png, svg = write_figure(self.folder, stem, keep)
        self.written += [png, svg]
        self.image(png, " ".join(part for part in (caption, *map(sentence_of_coinciding, drawn)) if part))

    def player(self, player: Player) -> None:
        """A player for readers with JavaScript. It does not print: put pictures of the same beside it, or how to get
        them."""
        self._add("player", **player.values())

    def still(self, stem: str, draw: Callable[[], Figure], caption: str) -> None:
        """A picture that is made of pixels, PNG alone."""
        png = write_plot(self.folder / f"{stem}.png", draw)
        self.written.append(png)
        self.image(png, caption)

    def scene(self, scene: ReportScene, stills: Sequence[tuple[str, Callable[[], Figure], str]]) -> None:
        """The vessel in space, drawn in the browser, and stills (stem, figure, caption) of it for print and for
        browsers without JavaScript or WebGL."""
        self._add("scene", library=library(), **scene.values())
        pictures = [(write_plot(self.folder / f"{stem}.png", draw), caption) for stem, draw, caption in stills]
        self.written += [png for png, _ in pictures]
        self._add("stills", images=[_image(png, caption) for png, caption in pictures])

    def image(self, png: Path, caption: str) -> None:
        self._add("image", **_image(png, caption))

    def write(self) -> Path:
        """Writes `report.md` and `report.html`; the latter's path."""
        kinds = {kind for kind, _ in self._blocks}
        values: dict[str, Any] = {"title": self.title, "sections": self._sections, "blocks": self._blocks}
        values |= {"plays": "player" in kinds, "shows": "scene" in kinds}
        for name in ("report.md", "report.html"):
            write_text(self.folder / name, render(f"{name}.j2", **values).rstrip("\n") + "\n")
        self.written.append(self.folder / name)
        return self.folder / name


def _image(png: Path, caption: str) -> dict[str, str]:
    return {"name": png.name, "caption": caption, "data": base64.b64encode(png.read_bytes()).decode("ascii")}
