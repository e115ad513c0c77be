#pragma once

#include <array>
#include <map>
#include <vector>

#include "mesh/simplex_mesh.hpp"
#include "mesher/offset_normals.hpp"

namespace fsi {

/// Nodes of columns of prisms that stand on facets, in levels above those of the facets.
struct Levels {
  std::vector<std::map<int, int>> nodes;  ///< of each level, by the node of the facets below
  std::vector<int> region;                ///< of the cells between a level and the next
  std::map<int, int> bottoms() const;     ///< the columns' lowest nodes, by the nodes of all levels
};

/// A level to be made.
struct NewLevel {
  double height = 0;  ///< part of the whole way along the columns
  int region = 0;     ///< of the cells below it
};

/// Adds the nodes level by level, so that a level's numbers are in the order of the level below.
/// \param ways  mm, by node: the column's vector from it
Levels raise_levels(const std::vector<NewLevel>& made, const std::map<int, Point>& ways, TetrahedralMesh& mesh);

/// The same from the places of each column's nodes, mm.
/// \param regions  of the cells below each level \param columns  by node, a point for each level
Levels raise_levels(const std::vector<int>& regions, const std::map<int, std::vector<Point>>& columns,
                    TetrahedralMesh& mesh);

/// Tetrahedra of a prism, cut along the diagonal of each quadrilateral from the node of least number at the bottom.
std::array<TetrahedralMesh::Cell, 3> prism_cells(std::array<int, 3> below, std::array<int, 3> above);

/// Fills the columns with prisms, each cut into three tetrahedra by the order of its nodes, so that the mesh is
/// conforming [Dompierre1999].
/// \param facets  their normals look along the columns
void fill_with_prisms(const std::vector<TetrahedralMesh::Facet>& facets, const Levels& levels, TetrahedralMesh& mesh);

/// Sides of prisms at the rims: the boundary's facets between two levels, found from the cells.
std::vector<TetrahedralMesh::Facet> sides_of_columns(const TetrahedralMesh& mesh, const std::vector<RimEdge>& rim,
                                                     const Levels& levels);

}  // namespace fsi
