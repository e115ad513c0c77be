#pragma once

#include "time/balance.hpp"

namespace fsi {

/// The midpoint rule, its balance shifted towards the step's end (docs/theory.md, section 8.5):
///   t_b = t_n + theta dt,   theta = 1/2 + damping dt,   at most 1,   k = 1 / (theta dt),   r = y^n.
/// Of second order; what changes its sign from step to step dies like exp(-4 damping t).
template <int n>
class ShiftedMidpoint : public BalanceScheme<n> {
 public:
  /// \param damping  the rate of the shift, 1/ms
  explicit ShiftedMidpoint(double damping) : damping_(damping) {}
  std::string about() const override;
  bool pressures_lag() const override { return true; }

 private:
  StepRates rates_of(const State& state, double step, int stage) const override;
  double level_shift(const State& state, double step) const override;
  double theta_of(double step) const;

  double damping_;
};

extern template class ShiftedMidpoint<1>;
extern template class ShiftedMidpoint<2>;
extern template class ShiftedMidpoint<3>;

}  // namespace fsi
