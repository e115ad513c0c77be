#pragma once

#include <vector>

#include "partitioned/interface/dirichlet_neumann.hpp"

namespace fsi {

/// Richardson's method for fluid and wall together, in the manner of [Renzi2025], whose preconditioner is the block
/// Gauss-Seidel sweep that a pass of Dirichlet-Neumann is: from fields x* a pass makes x~, and
///   x = (1 - alpha) x* + alpha x~   of both media.
/// One iteration is a step here, and x* is extrapolated quadratically, a start of our own. Where the fluid's added mass is G
/// times what the wall answers with, accelerations a obey a^(n+1) = (1 - alpha (1 + G)) a^n + alpha (...) then: stable for
/// 0 < alpha < 2/(1 + G), and of the first order in the step (docs/theory.md, section 10.8).
template <int n>
class Richardson : public DirichletNeumann<n> {
  using Base = DirichletNeumann<n>;

 public:
  Richardson(Scene<n>& scene, const PartitionedData& options)
      : Base(scene, options), alpha_(options.relaxation.value_or(0)) {}

  /// 0: not known yet
  double alpha() const { return alpha_; }
  void set_alpha(double alpha) { alpha_ = alpha; }

  void start(State& state, StepData& data) override {
    Base::start(state, data);
    state_ = &state;
    fluid_ = state.now.fluid;
    wall_ = state.now.wall;
  }

  void accept() override {
    Base::accept();
    blend(fluid_, state_->now.fluid);
    blend(wall_, state_->now.wall);
  }

 private:
  void blend(const std::vector<double>& from, std::vector<double>& values) const {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = (1 - alpha_) * from[i] + alpha_ * values[i];
  }

  double alpha_;
  State* state_ = nullptr;
  std::vector<double> fluid_, wall_;  ///< x*
};

}  // namespace fsi
