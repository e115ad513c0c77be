#pragma once

#include <Eigen/Core>
#include <vector>

#include "case/quasi_newton_options.hpp"
#include "partitioned/accelerators/accelerator.hpp"
#include "partitioned/interface_space.hpp"

namespace fsi {

/// Interface quasi-Newton for residuals that carry errors, because a pass solves the sub-problems inexactly: IQN-ILS
/// [Degroote2009] with a least-squares problem that knows how wrong its columns are. With differences of successive
/// passes V = [dr ...], W = [dx ...], of this step and earlier ones, and s_j the size of the error in column j of V,
///   c = argmin |V c + r|^2 + sum_j (s_j c_j)^2,   x <- x + W c + m (r + V c).
/// For independent errors the second term is the expected square of their effect on V c. It bounds the coefficients of
/// nearly parallel columns, so that no filter is needed (Tikhonov regularisation of an errors-in-variables problem).
/// s_j is relative to the length of the column and grows with its age in steps or stages, as the Jacobian drifts. m is
/// options.mixing; options.filter is not used.
class RegularisedIqn : public Accelerator {
 public:
  explicit RegularisedIqn(const QuasiNewtonOptions& options, const InterfaceSpace& space = {})
      : options_(options), space_(space) {}

  void start() override;
  void correct(std::vector<double>& x, const std::vector<double>& r) override;
  void accept(const std::vector<double>& x, const std::vector<double>& r) override;
  void abandon() override;
  void change(bool longer) override;
  AcceleratorStatus status() const override { return status_; }
  void keep(RestartArchive& archive) override;

 private:
  /// Adds the difference to the last pass, if there was one in this step or stage.
  void add_difference(const std::vector<double>& x, const std::vector<double>& r);
  void add_column(std::vector<double> v, std::vector<double> w, int age);
  /// Forgets the first `count` columns, the oldest.
  void drop(std::size_t count);

  QuasiNewtonOptions options_;
  InterfaceSpace space_;
  std::vector<std::vector<double>> v_, w_;  ///< oldest first
  std::vector<int> age_;                    ///< steps, or stages
  Eigen::MatrixXd gram_;                    ///< V^T V
  bool has_last_ = false;                   ///< there was a pass before, of this step or stage:
  std::vector<double> last_x_, last_r_;
  AcceleratorStatus status_;
};

}  // namespace fsi
