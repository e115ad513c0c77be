#pragma once

#include "time/balance.hpp"

namespace fsi {

/// The generalised-alpha method for systems of first order ([Jansen2000]; docs/theory.md, section 8.8), displacements
/// and velocities treated alike as in [Liu2021], pressures at the time of balance t_n + a_f dt:
///   y' at a_m = k (y - r),   k = a_m / (a_f g dt),   r = y^n - (1 - a_m / g) y'^n / k,
///   a_f = 1 / (1 + rho),   s = (1 - rho) / (2 (1 + rho)),   q = dt_old / dt,
///   a_m = (a_f + s q) / (1 - s + s q),   g = (1/2 + s q) / (1 - s + s q).
/// For equal steps these are the published a_m = (3 - rho) / (2 (1 + rho)) and g = 1/2 + a_m - a_f. y'^n is the rate at
/// t_n - s dt_old, so that the published numbers would make unequal steps of first order.
/// The load follows a rate's recursion, so that the impulse of a table is conserved. y' and the load's share in it go
/// on through a jump of the load as if there were none: its full share comes within some steps, alternating about it,
/// while the impulse is right at each step's end. A state begins at rest.
template <int n>
class GeneralisedAlpha : public BalanceScheme<n> {
 public:
  /// \param spectral_radius  rho at infinite frequency, 0 to 1; at most 0.5 is advised
  explicit GeneralisedAlpha(double spectral_radius);

  double period(double step) const override { return a_f_ * (0.5 + shift_) / (a_f_ + shift_) * step; }
  ErrorTerms error_terms() const override { return {2, 1.0 / 12 + shift_ * shift_}; }
  bool bears_one_pass() const override { return true; }
  std::string against_ringing() const override { return "give a smaller time.spectral_radius"; }
  bool pressures_lag() const override { return true; }
  void prepare(State& state) const override;

 private:
  StepRates rates_of(const State& state, double step, int stage) const override;
  double level_shift(const State& state, double step) const override;
  void keep(State& state, const StepData& data, const Solution& start, const Solution& end,
            const std::vector<double>& end_velocity) const override;

  struct Weights {
    double a_m, g;
  };
  /// Of the step of this length that follows the state's last one.
  Weights weights(const State& state, double step) const;

  double a_f_, shift_;
};

extern template class GeneralisedAlpha<1>;
extern template class GeneralisedAlpha<2>;
extern template class GeneralisedAlpha<3>;

}  // namespace fsi
