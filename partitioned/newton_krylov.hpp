#pragma once

#include <vector>

#include "partitioned/accelerator.hpp"

namespace fsi {

/// Inexact Newton's method on the interface residual, its linear systems by matrix-free GMRES (interface GMRES:
/// Michler, van Brummelen and de Borst 2005; forcing terms: Eisenstat and Walker 1996). At a base point x_0 with
/// residual r_0 and beta = |r_0|, products with the Jacobian are differences of passes,
///   J q_j = (r(x_0 + h q_j) - r_0) / h,   h = beta/20,
/// Arnoldi's process builds Q with J Q_m = Q_(m+1) H, and once min |beta e_1 + H y| <= eta beta the next base point is
/// x_0 + Q y, or closer to x_0 while that raises the residual. Each pass of the loop is one product or one base point.
class NewtonKrylov : public Accelerator {
 public:
  static constexpr int most_directions = 60;

  /// \param tolerance  of the coupling: no Newton step is solved much tighter than that needs
  explicit NewtonKrylov(double tolerance) : tolerance_(tolerance) {}
  void start() override;
  void correct(std::vector<double>& x, const std::vector<double>& r) override;
  AcceleratorStatus status() const override { return {0, static_cast<int>(h_.size())}; }
  bool allows_change() const override { return at_base_; }

 private:
  void begin(const std::vector<double>& x, const std::vector<double>& r);
  void probe(std::vector<double>& x) const;
  double minimise(std::vector<double>& y) const;

  double tolerance_;
  int halvings_ = 0;     ///< of the last Newton step
  bool at_base_ = true;  ///< the next residual is a base point's, not a product
  std::vector<double> base_x_, base_r_;
  double beta_ = 0, forcing_ = 0, last_beta_ = 0;
  std::vector<std::vector<double>> q_;  ///< orthonormal directions
  std::vector<std::vector<double>> h_;  ///< columns of the Hessenberg matrix
};

}  // namespace fsi
