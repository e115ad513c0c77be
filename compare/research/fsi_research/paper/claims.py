"""What the paper says, and whether it holds here."""

from collections import Counter
from dataclasses import dataclass
from typing import Sequence

from fsi_compare.reporting.column import Column
from fsi_compare.reporting.layout import Table

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
    """Verdict on counts in single cells, ours against the paper's."""
    return MIXED if fewer and more else MORE if more else FEWER


def tally(claims: Sequence[Claim]) -> str:
    """The verdicts counted in a sentence; comparisons do not count."""
    counts = Counter(c.verdict for c in claims if c.verdict in TALLY)
    return f"Of {counts.total()} claims: " + ", ".join(f"{counts[name]} {name}" for name in TALLY if counts[name]) + "."


CLAIM: Sequence[Column[Claim]] = (
    Column("section", "section", lambda c: c.section, left=True),
    Column("the paper", "claim", lambda c: c.claim, left=True),
)
VERDICTS: Sequence[Column[Claim]] = (
    *CLAIM,
    Column("here", "verdict", lambda c: c.verdict, left=True),
    Column("our numbers", "ours", lambda c: c.ours, left=True),
    Column("why", "why", lambda c: c.why, left=True),
    Column(csv="rule", value=lambda c: c.rule),
)
RULES: Sequence[Column[Claim]] = (*CLAIM, Column("rule", "rule", lambda c: c.rule, left=True))


def claims_table(claims: Sequence[Claim]) -> Table:
    table = Table("claims", "The paper's claims, one by one", VERDICTS, claims)
    if any(c.verdict not in TALLY for c in claims):
        table.notes.append(f"{FEWER}, {MORE}: counts compared, of which the paper claims nothing; not in the tally.")
    return table


def rules_table(claims: Sequence[Claim]) -> Table:
    """What each verdict asks for, so that it can be judged without our numbers."""
    ruled = [c for c in claims if c.rule]
    return Table(
        "claim_rules", "What each verdict asks for", RULES, ruled, notes=["What meets neither is not reproduced."]
    )
