#pragma once

#include <string>
#include <vector>

#include "io/fields_writer.hpp"

namespace fsi::test {

// Two small grids that share an interface in space but no nodes. read_sample_fields.py knows the same formulas.

inline std::vector<FieldGrid> sample_grids() {
  FieldGrid fluid;
  fluid.name = "fluid";
  fluid.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  fluid.cells = {0, 1, 2, 3, 1, 2, 3, 4};
  fluid.fields = {{"velocity", 3, "mm/ms"}, {"pressure", 1, "kPa"}};
  FieldGrid wall;
  wall.name = "wall";
  wall.points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 2, 2}, {1, 1, 1}, {3, 2, 2}};
  wall.cells = {0, 1, 2, 4, 1, 2, 3, 4, 1, 2, 3, 5};
  wall.layer = {7, 7, 9};
  wall.fields = {{"displacement", 3, "mm"}, {"pressure", 1, "kPa"}};
  return {fluid, wall};
}

/// Times of steps of one length, ms.
inline auto steps_of(double length) {
  return [length](std::int64_t step) { return static_cast<double>(step) * length; };
}

/// These entries and no others.
inline FieldPlan plan_of(std::vector<FieldStep> entries) {
  const auto count = static_cast<std::int64_t>(entries.size());
  return {count, [entries](std::int64_t i) { return entries.at(static_cast<std::size_t>(i)); }};
}

/// Component c of a vector: x_c + 10 t; a scalar: x + 100 y + 10000 z + t, plus 0.5 in the wall.
inline FieldValues sample_values(const std::vector<FieldGrid>& grids, double time) {
  FieldValues values;
  for (const auto& grid : grids)
    for (const auto& field : grid.fields) {
      auto& data = values[{grid.name, field.name}];
      for (const auto& p : grid.points) {
        if (field.components == 3)
          for (const double x : p) data.push_back(x + 10 * time);
        else
          data.push_back(p[0] + 100 * p[1] + 10000 * p[2] + time + (grid.name == "wall" ? 0.5 : 0.0));
      }
    }
  return values;
}

}  // namespace fsi::test
