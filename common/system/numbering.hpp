#pragma once

#include <cassert>
#include <vector>

#include "scene/scene.hpp"
#include "system/field_numbering.hpp"

namespace fsi {

namespace detail {

/// Gives an own unknown, and the equation of the same place, to every component of a vector that `fixed(node,
/// component)` does not prescribe and to every scalar that there is. Vectors come first in each node. A copy of a node
/// hangs on its original's vector and has a scalar of its own.
/// \param scalars  whether a node has one
template <int Components, class Fixed, class Scalars>
UnknownMap number_nodes(const PartNodes& part, std::int64_t& next, Fixed fixed, Scalars scalars) {
  using Mixed = MixedLayout<Components>;
  const int nodes = part.node_count();
  UnknownMap map(Mixed::size(nodes));
  for (int a = 0; a < nodes; ++a) {
    const int original = part.original_of(a);
    assert(original <= a);
    for (int k = 0; k < Components; ++k)
      if (original != a)
        map[Mixed::vector(a, k)] = map[Mixed::vector(original, k)];
      else if (!fixed(a, k))
        map[Mixed::vector(a, k)] = {next++, 1.0};
    if (scalars(a)) map[Mixed::scalar(a)] = {next++, 1.0};
  }
  return map;
}
template <int Components, class Fixed>
UnknownMap number_vectors(int nodes, std::int64_t& next, Fixed fixed) {
  using Vector = VectorLayout<Components>;
  UnknownMap map(Vector::size(nodes));
  for (int a = 0; a < nodes; ++a)
    for (int k = 0; k < Components; ++k)
      if (!fixed(a, k)) map[Vector::vector(a, k)] = {next++, 1.0};
  return map;
}

/// The scene's fluid-wall interface as a flag per fluid node.
template <int n>
std::vector<char> on_interface(const Scene<n>& scene) {
  std::vector<char> on(static_cast<std::size_t>(scene.fluid->node_count()), 0);
  for (const auto& node : scene.interface) on[node.fluid] = 1;
  return on;
}

}  // namespace detail

/// The fluid alone, its velocity free on the interface or prescribed there (Dirichlet side of the partitioned split).
template <int n>
Numbering number_fluid(const Scene<n>& scene, bool free_interface = false) {
  Numbering part;
  const auto wet = detail::on_interface(scene);
  const auto& space = scene.fluid->space();
  part.fluid = detail::number_nodes<n>(
      scene.fluid->nodes(), part.size,
      [&](int a, int k) { return scene.velocity_conditions.fixes(a, k) || (wet[a] && !free_interface); },
      [&](int a) { return space.carries_scalar(a); });
  part.fluid_rows = part.fluid;
  return part;
}

/// The fluid, free on the interface, with its domain, which follows the interface's velocity: d_m = reference + period u
/// there. So derivatives know how the domain moves.
template <int n>
Numbering number_fluid_and_domain(const Scene<n>& scene) {
  using Vector = VectorLayout<n>;
  Numbering part = number_fluid(scene, /*free_interface=*/true);
  const auto wet = detail::on_interface(scene);
  part.mesh = detail::number_vectors<n>(scene.fluid->node_count(), part.size,
                                        [&](int a, int k) { return wet[a] || scene.mesh_conditions.fixes(a, k); });
  part.mesh_rows = part.mesh;
  for (const auto& node : scene.interface)
    for (int k = 0; k < n; ++k) {
      const Unknown velocity = part.fluid[MixedLayout<n>::vector(node.fluid, k)];
      if (velocity.index < 0) continue;
      part.mesh[Vector::vector(node.fluid, k)] = {velocity.index, part.interface.period};
      part.interface_displacements.push_back(Vector::vector(node.fluid, k));
    }
  return part;
}

/// The wall alone, free on the interface (Neumann side of the partitioned split). Where layers with pressures of their
/// own meet, they have one displacement and one momentum equation, the sum of theirs.
template <int n>
Numbering number_wall(const Scene<n>& scene) {
  Numbering part;
  const auto& space = scene.wall->space();
  part.wall = detail::number_nodes<n>(
      scene.wall->nodes(), part.size, [&](int a, int k) { return scene.wall_conditions.fixes(a, k); },
      [&](int a) { return space.carries_scalar(a); });
  part.wall_rows = part.wall;
  return part;
}

/// The mesh motion alone, displacement prescribed on the whole boundary.
template <int n>
Numbering number_mesh_motion(const Scene<n>& scene) {
  Numbering part;
  const auto wet = detail::on_interface(scene);
  part.mesh = detail::number_vectors<n>(scene.fluid->node_count(), part.size,
                                        [&](int a, int k) { return wet[a] || scene.mesh_conditions.fixes(a, k); });
  part.mesh_rows = part.mesh;
  return part;
}

/// The one medium of a scene that has only one.
template <int n>
Numbering number_single_medium(const Scene<n>& scene) {
  assert(!scene.coupled());
  return scene.fluid ? number_fluid(scene) : number_wall(scene);
}

}  // namespace fsi
