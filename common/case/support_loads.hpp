#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"

namespace fsi {

/// A load on the wall from outside: a function of time on a surface, or on the whole wall.
struct SupportLoad {
  std::string surface;   ///< name of the facet group; empty: a force on the wall's volume
  int component = -1;    ///< of a traction or force, a direction of the scene; -1: a pressure that follows the surface
  PressureTable course;  ///< kPa; a force on the volume in kPa/mm
};

/// Axes of space along which the directions of a scene lie.
inline std::vector<int> axes_of(Geometry geometry) {
  if (geometry == Geometry::axisymmetric) return {0, 2};
  if (geometry == Geometry::plane) return {0, 1};
  return {0, 1, 2};
}

/// The loads of a case's supports, and the weight of its wall, in the order in which scenes and loads hold them.
inline std::vector<SupportLoad> support_loads_of(const Case& setup) {
  std::vector<SupportLoad> loads;
  for (const auto& [surface, support] : setup.supports) {
    if (support.pressure) loads.push_back({surface, -1, *support.pressure});
    for (std::size_t k = 0; k < support.traction.size(); ++k)
      loads.push_back({surface, static_cast<int>(k), support.traction[k]});
  }
  if (!setup.structure) return loads;
  const auto axes = axes_of(setup.geometry);
  for (std::size_t k = 0; k < axes.size(); ++k)
    if (const double force = setup.structure->density * setup.structure->gravity[axes[k]]; force != 0)
      loads.push_back({"", static_cast<int>(k), {{{0.0, force}}}});
  return loads;
}

/// The value with which a run in time begins: behind a jump at 0.
inline double first_value(const PressureTable& table) {
  double value = table.points.empty() ? 0.0 : table.points.front().second;
  for (const auto& [time, at_time] : table.points)
    if (time <= 0) value = at_time;
  return value;
}

/// The loads of support_loads_of() on a wall at rest under prestress: as a run in time begins, in statics the whole.
inline std::vector<double> support_loads_at_rest(const Case& setup) {
  std::vector<double> loads;
  for (const SupportLoad& load : support_loads_of(setup))
    loads.push_back(setup.time ? first_value(load.course) : load.course.at_end());
  return loads;
}

}  // namespace fsi
