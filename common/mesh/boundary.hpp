#pragma once

#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A facet of the boundary of a set of cells, with the cell of the set that it bounds.
struct BoundaryFacet {
  TetrahedralMesh::Facet nodes;  ///< oriented: normal points out of `cell`
  int cell;
};

/// Boundary of the union of the cells of `regions` (all cells when empty), outward orientation; ordered by cell, then
/// by local facet. Facets towards cells of other regions belong to it.
std::vector<BoundaryFacet> boundary_facets(const TetrahedralMesh& mesh, const std::vector<int>& regions = {});

/// The interface: facets that a cell of `fluid_region` shares with a cell of one of `wall_regions`, oriented outward
/// from the fluid; ordered by fluid cell. Found from the cells, not from tags. Empty when there are none.
std::vector<TetrahedralMesh::Facet> interface_facets(const TetrahedralMesh& mesh, int fluid_region,
                                                     const std::vector<int>& wall_regions);

/// Nodes on the rim of a surface, that is on edges that only one of its facets has; ascending.
std::vector<int> rim_nodes(const std::vector<TetrahedralMesh::Facet>& surface);

/// Nodes of a set of facets, ascending, each once.
std::vector<int> facet_nodes(const std::vector<TetrahedralMesh::Facet>& surface);

}  // namespace fsi
