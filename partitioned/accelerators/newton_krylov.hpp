#pragma once

#include <vector>

#include "partitioned/accelerators/accelerator.hpp"
#include "partitioned/accelerators/difference_columns.hpp"
#include "partitioned/accelerators/iqn_ils.hpp"

namespace fsi {

/// Inexact Newton's method on the interface residual, its linear systems by matrix-free GMRES (interface GMRES:
/// [Michler2005]; forcing terms: [Eisenstat1996]). At a base point x_0 with
/// residual r_0 and beta = |r_0|, GMRES is preconditioned from the right by what earlier products, v_i = J w_i, tell of
/// the Jacobian J,
///   P q = W c - m (q - V c),   c = V^+ q:
/// the inverse of J in their span, relaxation by m outside it. Products with J P are differences of passes,
///   J p_j = (r(x_0 + h p_j) - r_0) / h,   p_j = P q_j,   h = -beta, or less:
/// the first of them tries the quasi-Newton step. Arnoldi's process builds Q with J P Q_m = Q_(m+1) H, and once
/// min |beta e_1 + H y| <= eta beta the next base point is x_0 + P Q y, or closer to x_0 while that raises the
/// residual. Each pass of the loop is one product or one base point.
class NewtonKrylov : public Accelerator {
 public:
  static constexpr int most_directions = 60;

  explicit NewtonKrylov(const QuasiNewtonOptions& options, const InterfaceSpace& space = {})
      : space_(space),
        mixing_(options.mixing),
        columns_(options.columns, options.reused_steps, options.filter, space),
        qr_({}, 0, space) {}
  void start() override;
  void correct(std::vector<double>& x, const std::vector<double>& r) override;
  void accept(const std::vector<double>& x, const std::vector<double>& r) override;
  void abandon() override;
  void change(bool) override { columns_.clear(); }
  void aim(double residual) override { aim_ = residual; }
  AcceleratorStatus status() const override { return {0, static_cast<int>(h_.size())}; }
  bool allows_change() const override { return at_base_; }
  void keep(RestartArchive& archive) override;

 private:
  void begin(const std::vector<double>& x, const std::vector<double>& r);
  void keep_products();
  std::vector<double> precondition(const std::vector<double>& q) const;
  void probe(std::vector<double>& x);
  double minimise(std::vector<double>& y) const;

  InterfaceSpace space_;
  double aim_ = 0;  ///< no Newton step is solved much tighter than that needs
  double mixing_;
  DifferenceColumns columns_;  ///< v = J w
  FilteredQr qr_;              ///< of their V, as it was at the base point
  int halvings_ = 0;           ///< of the last Newton step
  bool at_base_ = true;        ///< the next residual is a base point's, not a product
  bool has_base_ = false;      ///< there is one, of this step or stage:
  std::vector<double> base_x_, base_r_;
  double beta_ = 0, forcing_ = 0, last_beta_ = 0;
  std::vector<std::vector<double>> q_;         ///< orthonormal
  std::vector<std::vector<double>> p_;         ///< P q, the directions probed
  std::vector<std::vector<double>> products_;  ///< J p
  std::vector<std::vector<double>> h_;         ///< columns of the Hessenberg matrix
};

}  // namespace fsi
