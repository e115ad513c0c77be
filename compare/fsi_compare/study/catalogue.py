"""What a program has of studies: the kinds, by name, and the ready study files.

A kind is a module with `check(study)`, which raises InputError before the first run when the study is incomplete, and
`evaluate(context)`, which fills the report and returns the exit code, 0 where it returns nothing. A kind that runs more
than the study lists may have `also_runs(study)`, lines for --list, and `also_standing(study, runner)`, how many of
those are there."""

import importlib
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Mapping, Sequence

from ..base.errors import InputError
from ..base.files import is_file
from ..base.suggestions import hint
from ..reporting.matplotlib_loader import load_matplotlib
from . import source_tree


@dataclass(frozen=True)
class Catalogue:
    modules: Mapping[str, str]  # of the kinds, full names, by what a study file calls them
    folders: Sequence[Path]  # with the ready studies; case files that they use lie beside them

    @property
    def kinds(self) -> tuple[str, ...]:
        return tuple(self.modules)

    def kind(self, name: str) -> Any:
        """Loaded on demand: the pictures' library takes a second."""
        load_matplotlib()
        return importlib.import_module(self.modules[name])

    @property
    def ready(self) -> dict[str, Path]:
        """The ready study files by name, in the order of their names."""
        files = [path for folder in self.folders for path in folder.glob("*.toml")]
        studies = [path for path in files if re.search(r"^kind\s*=", path.read_text(encoding="utf-8"), re.MULTILINE)]
        return {path.stem: path for path in sorted(studies, key=lambda path: path.stem)}

    def path(self, text: str) -> Path:
        """The file of the study that a user names: a file, or a ready study. Raises InputError."""
        path, ready = Path(text), self.ready
        if path.suffix == ".toml" or is_file(path):
            return path
        if text in ready:
            return ready[text]
        if text in source_tree.STUDIES:
            raise source_tree.refusal("", "STUDY", f"the study '{text}'")
        raise InputError("", "STUDY", f"'{text}' is neither a file nor a ready study", hint(text, ready, "Ready:"))


OWN = Catalogue({"runs": "fsi_compare.study.plain_runs"}, (Path(__file__).resolve().parents[2] / "studies",))
