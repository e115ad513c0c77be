#!/usr/bin/env bash
# Whether QR of a sparse matrix solves a regular system depends on its units, by Eigen's SparseQR and by SuiteSparseQR, here
# through Eigen's SPQR. Both take a column for dependent where less is left of it than a tolerance, 20 (rows + columns) 2e-16
# times the longest column, and set its unknown to zero. In SI units the columns of pressures have ones and those of flows
# resistances of 1e12: the pressures of a network of arterioles are 0, and info() is Success. The tolerance grows with the
# number of unknowns, so SPQR is right for few vessels and not for many. SparseLU is right, whatever the unit; and with flows in
# a unit that makes the resistances 1, all are right. rank() tells: it is below the number of unknowns.
# A guess would be that QR is the safe choice beside LU, and gives up columns only where the matrix is singular to rounding.
# Seen with Eigen 3.4.0 and SuiteSparse 5.12.0 (Debian 12): n vessels in a row, given inflow, pressure 0 behind the last.
# Output seen, pressure at the inlet by the right one, for n = 3, 30, 300: SI units: SparseQR 0, 0, 0, SPQR 1, 1, 0, LU 1, 1, 1;
# resistances 1: all 1. Rank of SPQR in SI units: full, full, half.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" libeigen3-dev=3.4.0-4 libsuitesparse-dev=1:5.12.0+dfsg-2 g++=4:12.2.0-3
cat >"$scratch/12/root/network.cpp" <<'END'
#include <Eigen/SPQRSupport>
#include <Eigen/SparseLU>
#include <Eigen/SparseQR>
#include <cstdio>
#include <vector>

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

// The pressure at the inlet, divided by the right one, or -1 where the solver says that it failed.
template <class Solver> static double inlet(const Solver &solver, const Vector &side, double pressure) {
  if (solver.info() != Eigen::Success) return -1;
  const Vector solution = solver.solve(side);
  return solver.info() == Eigen::Success ? solution[side.size() / 2] / pressure : -1;
}

// Unknowns: the flow of each vessel, then the pressure before each. Rows: the drop of pressure, then the balance of flows.
static void network(const char *units, int vessels, double resistance, double inflow) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < vessels; ++k) {
    entries.emplace_back(k, vessels + k, 1.0);
    if (k + 1 < vessels) entries.emplace_back(k, vessels + k + 1, -1.0);
    entries.emplace_back(k, k, -resistance);
    entries.emplace_back(vessels + k, k, 1.0);
    if (k > 0) entries.emplace_back(vessels + k, k - 1, -1.0);
  }
  Matrix matrix(2 * vessels, 2 * vessels);
  matrix.setFromTriplets(entries.begin(), entries.end());
  matrix.makeCompressed();
  Vector side = Vector::Zero(2 * vessels);
  side[vessels] = inflow;
  const double pressure = vessels * resistance * inflow;
  const Eigen::SparseQR<Matrix, Eigen::COLAMDOrdering<int>> qr(matrix);
  const Eigen::SPQR<Matrix> spqr(matrix);
  const Eigen::SparseLU<Matrix> lu(matrix);
  std::printf("%s, %d vessels: SparseQR %.3g, SPQR %.3g, LU %.3g; %d unknowns, rank of SPQR %d\n", units, vessels,
              inlet(qr, side, pressure), inlet(spqr, side, pressure), inlet(lu, side, pressure), 2 * vessels,
              static_cast<int>(spqr.rank()));
}

int main() {
  for (int vessels : {3, 30, 300}) network("SI", vessels, 1e12, 1e-9);
  for (int vessels : {3, 30, 300}) network("resistances 1", vessels, 1, 1e3);
}
END
within "$scratch/12" sh -c 'cd /root && g++ -std=c++17 -O0 -I/usr/include/eigen3 -I/usr/include/suitesparse -o network \
  network.cpp -lspqr -lcholmod && ./network' >"$scratch/said" 2>"$scratch/log" || fail "ends with $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "the pressures"
SI, 3 vessels: SparseQR 0, SPQR 1, LU 1; 6 unknowns, rank of SPQR 6
SI, 30 vessels: SparseQR 0, SPQR 1, LU 1; 60 unknowns, rank of SPQR 60
SI, 300 vessels: SparseQR 0, SPQR 0, LU 1; 600 unknowns, rank of SPQR 300
resistances 1, 3 vessels: SparseQR 1, SPQR 1, LU 1; 6 unknowns, rank of SPQR 6
resistances 1, 30 vessels: SparseQR 1, SPQR 1, LU 1; 60 unknowns, rank of SPQR 60
resistances 1, 300 vessels: SparseQR 1, SPQR 1, LU 1; 600 unknowns, rank of SPQR 600
END
