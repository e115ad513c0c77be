#pragma once

#include <array>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A facet of the boundary of a set of cells, with the cell of the set that it bounds.
template <int Dim = 3, int Order = 1>
struct BoundaryFacet {
  typename SimplexMesh<Dim, Order>::Facet nodes;  ///< oriented: normal points out of `cell`
  int cell;
};

/// Boundary of the union of the cells of `regions` (all cells when empty), outward orientation; ordered by cell, then
/// by local facet. Facets towards cells of other regions belong to it.
template <int Dim, int Order>
std::vector<BoundaryFacet<Dim, Order>> boundary_facets(const SimplexMesh<Dim, Order>& mesh,
                                                       const std::vector<int>& regions = {});

/// The interface: facets that a cell of `fluid_region` shares with a cell of one of `wall_regions`, oriented outward
/// from the fluid; ordered by fluid cell. Found from the cells, not from tags. Empty when there are none.
template <int Dim, int Order>
std::vector<typename SimplexMesh<Dim, Order>::Facet> interface_facets(const SimplexMesh<Dim, Order>& mesh,
                                                                      int fluid_region,
                                                                      const std::vector<int>& wall_regions);

/// Nodes on the rim of a surface, ascending: on edges that only one of its facets has, mid-edge nodes included. In two
/// dimensions, where facets are edges: vertices that only one of them has.
/// \tparam Dim  of the mesh; the length of the facets does not tell it
template <int Dim = 3, std::size_t Nodes>
std::vector<int> rim_nodes(const std::vector<std::array<int, Nodes>>& surface);

/// Nodes of a set of facets, ascending, each once; mid-edge nodes included.
template <std::size_t Nodes>
std::vector<int> facet_nodes(const std::vector<std::array<int, Nodes>>& surface);

}  // namespace fsi
