"""Pages from the templates in `templates/`, by Jinja2. Text in HTML is escaped, unless a template says otherwise."""

import html
import re
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined, select_autoescape
from markupsafe import Markup

FOLDER = Path(__file__).parent / "templates"


def render(template: str, **values: Any) -> str:
    return _environment.get_template(template).render(**values)


def inline(text: str) -> Markup:
    """HTML of a text that may hold `code` and **bold** marks; everything else is shown as it stands."""
    marked = re.sub(r"`([^`]+)`", r"<code>\1</code>", html.escape(text, quote=False))
    return Markup(re.sub(r"\*\*([^*]+)\*\*", r"<strong>\1</strong>", marked))


def without_marks(text: str) -> str:
    return re.sub(r"[`*]", "", text)


def file(name: str) -> Markup:
    """A style or a program, as it stands."""
    return Markup((FOLDER / name).read_text(encoding="utf-8"))


_environment = Environment(
    loader=FileSystemLoader(FOLDER),
    autoescape=select_autoescape(["html.j2"]),
    undefined=StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
    keep_trailing_newline=True,
)
_environment.filters.update(inline=inline, without_marks=without_marks)
_environment.globals.update(file=file)
_environment.policies["json.dumps_kwargs"] = {"separators": (",", ":"), "allow_nan": False}
