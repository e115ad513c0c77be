#pragma once

#include <vector>

#include "linear/direct/central_factorisation.hpp"
#include "linear/interface/linear_solver.hpp"

namespace fsi {

/// LU of a Jacobian that is shared out among processes, at the first of them: DirectLinearSolver for small systems on
/// several processes.
template <int n>
class CentralDirectSolver : public LinearSolver {
 public:
  explicit CentralDirectSolver(const JacobianBlocks<n>& blocks);

  void update() override;
  const char* preparation() override { return "factorisation"; }
  bool ready() const override { return factors_.factorised(); }
  LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) override;
  LinearStatistics statistics() const override;
  double keep_contraction() const override { return 0.4; }

 private:
  JacobianBlocks<n> blocks_;
  CentralFactorisation factors_;
  int gathered_ = -1;  ///< Numbering::version that the matrix was gathered with
  std::vector<double> whole_;
};

}  // namespace fsi
