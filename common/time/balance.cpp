#include "time/balance.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "fem/nodal_layout.hpp"
#include "time/time_rounding.hpp"

namespace fsi {

namespace {

template <class Function>
void for_each_field(Function function) {
  function(&Solution::mesh);
  function(&Solution::fluid);
  function(&Solution::wall);
  function(&Solution::openings);
  function(&Solution::branches);
}

std::vector<double> combine(double a, const std::vector<double>& x, double b, const std::vector<double>& y) {
  std::vector<double> z(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) z[i] = a * x[i] + b * y[i];
  return z;
}

/// y_0 + (y - y_0) / theta
std::vector<double> carried(const std::vector<double>& from, const std::vector<double>& to, double theta) {
  if (theta == 1) return to;
  std::vector<double> end(to.size());
  for (std::size_t i = 0; i < end.size(); ++i) end[i] = from[i] + (to[i] - from[i]) / theta;
  return end;
}

/// Weights of three values in a straight line that is blind to what alternates: through the means of neighbours.
std::array<double, 3> smooth_weights(const std::array<double, 3>& t, double time) {
  const double latest = 0.5 * (t[0] + t[1]), before = 0.5 * (t[1] + t[2]), along = (time - latest) / (latest - before);
  return {0.5 * (1 + along), 0.5, -0.5 * along};
}

/// Pressures of both media: those of q0, or between (beyond) those of two balances, q = (1 - w) q0 + w q1.
template <int n>
void set_pressures(Solution& to, const Solution& q0, const Solution& q1, double w) {
  using Mixed = MixedLayout<n>;
  const auto set = [&](std::vector<double>& p, const std::vector<double>& p0, const std::vector<double>& p1) {
    const int nodes = static_cast<int>(p.size()) / Mixed::entries;
    for (int a = 0; a < nodes; ++a) {
      const std::size_t i = Mixed::scalar(a);
      p[i] = w == 0 ? p0[i] : (1 - w) * p0[i] + w * p1[i];
    }
  };
  set(to.fluid, q0.fluid, q1.fluid);
  set(to.wall, q0.wall, q1.wall);
}

}  // namespace

bool pressures_settled(const State& state) {
  return state.since_jump == 0 || state.balance_times[0] >= state.time * (1 - time_rounding);
}

References combine(double a, const References& x, double b, const References& y) {
  References z;
  for_each_field([&](auto field) { z.of.*field = combine(a, x.of.*field, b, y.of.*field); });
  z.wall_velocity = combine(a, x.wall_velocity, b, y.wall_velocity);
  return z;
}

template <int n>
void BalanceScheme<n>::prepare(State& state) const {
  state.since_jump = state.balances_since_jump = 0;
  for (auto& balance : state.balances) balance = state.now;
  state.balance_times = {state.time, state.time, state.time};
  state.wall_velocity_before = state.wall_velocity;
}

template <int n>
References BalanceScheme<n>::start(const State& state, double step) const {
  using Mixed = MixedLayout<n>;
  References start = level(state);
  // After three equal steps alone. Where steps change all the time levels keep no course, and shifts would make motions
  // grow that the steps hardly resolve.
  const auto& t = state.balance_times;
  const double last = last_step(state, step);
  const bool steady =
      state.step > 2 && std::abs(t[0] - t[1] - last) <= 1e-9 * last && std::abs(t[1] - t[2] - last) <= 1e-9 * last;
  const double shift = steady ? level_shift(state, step) : 0.0;
  if (shift == 0) return start;
  const double weight = shift / (last * last);
  const auto move = [&](std::vector<double> Solution::*field, std::size_t i) {
    const auto& balances = state.balances;
    (start.of.*field)[i] += weight * ((balances[0].*field)[i] - 2 * (balances[1].*field)[i] + (balances[2].*field)[i]);
  };
  for (std::size_t i = 0; i < start.of.mesh.size(); ++i) move(&Solution::mesh, i);
  const int nodes = static_cast<int>(start.of.wall.size()) / Mixed::entries;
  for (int node = 0; node < nodes; ++node)
    for (int c = 0; c < n; ++c) move(&Solution::wall, Mixed::vector(node, c));
  return start;
}

template <int n>
double BalanceScheme<n>::last_step(const State& state, double step) {
  const double last = state.times[0] - state.times[1];
  return state.step == 0 || std::abs(last - step) <= 1e-9 * step ? step : last;
}

template <int n>
void BalanceScheme<n>::prepare_rates(State& state) {
  for_each_field([&](auto field) { (state.rate.*field).assign((state.now.*field).size(), 0.0); });
  state.velocity_rate.assign(state.wall_velocity.size(), 0.0);
}

template <int n>
StepRates BalanceScheme<n>::rates_from(double step, double k, References references, const Solution& pressures) const {
  assert(step > 0);
  StepRates rates;
  rates.step = step;
  rates.interface.period = 1 / k;
  rates.fluid_factor = k;
  rates.acceleration_factor = k * k;

  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;
  auto& history = rates.acceleration_history;
  history.resize(references.wall_velocity.size());
  const int nodes = static_cast<int>(history.size()) / n;
  for (int node = 0; node < nodes; ++node)
    for (int c = 0; c < n; ++c) {
      const std::size_t i = Vector::vector(node, c);
      history[i] = -k * k * references.of.wall[Mixed::vector(node, c)] - k * references.wall_velocity[i];
    }
  // No rate is made of pressures. The reference's are read by the projection of the fluid's stabilisation alone.
  set_pressures<n>(references.of, pressures, pressures, 0);
  rates.mesh_reference = std::move(references.of.mesh);
  rates.fluid_reference = std::move(references.of.fluid);
  rates.wall_reference = std::move(references.of.wall);
  rates.openings_reference = std::move(references.of.openings);
  rates.branches_reference = std::move(references.of.branches);
  return rates;
}

template <int n>
void BalanceScheme<n>::predict(State& state, int order, const StepData& data) const {
  // Solutions of the equations, the latest first, then the level at the jump: what alternates from level to level is
  // not in the solutions between them.
  const bool within = data.rates.stage > 0;
  std::array<const Solution*, 3> known{};
  std::array<double, 3> times{};
  int count = 0;
  const auto add = [&](const Solution& solution, double time) {
    if (count == 3) return;
    known[count] = &solution;
    times[count++] = time;
  };
  if (within) add(state.stage_balance, state.stage_time);
  for (int i = 0; i < std::min(state.balances_since_jump, 3); ++i) add(state.balances[i], state.balance_times[i]);
  if (state.since_jump < 3) add(state.before[state.since_jump], state.times[state.since_jump]);
  for (int i = count; i < 3; ++i) known[i] = known[0];  // of no weight
  const auto extrapolate = [&](std::vector<double> Solution::*field, const std::array<double, 3>& w) {
    const auto &x0 = known[0]->*field, &x1 = known[1]->*field, &x2 = known[2]->*field;
    auto& x = state.now.*field;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = w[0] * x0[i] + w[1] * x1[i] + w[2] * x2[i];
  };
  const auto w = extrapolation_weights(times, std::min({order, count - 1, 2}), data.rates.time);
  for_each_field([&](auto field) { extrapolate(field, w); });
  if (count == 1 && order > 0) {  // through a jump of the load displacements go on with the velocity that they have
    const double ahead = data.rates.time - state.time;
    for (std::size_t i = 0; i < state.wall_velocity.size(); ++i)
      state.now.wall[MixedLayout<n>::vector(static_cast<int>(i) / n, static_cast<int>(i) % n)] +=
          ahead * state.wall_velocity[i];
    const auto through = extrapolation_weights(state, 1, data.rates.time);
    for (std::size_t i = 0; i < state.now.mesh.size(); ++i)
      state.now.mesh[i] = through[0] * state.before[0].mesh[i] + through[1] * state.before[1].mesh[i];
  }

  auto v = balance_weights(state, order, data);
  if (order == 2 && data.rates.carry < 1 && state.balances_since_jump > 2)
    v = smooth_weights(state.balance_times, data.rates.time);
  const std::array<const Solution*, 3> balances =
      within ? std::array<const Solution*, 3>{&state.stage_balance, &state.balances[0], &state.balances[1]}
             : std::array<const Solution*, 3>{&state.balances[0], &state.balances[1], &state.balances[2]};
  using Mixed = MixedLayout<n>;
  for (auto field : {&Solution::fluid, &Solution::wall}) {
    const auto &p0 = balances[0]->*field, &p1 = balances[1]->*field, &p2 = balances[2]->*field;
    auto& p = state.now.*field;
    for (std::size_t i = Mixed::scalar(0); i < p.size(); i += Mixed::entries)
      p[i] = v[0] * p0[i] + v[1] * p1[i] + v[2] * p2[i];
  }
}

template <int n>
std::array<double, 3> BalanceScheme<n>::balance_weights(const State& state, int order, const StepData& data) const {
  const bool within = data.rates.stage > 0;
  const std::array<double, 3> times =
      within ? std::array<double, 3>{state.stage_time, state.balance_times[0], state.balance_times[1]}
             : state.balance_times;
  const int known = std::max(state.balances_since_jump + (within ? 1 : 0) - 1, 0);
  return extrapolation_weights(times, std::min({order, known, 2}), data.rates.time);
}

template <int n>
void BalanceScheme<n>::push(State& state, Solution balance, double time) {
  std::swap(state.balances[2], state.balances[1]);
  std::swap(state.balances[1], state.balances[0]);
  state.balances[0] = std::move(balance);
  state.balance_times = {time, state.balance_times[0], state.balance_times[1]};
  ++state.balances_since_jump;
}

template <int n>
void BalanceScheme<n>::accept(State& state, const StepData& data) const {
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;
  const StepRates& rates = data.rates;
  const Solution from = start(state, rates.step).of;
  Solution end;
  for_each_field([&](auto field) { end.*field = carried(from.*field, state.now.*field, rates.carry); });
  std::vector<double> end_velocity(state.wall_velocity.size());
  const int nodes = static_cast<int>(end_velocity.size()) / n;
  for (int node = 0; node < nodes; ++node)
    for (int c = 0; c < n; ++c) {
      const std::size_t w = Mixed::vector(node, c);
      end_velocity[Vector::vector(node, c)] = rates.interface.velocity(state.now.wall[w], rates.wall_reference[w]);
    }
  end_velocity = carried(state.wall_velocity, end_velocity, rates.carry);
  if (!rates.last_stage) {
    set_pressures<n>(end, state.now, state.now, 0);
    state.stage = std::move(end);
    state.stage_velocity = std::move(end_velocity);
    state.stage_end = rates.end;
    state.stage_balance = state.now;
    state.stage_time = rates.time;
    return;
  }

  if (rates.stage > 0) push(state, std::move(state.stage_balance), state.stage_time);
  push(state, state.now, rates.time);
  const Solution &q0 = state.balances[0], &q1 = state.balances[1];
  const auto weight = [&](double time) {
    return (state.balance_times[0] - time) / (state.balance_times[0] - state.balance_times[1]);
  };
  if (state.since_jump > 0 && pressures_lag()) set_pressures<n>(state.before[0], q0, q1, weight(state.times[0]));
  const bool extrapolated = rates.time < rates.end && state.balances_since_jump > 1;
  set_pressures<n>(end, q0, q1, extrapolated ? weight(rates.end) : 0.0);

  state.wall_acceleration.resize(end_velocity.size());
  for (int node = 0; node < nodes; ++node)
    for (int c = 0; c < n; ++c) {
      const std::size_t i = Vector::vector(node, c);
      state.wall_acceleration[i] =
          rates.acceleration_factor * state.now.wall[Mixed::vector(node, c)] + rates.acceleration_history[i];
    }
  keep(state, data, from, end, end_velocity);
  state.now = std::move(end);
  state.wall_velocity_before = std::move(state.wall_velocity);
  state.wall_velocity = std::move(end_velocity);
  state.finish_step(data.time);
  state.since_jump = data.ends_at_jump ? 0 : state.since_jump + 1;
  if (data.ends_at_jump) state.balances_since_jump = 0;
}

template class BalanceScheme<1>;
template class BalanceScheme<2>;
template class BalanceScheme<3>;

}  // namespace fsi
