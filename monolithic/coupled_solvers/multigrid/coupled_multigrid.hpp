#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "case/coupled_multigrid_options.hpp"
#include "linear/krylov/power_iteration.hpp"
#include "monolithic/coupled_solvers/amg/galerkin.hpp"
#include "monolithic/coupled_solvers/amg/sub_problem_options.hpp"
#include "monolithic/coupled_solvers/block/coupled_system.hpp"
#include "monolithic/coupled_solvers/multigrid/coupled_coarsening.hpp"
#include "monolithic/coupled_solvers/multigrid/coupled_cycle.hpp"

namespace fsi {

/// One cycle of a sub-problem's multigrid, started at some level of its hierarchy.
template <class Amg>
class AmgSubSolver : public SubSolver {
 public:
  AmgSubSolver(Amg& amg, int level) : amg_(amg), level_(level) {}

 private:
  void apply(const std::vector<double>& b, std::vector<double>& x) override { amg_.cycle(level_, b, x); }

  Amg& amg_;
  int level_;
};

/// With one level the sub-solvers are factorisations.
struct CoupledMultigridOptions {
  CoupledCoarseningOptions coarsening;
  EllipticAmgOptions mesh = mesh_amg_options();  ///< options of coarsening in these three have no effect
  SaddleAmgOptions fluid = fluid_amg_options(), wall = wall_amg_options();
};

/// Best damping omega = omega_f = omega_s of the block Gauss-Seidel iteration whose undamped form has the eigenvalues
/// -k, 0 <= k <= k_max. With exact sub-solves and theta = 1 - omega an iteration maps the interface's (u, d_s) by
///   [ theta         -omega k           ]
///   [ omega theta   theta - omega^2 k  ],   determinant theta^2, trace 2 theta - omega^2 k:
/// its eigenvalues have the modulus 1 - omega for all k with omega^2 k <= 4 (1 - omega), and the errors inside fluid
/// and wall shrink by 1 - omega too. The largest such omega is 2 / (1 + sqrt(1 + k_max)): the rate of the best
/// second-order iteration, where damping of u or d_s alone would give that of first order.
inline double damping_for(double largest) {
  return 2 / (1 + std::sqrt(1 + std::max(largest, 0.0)));
}

/// The hierarchy of the coupled system ([Langer2018], section 4.2.1): Galerkin products K_(l+1) = R K_l P of the whole
/// matrix, with its coupling blocks, and the multigrid hierarchies of the three sub-problems, which share its
/// diagonal blocks.
template <int n>
class CoupledMultigrid {
 public:
  using Levels = typename CoupledCycle<n>::Levels;

  /// \param system  updated; must outlive this
  CoupledMultigrid(const CoupledSystem<n>& system, const JacobianBlocks<n>& blocks,
                   const CoupledMultigridOptions& options);
  CoupledMultigrid(const CoupledMultigrid&) = delete;
  CoupledMultigrid& operator=(const CoupledMultigrid&) = delete;

  /// The system's matrix has new values.
  void update();
  /// The mesh motion's operator alone was assembled again.
  void update_mesh_motion() { mesh_.update(); }

  /// Sets smoothing steps and damping of all levels but the coarsest for the values that the matrices hold now.
  void set_smoothing(const CoupledSmoothingOptions& options);

  Levels& levels() { return levels_; }
  SubSolvers finest_sub_solvers() { return {*levels_[0]->mesh, *levels_[0]->fluid, *levels_[0]->wall}; }

  long long mesh_cycles() const;
  long long fluid_cycles() const;
  long long wall_cycles() const;
  /// Stored numbers of all levels over those of the finest.
  double operator_complexity() const;
  double memory_mib() const;

 private:
  /// Ams, Afm, Afs and Asf of a coarse level.
  class Couplings {
   public:
    Couplings(const CoupledMatrix<n>& fine, const CoupledTransfer& t)
        : fine_(fine),
          mesh_wall_product_(*fine.mesh_wall->graph, t.mesh, t.wall),
          wall_fluid_product_(*fine.wall_fluid->graph, t.wall, t.fluid),
          fluid_mesh_product_(*fine.fluid_mesh->graph, t.fluid, t.mesh),
          fluid_wall_product_(*fine.fluid_wall->graph, t.fluid, t.wall),
          mesh_wall_(mesh_wall_product_.make_coarse()),
          wall_fluid_(wall_fluid_product_.make_coarse()),
          fluid_mesh_(fluid_mesh_product_.make_coarse()),
          fluid_wall_(fluid_wall_product_.make_coarse()) {}
    CoupledMatrix<n> coarse(const BlockMatrix<1, n>& mesh,
                            const BlockMatrix<MixedLayout<n>::entries, MixedLayout<n>::entries>& fluid,
                            const BlockMatrix<MixedLayout<n>::entries, MixedLayout<n>::entries>& wall) const {
      return {&mesh, &mesh_wall_, &fluid_mesh_, &fluid, &fluid_wall_, &wall_fluid_, &wall};
    }
    void update() {
      mesh_wall_product_.compute(*fine_.mesh_wall, mesh_wall_);
      wall_fluid_product_.compute(*fine_.wall_fluid, wall_fluid_);
      fluid_mesh_product_.compute(*fine_.fluid_mesh, fluid_mesh_);
      fluid_wall_product_.compute(*fine_.fluid_wall, fluid_wall_);
    }
    std::size_t bytes() const {
      return 8 * (mesh_wall_.values.size() + wall_fluid_.values.size() + fluid_mesh_.values.size() +
                  fluid_wall_.values.size());
    }

   private:
    CoupledMatrix<n> fine_;
    GalerkinProduct<1, 1, 1, 1> mesh_wall_product_, wall_fluid_product_;
    GalerkinProduct<MixedLayout<n>::entries, n, n, n> fluid_mesh_product_;
    GalerkinProduct<n, MixedLayout<n>::entries, n, n> fluid_wall_product_;
    BlockMatrix<1, 1> mesh_wall_, wall_fluid_;
    BlockMatrix<MixedLayout<n>::entries, n> fluid_mesh_;
    BlockMatrix<n, MixedLayout<n>::entries> fluid_wall_;
  };

  static CoupledNodes finest_nodes(const CoupledSystem<n>& system, const JacobianBlocks<n>& blocks);

  void make_levels();

  /// Modulus of the largest eigenvalue of the undamped smoother S, by power iterations x <- S(x, 0) from a fixed start,
  /// so that a restarted run gets the same number. Three estimates on the way, which approach it like a geometric
  /// sequence, are extrapolated to its limit (Aitken). \returns 0 where the iteration vanishes
  double largest_eigenvalue(CoupledLevel<n>& level, int iterations) const;

  template <class Count>
  long long sum(Count count) const {
    long long total = 0;
    for (const auto& level : levels_) total += count(*level);
    return total;
  }

  EllipticAmg<n, n> mesh_;
  SaddleAmg<MixedLayout<n>::entries> fluid_, wall_;
  std::vector<CoupledTransfer> transfers_;
  std::vector<std::unique_ptr<Couplings>> couplings_;
  std::vector<CoupledMatrix<n>> matrices_;
  Levels levels_;
};

}  // namespace fsi
