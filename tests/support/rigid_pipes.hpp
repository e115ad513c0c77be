#pragma once

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "mesh/group_names.hpp"
#include "support/ring_meshes.hpp"

namespace fsi::test {

inline constexpr double pipe_radius = 1.2;  // mm

/// A rigid pipe 0 < z < length with groups inlet and outlet: of revolution, cells smaller towards the wall; of
/// tetrahedra the quarter x, y > 0, quadratic edges on the circle.
template <class Element>
SimplexMesh<Element::dim, Element::order> rigid_pipe(int across, int along, double length) {
  const auto groups = [&](auto& mesh, const auto& list) {
    for (const auto& [name, axis, value] : list)
      mesh.facet_groups.push_back({name, boundary_where(mesh, where(axis, value))});
  };
  using Group = std::tuple<const char*, int, double>;
  if constexpr (Element::dim == 2) {
    auto mesh = triangle_grid(
        {across, along}, {"fluid"},
        [&](int i, int j) {
          const double s = 1 - static_cast<double>(i) / across;
          return Point{pipe_radius * (1 - s * (0.5 + 0.5 * s)), 0, length * j / along};
        },
        [](int, int) { return 0; });
    groups(mesh, std::vector<Group>{{group::inlet, 2, 0.0}, {group::outlet, 2, length}});
    return in_order<Element>(mesh);
  } else {
    auto linear = grid_mesh(
        {across, across, along}, {"fluid"},
        [&](int i, int j, int k) {
          return Point{static_cast<double>(i) / across, static_cast<double>(j) / across, length * k / along};
        },
        [](int, int, int) { return 0; });
    groups(linear, std::vector<Group>{{group::inlet, 2, 0.0},
                                      {group::outlet, 2, length},
                                      {group::symmetry[0], 0, 0.0},
                                      {group::symmetry[1], 1, 0.0}});
    auto mesh = in_order<Element>(linear);
    for (auto& x : mesh.nodes)  // the square's outer sides become the arc
      x = {pipe_radius * x[0] * std::sqrt(1 - 0.5 * x[1] * x[1]), pipe_radius * x[1] * std::sqrt(1 - 0.5 * x[0] * x[0]),
           x[2]};
    return mesh;
  }
}

}  // namespace fsi::test
