#pragma once

#include "system/numbering.hpp"

namespace fsi {

/// The whole scene as one system of equations: what makes the method monolithic. On the interface of fluid and wall
/// there is one unknown, the wall's displacement: d_m = d_s, and u = (d_s - reference) / period, so that
/// du = d(d_s) / period; one momentum equation, the sum of the fluid's and the wall's (traction balance); and no
/// equation of mesh motion. This is the system of [Langer2018], section 3.4, with its two identity rows eliminated:
/// Newton's iterates are the same, the factorisation is smaller (docs/theory.md, section 9.1). A scene of one medium
/// has that one's numbering.
template <int n>
Numbering number_scene(const Scene<n>& scene) {
  if (!scene.coupled()) return number_single_medium(scene);
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;
  Numbering all = detail::number_wall_here(scene);
  const int nodes = scene.fluid->node_count();
  const auto wet = detail::on_interface(scene);
  const auto& space = scene.fluid->space();
  all.fluid = detail::number_nodes<n>(
      scene.fluid->nodes(), all.size, [&](int a, int k) { return wet[a] || scene.velocity_conditions.fixes(a, k); },
      [&](int a) { return space.carries_scalar(a); });
  all.fluid_rows = all.fluid;
  all.mesh = detail::number_vectors<n>(nodes, all.size,
                                       [&](int a, int k) { return wet[a] || scene.mesh_conditions.fixes(a, k); });
  all.mesh_rows = all.mesh;
  for (const auto& i : scene.interface)
    for (int k = 0; k < n; ++k) {
      const Unknown displacement = all.wall[Mixed::vector(i.wall, k)];
      if (displacement.index < 0) continue;
      all.mesh[Vector::vector(i.fluid, k)] = displacement;
      all.fluid[Mixed::vector(i.fluid, k)] = {displacement.index, all.interface.rate()};
      all.fluid_rows[Mixed::vector(i.fluid, k)] = displacement;
      all.interface_velocities.push_back(Mixed::vector(i.fluid, k));
    }
  detail::share_out(scene, all);
  return all;
}

}  // namespace fsi
