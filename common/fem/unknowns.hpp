#pragma once

#include <cstdint>
#include <vector>

namespace fsi {

/// Where a nodal value of a field stands in a system of equations: value = factor * x[unknown] + known part.
/// A prescribed value has no unknown (-1). Several nodal values may depend on one unknown, as velocity, mesh and wall
/// displacement do on the fluid-wall interface.
struct Unknown {
  std::int64_t index = -1;
  double factor = 1;
};

/// The unknowns of one field (or the equations of one residual), entry by entry.
using UnknownMap = std::vector<Unknown>;

/// field += step * (factor * x)
inline void add_to_field(const UnknownMap& map, const std::vector<double>& x, double step, std::vector<double>& field) {
  for (std::size_t i = 0; i < map.size(); ++i)
    if (map[i].index >= 0) field[i] += step * map[i].factor * x[map[i].index];
}

/// system += factor * residual, entries without an equation dropped.
inline void add_to_system(const UnknownMap& map, const std::vector<double>& residual, std::vector<double>& system) {
  for (std::size_t i = 0; i < map.size(); ++i)
    if (map[i].index >= 0) system[map[i].index] += map[i].factor * residual[i];
}

}  // namespace fsi
