#pragma once

#include <vector>

#include "case/quasi_newton_options.hpp"
#include "partitioned/accelerators/accelerator.hpp"
#include "partitioned/accelerators/difference_columns.hpp"

namespace fsi {

/// Interface quasi-Newton with an approximation of the inverse Jacobian by least squares, IQN-ILS
/// [Degroote2009]. With differences of successive passes as columns, V = [dr ...] and W = [dx~ ...], newest first
/// and those of earlier time steps behind,
///   c = argmin |V c + r|,   x <- x~ + W c.
/// This takes the part of r that V does not explain, r + V c, as it is. It may be relaxed by a factor m instead,
///   x <- x~ + W c - (1 - m) (r + V c),
/// as in Anderson mixing: good where unexplained parts are overshot too, though less than the others.
class IqnIls : public Accelerator {
 public:
  explicit IqnIls(const QuasiNewtonOptions& options)
      : options_(options), columns_(options.columns, options.reused_steps, options.filter) {}
  void start() override;
  void correct(std::vector<double>& x, const std::vector<double>& r) override;
  void accept(const std::vector<double>& x, const std::vector<double>& r) override;
  void abandon() override { columns_.abandon(); }
  AcceleratorStatus status() const override { return status_; }
  void remember(Memory& memory) const override;
  void recall(const Memory& memory) override;

 private:
  void add_difference(const std::vector<double>& x, const std::vector<double>& r);

  QuasiNewtonOptions options_;
  DifferenceColumns columns_;  ///< of r and of x~ = x + r
  std::vector<double> last_x_, last_r_;
  AcceleratorStatus status_;
};

}  // namespace fsi
