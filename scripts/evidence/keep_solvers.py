"""Keeps the tables of single linear systems as docs/evidence/linear-solvers.md.

usage: python3 scripts/evidence/keep_solvers.py FOLDER    (with tables/, later/ and stress/, as fsi-compare solvers leaves each)
"""

import sys
from pathlib import Path
from typing import List

from keep_study import TOP, fail

HEAD = """# Tables of the linear solvers

Made by `fsi-compare solvers`. One thread, on a machine that need not be idle: compare seconds within a table only, and loosely.
What follows from them: [solvers.md](../guide/solvers.md). The fine mesh: [paper](paper.md). The paper is [Langer2018] of the
[bibliography](../bibliography.md).

| in the tables | means |
|---|---|
| C, I, F | coarse, intermediate, fine mesh |
| #it | number of the Newton iteration (Table 3), iterations of the linear solver (elsewhere) |
| P_D, P_L, P_U, P_SSOR, P_ILU | the block preconditioners `diagonal`, `lower`, `upper`, `ssor`, `ilu` of GMRES |
| AMG, exact | sub-problems solved by one multigrid cycle, by factorisation |
| ratio | iterations with AMG over those with exact sub-solves |
| AMG_GMRES, AMLI_FGMRES and so on | the coupled method on the left as preconditioner of the Krylov method on the right |
| work units | seconds of the solve over seconds of one product with the coupled matrix |
| cycles | cycles of the sub-problems' multigrid: mesh motion, fluid, wall |
| "true: residual" | residual recomputed at the end, relative |
| "difference: to direct" | of the solution from that of the factorisation, relative |
| - | not run |
"""
HEADING, DEEPER = "## ", "### "  # of tables, which stand below a part
PARTS = (
    ("Three materials, coarse and intermediate mesh", "tables/solvers.md"),
    ("A later system on the fine mesh, three methods", "later/solvers.md"),
    ("Extreme parameters, coarse and intermediate mesh", "stress/stress.md"),
)


def main(words: List[str]) -> int:
    if len(words) != 1 or words[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 1
    page = TOP / "docs" / "evidence" / "linear-solvers.md"
    parts = [HEAD]
    try:
        for title, file in PARTS:
            heading, _, tables = (Path(words[0]) / file).read_text(encoding="utf-8").partition("\n")
            if not heading.startswith("# ") or "| --- |" not in tables:
                fail(f"{words[0]}/{file} is no page of tables; run fsi-compare solvers anew")
            parts.append(f"## {title}\n\n{tables.strip().replace(HEADING, DEEPER)}\n")
        page.write_text("\n".join(parts), encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        fail(f"{error}; run fsi-compare solvers first")
    print(page)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
