#pragma once

#include <vector>

#include "parallel/communicator.hpp"

namespace fsi {

/// Shares out the nodes of a graph so that processes get about the same weight and few edges join nodes of different
/// ones, by PT-Scotch: each process hands over a stretch of the rows. All processes must give the same graph, and all
/// get the same answer, the same again for as many processes.
/// \param offsets, columns  adjacency row by row; a node's own number in its row is passed over
/// \param weights           of the nodes, positive
/// \returns per node the process that owns it; a process may own none
/// \throws std::runtime_error when the library fails
std::vector<int> partition_of_graph(const std::vector<int>& offsets, const std::vector<int>& columns,
                                    const std::vector<int>& weights, const Communicator& processes);

}  // namespace fsi
