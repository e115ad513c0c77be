#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "mesh/group_names.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "support/inflated_tube.hpp"
#include "support/meshes.hpp"

namespace fsi::test {

/// Cells of a ring of blood and its two-layer wall.
struct RingCells {
  int fluid, media, adventitia;  ///< across
  int along;                     ///< around a quarter, or along the axis
};

/// Facets of the boundary of all cells whose nodes all satisfy a predicate, normals outward.
template <class Mesh, class Predicate>
std::vector<typename Mesh::Facet> boundary_where(const Mesh& mesh, Predicate holds) {
  std::vector<typename Mesh::Facet> found;
  for (const auto& facet : boundary_facets(mesh))
    if (std::all_of(facet.nodes.begin(), facet.nodes.end(), [&](int node) { return holds(mesh.nodes[node]); }))
      found.push_back(facet.nodes);
  return found;
}

/// The piece of blood and two-layer wall r0 < r < 1.82 before it is bent round: radius and height of bodies of
/// revolution, radius and angle in the plane, radius, angle and height (one cell) of tetrahedra. Irregular inside.
/// \param along    length in the second coordinate
/// \param grading  1: fluid cells of one size across; 2: their sizes fall linearly towards the wall
template <class Element>
SimplexMesh<Element::dim> unbent_ring(const RingCells& n, double r0, double along, double height, int grading) {
  const int across = n.fluid + n.media + n.adventitia;
  const auto radius = [&](int i) {
    if (i <= n.fluid)
      return inner_radius - (inner_radius - r0) * std::pow(1 - static_cast<double>(i) / n.fluid, grading);
    i -= n.fluid;
    if (i <= n.media) return inner_radius + (middle_radius - inner_radius) * i / n.media;
    return middle_radius + (outer_radius - middle_radius) * (i - n.media) / n.adventitia;
  };
  Random random(5);
  const auto place = [&](int i, int j) {
    const bool bound = i == 0 || i == n.fluid || i == n.fluid + n.media || i == across;
    const double r = radius(i), across_shift = 0.1 * random(), along_shift = 0.1 * random() * along / n.along;
    const double size = bound ? 0.0 : std::min(radius(i + 1) - r, r - radius(i - 1));
    const bool end = j == 0 || j == n.along;
    return std::array<double, 2>{r + across_shift * size, along * j / n.along + (end ? 0.0 : along_shift)};
  };
  const auto region = [&](int i) { return i < n.fluid ? 0 : i < n.fluid + n.media ? 1 : 2; };
  const std::vector<std::string> regions{"fluid", "media", "adventitia"};
  if constexpr (Element::dim == 3) {
    return grid_mesh(
        {across, n.along, 1}, regions,
        [&](int i, int j, int k) {
          const auto [r, angle] = place(i, j);
          return Point{r, angle, height * k};
        },
        [&](int i, int, int) { return region(i); });
  } else {
    return triangle_grid(
        {across, n.along}, regions,
        [&](int i, int j) {
          const auto [r, second] = place(i, j);
          return Point{r, 0, second};
        },
        [&](int i, int) { return region(i); });
  }
}

/// Where a coordinate has a value.
inline auto where(int axis, double value) {
  return [=](const Point& x) { return std::abs(x[axis] - value) < 1e-9; };
}

/// The mesh in the element's order.
template <class Element>
SimplexMesh<Element::dim, Element::order> in_order(const SimplexMesh<Element::dim>& mesh) {
  if constexpr (Element::order == 2) {
    return with_mid_edge_nodes(mesh);
  } else {
    return mesh;
  }
}

/// A piece of a ring of blood and two-layer wall, r0 < r < 1.82, with groups `inlet` (the cylinder of radius r0) and
/// the symmetry planes that bound it. In the plane the quarter x, y > 0, as a body of revolution 0 < z < height, of
/// tetrahedra the quarter x, y > 0 one cell high; quadratic edges lie on the circles.
template <class Element>
SimplexMesh<Element::dim, Element::order> ring_mesh(const RingCells& n, double r0, double height) {
  const double quarter = std::acos(0.0), along = Element::axisymmetric ? height : quarter;
  auto unbent = unbent_ring<Element>(n, r0, along, height, 1);
  const auto add = [&](const char* name, const std::vector<std::pair<int, double>>& places) {
    unbent.facet_groups.push_back({name, {}});
    auto& facets = unbent.facet_groups.back().facets;
    for (const auto& [axis, value] : places) {
      const auto found = boundary_where(unbent, where(axis, value));
      facets.insert(facets.end(), found.begin(), found.end());
    }
  };
  add(group::inlet, {{0, r0}});
  constexpr int second = Element::dim == 3 ? 1 : 2;
  if (Element::axisymmetric) {
    add(group::symmetry[2], {{second, 0}, {second, along}});
  } else {
    add(group::symmetry[1], {{second, 0}});
    add(group::symmetry[0], {{second, along}});
  }
  if (Element::dim == 3) add(group::symmetry[2], {{2, 0}, {2, height}});
  auto mesh = in_order<Element>(unbent);
  if constexpr (!Element::axisymmetric)
    for (auto& x : mesh.nodes) {
      const double angle = x[second];
      x = {angle > quarter - 1e-9 ? 0.0 : x[0] * std::cos(angle), x[0] * std::sin(angle),
           Element::dim == 3 ? x[2] : 0.0};
    }
  return mesh;
}

/// A piece 0 < z < length of a pipe of blood and two-layer wall as a body of revolution, finer towards the wall, with
/// groups `inlet`, `outlet` and `wall_ends`: the wall's ends and its outer face.
template <class Element>
SimplexMesh<2, Element::order> pipe_mesh(const RingCells& n, double length) {
  auto mesh = unbent_ring<Element>(n, 0, length, 0, 2);
  const auto in_fluid = [](double z) {
    return [=](const Point& x) { return where(2, z)(x) && x[0] < inner_radius + 1e-9; };
  };
  mesh.facet_groups = {{group::inlet, boundary_where(mesh, in_fluid(0))},
                       {group::outlet, boundary_where(mesh, in_fluid(length))},
                       {group::wall_ends, boundary_where(mesh, where(0, outer_radius))}};
  auto& held = mesh.facet_groups.back().facets;
  for (double z : {0.0, length})
    for (const auto& facet :
         boundary_where(mesh, [=](const Point& x) { return where(2, z)(x) && x[0] > inner_radius - 1e-9; }))
      held.push_back(facet);
  return in_order<Element>(mesh);
}

}  // namespace fsi::test
