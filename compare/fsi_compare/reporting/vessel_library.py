"""The library that draws the scene in a browser: three.js of Debian's libjs-three, copied into the page."""

import json
from pathlib import Path
from typing import NamedTuple

from .scene_packing import deflated

PACKAGE = "libjs-three"
PROGRAM = Path("/usr/share/javascript/three/three.min.js")
ABOUT = Path("/usr/share/nodejs/three/package.json")
COPYRIGHT = Path("/usr/share/doc/libjs-three/copyright")
REMEDY = f"install the Debian package {PACKAGE} and make the report again to turn it"
MISSING = f"the vessel is shown as still pictures: {REMEDY}"


class Library(NamedTuple):
    name: str
    version: str
    licence_name: str
    licence: str  # its words
    program: str  # deflated, in base64


def library() -> Library | None:
    """Reads three.js; None where the package is not installed."""
    try:
        program = PROGRAM.read_text(encoding="utf-8")
    except OSError:
        return None
    return Library("three.js", _version(), "MIT", _licence(), deflated(program.encode("utf-8")))


def _version() -> str:
    try:
        return str(json.loads(ABOUT.read_text(encoding="utf-8"))["version"])
    except (OSError, ValueError, KeyError, TypeError):
        return "of Debian"


def _licence() -> str:
    """The holders and the words of the licence, from the package's own file."""
    try:
        text = COPYRIGHT.read_text(encoding="utf-8")
    except OSError:
        return "MIT licence (Expat): see the Debian package libjs-three."
    copyrights = [line for line in text.splitlines() if line.startswith("Copyright:") and "three.js authors" in line]
    holders = copyrights[0].removeprefix("Copyright:").strip() if copyrights else ""
    words = text.partition("\nLicense: Expat\n Permission")[2]
    lines = ("Permission" + words).split("\n\n")[0].splitlines() if words else []
    return "\n".join([holders, "", *("" if line.strip() == "." else line.strip() for line in lines)])
