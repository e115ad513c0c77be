#pragma once

#include <array>
#include <string>
#include <vector>

namespace fsi {

using Point = std::array<double, 3>;  ///< coordinates in mm

/// A linear simplex mesh: tetrahedra (Dim = 3) or triangles (Dim = 2) with named cell regions and facet groups.
/// Axisymmetric meshes store (r, 0, z), plane ones (x, y, 0).
template <int Dim>
struct SimplexMesh {
  static constexpr int dim = Dim;
  using Cell = std::array<int, Dim + 1>;
  using Facet = std::array<int, Dim>;

  /// Facets of one named surface. Boundary facets are oriented: their normal, by the right-hand rule, points out of the
  /// cell they bound.
  struct FacetGroup {
    std::string name;
    std::vector<Facet> facets;
  };

  std::vector<Point> nodes;              ///< mm
  std::vector<Cell> cells;               ///< node indices, positively oriented
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

using TetrahedralMesh = SimplexMesh<3>;
using TriangleMesh = SimplexMesh<2>;

}  // namespace fsi
