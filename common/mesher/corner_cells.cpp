#include "mesher/corner_cells.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_set>

#include "mesh/boundary.hpp"
#include "mesh/cell_grid.hpp"
#include "mesh/facets.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/group_names.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesher/child_cells.hpp"

namespace fsi {

namespace {

/// Edges on the fluid's boundary where a case may give the whole velocity, as EdgeMiddles::key().
template <int Dim, int Order>
std::unordered_set<std::uint64_t> edges_on_boundary(const SimplexMesh<Dim, Order>& mesh, int fluid) {
  std::unordered_set<FacetKey<Dim>, FacetKeyHash> mirrors;
  for (const auto& group : mesh.facet_groups)
    if (group::is_symmetry_plane(group.name))
      for (const auto& facet : group.facets) mirrors.insert(facet_key<Dim>(facet));
  // Meridian sections lie in the plane y = 0; those drawn in z = 0 are taken for plane ones.
  const bool section =
      Dim == 2 && std::all_of(mesh.nodes.begin(), mesh.nodes.end(), [](const Point& x) { return x[1] == 0; });
  std::unordered_set<std::uint64_t> edges;
  for (const auto& facet : boundary_facets(mesh, {fluid})) {
    const auto& nodes = facet.nodes;
    if (mirrors.count(facet_key<Dim>(nodes)) > 0) continue;
    if (section && mesh.nodes[nodes[0]][0] == 0 && mesh.nodes[nodes[1]][0] == 0) continue;
    for (const auto& [a, b] : SimplexEdges<Dim - 1>::vertices) edges.insert(EdgeMiddles::key(nodes[a], nodes[b]));
  }
  return edges;
}

template <int Dim, int Order>
void divide(SimplexMesh<Dim, Order>& mesh, int cell) {
  const auto whole = mesh.cells[cell];
  const auto map = map_of(mesh, cell);
  std::array<double, Dim + 1> lambda;
  lambda.fill(1.0 / (Dim + 1));
  const auto add = [&] {
    mesh.nodes.push_back(map.at(lambda));
    return static_cast<int>(mesh.nodes.size()) - 1;
  };
  const int centre = add();
  std::array<int, Dim + 1> towards{};  // nodes half way between the centre and each vertex
  if constexpr (Order == 2)
    for (int a = 0; a <= Dim; ++a) {
      for (int b = 0; b <= Dim; ++b) lambda[b] = 0.5 / (Dim + 1) + (a == b ? 0.5 : 0);
      towards[a] = add();
    }
  for (int apart = 0; apart <= Dim; ++apart) {  // the centre in place of one vertex
    auto part = whole;
    part[apart] = centre;
    if constexpr (Order == 2)
      for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
        const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
        if (a == apart || b == apart) part[Dim + 1 + e] = towards[a == apart ? b : a];
      }
    if (apart == 0) {
      mesh.cells[cell] = part;
      continue;
    }
    mesh.cells.push_back(part);
    mesh.cell_region.push_back(mesh.cell_region[cell]);
  }
}

}  // namespace

template <int Dim, int Order>
std::vector<int> corner_cells(const SimplexMesh<Dim, Order>& mesh) {
  const int fluid = mesh.region_index(group::fluid);
  if (fluid < 0) return {};
  const auto edges = edges_on_boundary(mesh, fluid);
  std::vector<char> free(mesh.nodes.size(), 0);  // per vertex: beside a velocity inside
  std::vector<int> candidates;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    if (mesh.cell_region[c] != fluid) continue;
    const auto& cell = mesh.cells[c];
    const bool enclosed =
        std::all_of(SimplexEdges<Dim>::vertices.begin(), SimplexEdges<Dim>::vertices.end(),
                    [&](const auto& edge) { return edges.count(EdgeMiddles::key(cell[edge[0]], cell[edge[1]])) > 0; });
    if (enclosed)
      candidates.push_back(static_cast<int>(c));
    else
      for (int a = 0; a <= Dim; ++a) free[cell[a]] = 1;
  }
  std::vector<int> found;
  for (const int c : candidates)
    if (std::any_of(mesh.cells[c].begin(), mesh.cells[c].begin() + Dim + 1, [&](int vertex) { return !free[vertex]; }))
      found.push_back(c);
  return found;
}

template <int Dim, int Order>
SimplexMesh<Dim, Order> divided_at_centres(SimplexMesh<Dim, Order> mesh, const std::vector<int>& cells) {
  for (const int cell : cells) divide(mesh, cell);
  return mesh;
}

// Numbers as template arguments: parentheses would only hide them.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define INSTANTIATE(Dim, Order)                                           \
  template std::vector<int> corner_cells(const SimplexMesh<Dim, Order>&); \
  template SimplexMesh<Dim, Order> divided_at_centres(SimplexMesh<Dim, Order>, const std::vector<int>&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fsi
