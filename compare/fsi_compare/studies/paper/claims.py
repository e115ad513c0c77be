"""What the paper says, and whether it holds here."""

from dataclasses import dataclass
from typing import Sequence

from ...layout import Table

REPRODUCED = "reproduced"
IN_PART = "in part"
NOT_REPRODUCED = "not reproduced"
NO_RUN = "no run for it"


@dataclass(frozen=True)
class Claim:
    section: str  # of the paper
    claim: str  # in our words, with the paper's numbers
    verdict: str
    ours: str  # our numbers
    why: str = ""


def unexamined(section: str, claim: str) -> Claim:
    return Claim(section, claim, NO_RUN, "-", "the runs that it needs are missing, or not in this form of the study")


def verdict(holds: bool, partly: bool = False) -> str:
    return REPRODUCED if holds else IN_PART if partly else NOT_REPRODUCED


def claims_table(claims: Sequence[Claim]) -> Table:
    table = Table(stem="claims", title="The paper's claims, one by one", left=5,
                  columns=[("", "section"), ("", "the paper"), ("", "here"), ("", "our numbers"), ("", "why")],
                  csv_columns=["section", "claim", "verdict", "ours", "why"])
    for c in claims:
        table.rows.append([c.section, c.claim, c.verdict, c.ours, c.why])
        table.csv_rows.append([c.section, c.claim, c.verdict, c.ours, c.why])
    return table
