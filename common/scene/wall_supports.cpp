#include "scene/wall_supports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "case/support_loads.hpp"
#include "fem/contributions.hpp"
#include "fem/element_packs.hpp"
#include "fem/elements.hpp"
#include "fem/facet_load.hpp"
#include "fem/held_components.hpp"
#include "wall/supports.hpp"

namespace fsi {

namespace {

constexpr double parallel = 1e-4;       // normals that differ by less are one
constexpr std::size_t most_planes = 6;  // of one surface: more of them are a curved one

/// Facets of one normal.
template <class Element>
struct SupportedPart {
  Direction<Element::components> normal;  ///< unit vector; components below 1e-10 are taken for rounding
  FacetsOf<Element> facets;
};

template <class Element>
std::vector<SupportedPart<Element>> flat_parts(const MeshOf<Element>& mesh, const FacetsOf<Element>& facets) {
  constexpr int n = Element::components;
  using F = typename Element::Facet;
  std::vector<SupportedPart<Element>> parts;
  for (const auto& facet : facets) {
    Vec3<Pack> corner[F::nodes];
    facet_corners<F>(mesh.nodes, facet, corner);
    Direction<n> normal{};
    for (int q = 0; q < F::points; ++q) {
      const auto weighted = F::weighted_normal(corner, q);
      for (int k = 0; k < n; ++k) normal[k] += weighted[Element::axis[k]][0];
    }
    const double length = std::sqrt(detail::dot<n>(normal, normal));
    for (double& x : normal) {
      x /= length;
      if (std::abs(x) < 1e-10) x = 0;
    }
    const auto known = std::find_if(parts.begin(), parts.end(), [&](const auto& part) {
      const double cosine = detail::dot<n>(part.normal, normal);
      return 1 - cosine * cosine < parallel * parallel;
    });
    if (known != parts.end())
      known->facets.push_back(facet);
    else if (parts.size() <= most_planes)
      parts.push_back({normal, {facet}});
  }
  return parts;
}

/// The direction of a name of SupportData::fixed other than "normal".
template <class Element>
Direction<Element::components> direction_of(const std::string& name) {
  const int axis = name == "z" ? 2 : name == "y" ? 1 : 0;  // r is along x
  Direction<Element::components> direction{};
  for (int k = 0; k < Element::components; ++k)
    if (Element::axis[k] == axis) direction[k] = 1;
  return direction;
}

/// Integrals of the vectors' shape functions, in the mixed layout, mm^3.
template <class Element>
std::vector<double> volume_shares(const WallProblem<Element>& wall) {
  const auto& part = wall.part();
  std::vector<double> shares(wall.space().mixed_size(), 0.0);
  const ElementPacks<Element> packs(part.nodes, part.cells, all_cells(part), *wall.graph());
  ElementRows<Element, Pack> rows;
  for (int t = 0; t < packs.thread_count(); ++t)
    for (const auto& pack : packs.of_thread(t)) {
      rows.set_zero();
      for (int q = 0; q < Element::points; ++q) {
        const auto g = Element::at(pack.geometry, q);
        Integrand<Pack> f;
        f.source = {{Pack(1.0), Pack(1.0), Pack(1.0)}};
        f.scalar_source = Pack(0.0);
        rows.add_sources(f, g);
      }
      scatter_residual<Element>(rows, pack, shares.data());
    }
  return shares;
}

}  // namespace

template <class Element>
std::vector<HeldSurface<Element::components>> surfaces_held_by_supports(const Case& setup, const MeshOf<Element>& mesh,
                                                                        const PartOf<Element>& wall) {
  std::vector<HeldSurface<Element::components>> surfaces;
  for (const auto& [name, support] : setup.supports) {
    const auto facets = group_facets(mesh, name);
    if (!support.fixed) continue;
    for (const auto& fixed : *support.fixed) {
      if (fixed != "normal") {
        surfaces.push_back({nodes_on<Element>(wall, facets), direction_of<Element>(fixed)});
        continue;
      }
      const auto parts = flat_parts<Element>(mesh, facets);
      if (parts.size() > most_planes)
        throw InputError(setup.path.string(), "support." + name + ".fixed",
                         "\"normal\" holds along the normal of planes, and this surface is curved",
                         "give a normal_spring in its place, or directions of space");
      for (const auto& part : parts) surfaces.push_back({nodes_on<Element>(wall, part.facets), part.normal});
    }
  }
  return surfaces;
}

template <class Element>
SupportFacets<Element> support_facets(const Case& setup, const MeshOf<Element>& mesh, const PartOf<Element>& part) {
  SupportFacets<Element> facets;
  for (const auto& [name, support] : setup.supports) facets[name] = in_part<Element>(part, group_facets(mesh, name));
  return facets;
}

template <class Element>
void support_wall(const Case& setup, const SupportFacets<Element>& facets_of, WallProblem<Element>& wall) {
  auto supports = std::make_unique<WallSupports<Element::components>>(*wall.graph(), wall.nodes().share);
  const auto& x = wall.nodes().nodes;
  for (const auto& [name, support] : setup.supports) {
    const auto& facets = facets_of.at(name);
    const Bedding springs{support.spring, support.normal_spring}, dampers{support.damper, support.normal_damper};
    if (!springs.is_none()) supports->template add_springs<Element>(x, facets, springs);
    if (!dampers.is_none()) supports->template add_dampers<Element>(x, facets, dampers);
  }
  std::vector<double> shares;  // of the nodes in the volume, for all components alike
  for (const SupportLoad& load : support_loads_of(setup)) {
    if (load.surface.empty()) {
      if (shares.empty()) shares = volume_shares(wall);
      supports->add_force(shares, load.component);
      continue;
    }
    const auto& facets = facets_of.at(load.surface);
    if (load.component < 0)
      supports->template add_pressure<Element>(x, facets);
    else
      supports->template add_traction<Element>(x, facets, load.component);
  }
  if (supports->has_springs() || supports->has_dampers() || supports->load_count() > 0)
    wall.support_by(std::move(supports));
}

template <int n>
void require_common_frames(const Case& setup, const Scene<n>& scene) {
  for (const InterfaceNode& node : scene.interface) {
    const auto *fluid = scene.fluid_frames.at(node.fluid), *wall = scene.wall_frames.at(node.wall);
    if (node.clamped || (fluid && wall ? *fluid == *wall : fluid == wall)) continue;
    const Point& x = scene.fluid->nodes().nodes[node.fluid];
    throw InputError(setup.path.string(), "support",
                     fmt::format("its fixed components reach the fluid's surface at ({:.6g}, {:.6g}, {:.6g}), along no "
                                 "axis of space",
                                 x[0], x[1], x[2]),
                     "fix all components there, or directions of space");
  }
}
template void require_common_frames<2>(const Case&, const Scene<2>&);
template void require_common_frames<3>(const Case&, const Scene<3>&);

#define FSI_INSTANTIATE(Element)                                                               \
  template std::vector<HeldSurface<Element::components>> surfaces_held_by_supports<Element>(   \
      const Case&, const MeshOf<Element>&, const PartOf<Element>&);                            \
  template SupportFacets<Element> support_facets<Element>(const Case&, const MeshOf<Element>&, \
                                                          const PartOf<Element>&);             \
  template void support_wall<Element>(const Case&, const SupportFacets<Element>&, WallProblem<Element>&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
