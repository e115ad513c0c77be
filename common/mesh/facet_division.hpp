#pragma once

#include <array>
#include <vector>

#include "mesh/mid_edge_nodes.hpp"
#include "mesh/point_math.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A quadratic facet taken as flat ones between points of it, four along each edge.
template <int Dim>
struct FacetDivision {
  std::vector<std::array<double, 3>> points;  ///< barycentric coordinates; of an edge the third is 0
  std::vector<std::array<int, 3>> parts;      ///< indices into `points`; an edge has its last point twice
};

template <int Dim>
FacetDivision<Dim> divided_facet() {
  constexpr int n = 4;
  FacetDivision<Dim> division;
  std::array<std::array<int, n + 1>, n + 1> number{};
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= (Dim == 3 ? n - i : 0); ++j) {
      number[i][j] = static_cast<int>(division.points.size());
      division.points.push_back(
          {1 - static_cast<double>(i + j) / n, static_cast<double>(i) / n, static_cast<double>(j) / n});
    }
  for (int i = 0; i < n; ++i) {
    if (Dim == 2) division.parts.push_back({number[i][0], number[i + 1][0], number[i + 1][0]});
    for (int j = 0; Dim == 3 && i + j < n; ++j) {
      division.parts.push_back({number[i][j], number[i + 1][j], number[i][j + 1]});
      if (i + j + 1 < n) division.parts.push_back({number[i + 1][j], number[i + 1][j + 1], number[i][j + 1]});
    }
  }
  return division;
}

/// The point of a quadratic facet at barycentric coordinates.
template <int Dim>
Point point_of_facet(const std::vector<Point>& nodes, const typename SimplexMesh<Dim, 2>::Facet& facet,
                     const std::array<double, 3>& l) {
  Point x{0, 0, 0};
  for (int a = 0; a < Dim; ++a) x = x + (l[a] * (2 * l[a] - 1)) * nodes[facet[a]];
  int middle = Dim;
  for (const auto& [a, b] : SimplexEdges<Dim - 1>::vertices) x = x + (4 * l[a] * l[b]) * nodes[facet[middle++]];
  return x;
}

}  // namespace fsi
