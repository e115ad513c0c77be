#include "monolithic/coupled_solvers/coupled_linear_solver.hpp"

#include <memory>
#include <utility>

#include "fem/dimensions.hpp"

namespace fsi {

template <int n>
CoupledLinearSolver<n>::CoupledLinearSolver(const JacobianBlocks<n>& blocks, const CoupledSolverOptions& options)
    : blocks_(blocks), options_(options), system_(blocks), b_(system_.matrix().zero_vector()), in_(b_), out_(b_) {
  zero_ = b_;
}

template <int n>
void CoupledLinearSolver<n>::update() {
  system_.update();
  if (!multigrid_)
    multigrid_ = std::make_unique<CoupledMultigrid<n>>(system_, blocks_, options_.multigrid);
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

template <int n>
LinearReport CoupledLinearSolver<n>::solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) {
  if (set_up_ != *blocks_.mesh_laplacian_version) {
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
  const KrylovReport done =
      options_.iteration == CoupledIteration::richardson ? richardson_.solve(product, inverse, flat_b_, flat_x_, krylov)
      : options_.iteration == CoupledIteration::gmres    ? gmres_.solve(product, inverse, flat_b_, flat_x_, krylov)
                                                         : fgmres_.solve(product, inverse, flat_b_, flat_x_, krylov);
  unflatten(flat_x_, in_);
  system_.compress(in_, x);
  return {done.converged, done.iterations, done.relative_residual, done.failure};
}

template <int n>
LinearStatistics CoupledLinearSolver<n>::statistics() const {
  LinearStatistics s;
  s.memory_mib = system_.matrix().memory_mib() +
                 static_cast<double>(gmres_.bytes() + fgmres_.bytes() + richardson_.bytes()) / (1 << 20) +
                 cycle_memory_;
  if (!multigrid_) return s;
  s.memory_mib += multigrid_->memory_mib();
  s.operator_complexity = multigrid_->operator_complexity();
  s.levels = static_cast<int>(multigrid_->levels().size());
  s.mesh_cycles = multigrid_->mesh_cycles();
  s.fluid_cycles = multigrid_->fluid_cycles();
  s.wall_cycles = multigrid_->wall_cycles();
  return s;
}

template <int n>
void CoupledLinearSolver<n>::mesh_motion_is_set_up() {
  set_up_ = *blocks_.mesh_laplacian_version;
  if (blocks_.profile) blocks_.profile->count("mesh motion set-ups");
}

#define FSI_INSTANTIATE(n) template class CoupledLinearSolver<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
