#include "scene/time_scheme.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "case/openings.hpp"
#include "fem/dimensions.hpp"
#include "scene/wave_speed.hpp"
#include "time/bdf2.hpp"
#include "time/euler_newmark.hpp"
#include "time/generalised_alpha.hpp"
#include "time/shifted_midpoint.hpp"
#include "time/tr_bdf2.hpp"

namespace fsi {

namespace {

constexpr double rounding = 1e-9;  // that the product of a step and a rate may have

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

/// Of a fluid without wall, mm: its largest distance from the z axis, where the axis of such a tube lies; half the smaller
/// extent of a plane one.
double radius_of_fluid(const Case& setup, const PartNodes& part) {
  if (setup.geometry != Geometry::plane) return largest_radius(part, {0, 0, 0}, {0, 0, 1});
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

}  // namespace

template <int n>
double midpoint_damping(const Case& setup, const Scene<n>& scene) {
  if (scene.coupled()) {
    const double area = scene.interface_area();
    return midpoint_share * wave_speed(scene) * area / (2 * scene.fluid->volume());
  }
  if (scene.wall) {
    double stiffness = 0, volume = 0;
    for (const auto& layer : scene.wall->layer_data()) {
      stiffness += hoop_modulus(layer.material, scene.wall->constants().bulk_modulus) * layer.volume;
      volume += layer.volume;
    }
    return midpoint_share * std::sqrt(stiffness / volume / scene.wall->constants().density) /
           largest_radius(scene.wall->nodes(), setup.structure->axis_origin, setup.structure->axis_direction);
  }
  const AleFluid& form = scene.fluid->form();
  const double decay =
      form.viscosity / form.density * std::pow(2.405 / radius_of_fluid(setup, scene.fluid->nodes()), 2);
  return std::max(decay, midpoint_share / shortest_pulse(setup));
}

double largest_midpoint_theta(const TimeData& time) {
  return time.damping ? 1 : midpoint_bound;
}

template <int n>
TimeScheme time_scheme_of(const Case& setup, const Scene<n>& scene) {
  const TimeData& time = setup.time.value();
  if (time.scheme) return *time.scheme;
  const double rate = midpoint_damping(setup, scene);
  const bool is_long = time.adaptive ? time.largest_step && rate * *time.largest_step > midpoint_share * (1 + rounding)
                                     : rate * time.step > (midpoint_bound - 0.5) * (1 + rounding);
  return is_long ? TimeScheme::tr_bdf2 : TimeScheme::midpoint;
}

template <int n>
std::string about_time_scheme(const Case& setup, const Scene<n>& scene, TimeScheme scheme) {
  const TimeData& time = setup.time.value();
  if (time.scheme) return {};
  const std::string name = "time scheme: " + time_schemes().name_of(scheme);
  if (scheme != time_scheme_of(setup, scene)) return name + ", that of the run so far";
  if (scheme == TimeScheme::midpoint) return name + ", chosen for the length of the steps";
  const double scene_time = midpoint_share / midpoint_damping(setup, scene);
  const double most = time.adaptive ? scene_time : (midpoint_bound - 0.5) / midpoint_share * scene_time;
  return fmt::format(
      "{}, chosen because {} of {:g} ms are long against the scene's time of {:.3g} ms: two solves a step, of second "
      "order "
      "there, too; midpoint, with one, is chosen up to {:.3g} ms",
      name, time.adaptive ? "largest steps" : "steps", time.adaptive ? *time.largest_step : time.step, scene_time,
      most);
}

template <int n>
std::string lost_order(const Case& setup, const Scene<n>& scene, TimeScheme scheme) {
  const TimeData& time = setup.time.value();
  if (scheme != TimeScheme::midpoint || time.adaptive) return {};
  const double rate = time.damping ? *time.damping : midpoint_damping(setup, scene);
  const double most = (midpoint_bound - 0.5) / rate;
  if (!(time.step > most * (1 + rounding))) return {};
  const std::string remedy = time.damping  ? "a smaller time.damping, or leave time.scheme and time.damping out"
                             : time.scheme ? "or leave time.scheme out"
                                           : "or begin a new run";
  return fmt::format(
      "time.step: with {:g} ms the midpoint rule has theta = {:.3g} and an error that falls like the step, not like "
      "its "
      "square; give steps of at most {:.3g} ms, {}",
      time.step, std::min(largest_midpoint_theta(time), 0.5 + rate * time.step), most, remedy);
}

template <int n>
std::unique_ptr<const TimeIntegrator> make_time_scheme(const Case& setup, const Scene<n>& scene, TimeScheme scheme) {
  const TimeData& time = setup.time.value();
  switch (scheme) {
    case TimeScheme::euler:
      return std::make_unique<EulerNewmark<n>>(NewmarkParameters{time.newmark_beta, time.newmark_gamma});
    case TimeScheme::midpoint:
      return std::make_unique<ShiftedMidpoint<n>>(time.damping ? *time.damping : midpoint_damping(setup, scene),
                                                  largest_midpoint_theta(time));
    case TimeScheme::bdf2:
      return std::make_unique<Bdf2<n>>();
    case TimeScheme::generalised_alpha:
      return std::make_unique<GeneralisedAlpha<n>>(time.spectral_radius);
    case TimeScheme::tr_bdf2:
      return std::make_unique<TrBdf2<n>>();
  }
  throw std::logic_error("a time scheme without an integrator");
}

#define FSI_INSTANTIATE(n)                                                             \
  template double midpoint_damping<n>(const Case&, const Scene<n>&);                   \
  template TimeScheme time_scheme_of<n>(const Case&, const Scene<n>&);                 \
  template std::string about_time_scheme<n>(const Case&, const Scene<n>&, TimeScheme); \
  template std::string lost_order<n>(const Case&, const Scene<n>&, TimeScheme);        \
  template std::unique_ptr<const TimeIntegrator> make_time_scheme<n>(const Case&, const Scene<n>&, TimeScheme);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
