#pragma once

#include <array>
#include <string>
#include <vector>

namespace fsi {

using Point = std::array<double, 3>;  ///< coordinates in mm

/// Nodes of a simplex: its vertices, and with order 2 the middles of its edges behind them.
constexpr int nodes_of_simplex(int dim, int order) {
  return order == 1 ? dim + 1 : (dim + 1) * (dim + 2) / 2;
}

/// A simplex mesh: tetrahedra (Dim = 3) or triangles (Dim = 2) with named cell regions and facet groups, with straight
/// (Order = 1) or quadratic edges (Order = 2). Axisymmetric meshes store (r, 0, z), plane ones (x, y, 0).
template <int Dim, int Order = 1>
struct SimplexMesh {
  static constexpr int dim = Dim, order = Order;
  using Cell = std::array<int, nodes_of_simplex(Dim, Order)>;
  using Facet = std::array<int, nodes_of_simplex(Dim - 1, Order)>;

  /// Facets of one named surface. Boundary facets are oriented: their normal points out of the cell they bound, that of
  /// a face by the right-hand rule; an edge has it on its right, seen with r (or x) to the right and z (or y) upwards.
  struct FacetGroup {
    std::string name;
    std::vector<Facet> facets;
    std::string astray{};  ///< in words, the first element of the surface in its file that is no facet; empty: none
  };

  std::vector<Point> nodes;  ///< mm
  /// Node indices, mid-edge nodes as mesh/mid_edge_nodes.hpp orders them. Positively oriented: of positive volume;
  /// triangles counter-clockwise with r (or x) to the right and z (or y) upwards.
  std::vector<Cell> cells;
  std::vector<int> cell_region;          ///< per cell, index into `regions`
  std::vector<std::string> regions;      ///< names of the volume groups
  std::vector<FacetGroup> facet_groups;  ///< named surface groups

  /// Index of a region, -1 when there is none of that name.
  int region_index(const std::string& name) const {
    for (std::size_t i = 0; i < regions.size(); ++i)
      if (regions[i] == name) return static_cast<int>(i);
    return -1;
  }
  /// The facets of a named group, nullptr when there is none of that name.
  const std::vector<Facet>* facets(const std::string& name) const {
    for (const auto& group : facet_groups)
      if (group.name == name) return &group.facets;
    return nullptr;
  }
};

/// What the plane of a triangle mesh is: a half plane that the body is turned out of, or a section of plane strain.
enum class TriangleGeometry { axisymmetric, plane };

using TetrahedralMesh = SimplexMesh<3>;
using TriangleMesh = SimplexMesh<2>;

}  // namespace fsi
