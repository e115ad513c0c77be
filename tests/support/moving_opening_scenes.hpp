#pragma once

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "fem/nodal_frames.hpp"
#include "support/opening_laws.hpp"
#include "support/ring_meshes.hpp"
#include "support/scenes.hpp"
#include "support/supported_meshes.hpp"

namespace fsi::test {

/// How the ends of the wall at the openings are held.
enum class Ends { slide, free };

/// A case of a box or pipe between `inlet` and `outlet`, whose wall ends `ends` are not clamped.
inline Case case_with(Ends ends, const std::string& normal, double step) {
  Case setup = coupled_case("neo-hookean", step);
  setup.fluid = FluidData{1.3, 0.5, true, false};
  setup.structure->bulk_modulus = 50;
  setup.inlet.reset();
  setup.openings["inlet"].pressure = PressureTable{{{0.0, 0.0}, {4 * step, 0.4}}};
  setup.openings["outlet"].law = windkessel(0.3, 0.4, 0.5, 0, 0.02);
  setup.supports["ends"].fixed = ends == Ends::slide ? std::vector<std::string>{normal} : std::vector<std::string>{};
  return setup;
}

using Rotation = std::array<Direction<3>, 3>;
inline constexpr Rotation unturned{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
inline constexpr Rotation turned{{{0.36, 0.48, -0.8}, {-0.8, 0.6, 0}, {0.48, 0.64, 0.6}}};

/// The box of fluid and wall, turned, its wall ends at the openings in `ends`; the fluid mirrored in y = 0 and 1, so that
/// the frames of planes of symmetry and of openings meet.
template <class Element>
SimplexMesh<3, Element::order> box(int n, const Rotation& rotation, bool mirrored) {
  auto linear = fluid_and_wall_box(n);
  const auto at = [](int axis) {
    return [axis](const Point& x) { return std::abs(x[axis]) < 1e-12 || std::abs(x[axis] - 1) < 1e-12; };
  };
  linear.facet_groups.pop_back();  // outer
  linear.facet_groups.pop_back();  // wall_ends
  typename TetrahedralMesh::FacetGroup ends{"ends", {}}, low{"symmetry_1", {}}, high{"symmetry_2", {}},
      sides{"wall_ends", {}};
  const auto add = [](auto& group, const auto& facets) {
    group.facets.insert(group.facets.end(), facets.begin(), facets.end());
  };
  for (const auto* layer : {"media", "adventitia"}) {
    add(ends, facets_where(linear, layer, at(0)));
    add(sides, facets_where(linear, layer, at(1)));
  }
  for (const auto* region : {"fluid", "media", "adventitia"}) {
    add(low, facets_where(linear, region, where(1, 0)));
    add(high, facets_where(linear, region, where(1, 1)));
  }
  linear.facet_groups.push_back(ends);
  if (mirrored) {
    linear.facet_groups.push_back(low);
    linear.facet_groups.push_back(high);
  } else {
    linear.facet_groups.push_back(sides);
  }
  for (auto& x : linear.nodes) {
    const Point old = x;
    for (int i = 0; i < 3; ++i) x[i] = rotation[i][0] * old[0] + rotation[i][1] * old[1] + rotation[i][2] * old[2];
  }
  return in_order<Element>(linear);
}

/// The piece of the artery 0 < z < length with wall ends `ends`, free outside.
template <class Element>
SimplexMesh<2, Element::order> pipe(const RingCells& cells, double length) {
  auto mesh = pipe_mesh<Element>(cells, length);
  mesh.facet_groups.pop_back();
  for (double z : {0.0, length})
    name_boundary(mesh, "ends", [&](const Point& x) { return where(2, z)(x) && x[0] > inner_radius - 1e-9; });
  return mesh;
}

}  // namespace fsi::test
