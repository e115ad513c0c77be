#pragma once

#include <vector>

#include "monolithic/coupled_solvers/block/coupled_matrix.hpp"
#include "monolithic/coupled_solvers/block/sub_solver.hpp"

namespace fsi {

/// Damping factors of the block Gauss-Seidel iteration.
struct BlockDamping {
  double mesh = 1, fluid = 1, wall = 1;
};

/// Damped block Gauss-Seidel iteration, the smoother of the coupled system ([Langer2018], algorithm 2):
///   d_m += omega_m A~m^-1 (r_m - Am d_m - Ams u_s)
///   u_f += omega_f A~f^-1 (r_f - Afm d_m - Af u_f - Afs u_s)
///   u_s += omega_s A~s^-1 (r_s - Asf u_f - As u_s), each with the newest values,
/// u_f being (u, p_f) and u_s (d_s, p_s).
template <int n>
class BlockGaussSeidel {
 public:
  BlockGaussSeidel(const CoupledMatrix<n>& k, SubSolvers inverse) : k_(k), inverse_(inverse) {}

  /// One iteration on K x = b from x.
  void sweep(const CoupledVector& b, CoupledVector& x, const BlockDamping& damping) {
    k_.mesh_residual(b, x, residual_.mesh);
    correct(inverse_.mesh, damping.mesh, residual_.mesh, correction_.mesh, x.mesh);
    k_.fluid_residual(b, x, residual_.fluid);
    correct(inverse_.fluid, damping.fluid, residual_.fluid, correction_.fluid, x.fluid);
    k_.wall_residual(b, x, residual_.wall);
    correct(inverse_.wall, damping.wall, residual_.wall, correction_.wall, x.wall);
  }

 private:
  static void correct(SubSolver& inverse, double omega, const std::vector<double>& r, std::vector<double>& t,
                      std::vector<double>& x) {
    t.resize(r.size());
    inverse.solve(r, t);
    axpy(omega, t, x);
  }

  const CoupledMatrix<n>& k_;
  SubSolvers inverse_;
  CoupledVector residual_, correction_;
};

}  // namespace fsi
