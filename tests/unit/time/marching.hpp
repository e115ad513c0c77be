#pragma once

#include <cstddef>
#include <vector>

#include "case/case.hpp"
#include "time/time_integrator.hpp"

namespace fsi::test {

/// The load of a balance as the scheme takes it, kPa (Loads::next does the same for a case's tables).
inline double load_of(const PressureTable& table, const StepRates& rates, double load_rate) {
  double load = rates.load_rate_weight * load_rate;
  for (const LoadShare& share : rates.load) load += share.weight * table.mean(share.from, share.to);
  return load;
}

/// Ends of steps between `times`, where loads jump: `steps` a piece, equal, or every third twice as long as the others.
inline std::vector<double> step_ends(const std::vector<double>& times, int steps, bool uneven) {
  std::vector<double> ends;
  for (std::size_t piece = 0; piece + 1 < times.size(); ++piece) {
    const double length = times[piece + 1] - times[piece];
    double units = 0;
    for (int i = 1; i <= steps; ++i) {
      units += uneven && i % 3 == 0 ? 2 : 1;
      const double all = uneven ? steps + steps / 3 : steps;
      ends.push_back(i == steps ? times[piece + 1] : times[piece] + length * units / all);
    }
  }
  return ends;
}

/// One step of a state up to a time, all its stages. `solve(state, data)` leaves the solution of a stage's equations in
/// state.now.
template <class Solve>
void march_step(const TimeIntegrator& scheme, State& state, double end, const PressureTable& load, Solve solve) {
  const double step = end - state.time;
  const int stages = scheme.stages(state);
  for (int stage = 0; stage < stages; ++stage) {
    StepData data;
    data.time = end;
    data.rates = scheme.rates(state, step, stage);
    for (double jump : load.jumps()) data.ends_at_jump = data.ends_at_jump || jump == end;
    const auto rate = [&](std::size_t i) { return state.load_rates.empty() ? 0.0 : state.load_rates[i]; };
    data.opening_pressures = {load_of(load, data.rates, rate(0))};
    data.wall_pressure = load_of(load, data.rates, rate(1));
    solve(state, data);
    scheme.accept(state, data);
  }
}

/// From rest, or from initial displacements, with the history that the scheme keeps.
inline State started(const TimeIntegrator& scheme, const Solution& at, std::size_t wall_components) {
  State state;
  state.now = at;
  state.before = {at, at, at};
  state.wall_velocity.assign(wall_components, 0.0);
  state.wall_acceleration = state.wall_velocity;
  scheme.prepare(state);
  state.load_rates.assign(2, 0.0);
  return state;
}

}  // namespace fsi::test
