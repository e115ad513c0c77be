#pragma once

#include <vector>

#include "case/quasi_newton_options.hpp"
#include "partitioned/accelerators/accelerator.hpp"
#include "partitioned/accelerators/difference_columns.hpp"
#include "partitioned/accelerators/low_rank_map.hpp"

namespace fsi {

/// Interface quasi-Newton with an approximation of the inverse Jacobian by least squares, IQN-ILS
/// [Degroote2009]. With differences of successive passes as columns, V = [dr ...] and W = [dx~ ...], newest first
/// and those of earlier time steps behind,
///   c = argmin |V c + r|,   x <- x~ + W c.
/// This takes the part of r that V does not explain, r + V c, as it is. It may be relaxed by a factor m instead,
///   x <- x~ + W c - (1 - m) (r + V c),
/// as in Anderson mixing: good where a pass overshoots the unexplained part too, though less than the rest.
/// Columns of a step of longer period belong to another r and would contradict the new ones where both are nearly
/// parallel. They become a map instead, as in the multi-vector method (iqn_imvj.hpp),
///   L <- L + (W - (1 - m) V - L V) V^+,
/// for what the columns that follow do not explain, x <- x~ + W c - (1 - m + L) (r + V c), in the first step, or stage,
/// after the change. Later ones converge better without it. After a change to a longer period all columns are dropped.
class IqnIls : public Accelerator {
 public:
  static constexpr int most_before = 1;  ///< steps, or stages, in which L serves

  explicit IqnIls(const QuasiNewtonOptions& options, const InterfaceSpace& space = {})
      : options_(options), columns_(options.columns, options.reused_steps, options.filter, space), before_(space) {}
  void start() override;
  void correct(std::vector<double>& x, const std::vector<double>& r) override;
  void accept(const std::vector<double>& x, const std::vector<double>& r) override;
  void abandon() override { columns_.abandon(); }
  void change(bool longer) override;
  AcceleratorStatus status() const override { return status_; }
  void keep(RestartArchive& archive) override;

 private:
  void add_difference(const std::vector<double>& x, const std::vector<double>& r);

  QuasiNewtonOptions options_;
  DifferenceColumns columns_;  ///< of r and of x~ = x + r
  LowRankMap before_;          ///< L, of steps of other lengths
  int before_age_ = 0;         ///< steps, or stages, since the last change
  bool has_last_ = false;      ///< there was a pass before, of this step or stage:
  std::vector<double> last_x_, last_r_;
  AcceleratorStatus status_;
};

}  // namespace fsi
