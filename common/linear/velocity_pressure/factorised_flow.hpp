#pragma once

#include <vector>

#include "linear/direct/direct_solver.hpp"
#include "linear/direct/gathered_matrix.hpp"
#include "linear/interface/linear_solver.hpp"
#include "linear/velocity_pressure/velocity_pressure_layout.hpp"

namespace fsi {

/// Velocities and pressures of both media by sparse factors: the inner solver of a CondensedIteration. The mesh displacement,
/// which shape derivatives tie to all velocities around, so that it fills in, is left to its own equations; of the shape derivatives those of
/// the interface's momentum by the interface's displacement are in (interface_shape_derivatives.hpp).
/// \tparam n  components of a velocity
template <int n>
class FactorisedFlow {
 public:
  /// \param layout  of these blocks; must outlive this
  FactorisedFlow(const JacobianBlocks<n>& blocks, const VelocityPressureLayout<n>& layout,
                 const DirectSolver::Options& options);

  /// The blocks hold new values; the layout has been updated.
  /// \throws ConvergenceError, OutOfMemory as DirectSolver::factorise()
  void update();

  /// \param right      of the equations, in the order of the layout
  /// \param tolerance  residual over |right|
  /// \param solution   overwritten: velocities and pressures, in the order of the layout
  /// \throws ConvergenceError as DirectSolver::solve()
  void solve(const std::vector<double>& right, double tolerance, std::vector<double>& solution);

  void discard() { solver_.discard(); }
  double bytes() const;

 private:
  void gather();

  JacobianBlocks<n> blocks_;
  const VelocityPressureLayout<n>& layout_;
  DirectSolver::Options options_;
  GatheredMatrix matrix_;
  int gathered_ = 0;  ///< Numbering::version that the matrix was gathered with
  DirectSolver solver_;
  std::vector<double> scale_;  ///< the system's unknown over that of the layout
};

}  // namespace fsi
