#pragma once

#include "time/balance.hpp"

namespace fsi {

/// A step in two stages ([Bank1985]; docs/theory.md, section 8.6): the trapezoidal rule up to t_n + g dt,
/// g = 2 - sqrt(2), then the second backward difference through t_n, t_n + g dt and t_{n+1},
///   k = 2 / (g dt),   r = y^n + y'^n / k;
///   k = (2 - g) / ((1 - g) dt), the same number,   r = (y_g - (1 - g)^2 y^n) / (1 - (1 - g)^2).
/// Of second order and L-stable. The equations hold at the end of each stage: with the midpoint rule in place of the
/// trapezoidal one displacements at its end would not quite keep the volume, which the second stage would correct with
/// wrong pressures at every step length. After a jump of the load, when no y' is known, the first stage is one of
/// backward Euler, k = 1 / (g dt), r = y^n: its error, of second order, is made once.
template <int n>
class TrBdf2 : public BalanceScheme<n> {
 public:
  int stages(const State&) const override { return 2; }
  double period(double step) const override;
  ErrorTerms error_terms() const override { return {2, 0.0404}; }
  void prepare(State& state) const override;
  std::optional<Balance> balance_again(const State& state) const override;

  /// Rates of a stage of a first step, which has no history; also for other schemes.
  static StepRates first_rates(const BalanceScheme<n>& scheme, const State& state, double step, int stage);

 private:
  StepRates rates_of(const State& state, double step, int stage) const override;
  void keep(State& state, const StepData& data, const Solution& start, const Solution& end,
            const std::vector<double>& end_velocity) const override;
};

extern template class TrBdf2<1>;
extern template class TrBdf2<2>;
extern template class TrBdf2<3>;

}  // namespace fsi
