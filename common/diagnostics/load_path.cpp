#include "diagnostics/load_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "fem/dimensions.hpp"
#include "scene/level_energy.hpp"

namespace fsi {

namespace {

/// a + factor b
std::vector<double> sum_of(const std::vector<double>& a, double factor, const std::vector<double>& b) {
  std::vector<double> c(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) c[i] = a[i] + factor * b[i];
  return c;
}

template <int n>
double stored_in(const Scene<n>& scene, const State& state) {
  const LevelEnergy level = level_energy(scene, state);
  double energy = level.wall_isochoric + level.wall_volumetric;
  if (const auto* supports = scene.wall->supports()) energy += supports->stored(state.before[0].wall);
  return energy;
}

/// The loads of one load step.
struct LoadValues {
  double pressure;
  std::vector<double> supports;
};

/// Work along `moved` with the surfaces as they are at `at`: this process's part.
template <int n>
double work_at(const Scene<n>& scene, const LoadValues& loads, const std::vector<double>& at,
               const std::vector<double>& moved) {
  const std::vector<double> from = sum_of(at, -1, moved);
  double work = scene.wall->pressure_work(loads.pressure, from, at);
  if (const auto* supports = scene.wall->supports(); supports != nullptr && !loads.supports.empty()) {
    WallStep step;
    step.balance.wall = at.data();
    step.balance.support_loads = loads.supports.data();
    step.reference = step.start = from.data();
    step.end = at.data();
    work += supports->work(step).loads;
  }
  return work;
}

/// By Simpson's rule along the straight way: areas are quadratic in it.
template <int n>
double work_of(const Scene<n>& scene, const LoadValues& loads, const std::vector<double>& start,
               const std::vector<double>& moved) {
  double work = 0;
  for (const auto& [share, weight] : {std::array{0.0, 1.0 / 6}, std::array{0.5, 4.0 / 6}, std::array{1.0, 1.0 / 6}})
    work += weight * work_at(scene, loads, sum_of(start, share, moved), moved);
  return work;
}

}  // namespace

double LoadPathEnergy::excess() const {
  const double low = std::min(work_before, work_after), high = std::max(work_before, work_after);
  const double beyond = std::max({low - stored, stored - high, 0.0});
  if (!(beyond > 0)) return std::isnan(beyond) ? beyond : 0;
  return beyond / std::max({std::abs(stored), std::abs(low), std::abs(high)});
}

template <int n>
LoadPathEnergy load_path_energy(const Scene<n>& scene, const Loads& loads, int step, const State& before,
                                const State& after) {
  const auto values = [&](int of) { return LoadValues{loads.wall_pressure(of), loads.static_support_loads(of)}; };
  const std::vector<double>& start = before.before[0].wall;
  const std::vector<double> moved = sum_of(after.before[0].wall, -1, start);
  std::array<double, 3> sums{stored_in(scene, after) - stored_in(scene, before),
                             work_of(scene, values(step - 1), start, moved),
                             work_of(scene, values(step), start, moved)};
  scene.processes().sum(sums.data(), sums.size());
  return {sums[0], sums[1], sums[2]};
}

std::string text_of(const LoadPathEnergy& energy) {
  return fmt::format(
      "the wall's elastic energy changes by {:.4g} uJ, where the loads' work is {:.4g} uJ as they are before and "
      "{:.4g} "
      "uJ as they are after",
      energy.stored, energy.work_before, energy.work_after);
}

#define FSI_INSTANTIATE(n) \
  template LoadPathEnergy load_path_energy(const Scene<n>&, const Loads&, int, const State&, const State&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
