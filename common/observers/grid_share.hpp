#pragma once

#include <array>
#include <vector>

#include "io/field_grid.hpp"
#include "mesh/submesh.hpp"
#include "parallel/whole_order.hpp"

namespace fsi {

/// A point in the middle of an edge of a grid.
struct Middle {
  int point, node;  ///< of the grid that is written, of the state
  std::array<int, 2> ends;
};

/// Gives the cells of a grid that have a mid-edge node in common, but not its ends, points of their own. Returns the
/// middles of all edges; none for linear cells. \tparam n  dimension of the cells
template <int n>
std::vector<Middle> separate_middles(FieldGrid& grid);

/// How a process makes its part of the values of a grid that is shared out: at the points here, which are the nodes of its
/// part of the medium, and behind them points in the middle of edges that have that node in common with others.
struct GridShare {
  std::vector<Middle> middles;  ///< at this process's nodes, in numbers here
  WholeOrder order;             ///< of the points here among those of the grid
};

/// Leaves of a whole grid what this process writes of it, its mid-edge points separated: FieldGrid::stretch. For all
/// processes together. \param here  this process's part of the medium, with its share
template <int n>
GridShare share_out(FieldGrid& whole, const PartNodes& here);

}  // namespace fsi
