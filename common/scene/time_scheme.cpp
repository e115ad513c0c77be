#include "scene/time_scheme.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "case/openings.hpp"
#include "case/scene_period.hpp"
#include "fem/dimensions.hpp"
#include "scene/wave_speed.hpp"
#include "time/shifted_midpoint.hpp"
#include "time/time_rounding.hpp"
#include "time/time_schemes.hpp"

namespace fsi {

namespace {

/// Largest distance of nodes from an axis, mm: the same for a tube and a sector of it.
double largest_radius(const PartNodes& part, const Point& origin, const Point& axis) {
  const double square = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
  double largest = 0;
  for (const Point& x : part.nodes) {
    double along = 0, distance = 0;
    for (int k = 0; k < 3; ++k) along += (x[k] - origin[k]) * axis[k] / square;
    for (int k = 0; k < 3; ++k) distance += std::pow(x[k] - origin[k] - along * axis[k], 2);
    largest = std::max(largest, distance);
  }
  return std::sqrt(part.processes().largest(largest));
}

/// Half the smaller extent of a plane part, mm.
double half_gap(const PartNodes& part) {
  double smallest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 2; ++k) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double low = infinity, high = -infinity;
    for (const Point& x : part.nodes) {
      low = std::min(low, x[k]);
      high = std::max(high, x[k]);
    }
    smallest = std::min(smallest, part.processes().largest(high) - part.processes().smallest(low));
  }
  return smallest / 2;
}

/// Of a fluid without wall, mm; infinite where it sticks nowhere.
template <int n>
double radius_of_fluid(const Case& setup, const Scene<n>& scene) {
  if (setup.geometry == Geometry::plane) return half_gap(scene.fluid->nodes());
  return 2 * scene.fluid->volume() / scene.closed_area;
}

/// Shortest time between two jumps of the load, the start counted among them, ms; infinite when there is no jump.
double shortest_pulse(const Case& setup) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& [key, table] : tables_over_time(setup)) {
    double last = 0;
    for (double jump : table->jumps(2 * table->period)) {  // of a periodic one between two periods as well
      if (jump > last) shortest = std::min(shortest, jump - last);
      last = jump;
    }
  }
  return shortest;
}

double shortest_period(const Case& setup) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& [key, period] : periods_of_openings(setup)) shortest = std::min(shortest, period);
  return shortest;
}

/// The longest steps that the midpoint rule is chosen for, ms.
double longest_midpoint_step(const TimeData& time, double scene_time) {
  return time.adaptive ? scene_time : (midpoint_bound - 0.5) / midpoint_share * scene_time;
}

}  // namespace

template <int n>
double scene_frequency(const Case& setup, const Scene<n>& scene) {
  if (scene.coupled()) {
    const double area = scene.interface_area();
    return wave_speed(scene) * area / (2 * scene.fluid->volume());
  }
  if (scene.wall) {
    double stiffness = 0, volume = 0;
    for (const auto& layer : scene.wall->layer_data()) {
      stiffness += layer.sudden_hoop_modulus(scene.wall->constants().bulk_modulus) * layer.volume;
      volume += layer.volume;
    }
    return std::sqrt(stiffness / volume / scene.wall->constants().density) /
           largest_radius(scene.wall->nodes(), setup.structure->axis_origin, setup.structure->axis_direction);
  }
  const AleFluid& form = scene.fluid->form();
  const double decay = form.viscosity / form.density * std::pow(2.405 / radius_of_fluid(setup, scene), 2);
  return std::max(decay / midpoint_share, 1 / shortest_pulse(setup));
}

template <int n>
double scene_time(const Case& setup, const Scene<n>& scene) {
  const double frequency = scene_frequency(setup, scene);
  return frequency > 0 ? 1 / frequency : setup.time.value().end;
}

template <int n>
double resolved_time(const Case& setup, const Scene<n>& scene) {
  constexpr double share_of_period = 1.0 / 8;
  return std::min(scene_time(setup, scene), share_of_period * shortest_period(setup));
}

template <int n>
std::string time_scheme_of(const Case& setup, const Scene<n>& scene) {
  const TimeData& time = setup.time.value();
  if (time.scheme) return *time.scheme;
  if (time.adaptive && !time.largest_step) return scheme_for_short_steps;
  const double longest = longest_midpoint_step(time, 1 / scene_frequency(setup, scene));
  const bool is_long = (time.adaptive ? *time.largest_step : time.step) > longest * (1 + time_rounding);
  return is_long ? scheme_for_long_steps : scheme_for_short_steps;
}

template <int n>
std::string about_time_scheme(const Case& setup, const Scene<n>& scene, const std::string& scheme) {
  const TimeData& time = setup.time.value();
  if (time.scheme) return {};
  const std::string name = "time scheme: " + scheme;
  if (scheme != time_scheme_of(setup, scene)) return name + ", that of the run so far";
  if (scheme == scheme_for_short_steps) return name + ", chosen for the length of the steps";
  const double swing = scene_time(setup, scene);
  return fmt::format(
      "{}, chosen because {} of {:g} ms are long against the scene's time of {:.3g} ms: two solves a step, of second "
      "order there, too; midpoint, with one, is chosen up to {:.3g} ms",
      name, time.adaptive ? "largest steps" : "steps", time.adaptive ? *time.largest_step : time.step, swing,
      longest_midpoint_step(time, swing));
}

std::string lost_order(const TimeData& time, const TimeIntegrator& scheme) {
  if (time.adaptive) return {};
  const auto lost = scheme.lost_order(time.step);
  if (!lost) return {};
  const std::string remedy = !lost->remedy.empty() ? lost->remedy
                             : time.scheme         ? "or leave time.scheme out"
                                                   : "or begin a new run";
  return fmt::format("time.step: with {:g} ms {}; give steps of at most {:.3g} ms, {}", time.step, lost->said,
                     lost->longest_step, remedy);
}

template <int n>
std::unique_ptr<const TimeIntegrator> make_time_scheme(const Case& setup, const Scene<n>& scene,
                                                       const std::string& scheme) {
  return make_integrator(scheme, n, setup.time.value().scheme_values, scene_frequency(setup, scene));
}

#define FSI_INSTANTIATE(n)                                                                     \
  template double scene_frequency<n>(const Case&, const Scene<n>&);                            \
  template double scene_time<n>(const Case&, const Scene<n>&);                                 \
  template double resolved_time<n>(const Case&, const Scene<n>&);                              \
  template std::string time_scheme_of<n>(const Case&, const Scene<n>&);                        \
  template std::string about_time_scheme<n>(const Case&, const Scene<n>&, const std::string&); \
  template std::unique_ptr<const TimeIntegrator> make_time_scheme<n>(const Case&, const Scene<n>&, const std::string&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
