#pragma once

#include <vector>

#include "parallel/communicator.hpp"

namespace fsi {

/// Shares out the nodes of a graph so that processes get about the same weight and few edges join nodes of different
/// ones, by PT-Scotch: each process hands over a stretch of the rows (EvenStretch, or another that follows the
/// one of the process before). All get the same answer, the same again for as many processes.
/// \param offsets, columns  adjacency of the stretch row by row, columns in numbers of the whole; a node's own number in its
///                          row is passed over
/// \param weights           of the nodes of the stretch, positive
/// \returns per node of the whole graph the process that owns it; a process may own none
/// \throws std::runtime_error when the library fails
std::vector<int> partition_of_graph(const std::vector<int>& offsets, const std::vector<int>& columns,
                                    const std::vector<int>& weights, const Communicator& processes);

}  // namespace fsi
