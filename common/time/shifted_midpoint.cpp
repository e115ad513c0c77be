#include "time/shifted_midpoint.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fsi {

template <int n>
std::string ShiftedMidpoint<n>::about() const {
  return fmt::format("midpoint rule, shifted by {:.4g}/ms times the step", damping_);
}

template <int n>
StepRates ShiftedMidpoint<n>::rates_of(const State& state, double step, int) const {
  const double theta = std::min(1.0, 0.5 + damping_ * step);
  StepRates rates = this->rates_from(step, 1 / (theta * step), this->level(state), state.balances[0]);
  rates.start = state.time;
  rates.end = state.time + step;
  rates.time = theta < 1 ? state.time + theta * step : rates.end;
  rates.carry = theta;
  rates.load = {{rates.start, rates.end, 1}};
  return rates;
}

template class ShiftedMidpoint<1>;
template class ShiftedMidpoint<2>;
template class ShiftedMidpoint<3>;

}  // namespace fsi
