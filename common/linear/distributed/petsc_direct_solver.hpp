#pragma once

#include <vector>

#include "linear/distributed/petsc_factorisation.hpp"
#include "linear/distributed/petsc_gathered_matrix.hpp"
#include "linear/interface/jacobian_product.hpp"
#include "linear/interface/linear_solver.hpp"

namespace fsi {

/// `direct` on several processes: LU of the whole Jacobian by MUMPS.
template <int n>
class PetscDirectSolver : public LinearSolver {
 public:
  explicit PetscDirectSolver(const JacobianBlocks<n>& blocks);

  void update() override;
  const char* preparation() override { return "factorisation"; }
  bool ready() const override { return static_cast<bool>(factors_); }
  LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) override;
  LinearStatistics statistics() const override;
  double keep_contraction() const override { return 0.4; }

 private:
  PetscGatheredMatrix gather() const;

  JacobianBlocks<n> blocks_;
  MPI_Comm communicator_;
  JacobianProduct<n> jacobian_;
  PetscGatheredMatrix matrix_;
  int gathered_ = 0;  ///< Numbering::version that the matrix was gathered with
  OwnedKsp factors_;
  OwnedVec b_, x_;
  std::vector<double> product_;
};

}  // namespace fsi
