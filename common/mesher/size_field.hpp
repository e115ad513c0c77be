#pragma once

#include <map>
#include <utility>
#include <vector>

#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// The edge lengths that cells are to have, linear on simplices.
struct SizeField {
  int dimension = 3;
  /// Of each simplex the x of its vertices, their y, their z, and the lengths there, mm: gmsh's list data of scalars.
  std::vector<double> simplices;

  /// The field with all lengths multiplied.
  SizeField scaled(double factor) const {
    SizeField field = *this;
    const auto vertices = static_cast<std::size_t>(dimension) + 1;
    for (std::size_t i = 0; i < simplices.size(); ++i)
      if (i % (4 * vertices) >= 3 * vertices) field.simplices[i] *= factor;
    return field;
  }
};

/// The edge lengths of a mesh: at a vertex the mean of the straight edges that meet there.
template <int Dim, int Order>
SizeField sizes_of(const SimplexMesh<Dim, Order>& mesh) {
  std::vector<double> sum(mesh.nodes.size(), 0.0), count(mesh.nodes.size(), 0.0);
  std::map<std::pair<int, int>, char> seen;
  for (const auto& cell : mesh.cells)
    for (const auto& [a, b] : SimplexEdges<Dim>::vertices) {
      if (!seen.try_emplace(std::minmax({cell[a], cell[b]}), 1).second) continue;
      const double length = distance(mesh.nodes[cell[a]], mesh.nodes[cell[b]]);
      for (const int node : {cell[a], cell[b]}) {
        sum[node] += length;
        ++count[node];
      }
    }
  SizeField field{Dim, {}};
  field.simplices.reserve(mesh.cells.size() * 4 * (Dim + 1));
  for (const auto& cell : mesh.cells) {
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i <= Dim; ++i) field.simplices.push_back(mesh.nodes[cell[i]][k]);
    for (int i = 0; i <= Dim; ++i) field.simplices.push_back(sum[cell[i]] / count[cell[i]]);
  }
  return field;
}

}  // namespace fsi
