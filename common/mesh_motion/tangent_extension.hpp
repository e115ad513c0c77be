#pragma once

#include <optional>
#include <vector>

#include "algebra/csr_matrix.hpp"
#include "linear/amg/scalar_multigrid.hpp"
#include "linear/direct/cholesky_solver.hpp"
#include "linear/direct/direct_solver.hpp"
#include "mesh_motion/mesh_extension.hpp"
#include "mesh_motion/nonlinear_mesh_motion.hpp"

namespace fsi {

/// How a linearised nonlinear mesh motion is solved.
struct TangentExtensionOptions {
  /// Inner nodes from which the iteration serves; without it SolverPolicy decides.
  std::optional<int> iterative_from;
  double tolerance = 1e-12;  ///< of the iteration: its residual over that of zero inner values
  int max_iterations = 200;  ///< of conjugate gradients; a solve that needs more is done by factorisation
  /// Factors are kept in single precision where they serve: for callers that ask for a few digits. More digits are
  /// reached by corrections.
  bool single_precision = false;
};

/// The linearised equations of a nonlinear mesh motion, whose components couple: by a factorisation or, where that is
/// large, by conjugate gradients in double precision, preconditioned by a V-cycle of smoothed aggregation in single
/// precision for each component alone: by Korn's inequality as good as for a Laplacian but for a constant
/// [Blaheta1994]. A tangent that is not positive, as it may be far from equilibrium, is factorised without regard to
/// symmetry, others by Cholesky's method.
/// Results do not depend on the number of threads.
template <int n>
class TangentExtension : public MeshExtension<n> {
 public:
  /// \param tangent  conditions not imposed, components along the frames of nodes that have one; must outlive this.
  ///                 Solved with its values at the last update(), which has to come first
  /// \param inner    per node and component: its value is sought, its row an equation
  TangentExtension(const MeshMotionTangent<n>& tangent, std::vector<char> inner,
                   const TangentExtensionOptions& options = {});

  void update() override;
  void solve(const std::vector<double>& right, std::vector<double>& field, double tolerance) override;
  void solve(const std::vector<double>& right, std::vector<double>& field) { solve(right, field, options_.tolerance); }
  bool iterates() const override { return iterative_ && !factorised(); }
  double memory_mib() const override;
  int iterations() const override { return iterations_; }

 private:
  void set_up_multigrid();
  bool factorised() const { return cholesky_.factorised() || solver_.factorised(); }
  void factorise();
  void solve_by_factors(const std::vector<double>& b, double tolerance, std::vector<double>& x) const;
  /// out = A v among inner entries
  void apply(const std::vector<double>& v, std::vector<double>& out) const;
  bool iterate(const std::vector<double>& right, std::vector<double>& x, double tolerance);
  void precondition(const std::vector<double>& r, std::vector<double>& z);

  const MeshMotionTangent<n>& tangent_;
  TangentExtensionOptions options_;
  std::vector<char> inner_;
  std::vector<int> row_;            ///< per entry of the vector layout; -1 where the value is given
  std::vector<std::size_t> entry_;  ///< per row
  bool iterative_ = false;
  CsrMatrix<double> matrix_;  ///< among inner entries; symmetric, so that its rows serve as columns
  std::vector<double> boundary_rows_, given_;
  ScalarMultigrid multigrid_[n];  ///< of each component
  std::vector<int> rows_of_[n];   ///< the rows of each component
  SparseMatrix columns_;
  CholeskySolver cholesky_;
  DirectSolver solver_;  ///< of a tangent that is not positive
  std::vector<float> single_r_, single_z_;
  int iterations_ = 0;
};

}  // namespace fsi
