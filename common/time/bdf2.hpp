#pragma once

#include "time/balance.hpp"

namespace fsi {

/// The second backward difference with steps of any lengths, q = dt / dt_old (docs/theory.md, section 8.7):
///   dy/dt = k (y - r),   k = (1 + 2 q) / ((1 + q) dt),   r = ((1 + q)^2 y^n - q^2 y^(n-1)) / (1 + 2 q),
/// with the load differenced alike, so that the impulse of a table is conserved. After a jump of the load it begins
/// with a step in two stages (tr_bdf2.hpp): backward Euler would add half its impulse to a pulse of one step.
template <int n>
class Bdf2 : public BalanceScheme<n> {
 public:
  int stages(const State& state) const override { return state.since_jump == 0 ? 2 : 1; }
  double period(double step) const override { return 2 * step / 3; }
  ErrorTerms error_terms() const override { return {2, 1.0 / 3}; }
  bool bears_one_pass() const override { return true; }

 private:
  StepRates rates_of(const State& state, double step, int stage) const override;
};

extern template class Bdf2<1>;
extern template class Bdf2<2>;
extern template class Bdf2<3>;

}  // namespace fsi
