#!/usr/bin/env bash
# Whether Krylov solvers of SciPy 1.10 solve a system depends on the unit of the right side, unless atol is given. Where the
# right side's norm is below tol itself, cg, bicgstab and gmres return zeros with status 0, which says success. lgmres takes
# tol for an absolute bound altogether: the smaller the right side, the fewer digits are right, with status 0. So a
# system is solved with forces in N, and not with the same in MN. A DeprecationWarning of a default that will change is all that
# is said, and only where the program's main file calls.
# A guess would be norm(residual) <= tol * norm(right side), whatever the unit. That is what SciPy 1.15.3 (Debian 13) does.
# Seen with SciPy 1.10.1 (Debian 12): a tridiagonal matrix of 40 rows, tol = 1e-5, right sides of ones times a factor.
# Output seen of 1.10.1, relative residuals: factor 1: all within tol; 0.0001: lgmres 0.012; 1e-06: all 1, zeros; status 0.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-scipy=1.10.1-2
debian trixie "$scratch/13" python3-scipy=1.15.3-1
cat >"$scratch/units.py" <<'END'
import inspect
import numpy as np
import scipy.sparse
from scipy.sparse.linalg import bicgstab, cg, gmres, lgmres

rows = 40
matrix = scipy.sparse.diags([-1.0, 2.2, -1.0], [-1, 0, 1], shape=(rows, rows)).tocsr()
tolerance = "rtol" if "rtol" in inspect.signature(cg).parameters else "tol"  # its name since 1.12
for factor in (1, 1e-4, 1e-6):
    said = []
    for solver in (cg, bicgstab, gmres, lgmres):
        side = np.full(rows, factor)
        solution, status = solver(matrix, side, **{tolerance: 1e-5})
        residual = np.linalg.norm(side - matrix @ solution) / np.linalg.norm(side)
        words = "within tol" if residual <= 1e-5 else f"residual {residual:.2g}"
        said.append(f"{solver.__name__} {words}{'' if solution.any() else ', zeros'}{f', status {status}' if status else ''}")
    print(f"{factor}: {'; '.join(said)}")
END
for version in 12 13; do
  cp "$scratch/units.py" "$scratch/$version/root/"
  within "$scratch/$version" python3 -W ignore /root/units.py | tee "$scratch/said$version"
done
diff "$scratch/said12" - <<'END' || fail "SciPy 1.10.1"
1: cg within tol; bicgstab within tol; gmres within tol; lgmres within tol
0.0001: cg within tol; bicgstab within tol; gmres within tol; lgmres residual 0.012
1e-06: cg residual 1, zeros; bicgstab residual 1, zeros; gmres residual 1, zeros; lgmres residual 1, zeros
END
diff "$scratch/said13" - <<'END' || fail "SciPy 1.15.3"
1: cg within tol; bicgstab within tol; gmres within tol; lgmres within tol
0.0001: cg within tol; bicgstab within tol; gmres within tol; lgmres within tol
1e-06: cg within tol; bicgstab within tol; gmres within tol; lgmres within tol
END
