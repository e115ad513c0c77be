#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Parameters of bisect().
struct BisectionPlan {
  std::vector<double> weights;  ///< per cell, not negative: what it has of the error
  double shrinkage = 0.5;       ///< weight of a half over that of its cell, below 1
  std::size_t most_nodes = 0;   ///< halving ends once there are as many
};

/// Halves cells, always that of the largest weight, until there are as many nodes as the plan allows or all weights are
/// zero. A cell is halved through the middle of its longest edge, with all cells around that edge; where it is
/// not the longest one of all of these, those with a longer one are halved first [Rivara1997]. So the mesh stays
/// conforming, and sizes change gradually from cell to cell.
///
/// Regions and groups stay, nodes keep their numbers. Quadratic cells are halved in their own coordinates, as in
/// uniform refinement: curved edges and faces stay where they are. In two dimensions no angle falls below half of the
/// smallest one [Rosenberg1975]; in three no bound is known.
///
/// \param file  for messages: where the mesh was read
/// \throws InputError, OutOfMemory as refine_uniformly()
template <int Dim, int Order>
SimplexMesh<Dim, Order> bisect(const SimplexMesh<Dim, Order>& mesh, const BisectionPlan& plan, const std::string& file);

}  // namespace fsi
