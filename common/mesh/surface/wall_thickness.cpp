#include "mesh/surface/wall_thickness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "mesh/fields/point_table.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/point_math.hpp"
#include "mesh/surface/local_radius.hpp"

namespace fsi {

namespace {

constexpr std::size_t most_near = 4;

/// Squared distances and numbers of the nearest places, nearest first.
using Near = std::vector<std::pair<double, std::size_t>>;

Near nearest(const Point& x, const std::vector<Point>& places, std::size_t count) {
  Near near;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Point between = places[i] - x;
    const double squared = dot(between, between);
    if (near.size() == count && squared >= near.back().first) continue;
    if (near.size() == count) near.pop_back();
    near.insert(std::upper_bound(near.begin(), near.end(), std::pair(squared, i)), {squared, i});
  }
  return near;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// How far each node may be from the nearest of the table's points, mm.
std::vector<double> reach_of(const TriangleSurface& surface, const ThicknessTable& table) {
  constexpr std::size_t most_asked = 500;  // points that stand for all
  const std::size_t stride = 1 + table.places.size() / most_asked;
  std::vector<double> to_surface, to_another;
  for (std::size_t i = 0; i < table.places.size(); i += stride) {
    to_surface.push_back(std::sqrt(nearest(table.places[i], surface.nodes, 1).front().first));
    to_another.push_back(std::sqrt(nearest(table.places[i], table.places, 2).back().first));
  }
  const double edge = mean_edge(surface);
  if (median(to_surface) < edge)
    return std::vector<double>(surface.nodes.size(), std::max(3 * median(to_another), 2 * edge));
  auto reach = local_radius(surface, 5);
  for (double& r : reach) r *= 1.5;
  return reach;
}

}  // namespace

ThicknessTable thickness_table(const std::string& text, const std::string& column, const std::string& file) {
  auto [places, values] = point_table(text, column, file, "give it in mm");
  return {file, std::move(places), std::move(values)};
}

std::vector<double> thickness_at(const TriangleSurface& surface, const ThicknessTable& table, int passes) {
  const auto reach = reach_of(surface, table);
  std::vector<double> thickness;
  for (std::size_t node = 0; node < surface.nodes.size(); ++node) {
    const auto near = nearest(surface.nodes[node], table.places, most_near);
    const double away = std::sqrt(near.front().first), value = table.values[near.front().second];
    if (away > reach[node])
      throw InputError(table.file, "thickness",
                       fmt::format("has a hole at {}: the nearest point is {:.3g} mm away, {:.3g} mm are allowed",
                                   place_of(surface.nodes[node]), away, reach[node]),
                       "give thicknesses there, too");
    if (!(std::isfinite(value) && value > 0))
      throw InputError(table.file, "thickness",
                       fmt::format("has a hole at {}: the value there is {:.3g}", place_of(surface.nodes[node]), value),
                       "give a thickness in mm there, above 0");
    double sum = 0, weights = 0;
    for (const auto& [squared, number] : near) {
      if (!(std::isfinite(table.values[number]) && table.values[number] > 0)) continue;
      const double weight = 1 / (squared + 1e-12);
      sum += weight * table.values[number];
      weights += weight;
    }
    thickness.push_back(sum / weights);
  }
  average_with_neighbours(surface, thickness, passes);
  return thickness;
}

}  // namespace fsi
