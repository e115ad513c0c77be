#pragma once

#include <memory>
#include <string>
#include <vector>

#include "monolithic/multigrid/coupled_multigrid.hpp"
#include "solvers/krylov/gmres.hpp"
#include "solvers/krylov/richardson.hpp"
#include "system/linear_solver.hpp"

namespace fsi {

/// The iteration around a preconditioner.
enum class CoupledIteration { richardson, gmres, fgmres };

struct CoupledSolverOptions {
  CoupledIteration iteration = CoupledIteration::gmres;
  std::string block_preconditioner;  ///< diagonal, lower, upper, ssor or ilu; empty: the coupled cycle
  KrylovOptions krylov;              ///< the tolerance comes with each solve
  CoupledMultigridOptions multigrid;
  CoupledSmoothingOptions smoothing;
  CoupledCycleOptions cycle;
};

/// Solves the linearised coupled equations in the paper's form K x = b by a preconditioned iteration ([Langer2018],
/// section 4): the tolerance is on its true residual |b - K x| / |b|, rows of all units as assembled.
template <class Element>
class CoupledLinearSolver : public LinearSolver {
 public:
  static constexpr int n = Element::components;

  CoupledLinearSolver(const JacobianBlocks<Element>& blocks, const CoupledSolverOptions& options)
      : blocks_(blocks), options_(options), system_(blocks), b_(system_.matrix().zero_vector()), in_(b_), out_(b_) {
    zero_ = b_;
  }

  void update() override {
    system_.update();
    if (!multigrid_)
      multigrid_ = std::make_unique<CoupledMultigrid<Element>>(system_, blocks_, options_.multigrid);
    else
      multigrid_->update();
    if (options_.block_preconditioner.empty()) {
      multigrid_->set_smoothing(options_.smoothing);
      auto cycle = std::make_unique<CoupledCycle<n>>(multigrid_->levels(), options_.cycle);
      cycle->factorise_coarsest();
      cycle_memory_ = cycle->memory_mib();
      preconditioner_ = std::move(cycle);
    } else {
      preconditioner_ =
          make_block_preconditioner(options_.block_preconditioner, system_.matrix(), multigrid_->finest_sub_solvers());
    }
    mesh_motion_is_set_up();
  }
  bool ready() const override { return preconditioner_ != nullptr; }

  LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) override {
    if (set_up_ != blocks_.scene.mesh_motion_assemblies) {
      system_.update_mesh_motion();
      multigrid_->update_mesh_motion();
      mesh_motion_is_set_up();
    }
    system_.expand(b, b_);
    flatten(b_, flat_b_);
    flat_x_.assign(flat_b_.size(), 0.0);
    KrylovOptions krylov = options_.krylov;
    krylov.tolerance = tolerance;
    const LinearOperator product = [this](const std::vector<double>& from, std::vector<double>& to) {
      unflatten(from, in_);
      system_.matrix().residual(zero_, in_, out_);
      flatten(out_, to);
      scale(-1, to);
    };
    const LinearOperator inverse = [this](const std::vector<double>& from, std::vector<double>& to) {
      unflatten(from, in_);
      preconditioner_->apply(in_, out_);
      flatten(out_, to);
    };
    const KrylovReport done = options_.iteration == CoupledIteration::richardson
                                  ? richardson_.solve(product, inverse, flat_b_, flat_x_, krylov)
                              : options_.iteration == CoupledIteration::gmres
                                  ? gmres_.solve(product, inverse, flat_b_, flat_x_, krylov)
                                  : fgmres_.solve(product, inverse, flat_b_, flat_x_, krylov);
    unflatten(flat_x_, in_);
    system_.compress(in_, x);
    return {done.converged, done.iterations, done.relative_residual, done.failure};
  }

  LinearStatistics statistics() const override {
    LinearStatistics s;
    s.memory_mib = system_.matrix().memory_mib() +
                   static_cast<double>(gmres_.bytes() + fgmres_.bytes() + richardson_.bytes()) / (1 << 20) +
                   cycle_memory_;
    if (!multigrid_) return s;
    s.memory_mib += multigrid_->memory_mib();
    s.operator_complexity = multigrid_->operator_complexity();
    s.levels = static_cast<int>(multigrid_->levels().size());
    s.mesh_cycles = multigrid_->mesh_cycles();
    s.flow_cycles = multigrid_->flow_cycles();
    s.wall_cycles = multigrid_->wall_cycles();
    return s;
  }

  const CoupledSystem<Element>& system() const { return system_; }

 private:
  void mesh_motion_is_set_up() {
    set_up_ = blocks_.scene.mesh_motion_assemblies;
    blocks_.scene.profile.count("mesh motion set-ups");
  }

  JacobianBlocks<Element> blocks_;
  CoupledSolverOptions options_;
  CoupledSystem<Element> system_;
  std::unique_ptr<CoupledMultigrid<Element>> multigrid_;
  std::unique_ptr<CoupledPreconditioner> preconditioner_;
  Richardson richardson_;
  Gmres gmres_;
  Fgmres fgmres_;
  CoupledVector b_, in_, out_, zero_;
  std::vector<double> flat_b_, flat_x_;
  double cycle_memory_ = 0;
  int set_up_ = 0;  ///< the assembly whose mesh motion is set up
};

}  // namespace fsi
