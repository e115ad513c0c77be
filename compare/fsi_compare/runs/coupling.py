"""How a run has coupled fluid and wall, in the words of its `summary.json`: `interface`, `block` or `monolithic`
(docs/coupling.md). Results of earlier versions do not say their kind, and older ones no scheme."""

from typing import Any, Mapping

from ..base.errors import printable
from .summary import PROGRAMS


def coupling_kind(summary: Mapping[str, Any]) -> str | None:
    """`interface`, `block` or `monolithic`; None: the summary does not say, or one medium is alone."""
    kind = summary.get("coupling_kind")
    return printable(kind) if isinstance(kind, str) else None


def chosen_scheme(summary: Mapping[str, Any]) -> str | None:
    """The coupling scheme of a run of `fsi-partitioned`, named by the case or not; None: it does not say."""
    choices = summary.get("choices")
    choice = choices.get("partitioned.scheme") if isinstance(choices, Mapping) else None
    value = choice.get("value") if isinstance(choice, Mapping) else None
    return printable(value) if isinstance(value, str) else None


def coupling_words(program: str, summary: Mapping[str, Any]) -> str:
    """Words for legends and tables: `monolithic`, `partitioned (interface, iqn-ils)`, as far as the summary says it."""
    return with_coupling(PROGRAMS.get(program, program), program, summary)


def with_coupling(label: str, program: str, summary: Mapping[str, Any]) -> str:
    """`label`, which tells no kind of coupling, with kind and scheme behind it: `results (interface, iqn-ils)`. A
    monolithic run has one kind, and keeps its label."""
    known = [word for word in (coupling_kind(summary), chosen_scheme(summary)) if word]
    return f"{label} ({', '.join(known)})" if known and program == "fsi-partitioned" else label
