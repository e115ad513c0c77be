#pragma once

#include <utility>
#include <vector>

#include "partitioned/interface/robin_robin.hpp"

namespace fsi {

/// Robin-Robin with a correction of its data, in the manner of [Burman2024] (docs/theory.md, section 10.5). A time
/// integration with RobinRobin beside this one, index 1, predicts by how much the data of both media change in a step:
///   lambda* = lambda^n + lambda_1^(n+1) - lambda_1^n,   u* = u^n + u_1^(n+1) - u_1^n,
///   W^(n+1) + lambda* + c (w^(n+1) - u*) = 0,
///   F^(n+1) - lambda* + c (u^(n+1) - w^(n+1)) = 0.
/// The error of the prediction is of first order in the step, that of its changes of second order. The corrected data
/// do not enter the prediction, so the stability is that of RobinRobin. alpha is twice that of the prediction: the rest
/// of a jump of the load oscillates with a frequency that depends on alpha, and at equal frequencies the prediction
/// would excite the correction in resonance.
template <int n>
class RobinRobinCorrected : public RobinRobin<n> {
  using Base = RobinRobin<n>;

 public:
  /// alpha of both marches over the coefficient of the case, or of the scene: their geometric mean is one.
  static constexpr double factor = 1.4142135623730951, factor_of_prediction = 1 / factor;

  RobinRobinCorrected(Scene<n>& scene, const PartitionedData& options) : Base(scene, options, factor) {}

  /// The changes of the prediction, from the last step to each stage of the next.
  void correct_by(std::vector<typename Base::Data> changes) { changes_ = std::move(changes); }

 protected:
  Pass single_pass(const std::vector<double>&, const PassAccuracy& accuracy) override {
    const auto& change = changes_.at(static_cast<std::size_t>(Base::data_->rates.stage));
    std::vector<double> u = Base::last_velocity(), lambda = Base::traction_;
    axpy(1, change.velocity, u);
    axpy(1, change.traction, lambda);
    return Base::pass_with(u, lambda, accuracy);
  }

 private:
  std::vector<typename Base::Data> changes_;
};

}  // namespace fsi
