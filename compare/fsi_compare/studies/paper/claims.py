"""What the paper says, and whether it holds here."""

from collections import Counter
from dataclasses import dataclass
from typing import Sequence

from ...reporting.layout import Table

REPRODUCED = "reproduced"
IN_PART = "in part"
NOT_REPRODUCED = "not reproduced"
NOT_COMPARABLE = "not comparable"  # what runs here is not what the claim counts
NO_RUN = "no run for it"
TALLY = (REPRODUCED, IN_PART, NOT_REPRODUCED, NOT_COMPARABLE, NO_RUN)

# Of a comparison of counts that the paper does not make itself: neither reproduced nor not, and outside the tally.
FEWER, MORE, MIXED = "fewer", "more", "fewer and more"


@dataclass(frozen=True)
class Claim:
    section: str  # of the paper
    claim: str  # in our words, with the paper's numbers
    verdict: str
    ours: str  # our numbers
    why: str = ""
    rule: str = ""  # what the verdict asks for; it knows the claim and none of our numbers


def unexamined(section: str, claim: str, rule: str = "") -> Claim:
    return Claim(
        section, claim, NO_RUN, "-", "the runs that it needs are missing, or not in this form of the study", rule
    )


def verdict(holds: bool, partly: bool = False) -> str:
    return REPRODUCED if holds else IN_PART if partly else NOT_REPRODUCED


def compared(fewer: int, more: int) -> str:
    """Of counts in single cells, ours against the paper's."""
    return MIXED if fewer and more else MORE if more else FEWER


def tally(claims: Sequence[Claim]) -> str:
    """The verdicts counted in a sentence; comparisons do not count."""
    counts = Counter(c.verdict for c in claims if c.verdict in TALLY)
    return f"Of {counts.total()} claims: " + ", ".join(f"{counts[name]} {name}" for name in TALLY if counts[name]) + "."


def claims_table(claims: Sequence[Claim]) -> Table:
    table = Table(
        stem="claims",
        title="The paper's claims, one by one",
        left=5,
        columns=[("", "section"), ("", "the paper"), ("", "here"), ("", "our numbers"), ("", "why")],
        csv_columns=["section", "claim", "verdict", "ours", "why", "rule"],
    )
    for c in claims:
        table.rows.append([c.section, c.claim, c.verdict, c.ours, c.why])
        table.csv_rows.append([c.section, c.claim, c.verdict, c.ours, c.why, c.rule])
    if any(c.verdict not in TALLY for c in claims):
        table.notes.append(f"{FEWER}, {MORE}: counts compared, of which the paper claims nothing; not in the tally.")
    return table


def rules_table(claims: Sequence[Claim]) -> Table:
    """What each verdict asks for, so that it can be judged without our numbers."""
    table = Table(
        stem="claim_rules",
        title="What each verdict asks for",
        left=3,
        columns=[("", "section"), ("", "the paper"), ("", "rule")],
        csv_columns=["section", "claim", "rule"],
        notes=["What meets neither is not reproduced."],
    )
    for c in claims:
        if c.rule:
            table.rows.append([c.section, c.claim, c.rule])
            table.csv_rows.append([c.section, c.claim, c.rule])
    return table
