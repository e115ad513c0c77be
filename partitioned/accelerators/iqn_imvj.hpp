#pragma once

#include <vector>

#include "partitioned/accelerators/accelerator.hpp"
#include "partitioned/accelerators/iqn_ils.hpp"
#include "partitioned/accelerators/low_rank_map.hpp"

namespace fsi {

/// Interface quasi-Newton with an inverse multi-vector Jacobian, IQN-IMVJ ([Bogaers2014], [Lindner2015]): the
/// differences V, W of a time step correct the Jacobian of the last one,
///   J = J_old + (W - J_old V) V^+,   x <- x~ - J r,
/// beginning with J_old = (1 - m) I, which relaxes by m what no difference has explained yet.
/// J is kept as a sum of rank-one terms, a chunk per time step. When there are too many, the best approximation by few
/// of them takes their place.
class IqnImvj : public Accelerator {
 public:
  /// options.columns bounds the terms of J; when they are more, half of them stay. options.reused_steps is not used.
  explicit IqnImvj(const QuasiNewtonOptions& options, const InterfaceSpace& space = {})
      : options_(options), space_(space), jacobian_(space) {}
  void start() override;
  void correct(std::vector<double>& x, const std::vector<double>& r) override;
  void accept(const std::vector<double>& x, const std::vector<double>& r) override;
  AcceleratorStatus status() const override { return status_; }
  void keep(RestartArchive& archive) override;

 private:
  std::vector<double> old_jacobian_times(const std::vector<double>& r) const;
  void add_difference(const std::vector<double>& x, const std::vector<double>& r);

  QuasiNewtonOptions options_;
  InterfaceSpace space_;
  LowRankMap jacobian_;                 ///< J_old - (1 - m) I
  std::vector<std::vector<double>> v_;  ///< columns of this step, newest first
  std::vector<std::vector<double>> a_;  ///< W - J_old V, in the same order
  bool has_last_ = false;               ///< there was a pass before, of this step or stage:
  std::vector<double> last_x_, last_r_;
  AcceleratorStatus status_;
};

}  // namespace fsi
