#include "time/tr_bdf2.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

namespace fsi {

namespace {

const double g = 2 - std::sqrt(2.0);

}  // namespace

template <int n>
void TrBdf2<n>::prepare(State& state) const {
  BalanceScheme<n>::prepare(state);
  BalanceScheme<n>::prepare_rates(state);
}

template <int n>
StepRates TrBdf2<n>::first_rates(const BalanceScheme<n>& scheme, const State& state, double step, int stage) {
  const double start = state.time, middle = state.time + g * step, end = state.time + step;
  if (stage == 0) {
    StepRates rates = scheme.rates_from(step, 1 / (g * step), scheme.level(state), state.balances[0]);
    rates.last_stage = false;
    rates.strain_lag = g * step / 2;
    rates.start = start;
    rates.time = rates.end = middle;
    rates.weight = 1 / (2 - g);
    rates.load = {{start, middle, 1}};
    return rates;
  }
  const double old = (1 - g) * (1 - g), both = 1 - old;
  const References difference =
      combine(1 / both, {state.stage, state.stage_velocity}, -old / both, scheme.level(state));
  StepRates rates = scheme.rates_from(step, 2 / (g * step), difference, state.stage_balance);
  rates.stage = 1;
  rates.start = middle;
  rates.time = rates.end = end;
  rates.weight = (1 - g) / (2 - g);
  // Extrapolated from the means over both parts: with the first stage's load the impulse of the whole step.
  rates.load = {{middle, end, 2 - g}, {start, middle, -(1 - g)}};
  return rates;
}

template <int n>
double TrBdf2<n>::period(double step) const {
  return 0.5 * g * step;
}

template <int n>
StepRates TrBdf2<n>::rates_of(const State& state, double step, int stage) const {
  if (stage == 1 || state.since_jump == 0) return first_rates(*this, state, step, stage);
  const double k = 2 / (g * step);
  const References rate{state.rate, state.velocity_rate};
  StepRates rates = this->rates_from(step, k, combine(1, this->level(state), 1 / k, rate), state.balances[0]);
  rates.last_stage = false;
  rates.start = state.time;
  rates.time = rates.end = state.time + g * step;
  rates.weight = rates.previous_weight = 0.5 / (2 - g);
  rates.load = {{rates.start, rates.end, 2}};
  rates.load_rate_weight = -1;
  return rates;
}

template <int n>
std::optional<Balance> TrBdf2<n>::balance_again(const State& state) const {
  if (state.since_jump == 0) return std::nullopt;
  const double step = state.times[0] - state.times[1], k = 2 / (g * step);
  const References rate{state.rate, state.velocity_rate};
  Balance balance{state.balances[0], {}};
  StepData& data = balance.data;
  data.time = state.time;
  data.rates = this->rates_from(step, k, combine(1, this->level(state), -1 / k, rate), state.balances[1]);
  data.rates.stage = 1;
  data.rates.time = data.rates.end = state.time;
  data.rates.start = state.time - (1 - g) * step;
  const auto supports = state.load_rates.end() - 1 - static_cast<std::ptrdiff_t>(state.support_loads);
  data.opening_pressures.assign(state.load_rates.begin(), supports);
  data.support_loads.assign(supports, state.load_rates.end() - 1);
  data.wall_pressure = state.load_rates.back();
  return balance;
}

template <int n>
void TrBdf2<n>::keep(State& state, const StepData& data, const Solution&, const Solution&,
                     const std::vector<double>&) const {
  const StepRates& rates = data.rates;
  const auto differenced = [](double k, const std::vector<double>& y, const std::vector<double>& r) {
    std::vector<double> rate(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) rate[i] = k * (y[i] - r[i]);
    return rate;
  };
  state.rate.mesh = differenced(rates.interface.rate(), state.now.mesh, rates.mesh_reference);
  state.rate.fluid = differenced(rates.fluid_factor, state.now.fluid, rates.fluid_reference);
  state.rate.wall = differenced(rates.interface.rate(), state.now.wall, rates.wall_reference);
  state.rate.openings = differenced(rates.fluid_factor, state.now.openings, rates.openings_reference);
  state.rate.branches = differenced(rates.interface.rate(), state.now.branches, rates.branches_reference);
  state.velocity_rate = state.wall_acceleration;
  state.load_rates = data.opening_pressures;
  state.load_rates.insert(state.load_rates.end(), data.support_loads.begin(), data.support_loads.end());
  state.load_rates.push_back(data.wall_pressure);
}

template class TrBdf2<1>;
template class TrBdf2<2>;
template class TrBdf2<3>;

}  // namespace fsi
