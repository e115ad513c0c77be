#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "linear/distributed/petsc_factories.hpp"
#include "linear/interface/central_direct_solver.hpp"
#include "linear/velocity_pressure/plane_judge.hpp"

namespace fsi {

/// What several processes do with a plane system that `fast` on one process iterates or factorises by what its wall is like:
/// `petsc`, or factors at the first process.
template <int n>
class JudgedOnProcesses : public LinearSolver {
 public:
  JudgedOnProcesses(const JacobianBlocks<n>& blocks, const FastOptions& fast)
      : blocks_(blocks), fast_(fast), judge_(blocks) {}

  void update() override {
    const bool iterates = judged_to_iterate();
    verdict_.reset();
    if (!solver_ || iterates != iterates_) {
      solver_.reset();  // before memory is taken for the other
      if (iterates)
        solver_ = make_petsc_solver<n>(blocks_, fast_);
      else
        solver_ = std::make_unique<CentralDirectSolver<n>>(blocks_);
      iterates_ = iterates;
    }
    solver_->update();
  }
  const char* preparation() override { return judged_to_iterate() ? LinearSolver::preparation() : "factorisation"; }
  std::string decides() const override { return PlaneJudge<n>::says(); }
  bool ready() const override { return solver_ && solver_->ready(); }
  LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) override {
    return solver_->solve(b, tolerance, x);
  }
  LinearStatistics statistics() const override { return solver_ ? solver_->statistics() : LinearStatistics(); }
  double keep_contraction() const override {
    return solver_ ? solver_->keep_contraction() : LinearSolver::keep_contraction();
  }

 private:
  bool judged_to_iterate() {
    if (!verdict_) verdict_ = judge_.iterates();
    return *verdict_;
  }

  JacobianBlocks<n> blocks_;
  FastOptions fast_;
  PlaneJudge<n> judge_;
  std::optional<bool> verdict_;  ///< on the present values, until update()
  std::unique_ptr<LinearSolver> solver_;
  bool iterates_ = false;  ///< solver_ does
};

}  // namespace fsi
