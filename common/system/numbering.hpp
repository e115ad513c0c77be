#pragma once

#include <vector>

#include "fem/unknowns.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// Which entries of a Solution are unknowns of a system of equations, and which residual rows are its equations. Maps
/// of absent parts are empty.
struct Numbering {
  std::int64_t size = 0;
  UnknownMap mesh_rows, mesh;  ///< mesh motion: equations, unknowns d_m
  UnknownMap flow_rows, flow;  ///< momentum and continuity; (u, p_f)
  UnknownMap wall_rows, wall;  ///< momentum and volume; (d_s, p_s)
};

namespace detail {

/// Gives an own unknown, and the equation of the same place, to every entry that is not prescribed. Vectors come first
/// in each node; `fixed(node)` prescribes the vector, scalars are never prescribed.
template <class Fixed>
UnknownMap number_nodes(int nodes, int vector_entries, int entries, std::int64_t& next, Fixed fixed) {
  UnknownMap map(static_cast<std::size_t>(nodes) * entries);
  for (int a = 0; a < nodes; ++a)
    for (int k = 0; k < entries; ++k)
      if (k >= vector_entries || !fixed(a)) map[static_cast<std::size_t>(a) * entries + k] = {next++, 1.0};
  return map;
}

}  // namespace detail

/// The whole scene. On the interface of fluid and wall there is one unknown, the wall's displacement: d_m = d_s, and
/// u = (d_s - d_s^(n-1)) / dt, so du = d(d_s) / dt; one momentum equation, the sum of the fluid's and the wall's
/// (traction balance); and no equation of mesh motion. This is the paper's system (its section 3.4) with its two
/// identity rows eliminated: Newton's iterates are the same, the factorisation is smaller.
template <class Element>
Numbering number_scene(const Scene<Element>& scene) {
  constexpr int n = Element::components;
  Numbering all;
  if (scene.wall) {
    all.wall = detail::number_nodes(scene.wall->node_count(), n, n + 1, all.size,
                                    [&](int a) { return scene.clamped[a] != 0; });
    all.wall_rows = all.wall;
  }
  if (scene.fluid) {
    const int nodes = scene.fluid->node_count();
    std::vector<int> wall_node(nodes, -1);
    for (const auto& i : scene.interface) wall_node[i.fluid] = i.wall;
    all.flow =
        detail::number_nodes(nodes, n, n + 1, all.size, [&](int a) { return scene.no_slip[a] || wall_node[a] >= 0; });
    all.flow_rows = all.flow;
    if (scene.coupled()) {
      all.mesh =
          detail::number_nodes(nodes, n, n, all.size, [&](int a) { return scene.mesh_fixed[a] || wall_node[a] >= 0; });
      all.mesh_rows = all.mesh;
      for (const auto& i : scene.interface)
        for (int k = 0; k < n; ++k) {
          const Unknown displacement = all.wall[static_cast<std::size_t>(i.wall) * (n + 1) + k];
          if (displacement.index < 0) continue;
          all.mesh[static_cast<std::size_t>(i.fluid) * n + k] = displacement;
          all.flow[static_cast<std::size_t>(i.fluid) * (n + 1) + k] = {displacement.index, 1.0 / scene.scheme.step};
          all.flow_rows[static_cast<std::size_t>(i.fluid) * (n + 1) + k] = displacement;
        }
    }
  }
  return all;
}

/// The fluid alone, velocity prescribed on the interface (Dirichlet side of the partitioned split).
template <class Element>
Numbering number_fluid(const Scene<Element>& scene) {
  constexpr int n = Element::components;
  Numbering part;
  std::vector<char> prescribed = scene.no_slip;
  for (const auto& i : scene.interface) prescribed[i.fluid] = 1;
  part.flow =
      detail::number_nodes(scene.fluid->node_count(), n, n + 1, part.size, [&](int a) { return prescribed[a] != 0; });
  part.flow_rows = part.flow;
  return part;
}

/// The wall alone, free on the interface (Neumann side of the partitioned split).
template <class Element>
Numbering number_wall(const Scene<Element>& scene) {
  constexpr int n = Element::components;
  Numbering part;
  part.wall =
      detail::number_nodes(scene.wall->node_count(), n, n + 1, part.size, [&](int a) { return scene.clamped[a] != 0; });
  part.wall_rows = part.wall;
  return part;
}

/// The mesh motion alone, displacement prescribed on the whole boundary.
template <class Element>
Numbering number_mesh_motion(const Scene<Element>& scene) {
  constexpr int n = Element::components;
  Numbering part;
  std::vector<char> prescribed = scene.mesh_fixed;
  for (const auto& i : scene.interface) prescribed[i.fluid] = 1;
  part.mesh =
      detail::number_nodes(scene.fluid->node_count(), n, n, part.size, [&](int a) { return prescribed[a] != 0; });
  part.mesh_rows = part.mesh;
  return part;
}

}  // namespace fsi
