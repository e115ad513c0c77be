#include "time/generalised_alpha.hpp"

#include <cstddef>
#include <utility>

namespace fsi {

template <int n>
GeneralisedAlpha<n>::GeneralisedAlpha(double spectral_radius)
    : a_f_(1 / (1 + spectral_radius)), shift_((1 - spectral_radius) / (2 * (1 + spectral_radius))) {}

template <int n>
typename GeneralisedAlpha<n>::Weights GeneralisedAlpha<n>::weights(const State& state, double step) const {
  const double q = this->last_step(state, step) / step;
  const double between = 1 - shift_ + shift_ * q;  // of the rates' times, in steps
  return {(a_f_ + shift_ * q) / between, (0.5 + shift_ * q) / between};
}

template <int n>
void GeneralisedAlpha<n>::prepare(State& state) const {
  BalanceScheme<n>::prepare(state);
  BalanceScheme<n>::prepare_rates(state);
}

template <int n>
StepRates GeneralisedAlpha<n>::rates_of(const State& state, double step, int) const {
  const auto [a_m, g] = weights(state, step);
  const double k = a_m / (a_f_ * g * step), kept = 1 - a_m / g;
  const References rate{state.rate, state.velocity_rate};
  StepRates rates = this->rates_from(step, k, combine(1, this->start(state, step), -kept / k, rate), state.balances[0]);
  rates.start = state.time;
  rates.end = state.time + step;
  rates.carry = a_f_;
  rates.time = a_f_ < 1 ? state.time + a_f_ * step : rates.end;
  rates.load = {{rates.start, rates.end, a_m / g}};
  rates.load_rate_weight = kept;
  return rates;
}

template <int n>
double GeneralisedAlpha<n>::level_shift(const State& state, double step) const {
  const double last = this->last_step(state, step);
  return -0.5 * a_f_ * (1 - a_f_) * (step * step - last * last);
}

template <int n>
void GeneralisedAlpha<n>::keep(State& state, const StepData& data, const Solution& start, const Solution& end,
                               const std::vector<double>& end_velocity) const {
  const double step = data.rates.step;
  const Weights weight = weights(state, step);
  const double a_m = weight.a_m, g = weight.g;
  std::vector<double> loads = data.opening_pressures;
  loads.insert(loads.end(), data.support_loads.begin(), data.support_loads.end());
  loads.push_back(data.wall_pressure);
  // y'^(n+1) = (y^(n+1) - y^n) / (g dt) - (1 - g) / g y'^n
  const auto follow = [&](std::vector<double>& rate, const std::vector<double>& y, const std::vector<double>& old) {
    for (std::size_t i = 0; i < rate.size(); ++i) rate[i] = (y[i] - old[i]) / (g * step) - (1 - g) / g * rate[i];
  };
  follow(state.rate.mesh, end.mesh, start.mesh);
  follow(state.rate.fluid, end.fluid, start.fluid);
  follow(state.rate.wall, end.wall, start.wall);
  follow(state.rate.openings, end.openings, start.openings);
  follow(state.rate.branches, end.branches, start.branches);
  follow(state.velocity_rate, end_velocity, state.wall_velocity);
  for (std::size_t i = 0; i < loads.size(); ++i)
    state.load_rates[i] = (loads[i] - (1 - a_m) * state.load_rates[i]) / a_m;
}

template class GeneralisedAlpha<1>;
template class GeneralisedAlpha<2>;
template class GeneralisedAlpha<3>;

}  // namespace fsi
