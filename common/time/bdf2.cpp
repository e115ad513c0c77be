#include "time/bdf2.hpp"

#include "time/tr_bdf2.hpp"

namespace fsi {

template <int n>
StepRates Bdf2<n>::rates_of(const State& state, double step, int stage) const {
  if (stages(state) == 2) return TrBdf2<n>::first_rates(*this, state, step, stage);
  const double last = this->last_step(state, step), q = step / last;
  const double k = (1 + 2 * q) / ((1 + q) * step), square = (1 + q) * (1 + q) / (1 + 2 * q);
  const References before{state.before[1], state.wall_velocity_before};
  StepRates rates =
      this->rates_from(step, k, combine(square, this->level(state), 1 - square, before), state.balances[0]);
  rates.start = state.time;
  rates.time = rates.end = state.time + step;
  rates.load = {{rates.start, rates.end, k * step}, {state.times[1], state.times[0], -q * q / (1 + q) * last / step}};
  return rates;
}

template class Bdf2<1>;
template class Bdf2<2>;
template class Bdf2<3>;

}  // namespace fsi
