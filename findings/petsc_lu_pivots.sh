#!/usr/bin/env bash
# PETSc's own LU, which PCLU takes unless another package is named, never exchanges rows for a larger pivot. A saddle point with
# a small number on the diagonal of its pressures, as stabilized or penalized Stokes has it, loses about as many digits as that
# number has zeros. KSPPREONLY looks at no residual: its reason is 4, CONVERGED_ITS. MUMPS and UMFPACK, by
# -pc_factor_mat_solver_type, are exact to rounding. Only an epsilon of 1e-14 or less is noticed, by the reason -11 or an error.
# A guess would be partial pivoting, as in LAPACK, SuperLU and UMFPACK, and that a direct solver which says converged has
# solved.
# Seen with PETSc 3.18.5 (Debian 12): 20 velocities, 19 pressures with -epsilon on the diagonal, solution ones.
# Output seen, relative residual for epsilon 1e-06, 1e-10, 1e-12: PETSc 3e-10, 3e-06, 4e-04; MUMPS and UMFPACK below 1e-14.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-petsc4py=3.18.5-1 python3-scipy=1.10.1-2
cat >"$scratch/12/root/pivots.py" <<'END'
import numpy, scipy.sparse
from petsc4py import PETSc

velocities = 20
stiffness = scipy.sparse.diags([-1.0, 2, -1], [-1, 0, 1], shape=(velocities, velocities))
gradient = scipy.sparse.diags([-1.0, 1], [0, 1], shape=(velocities - 1, velocities))
for epsilon in (1e-6, 1e-10, 1e-12):
    system = scipy.sparse.bmat([[stiffness, gradient.T], [gradient, -epsilon * scipy.sparse.eye(velocities - 1)]]).tocsr()
    side = system @ numpy.ones(system.shape[0])
    matrix = PETSc.Mat().createAIJ(system.shape, csr=(system.indptr, system.indices, system.data))
    said = []
    for package in ("petsc", "mumps", "umfpack"):
        solver, solution = PETSc.KSP().create(), matrix.createVecLeft()
        solver.setType("preonly")
        solver.getPC().setType("lu")
        solver.getPC().setFactorSolverType(package)
        solver.setOperators(matrix)
        solver.solve(PETSc.Vec().createWithArray(side.copy()), solution)
        residual = numpy.linalg.norm(system @ solution.array - side) / numpy.linalg.norm(side)
        said.append(f"{package} reason {solver.getConvergedReason()}, " + (f"{residual:.0e}" if residual > 1e-14 else "exact"))
    print(f"{epsilon}: {'; '.join(said)}")
END
within "$scratch/12" env PETSC_DIR=/usr/lib/petscdir/petsc3.18/x86_64-linux-gnu-real \
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 python3 /root/pivots.py >"$scratch/said" 2>"$scratch/log" ||
  fail "python ends with $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "residuals"
1e-06: petsc reason 4, 3e-10; mumps reason 4, exact; umfpack reason 4, exact
1e-10: petsc reason 4, 3e-06; mumps reason 4, exact; umfpack reason 4, exact
1e-12: petsc reason 4, 4e-04; mumps reason 4, exact; umfpack reason 4, exact
END
