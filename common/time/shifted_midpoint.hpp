#pragma once

#include "time/balance.hpp"

namespace fsi {

/// The midpoint rule, its balance shifted towards the step's end (docs/theory.md, section 8.5):
///   t_b = t_n + theta dt,   theta = 1/2 + damping dt,   at most a bound,   k = 1 / (theta dt),   r = y^n.
/// Of second order while theta is below its bound; at the bound of first order, with 2 theta - 1 times the error of backward
/// Euler. What changes its sign from step to step dies like exp(-4 damping t), or by -(1 - theta) / theta a step.
template <int n>
class ShiftedMidpoint : public BalanceScheme<n> {
 public:
  /// \param damping        the rate of the shift, 1/ms
  /// \param largest_theta  1/2 to 1
  explicit ShiftedMidpoint(double damping, double largest_theta = 1)
      : damping_(damping), largest_theta_(largest_theta) {}
  std::string about(double shortest, double longest) const override;
  double period(double step) const override { return theta_of(step) * step; }
  bool pressures_lag() const override { return true; }

 private:
  StepRates rates_of(const State& state, double step, int stage) const override;
  double level_shift(const State& state, double step) const override;
  double theta_of(double step) const;

  double damping_, largest_theta_;
};

extern template class ShiftedMidpoint<1>;
extern template class ShiftedMidpoint<2>;
extern template class ShiftedMidpoint<3>;

}  // namespace fsi
