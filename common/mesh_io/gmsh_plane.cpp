#include "mesh_io/gmsh_plane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

template <int Order>
void lay_into_plane(const std::string& file, GmshFile& gmsh, const std::vector<TriangleCell<Order>>& cells,
                    TriangleGeometry geometry) {
  const auto fail = [&file](const std::string& key, const std::string& problem, const std::string& remedy) {
    throw InputError(file, key, problem, remedy);
  };
  std::vector<char> used(gmsh.nodes.size(), 0);
  for (const auto& cell : cells)
    for (const int node : cell) used[node] = 1;
  Point most{0, 0, 0}, low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t n = 0; n < used.size(); ++n)
    if (used[n])
      for (int d = 0; d < 3; ++d) {
        most[d] = std::max(most[d], std::abs(gmsh.nodes[n][d]));
        low[d] = std::min(low[d], gmsh.nodes[n][d]);
        high[d] = std::max(high[d], gmsh.nodes[n][d]);
      }
  const double rounding = 1e-9 * distance(low, high);
  const bool axisymmetric = geometry == TriangleGeometry::axisymmetric;
  if (axisymmetric && most[1] > rounding && most[2] <= rounding) {  // drawn with the axis along y
    for (auto& x : gmsh.nodes) std::swap(x[1], x[2]);
    std::swap(most[1], most[2]);
  }
  const int across = axisymmetric ? 1 : 2;
  if (most[across] > rounding) {
    const auto off = [&](std::size_t n) { return used[n] && std::abs(gmsh.nodes[n][across]) > rounding; };
    std::size_t first = 0;
    while (!off(first)) ++first;
    const Point& x = gmsh.nodes[first];
    fail(fmt::format("node {}", gmsh.node_tags[first]),
         fmt::format("({:.6g}, {:.6g}, {:.6g}) is out of the plane of the mesh", x[0], x[1], x[2]),
         axisymmetric ? "an axisymmetric mesh lies in the plane y = 0 (r along x, axis along z) or in the plane z = 0 "
                        "(r along x, axis along y)"
                      : "a plane mesh lies in the plane z = 0");
  }
  for (std::size_t n = 0; n < used.size(); ++n) {
    if (!used[n]) continue;
    Point& x = gmsh.nodes[n];
    x[across] = 0;
    if (!axisymmetric) continue;
    if (x[0] < -rounding)
      fail(fmt::format("node {}", gmsh.node_tags[n]), fmt::format("its radius is negative, r = x = {:.6g} mm", x[0]),
           "draw the half of the section with x >= 0; or choose geometry = \"plane\"");
    if (x[0] <= rounding) x[0] = 0;
  }
}

template <int Order>
void turn_counter_clockwise(const std::vector<Point>& nodes, std::vector<TriangleCell<Order>>& cells) {
  for (auto& cell : cells) {
    if (triangle_area(nodes[cell[0]], nodes[cell[1]], nodes[cell[2]]) >= 0) continue;
    std::swap(cell[1], cell[2]);
    if constexpr (Order == 2) std::swap(cell[3], cell[5]);
  }
}

template void lay_into_plane<1>(const std::string&, GmshFile&, const std::vector<TriangleCell<1>>&, TriangleGeometry);
template void turn_counter_clockwise<1>(const std::vector<Point>&, std::vector<TriangleCell<1>>&);
template void lay_into_plane<2>(const std::string&, GmshFile&, const std::vector<TriangleCell<2>>&, TriangleGeometry);
template void turn_counter_clockwise<2>(const std::vector<Point>&, std::vector<TriangleCell<2>>&);

}  // namespace fsi
