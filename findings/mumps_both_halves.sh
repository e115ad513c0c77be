#!/usr/bin/env bash
# MUMPS, told that a matrix is symmetric (SYM = 2), adds what is given above the diagonal to what is given below it. A symmetric
# matrix that is handed over whole, as an assembly without symmetry makes it, is factorized with all its off-diagonal entries
# doubled: INFOG(1) is 0, and the solution is that of another matrix. With SYM = 1, which does not pivot, the doubled matrix
# of this script is reported as singular.
# A guess would be that one half is used and the other left alone, as in Eigen, CHOLMOD and LAPACK, or that it is refused.
# Seen with MUMPS 5.5.1 (Debian 12): the tridiagonal matrix -1, 2, -1 of three rows, right side 1, 1, 1, of which the solution
# is 1.5, 2, 1.5.
# Output seen: SYM=0 whole, and SYM=2 one half, 1.5 2 1.5; SYM=2 whole -1 -1.5 -1, INFOG(1) 0; SYM=1 whole INFOG(1) -10.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" libmumps-seq-dev=5.5.1-1 gcc=4:12.2.0-3
cat >"$scratch/12/root/solve.c" <<'END'
#include <dmumps_c.h>
#include <stdio.h>

/* Solves with the first so many entries: the diagonal, the lower half, the upper half. */
static void solve(const char *name, int sym, int entries) {
  int row[] = {1, 2, 3, 2, 3, 1, 2}, column[] = {1, 2, 3, 1, 2, 2, 3};
  double value[] = {2, 2, 2, -1, -1, -1, -1}, x[] = {1, 1, 1};
  DMUMPS_STRUC_C mumps = {0};
  mumps.par = 1;
  mumps.sym = sym;
  mumps.comm_fortran = -987654; /* all processes */
  mumps.job = -1;
  dmumps_c(&mumps);
  for (int k = 0; k < 3; ++k) mumps.icntl[k] = 0; /* nothing printed */
  mumps.n = 3;
  mumps.nnz = entries;
  mumps.irn = row;
  mumps.jcn = column;
  mumps.a = value;
  mumps.rhs = x;
  mumps.job = 6;
  dmumps_c(&mumps);
  printf("%s: INFOG(1) = %d", name, mumps.infog[0]);
  if (mumps.infog[0] == 0) printf(", solution %g %g %g", x[0], x[1], x[2]);
  printf("\n");
  mumps.job = -2;
  dmumps_c(&mumps);
}

int main(void) {
  solve("SYM=0, whole", 0, 7);
  solve("SYM=2, one half", 2, 5);
  solve("SYM=2, whole", 2, 7);
  solve("SYM=1, whole", 1, 7);
}
END
within "$scratch/12" sh -c 'cd /root && gcc -I/usr/include/mumps_seq -o solve solve.c -ldmumps_seq && ./solve' \
  >"$scratch/said" 2>"$scratch/log" || fail "ends with $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "what is solved"
SYM=0, whole: INFOG(1) = 0, solution 1.5 2 1.5
SYM=2, one half: INFOG(1) = 0, solution 1.5 2 1.5
SYM=2, whole: INFOG(1) = 0, solution -1 -1.5 -1
SYM=1, whole: INFOG(1) = -10
END
