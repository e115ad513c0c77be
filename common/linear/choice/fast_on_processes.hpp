#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "linear/distributed/petsc_factories.hpp"
#include "linear/interface/central_direct_solver.hpp"
#include "linear/velocity_pressure/jacobian_policy.hpp"

namespace fsi {

/// `fast` on several processes: `petsc` where a system is iterated, else factors at the first process. Where the wall decides,
/// each Jacobian is solved by the one or the other.
template <int n>
class FastOnProcesses : public LinearSolver {
 public:
  FastOnProcesses(const JacobianBlocks<n>& blocks, const FastOptions& fast, JacobianPolicy<n> policy)
      : blocks_(blocks), fast_(fast), policy_(std::move(policy)) {
    if (!policy_.wall_decides()) make_solver(policy_.iterates());
  }

  void update() override {
    const bool iterates = policy_.iterates();
    if (!solver_ || iterates != iterates_) {
      solver_.reset();  // before memory is taken for the other
      make_solver(iterates);
    }
    policy_.forget();
    solver_->update();
  }
  const char* preparation() override {
    if (!policy_.wall_decides()) return solver_->preparation();
    return policy_.iterates() ? LinearSolver::preparation() : "factorisation";
  }
  std::string decides() const override { return policy_.rule(); }
  bool ready() const override { return solver_ && solver_->ready(); }
  LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) override {
    return solver_->solve(b, tolerance, x);
  }
  LinearReport try_to_solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) override {
    return solver_->try_to_solve(b, tolerance, x);
  }
  LinearStatistics statistics() const override { return solver_ ? solver_->statistics() : LinearStatistics(); }
  double keep_contraction() const override {
    return solver_ ? solver_->keep_contraction() : LinearSolver::keep_contraction();
  }

 private:
  void make_solver(bool iterates) {
    if (iterates)
      solver_ = make_petsc_solver<n>(blocks_, fast_);
    else
      solver_ = std::make_unique<CentralDirectSolver<n>>(blocks_);
    iterates_ = iterates;
  }

  JacobianBlocks<n> blocks_;
  FastOptions fast_;
  JacobianPolicy<n> policy_;
  std::unique_ptr<LinearSolver> solver_;
  bool iterates_ = false;  ///< solver_ does
};

}  // namespace fsi
