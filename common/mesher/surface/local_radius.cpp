#include "mesher/surface/local_radius.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "mesh/point_math.hpp"

namespace fsi {

namespace {

std::vector<Point> unit_normals(const TriangleSurface& surface) {
  auto normals = area_vectors_at_nodes(surface);
  for (Point& normal : normals) normal = (1 / std::max(norm(normal), 1e-300)) * normal;
  return normals;
}

}  // namespace

std::vector<double> local_radius(const TriangleSurface& surface, int passes) {
  constexpr double cone = 0.5;                 // cosine of 60 degrees
  constexpr std::size_t most_others = 20'000;  // of large surfaces: every n-th node is enough
  const auto normals = unit_normals(surface);
  const auto& x = surface.nodes;
  const std::size_t stride = 1 + x.size() / most_others;
  double largest = 0;
  std::vector<double> radius(x.size(), std::numeric_limits<double>::infinity());
  for (std::size_t p = 0; p < x.size(); ++p) {
    for (std::size_t q = 0; q < x.size(); q += stride) {
      const Point between = x[p] - x[q];
      const double depth = dot(between, normals[p]), squared = dot(between, between);
      if (depth > 0 && depth * depth >= cone * cone * squared && p != q)
        radius[p] = std::min(radius[p], squared / (2 * depth));
    }
    if (radius[p] < std::numeric_limits<double>::infinity()) largest = std::max(largest, radius[p]);
  }
  if (largest == 0) return radius;
  for (double& r : radius) r = std::min(r, largest);  // where nothing lies opposite
  average_with_neighbours(surface, radius, passes);
  return radius;
}

void average_with_neighbours(const TriangleSurface& surface, std::vector<double>& field, int passes) {
  const auto neighbours = neighbours_of(surface);
  for (int pass = 0; pass < passes; ++pass) {
    const auto old = field;
    for (std::size_t i = 0; i < field.size(); ++i) {
      double sum = 0;
      for (const int next : neighbours[i]) sum += old[next];
      field[i] = 0.5 * (old[i] + sum / static_cast<double>(neighbours[i].size()));
    }
  }
}

}  // namespace fsi
