#include "time/shifted_midpoint.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "time/time_rounding.hpp"

namespace fsi {

template <int n>
std::unique_ptr<ShiftedMidpoint<n>> ShiftedMidpoint<n>::of_scene(double frequency) {
  auto scheme = std::make_unique<ShiftedMidpoint>(midpoint_share * frequency);
  scheme->largest_theta_ = midpoint_bound;
  return scheme;
}

template <int n>
std::optional<LostOrder> ShiftedMidpoint<n>::lost_order(double step) const {
  const double longest = (midpoint_bound - 0.5) / damping_;
  if (!(step > longest * (1 + time_rounding))) return std::nullopt;
  const bool given = largest_theta_ > midpoint_bound;
  return LostOrder{
      fmt::format("the midpoint rule has theta = {:.3g} and an error that falls like the step, not like its square",
                  theta_of(step)),
      longest, given ? "a smaller time.damping, or leave time.scheme and time.damping out" : ""};
}

template <int n>
std::string ShiftedMidpoint<n>::about(double shortest, double longest) const {
  const double from = theta_of(shortest), to = theta_of(longest);
  return fmt::format("midpoint rule, theta = {}: 1/2 + {:.4g}/ms times the step, at most {:g}",
                     to - from < 5e-5 ? fmt::format("{:.4f}", to) : fmt::format("{:.4f} to {:.4f}", from, to), damping_,
                     largest_theta_);
}

template <int n>
StepRates ShiftedMidpoint<n>::rates_of(const State& state, double step, int) const {
  const double theta = theta_of(step);
  StepRates rates = this->rates_from(step, 1 / (theta * step), this->start(state, step), state.balances[0]);
  rates.start = state.time;
  rates.end = state.time + step;
  rates.time = theta < 1 ? state.time + theta * step : rates.end;
  rates.carry = theta;
  rates.strain_lag = (theta - 0.5) * step;
  rates.load = {{rates.start, rates.end, 1}};
  return rates;
}

template <int n>
double ShiftedMidpoint<n>::theta_of(double step) const {
  return std::min(largest_theta_, 0.5 + damping_ * step);
}

template <int n>
double ShiftedMidpoint<n>::level_shift(const State& state, double step) const {
  if (damping_ == 0) return 0;  // what a shift leaves behind would not die, and no energy should come or go
  const auto of = [&](double length) { return -0.5 * theta_of(length) * (1 - theta_of(length)) * length * length; };
  return of(step) - of(this->last_step(state, step));
}

template class ShiftedMidpoint<1>;
template class ShiftedMidpoint<2>;
template class ShiftedMidpoint<3>;

}  // namespace fsi
