#pragma once

#include <memory>

#include "time/balance.hpp"

namespace fsi {

/// The midpoint rule's damping over a scene's frequency: what the artery's wave tolerates best (docs/theory.md, section
/// 8.5), 0.2/ms there.
inline constexpr double midpoint_share = 0.25;

/// Largest theta of a midpoint rule whose shift is found from the scene: a larger one would cost the order.
inline constexpr double midpoint_bound = 0.5625;

/// The midpoint rule, its balance shifted towards the step's end (docs/theory.md, section 8.5):
///   t_b = t_n + theta dt,   theta = 1/2 + damping dt,   at most a bound,   k = 1 / (theta dt),   r = y^n.
/// Of second order while theta is below its bound; at the bound of first order, with 2 theta - 1 times the error of
/// backward Euler. What alternates from step to step decays like exp(-4 damping t), or by -(1 - theta) / theta a step.
template <int n>
class ShiftedMidpoint : public BalanceScheme<n> {
 public:
  /// \param damping  rate of the shift, 1/ms
  explicit ShiftedMidpoint(double damping) : damping_(damping) {}
  /// With the damping of a scene of this frequency, 1/ms.
  static std::unique_ptr<ShiftedMidpoint> of_scene(double frequency);

  ErrorTerms error_terms() const override { return {2, 1.0 / 12, damping_, largest_theta_ - 0.5}; }
  std::optional<LostOrder> lost_order(double step) const override;
  std::string against_ringing() const override { return "give a larger time.damping"; }
  std::string about(double shortest, double longest) const override;
  double period(double step) const override { return theta_of(step) * step; }
  bool pressures_lag() const override { return true; }

 private:
  StepRates rates_of(const State& state, double step, int stage) const override;
  double level_shift(const State& state, double step) const override;
  double theta_of(double step) const;

  double damping_;            ///< 1/ms
  double largest_theta_ = 1;  ///< where the damping is given
};

extern template class ShiftedMidpoint<1>;
extern template class ShiftedMidpoint<2>;
extern template class ShiftedMidpoint<3>;

}  // namespace fsi
