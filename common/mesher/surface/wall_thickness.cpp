#include "mesher/surface/wall_thickness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "fields/field_units.hpp"
#include "fields/point_table.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/point_math.hpp"
#include "mesher/surface/local_radius.hpp"

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
  std::vector<double> between_points(surface.nodes.size(), std::max(3 * median(to_another), 2 * edge));
  if (median(to_surface) < edge) return between_points;
  auto reach = local_radius(surface, 5);
  for (double& r : reach) r *= 1.5;
  return std::isfinite(reach.front()) ? reach : between_points;
}

/// The beginning of a remedy for a hole that another unit of length would explain; else empty.
std::string slip_of(const TriangleSurface& surface, const ThicknessTable& table) {
  const auto slip = length_slip(table.places, surface.nodes);
  return slip ? fmt::format("times {:g} its points would fit: give --thickness-unit {}, if it is in {}; else ",
                            slip->factor, slip->unit, slip->unit)
              : "";
}

}  // namespace

ThicknessTable thickness_table(const std::string& text, const std::string& column, const std::string& file) {
  auto table = point_table(text, column, file, "give it in mm");
  if (!table.unit.empty()) {
    const auto factor = length_unit(table.unit);
    if (!factor)
      throw InputError(file, "column " + column, table.unit + " is no known unit of length",
                       "there are " + known_length_units());
    for (double& value : table.values) value *= *factor;
  }
  return {file, std::move(table.places), std::move(table.values), table.length_unit, table.unit};
}

void bring_to_mm(ThicknessTable& table, const ThicknessUnits& units) {
  const auto factor = [&](const char* option, const std::string& unit, const std::string& of_file) {
    if (unit.empty() || unit == of_file) return 1.0;
    if (!of_file.empty())
      throw InputError(table.file, option, unit + " is not what the header of the file says, " + of_file,
                       "leave it out, or correct the header");
    return length_unit(unit).value_or(1.0);
  };
  const double of_values = factor("--thickness-unit", units.values, table.unit);
  const double of_places = units.places.empty() && table.length_unit.empty()
                               ? length_unit(units.values).value_or(1.0)
                               : factor("--thickness-points-unit", units.places, table.length_unit);
  for (Point& x : table.places) x = of_places * x;
  for (double& value : table.values) value *= of_values;
}

std::string thickness_slip(const TriangleSurface& surface, const std::vector<double>& thickness) {
  constexpr double thinnest = 0.015, thickest = 3;  // of the radius: aneurysms, arterioles
  constexpr double usual_least = 0.02, usual_most = 1;
  auto shares = local_radius(surface, 5);
  if (!std::isfinite(shares.front())) return "";
  for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = thickness[i] / shares[i];
  const double share = median(shares);
  if (share >= thinnest && share <= thickest) return "";
  std::string fitting;
  for (const char* unit : {"cm", "m", "um"})
    if (const double other = share * *length_unit(unit); other >= usual_least && other <= usual_most)
      fitting = fmt::format(
          ": did you mean {}? --thickness-unit {} would make it {:.3g}, with --thickness-points-unit mm "
          "for points in mm",
          unit, unit, other);
  return fmt::format("half of the wall is {} than {:.3g} of the lumen's radius, as no vessel's is{}",
                     share < thinnest ? "thinner" : "thicker", share, fitting);
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
                       slip_of(surface, table) + "give thicknesses there, too");
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
