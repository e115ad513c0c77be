#include "diagnostics/limit_load.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/dimensions.hpp"
#include "materials/material.hpp"
#include "mesh/axis.hpp"

namespace fsi {

namespace {

/// A layer measured as if it were a tube.
struct TubeLayer {
  double inner = std::numeric_limits<double>::infinity(), outer = 0;  ///< mm
  double first = std::numeric_limits<double>::infinity(), last = -first;
  double volume = 0;  ///< mm^3

  /// Whether it fills the tube between its radii but for what flat faces cut off.
  bool is_tube() const {
    constexpr double pi = 3.14159265358979323846, cut_off = 0.15;
    const double whole = pi * (outer * outer - inner * inner) * (last - first);
    return inner > 0 && std::abs(volume - whole) <= cut_off * whole;
  }
};

TubeLayer measure(const LayerData& data, const PartNodes& wall, const AxisFrame& frame) {
  TubeLayer layer;
  layer.volume = data.volume;
  for (const int node : data.nodes) {
    const double radius = frame.radius(wall.nodes[node]), along = frame.axial(wall.nodes[node]);
    layer.inner = std::min(layer.inner, radius);
    layer.outer = std::max(layer.outer, radius);
    layer.first = std::min(layer.first, along);
    layer.last = std::max(layer.last, along);
  }
  const Communicator& processes = wall.processes();
  for (double* lowest : {&layer.inner, &layer.first}) *lowest = processes.smallest(*lowest);
  for (double* highest : {&layer.outer, &layer.last}) *highest = processes.largest(*highest);
  return layer;
}

}  // namespace

template <int n>
std::optional<double> tube_limit_load(const StructureData& data, const Wall<n>& wall) {
  const AxisFrame frame({data.axis_origin, data.axis_direction});
  double limit = 0;
  for (const LayerData& measured : wall.layer_data()) {
    const auto modulus = inflation_modulus(measured.material);
    if (!modulus) return std::nullopt;
    const TubeLayer layer = measure(measured, wall.nodes(), frame);
    if (!layer.is_tube()) return std::nullopt;
    limit += *modulus * std::log(layer.outer / layer.inner);
  }
  return limit;
}

#define FSI_INSTANTIATE(n) template std::optional<double> tube_limit_load(const StructureData&, const Wall<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
