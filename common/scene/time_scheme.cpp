#include "scene/time_scheme.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "fem/dimensions.hpp"
#include "scene/wave_speed.hpp"
#include "time/bdf2.hpp"
#include "time/euler_newmark.hpp"
#include "time/generalised_alpha.hpp"
#include "time/shifted_midpoint.hpp"
#include "time/tr_bdf2.hpp"

namespace fsi {

namespace {

/// Of the scene's frequency: what the artery's wave tolerates best (docs/theory.md, section 8.5), 0.2/ms there.
constexpr double share = 0.25;

/// Largest distance of the wall's nodes from the axis of its fibres' frame, mm.
template <int n>
double radius_of_wall(const Case& setup, const Wall<n>& wall) {
  const Point &origin = setup.structure->axis_origin, &axis = setup.structure->axis_direction;
  const double square = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
  double largest = 0;
  for (const Point& x : wall.nodes().nodes) {
    double along = 0, distance = 0;
    for (int k = 0; k < 3; ++k) along += (x[k] - origin[k]) * axis[k] / square;
    for (int k = 0; k < 3; ++k) distance += std::pow(x[k] - origin[k] - along * axis[k], 2);
    largest = std::max(largest, distance);
  }
  return std::sqrt(largest);
}

/// Half the smallest extent of the fluid that is not zero, mm; half a plane through an axis counts whole.
template <int n>
double radius_of_fluid(const Case& setup, const Fluid<n>& fluid) {
  double smallest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Point& x : fluid.nodes().nodes) {
      low = std::min(low, x[k]);
      high = std::max(high, x[k]);
    }
    if (high > low) smallest = std::min(smallest, high - low);
  }
  return setup.geometry == Geometry::axisymmetric ? smallest : smallest / 2;
}

/// Shortest time between two jumps of the load, the start counted among them, ms; infinite when there is no jump.
double shortest_pulse(const Case& setup) {
  double shortest = std::numeric_limits<double>::infinity(), last = 0;
  if (setup.inlet)
    for (double jump : setup.inlet->jumps()) {
      if (jump > last) shortest = std::min(shortest, jump - last);
      last = jump;
    }
  return shortest;
}

}  // namespace

template <int n>
double midpoint_damping(const Case& setup, const Scene<n>& scene) {
  if (scene.coupled()) {
    const double area = std::accumulate(scene.interface_areas.begin(), scene.interface_areas.end(), 0.0);
    return share * wave_speed(scene) * area / (2 * scene.fluid->volume());
  }
  if (scene.wall) {
    double stiffness = 0, volume = 0;
    for (const auto& layer : scene.wall->layer_data()) {
      stiffness += hoop_modulus(layer.material, scene.wall->constants().bulk_modulus) * layer.volume;
      volume += layer.volume;
    }
    return share * std::sqrt(stiffness / volume / scene.wall->constants().density) / radius_of_wall(setup, *scene.wall);
  }
  const AleFluid& form = scene.fluid->form();
  const double decay = form.viscosity / form.density * std::pow(2.405 / radius_of_fluid(setup, *scene.fluid), 2);
  return std::max(decay, share / shortest_pulse(setup));
}

template <int n>
std::unique_ptr<const TimeIntegrator> make_time_scheme(const Case& setup, const Scene<n>& scene) {
  const TimeData& time = setup.time.value();
  switch (time.scheme) {
    case TimeScheme::euler:
      return std::make_unique<EulerNewmark<n>>(NewmarkParameters{time.newmark_beta, time.newmark_gamma});
    case TimeScheme::midpoint:
      return std::make_unique<ShiftedMidpoint<n>>(time.damping ? *time.damping : midpoint_damping(setup, scene));
    case TimeScheme::bdf2:
      return std::make_unique<Bdf2<n>>();
    case TimeScheme::generalised_alpha:
      return std::make_unique<GeneralisedAlpha<n>>(time.spectral_radius);
    case TimeScheme::tr_bdf2:
      return std::make_unique<TrBdf2<n>>();
  }
  throw std::logic_error("a time scheme without an integrator");
}

#define FSI_INSTANTIATE(n)                                           \
  template double midpoint_damping<n>(const Case&, const Scene<n>&); \
  template std::unique_ptr<const TimeIntegrator> make_time_scheme<n>(const Case&, const Scene<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
