#include "time/generalised_alpha.hpp"

#include <cstddef>
#include <utility>

namespace fsi {

template <int n>
GeneralisedAlpha<n>::GeneralisedAlpha(double spectral_radius)
    : a_m_((3 - spectral_radius) / (2 * (1 + spectral_radius))),
      a_f_(1 / (1 + spectral_radius)),
      g_(0.5 + a_m_ - a_f_) {}

template <int n>
void GeneralisedAlpha<n>::prepare(State& state) const {
  BalanceScheme<n>::prepare(state);
  BalanceScheme<n>::prepare_rates(state);
}

template <int n>
StepRates GeneralisedAlpha<n>::rates_of(const State& state, double step, int) const {
  const double k = a_m_ / (a_f_ * g_ * step), kept = 1 - a_m_ / g_;
  const References rate{state.rate, state.velocity_rate};
  StepRates rates = this->rates_from(step, k, combine(1, this->level(state), -kept / k, rate), state.balances[0]);
  rates.start = state.time;
  rates.end = state.time + step;
  rates.carry = a_f_;
  rates.time = a_f_ < 1 ? state.time + a_f_ * step : rates.end;
  rates.load = {{rates.start, rates.end, a_m_ / g_}};
  rates.load_rate_weight = kept;
  return rates;
}

template <int n>
void GeneralisedAlpha<n>::keep(State& state, const StepData& data, const Solution& end,
                               const std::vector<double>& end_velocity) const {
  const StepRates& rates = data.rates;
  std::vector<double> loads = data.opening_pressures;
  loads.push_back(data.wall_pressure);
  // y'^(n+1) = (y^(n+1) - y^n) / (g dt) - (1 - g) / g y'^n
  const auto follow = [&](std::vector<double>& rate, const std::vector<double>& y, const std::vector<double>& old) {
    for (std::size_t i = 0; i < rate.size(); ++i)
      rate[i] = (y[i] - old[i]) / (g_ * rates.step) - (1 - g_) / g_ * rate[i];
  };
  follow(state.rate.mesh, end.mesh, state.before[0].mesh);
  follow(state.rate.fluid, end.fluid, state.before[0].fluid);
  follow(state.rate.wall, end.wall, state.before[0].wall);
  follow(state.velocity_rate, end_velocity, state.wall_velocity);
  for (std::size_t i = 0; i < loads.size(); ++i)
    state.load_rates[i] = (loads[i] - (1 - a_m_) * state.load_rates[i]) / a_m_;
}

template class GeneralisedAlpha<1>;
template class GeneralisedAlpha<2>;
template class GeneralisedAlpha<3>;

}  // namespace fsi
