#pragma once

#include <array>
#include <vector>

#include "io/field_grid.hpp"
#include "mesh/submesh.hpp"
#include "parallel/whole_order.hpp"

namespace fsi {

/// A point in the middle of an edge of a grid, whose ends are vertices of the state.
struct Middle {
  int point, node;  ///< of the grid that is written, and of the state
  std::array<int, 2> ends;
};

/// Gives cells that share a mid-edge node but not its ends, as in layers with separate vertices, points of their own.
/// \tparam n  dimension of the cells
/// \returns the middles of all edges; none for linear cells
template <int n>
std::vector<Middle> separate_middles(FieldGrid& grid);

/// How a process makes its part of the values of a shared grid: at the nodes of its part of the medium and, behind
/// them, at the points that separate_middles() has added for its own nodes.
struct GridShare {
  std::vector<Middle> middles;  ///< at this process's nodes, in numbers here
  WholeOrder order;             ///< places of the points here in the whole grid
};

/// Cuts a whole grid down to the stretch that this process writes (FieldGrid::stretch), after separate_middles().
/// Collective over processes. \param here  this process's part of the medium, with its share
template <int n>
GridShare share_out(FieldGrid& whole, const PartNodes& here);

}  // namespace fsi
