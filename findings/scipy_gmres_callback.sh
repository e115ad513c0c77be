#!/usr/bin/env bash
# A callback that does nothing changes what SciPy's gmres computes. Without one, maxiter counts restarts, each of `restart`
# iterations; with one it counts iterations, unless callback_type is given too. And where it stops within the iterations before
# a restart, these are thrown away: the solution is that of the last restart, or zeros. So a residual history taken of a solver
# that works shows one that does not, and maxiter = 20 means 400 iterations or 20.
# A guess would be that a callback only looks on, and that a solver that stops early gives the best that it has.
# Seen with SciPy 1.10.1 (Debian 12): a tridiagonal matrix of 400 rows, restart = 20, products by the matrix counted.
# Output seen: maxiter 20: 421 products, with callback 23; maxiter 15: 316 products, with callback 17 and a solution of zeros;
# with callback_type "pr_norm" 316. A DeprecationWarning asks for callback_type; of other iterations it says nothing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-scipy=1.10.1-2
cat >"$scratch/12/root/callback.py" <<'END'
import numpy as np
import scipy.sparse
from scipy.sparse.linalg import LinearOperator, gmres

rows = 400
matrix = scipy.sparse.diags([-1.0, 2.0, -1.1], [-1, 0, 1], shape=(rows, rows)).tocsr()
products = 0


def product(x):
    global products
    products += 1
    return matrix @ x


def solve(**options):
    global products
    products = 0
    solution, status = gmres(LinearOperator((rows, rows), product), np.ones(rows), restart=20, tol=1e-10, atol=0, **options)
    return f"{products} products, status {status}{'' if solution.any() else ', solution of zeros'}"


for maxiter in (20, 15):
    print(f"maxiter {maxiter}: {solve(maxiter=maxiter)}")
    print(f"  with callback: {solve(maxiter=maxiter, callback=lambda residual: None)}")
    print(f"  with callback, pr_norm: {solve(maxiter=maxiter, callback=lambda residual: None, callback_type='pr_norm')}")
END
within "$scratch/12" python3 -W ignore /root/callback.py | tee "$scratch/said"
diff "$scratch/said" - <<'END' || fail "what gmres does"
maxiter 20: 421 products, status 20
  with callback: 23 products, status 20
  with callback, pr_norm: 421 products, status 20
maxiter 15: 316 products, status 15
  with callback: 17 products, status 15, solution of zeros
  with callback, pr_norm: 316 products, status 15
END
