#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "case/coupled_multigrid_options.hpp"
#include "linear/direct/direct_solver.hpp"
#include "linear/krylov/gmres.hpp"
#include "monolithic/coupled_solvers/amg/transfer.hpp"
#include "monolithic/coupled_solvers/block/block_gauss_seidel.hpp"
#include "monolithic/coupled_solvers/block/block_preconditioners.hpp"

namespace fsi {

/// P = diag(P_m, P_f, P_s) between two levels ([Langer2018], section 4.2.1); restriction is the transpose.
struct CoupledTransfer {
  std::shared_ptr<const NodeTransfer> mesh, fluid, wall;
};

/// One level of the coupled hierarchy: its matrix, its sub-solvers and what the cycle works on.
template <int n>
struct CoupledLevel {
  CoupledLevel(const CoupledMatrix<n>& k_, std::unique_ptr<SubSolver> mesh_, std::unique_ptr<SubSolver> fluid_,
               std::unique_ptr<SubSolver> wall_)
      : k(k_),
        mesh(std::move(mesh_)),
        fluid(std::move(fluid_)),
        wall(std::move(wall_)),
        smoother(k, {*mesh, *fluid, *wall}),
        b(k.zero_vector()),
        x(b),
        r(b),
        inner_b(b),
        inner_x(b) {}
  CoupledLevel(const CoupledLevel&) = delete;
  CoupledLevel& operator=(const CoupledLevel&) = delete;

  CoupledMatrix<n> k;
  std::unique_ptr<SubSolver> mesh, fluid, wall;
  BlockGaussSeidel<n> smoother;
  std::vector<BlockDamping> pre_smoothing, post_smoothing;  ///< one entry a step
  CoupledTransfer coarser;                                  ///< to the next level; unused on the coarsest
  CoupledVector b, x, r;
  CoupledVector inner_b, inner_x;  ///< of the Krylov method around this level's cycle
  Fgmres krylov;
};

/// One iteration of the algebraic multigrid ([Langer2018], algorithm 3) or algebraic multilevel method (algorithm 4)
/// for the coupled system, sparse factorisation on the coarsest level. With kinds k and amli the map is not linear.
template <int n>
class CoupledCycle : public CoupledPreconditioner {
 public:
  using Levels = std::vector<std::unique_ptr<CoupledLevel<n>>>;

  /// \param levels  finest first; must outlive the cycle
  CoupledCycle(Levels& levels, const CoupledCycleOptions& options) : levels_(levels), options_(options) {}

  /// Factorises the coarsest matrix with the values that it holds now; to be called before the first cycle.
  /// \throws ConvergenceError when it is singular, OutOfMemory
  void factorise_coarsest() {
    coarsest_matrix_ = sparse_matrix(levels_.back()->k);
    coarsest_ = {};  // entries that vanish are left out, so the pattern may differ
    coarsest_.factorise(coarsest_matrix_);
  }

  void apply(const CoupledVector& b, CoupledVector& x) override {
    x.set_zero();
    iterate(0, b, x);
  }

  /// One cycle from x, x <- AMG(K_l, x, b); on the coarsest level x <- K_l^-1 b. All parts of x have their sizes.
  void iterate(std::size_t l, const CoupledVector& b, CoupledVector& x) {
    auto& level = *levels_[l];
    if (l + 1 == levels_.size()) {
      flatten(b, flat_b_);
      coarsest_.solve(coarsest_matrix_, flat_b_, flat_x_);
      unflatten(flat_x_, x);
      return;
    }
    for (const auto& damping : level.pre_smoothing) level.smoother.sweep(b, x, damping);

    auto& coarse = *levels_[l + 1];
    level.k.residual(b, x, level.r);
    restrict_to<n, n>(*level.coarser.mesh, level.r.mesh, coarse.b.mesh);
    restrict_to<MixedLayout<n>::entries, n>(*level.coarser.fluid, level.r.fluid, coarse.b.fluid);
    restrict_to<MixedLayout<n>::entries, n>(*level.coarser.wall, level.r.wall, coarse.b.wall);
    coarse.x.set_zero();
    correct(l + 1);
    prolongate_add<n, n>(*level.coarser.mesh, coarse.x.mesh, x.mesh);
    prolongate_add<MixedLayout<n>::entries, n>(*level.coarser.fluid, coarse.x.fluid, x.fluid);
    prolongate_add<MixedLayout<n>::entries, n>(*level.coarser.wall, coarse.x.wall, x.wall);

    for (const auto& damping : level.post_smoothing) level.smoother.sweep(b, x, damping);
  }

  double memory_mib() const {
    double entries = 2.0 * static_cast<double>(coarsest_.factor_nonzeros());
    std::size_t bytes = 0;
    for (const auto& level : levels_) {
      entries += 5.0 * static_cast<double>(level->b.size());
      bytes += level->krylov.bytes();
    }
    return (8.0 * entries + static_cast<double>(bytes)) / (1 << 20);
  }

 private:
  /// Solves K x = b of a coarse level approximately, from x = 0, as the kind of the cycle asks.
  void correct(std::size_t l) {
    auto& level = *levels_[l];
    const bool coarsest = l + 1 == levels_.size();
    if (coarsest || options_.kind == CoupledCycleKind::v) return iterate(l, level.b, level.x);
    if (options_.kind == CoupledCycleKind::w) {
      iterate(l, level.b, level.x);
      return iterate(l, level.b, level.x);
    }
    KrylovOptions krylov;
    krylov.max_iterations = krylov.restart = 2;
    krylov.tolerance = options_.kind == CoupledCycleKind::k ? options_.k_cycle_reduction : 0;
    std::vector<double> b, x(level.b.size(), 0.0);
    flatten(level.b, b);
    level.krylov.solve(
        [&](const std::vector<double>& in, std::vector<double>& out) {
          unflatten(in, level.inner_x);
          level.inner_b.set_zero();
          level.k.residual(level.inner_b, level.inner_x, level.r);
          flatten(level.r, out);
          scale(-1, out);
        },
        [&](const std::vector<double>& in, std::vector<double>& out) {
          unflatten(in, level.inner_b);
          level.inner_x.set_zero();
          iterate(l, level.inner_b, level.inner_x);
          flatten(level.inner_x, out);
        },
        b, x, krylov);
    unflatten(x, level.x);
  }

  Levels& levels_;
  CoupledCycleOptions options_;
  SparseMatrix coarsest_matrix_;
  DirectSolver coarsest_;
  std::vector<double> flat_b_, flat_x_;
};

}  // namespace fsi
