#include "fields/field_units.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "base/names.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr double nearly_all = 0.95;
constexpr std::array<std::pair<const char*, double>, 5> lengths{
    {{"mm", 1}, {"cm", 10}, {"m", 1000}, {"um", 1e-3}, {"in", 25.4}}};

bool holds(const BoundingBox& box, const Point& x, double margin) {
  for (int d = 0; d < 3; ++d)
    if (!(x[d] >= box.low[d] - margin && x[d] <= box.high[d] + margin)) return false;
  return true;
}

}  // namespace

std::optional<double> length_unit(const std::string& word) {
  for (const auto& [name, factor] : lengths)
    if (word == name) return factor;
  return std::nullopt;
}

std::string known_length_units() {
  std::vector<std::string> names;
  for (const auto& [name, factor] : lengths) names.emplace_back(name);
  return one_of(names);
}

std::optional<LengthSlip> length_slip(const std::vector<Point>& points, const std::vector<Point>& places) {
  constexpr double margin = 0.1, spread = 0.3;
  if (points.empty() || places.empty()) return std::nullopt;
  const BoundingBox box(places);
  const double size = BoundingBox(points).size(), whole = box.size();
  const auto fits = [&](double factor) {
    if (!(factor * size >= spread * whole)) return false;
    const auto inside = std::count_if(points.begin(), points.end(),
                                      [&](const Point& x) { return holds(box, factor * x, margin * whole); });
    return static_cast<double>(inside) >= nearly_all * static_cast<double>(points.size());
  };
  if (fits(1)) return std::nullopt;
  std::optional<LengthSlip> found;
  for (const auto& [name, factor] : lengths)
    if (fits(factor) && (!found || factor > found->factor)) found = LengthSlip{name, factor};
  return found;
}

std::optional<LengthSlip> length_slip(const std::vector<Point>& places,
                                      const std::function<double(const Point&)>& distance, double within,
                                      double spacing) {
  constexpr std::size_t most_asked = 1000;
  const std::size_t stride = 1 + places.size() / most_asked;
  const auto fits = [&](double factor) {
    std::size_t asked = 0, near = 0;
    for (std::size_t i = 0; i < places.size(); i += stride, ++asked)
      if (factor * distance((1 / factor) * places[i]) <= (within > 0 ? within : factor * spacing)) ++near;
    return static_cast<double>(near) >= nearly_all * static_cast<double>(asked);
  };
  if (places.empty() || fits(1)) return std::nullopt;
  std::optional<LengthSlip> found;
  for (const auto& [name, factor] : lengths)
    if (fits(factor) && (!found || factor < found->factor)) found = LengthSlip{name, factor};
  return found;
}

}  // namespace fsi
