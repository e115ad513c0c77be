#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "case/openings.hpp"
#include "derived/gradient_recovery.hpp"
#include "derived/recovery_mirrors.hpp"
#include "fem/facet_load.hpp"
#include "fem/nodal_layout.hpp"
#include "fluid/fluid_problem.hpp"
#include "mesh/boundary.hpp"
#include "mesh/symmetry_planes.hpp"
#include "scene/boundary_conditions.hpp"
#include "scene/build_scene.hpp"

namespace fsi {

/// What a facet of the fluid's boundary is.
enum class FluidFacetKind { solid, opening, symmetry, axis };

/// The whole boundary of the fluid: facets in the numbers of its part, normals outward.
template <class Element>
struct FluidSurface {
  using Facet = typename MeshOf<Element>::Facet;
  using Key = std::array<int, Element::dim>;  ///< a facet's vertices in the numbers of the mesh, ascending

  std::vector<Facet> facets;
  std::vector<FluidFacetKind> kinds;
  std::map<Key, int> place;  ///< number of a facet in `facets`

  static Key key(const Facet& facet) {
    Key key;
    std::copy_n(facet.begin(), key.size(), key.begin());
    std::sort(key.begin(), key.end());
    return key;
  }
  /// Places (numbers in `facets`) of those facets of the mesh that are on this surface.
  std::vector<int> places(const std::vector<Facet>& of_mesh) const {
    std::vector<int> found;
    for (const auto& facet : of_mesh)
      if (const auto known = place.find(key(facet)); known != place.end()) found.push_back(known->second);
    return found;
  }
  std::vector<int> places(FluidFacetKind kind) const {
    std::vector<int> found;
    for (std::size_t f = 0; f < facets.size(); ++f)
      if (kinds[f] == kind) found.push_back(static_cast<int>(f));
    return found;
  }
  /// Nodes of the facets at these places, ascending.
  std::vector<int> nodes(const std::vector<int>& places) const {
    std::vector<int> nodes;
    for (const int f : places) nodes.insert(nodes.end(), facets[f].begin(), facets[f].end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }
};

/// The boundary of the fluid; openings and planes of symmetry are those of the case and the mesh.
/// \param fluid  the whole fluid
template <class Element>
FluidSurface<Element> fluid_surface(const Case& setup, const MeshOf<Element>& mesh, const PartOf<Element>& fluid) {
  FluidSurface<Element> surface;
  for (const auto& facet : boundary_facets(mesh, {mesh.region_index(group::fluid)})) {
    surface.place[FluidSurface<Element>::key(facet.nodes)] = static_cast<int>(surface.facets.size());
    surface.facets.push_back(fluid.local(facet.nodes));
    FluidFacetKind kind = FluidFacetKind::solid;
    if constexpr (Element::axisymmetric)
      if (std::all_of(facet.nodes.begin(), facet.nodes.end(), [&](int node) { return mesh.nodes[node][0] == 0; }))
        kind = FluidFacetKind::axis;
    surface.kinds.push_back(kind);
  }
  const auto mark = [&](const FacetsOf<Element>& facets, FluidFacetKind kind) {
    for (const int f : surface.places(facets)) surface.kinds[f] = kind;
  };
  for (const auto& plane : symmetry_planes(mesh)) mark(plane.group->facets, FluidFacetKind::symmetry);
  for (const auto& opening : openings_of(setup)) mark(group_facets(mesh, opening.surface), FluidFacetKind::opening);
  return surface;
}

/// This process's part of the fluid. \pre the scene has a fluid, discretised by this element
template <class Element>
const PartOf<Element>& fluid_part(const Scene<Element::components>& scene) {
  return static_cast<const FluidProblem<Element>&>(*scene.fluid).part();
}
/// The whole fluid.
template <class Element>
const PartOf<Element>& whole_fluid(const Scene<Element::components>& scene, const WholeParts<Element>& whole) {
  return whole.fluid ? *whole.fluid : fluid_part<Element>(scene);
}

/// Gradients of the fluid's fields at some of its nodes.
/// \param mesh  with its planes of symmetry
/// \param part  the whole fluid
/// \param at    nodes of the whole fluid that are here
/// \param here  restriction of the fluid to this process; null: all of it is here
template <class Element>
GradientRecovery fluid_gradients(const MeshOf<Element>& mesh, const PartOf<Element>& part, std::vector<int> at,
                                 const PartRestriction* here) {
  RecoveryCells cells{
      part.nodes,           {}, Element::nodes, Element::order, {std::begin(Element::axis), std::end(Element::axis)},
      Element::axisymmetric};
  for (const auto& cell : part.cells) cells.nodes.insert(cells.nodes.end(), cell.begin(), cell.end());
  cells.mirrors = recovery_mirrors<Element>(mesh, part, cells.nodes);
  GradientRecovery gradients(cells, std::move(at));
  if (here) gradients.restrict_to(*here);
  return gradients;
}

/// The viscous stress mu (grad u + grad u^T) in the current configuration at entry i of the recovered nodes, kPa. Where
/// the viscosity follows a law it is that of the recovered gradient.
/// \param mesh  displacement of the domain, vector layout, from GradientRecovery::reach(); empty where it is rigid
/// \param flow  (u, p), mixed layout, from reach()
template <int n>
Mat3<double> viscous_stress(const GradientRecovery& gradients, std::size_t i, const AleFluid& fluid,
                            const std::vector<double>& mesh, const std::vector<double>& flow) {
  Mat3<double> l = gradients.gradient<MixedLayout<n>>(i, flow);
  if (!mesh.empty()) {
    Mat3<double> f = gradients.gradient<VectorLayout<n>>(i, mesh);
    for (int k = 0; k < 3; ++k) f(k, k) += 1;
    const Mat3<double> cofactors = cofactor(f);  // J F^-T
    const double ratio = f(0, 0) * cofactors(0, 0) + f(0, 1) * cofactors(0, 1) + f(0, 2) * cofactors(0, 2);
    l = (1 / ratio) * times_transposed(l, cofactors);
  }
  const double viscosity = fluid.law ? viscosity_at(*fluid.law, std::sqrt(shear_rate_squared(l))) : fluid.viscosity;
  Mat3<double> stress;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) stress(r, c) = viscosity * (l(r, c) + l(c, r));
  return stress;
}

/// Current positions of a facet's nodes, mm. \param mesh  displacement, vector layout; empty: none
template <class Element, class Facet>
void current_corners(const std::vector<Point>& nodes, const Facet& facet, const std::vector<double>& mesh,
                     Vec3<Pack> (&corner)[Element::Facet::nodes]) {
  using Vector = VectorLayout<Element::components>;
  facet_corners<typename Element::Facet>(nodes, facet, corner);
  if (mesh.empty()) return;
  for (int a = 0; a < Element::Facet::nodes; ++a)
    for (int k = 0; k < Element::components; ++k)
      corner[a][Element::axis[k]] += Pack(mesh[Vector::vector(facet[a], k)]);
}

}  // namespace fsi
