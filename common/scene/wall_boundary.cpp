#include "scene/wall_boundary.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "fem/elements.hpp"
#include "mesh/boundary.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/facets.hpp"
#include "mesh/group_names.hpp"
#include "mesh/point_math.hpp"
#include "mesh/symmetry_planes.hpp"

namespace fsi {

namespace {

/// Facets by their vertices, however they are oriented.
template <class Element>
class FacetSet {
 public:
  explicit FacetSet(const FacetsOf<Element>& facets) {
    for (const auto& facet : facets) keys_.push_back(facet_key<Element::dim>(facet));
    std::sort(keys_.begin(), keys_.end());
  }
  bool has(const FacetKey<Element::dim>& key) const { return std::binary_search(keys_.begin(), keys_.end(), key); }

 private:
  std::vector<FacetKey<Element::dim>> keys_;
};

template <class Element>
Point unit_normal(const MeshOf<Element>& mesh, const typename MeshOf<Element>::Facet& facet) {
  const auto x = [&](int i) { return mesh.nodes[facet[i]]; };
  Point normal{0, 0, 0};
  if constexpr (Element::dim == 3) {
    normal = triangle_area_vector(x(0), x(1), x(2));
  } else {
    const Point along = x(1) - x(0);
    normal[Element::axis[0]] = along[Element::axis[1]];
    normal[Element::axis[1]] = -along[Element::axis[0]];
  }
  return (1 / norm(normal)) * normal;
}

template <class Element>
bool lies_on_axis(const MeshOf<Element>& mesh, const typename MeshOf<Element>::Facet& facet) {
  constexpr double rounding = 1e-9;
  const auto x = [&](int i) { return mesh.nodes[facet[i]]; };
  return Element::axisymmetric && std::abs(x(0)[0]) + std::abs(x(1)[0]) < rounding * distance(x(0), x(1));
}

/// Sets of nodes that cells of these regions connect.
template <class Mesh>
DisjointSets bodies_of(const Mesh& mesh, const std::vector<int>& regions) {
  DisjointSets bodies(mesh.nodes.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (std::find(regions.begin(), regions.end(), mesh.cell_region[c]) != regions.end())
      for (const int node : mesh.cells[c]) bodies.join(node, mesh.cells[c][0]);
  return bodies;
}

}  // namespace

template <class Element>
WallFacets<Element> wall_boundary(const MeshOf<Element>& mesh, const std::vector<int>& wall_regions) {
  const FacetSet<Element> inner(inner_surface<Element>(mesh, wall_regions)), ends(group_facets(mesh, group::wall_ends));
  std::vector<FacetSet<Element>> planes;
  for (const auto& plane : symmetry_planes(mesh)) planes.emplace_back(plane.group->facets);
  DisjointSets bodies = bodies_of(mesh, wall_regions);
  std::vector<int> numbers;  // of the bodies met, by their roots
  const auto number_of = [&](int root) {
    const auto found = std::find(numbers.begin(), numbers.end(), root);
    if (found != numbers.end()) return static_cast<int>(found - numbers.begin());
    numbers.push_back(root);
    return static_cast<int>(numbers.size()) - 1;
  };

  WallFacets<Element> boundary;
  for (const auto& found : boundary_facets(mesh, wall_regions)) {
    WallFacet<Element> facet{found.nodes, unit_normal<Element>(mesh, found.nodes), WallFacetKind::other};
    const auto key = facet_key<Element::dim>(found.nodes);
    for (std::size_t p = 0; p < planes.size() && facet.plane < 0; ++p)
      if (planes[p].has(key)) facet.plane = static_cast<int>(p);
    if (inner.has(key))
      facet.kind = WallFacetKind::inner;
    else if (ends.has(key))
      facet.kind = WallFacetKind::end;
    else if (facet.plane >= 0)
      facet.kind = WallFacetKind::symmetry;
    else if (lies_on_axis<Element>(mesh, found.nodes))
      facet.kind = WallFacetKind::axis;
    facet.body = number_of(bodies.root(found.nodes[0]));
    boundary.push_back(facet);
  }
  return boundary;
}

#define FSI_INSTANTIATE(Element) \
  template WallFacets<Element> wall_boundary<Element>(const MeshOf<Element>&, const std::vector<int>&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
