#include "scene/boundary_conditions.hpp"

#include <algorithm>

#include "mesh/boundary.hpp"
#include "mesh/facets.hpp"
#include "mesh/group_names.hpp"

namespace fsi {

namespace {

using Facets = std::vector<TetrahedralMesh::Facet>;

/// One flag per node of a part: on these facets of the whole mesh.
std::vector<char> nodes_on(const Submesh<3>& part, const Facets& facets) {
  std::vector<char> marks(part.nodes.size(), 0);
  for (const auto& facet : facets)
    for (int node : facet) {
      assert(part.local_node[node] >= 0);
      marks[part.local_node[node]] = 1;
    }
  return marks;
}

/// Facets of the fluid's boundary that are in none of the given sets.
Facets closed_facets(const TetrahedralMesh& mesh, const std::vector<const Facets*>& others) {
  std::vector<TetrahedralMesh::Facet> known;
  for (const Facets* facets : others)
    for (const auto& facet : *facets) known.push_back(facet_key(facet));
  std::sort(known.begin(), known.end());
  Facets closed;
  for (const auto& facet : boundary_facets(mesh, {mesh.region_index(group::fluid)}))
    if (!std::binary_search(known.begin(), known.end(), facet_key(facet.nodes))) closed.push_back(facet.nodes);
  return closed;
}

}  // namespace

const Facets& group_facets(const TetrahedralMesh& mesh, const std::string& name) {
  static const Facets none;
  const auto* facets = mesh.facets(name);
  return facets ? *facets : none;
}

Facets in_part(const Submesh<3>& part, const Facets& facets) {
  Facets local;
  local.reserve(facets.size());
  for (const auto& facet : facets) local.push_back(part.local(facet));
  return local;
}

Facets inner_surface(const TetrahedralMesh& mesh, const std::vector<int>& wall_regions) {
  const int fluid = mesh.region_index(group::fluid);
  if (fluid < 0) return group_facets(mesh, group::inner);
  Facets facets = interface_facets(mesh, fluid, wall_regions);
  for (auto& facet : facets) std::swap(facet[1], facet[2]);
  return facets;
}

DirichletConditions<3> wall_conditions(const TetrahedralMesh& mesh, const Submesh<3>& wall) {
  DirichletConditions<3> conditions(wall.node_count());
  const auto ends = nodes_on(wall, group_facets(mesh, group::wall_ends));
  for (int a = 0; a < wall.node_count(); ++a)
    if (ends[a]) conditions.fix(a);
  return conditions;
}

FluidBoundary fluid_boundary(const std::vector<OpeningData>& openings, const TetrahedralMesh& mesh,
                             const Submesh<3>& fluid, const Facets& interface, const Submesh<3>* wall,
                             const DirichletConditions<3>* wall_conditions) {
  const int nodes = fluid.node_count();
  FluidBoundary boundary;
  boundary.velocity = boundary.mesh = DirichletConditions<3>(nodes);
  std::vector<const Facets*> not_closed{&interface};
  for (const auto& opening : openings) {
    const Facets& facets = group_facets(mesh, opening.surface);
    not_closed.push_back(&facets);
    boundary.open.emplace_back(opening.surface, fluid.nodes, in_part(fluid, facets));
    const auto on = nodes_on(fluid, facets);
    for (int a = 0; a < nodes; ++a)
      if (on[a]) boundary.mesh.fix(a);
  }
  const auto closed = nodes_on(fluid, closed_facets(mesh, not_closed));
  for (int a = 0; a < nodes; ++a)
    if (closed[a]) {
      boundary.velocity.fix(a);
      boundary.mesh.fix(a);
    }
  const auto wet = nodes_on(fluid, interface);
  for (int a = 0; a < nodes; ++a) {
    if (!wet[a]) continue;
    const int wall_node = wall->local_node[fluid.mesh_node[a]];
    const bool clamped = wall_conditions->fixes(wall_node);
    for (int k = 0; k < 3; ++k)
      if (wall_conditions->fixes(wall_node, k) || boundary.velocity.fixes(a, k)) {
        boundary.velocity.fix(a, k);
        boundary.mesh.fix(a, k);
      }
    boundary.interface.push_back({a, wall_node, clamped});
  }
  return boundary;
}

}  // namespace fsi
