#include "time/euler_newmark.hpp"

#include <cassert>

#include "fem/nodal_layout.hpp"

namespace fsi {

template <int Components>
StepRates EulerNewmark<Components>::rates_of(const State& state, double step, int) const {
  assert(step > 0);
  const Solution& old = state.before[0];
  StepRates rates;
  rates.step = step;
  rates.start = state.time;
  rates.time = rates.end = state.time + step;
  rates.load = {{rates.start, rates.end, 1}};
  rates.interface.period = step;
  rates.strain_lag = step / 2;
  rates.fluid_factor = 1.0 / step;
  rates.acceleration_factor = 1.0 / (newmark_.beta * step * step);
  rates.mesh_reference = old.mesh;
  rates.fluid_reference = old.fluid;
  rates.wall_reference = old.wall;
  rates.openings_reference = old.openings;
  rates.branches_reference = old.branches;

  using Vector = VectorLayout<Components>;
  using Mixed = MixedLayout<Components>;
  auto& history = rates.acceleration_history;
  history.resize(state.wall_velocity.size());
  const int nodes = static_cast<int>(history.size()) / Components;
  for (int node = 0; node < nodes; ++node)
    for (int k = 0; k < Components; ++k) {
      const std::size_t i = Vector::vector(node, k);
      history[i] = -rates.acceleration_factor * old.wall[Mixed::vector(node, k)] -
                   state.wall_velocity[i] / (newmark_.beta * step) -
                   (1 / (2 * newmark_.beta) - 1) * state.wall_acceleration[i];
    }
  return rates;
}

template <int Components>
void EulerNewmark<Components>::accept(State& state, const StepData& data) const {
  using Vector = VectorLayout<Components>;
  using Mixed = MixedLayout<Components>;
  const StepRates& rates = data.rates;
  const double gamma = newmark_.gamma;
  const int nodes = static_cast<int>(state.wall_velocity.size()) / Components;
  for (int node = 0; node < nodes; ++node)
    for (int k = 0; k < Components; ++k) {
      const std::size_t i = Vector::vector(node, k);
      const double acceleration =
          rates.acceleration_factor * state.now.wall[Mixed::vector(node, k)] + rates.acceleration_history[i];
      state.wall_velocity[i] += rates.step * (gamma * acceleration + (1 - gamma) * state.wall_acceleration[i]);
      state.wall_acceleration[i] = acceleration;
    }
  state.finish_step(data.time);
}

template class EulerNewmark<1>;
template class EulerNewmark<2>;
template class EulerNewmark<3>;

}  // namespace fsi
