#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "parallel/communicator.hpp"
#include "parallel/node_share.hpp"

namespace fsi::test {

/// Nodes 0, ..., whole - 1, of which node a belongs to process owner(a), and each process has copies of the neighbours
/// a - 1 and a + 1 of its nodes. Items of the exchange are not filled in.
template <class Owner>
NodeShare shared_nodes(const Communicator& processes, int whole, Owner owner) {
  NodeShare share;
  share.processes = &processes;
  share.whole_nodes = whole;
  for (int a = 0; a < whole; ++a) {
    bool here = false;
    for (int b = std::max(0, a - 1); b <= std::min(whole - 1, a + 1); ++b) here = here || owner(b) == processes.rank();
    if (!here) continue;
    share.whole_node.push_back(a);
    share.owned.push_back(owner(a) == processes.rank() ? 1 : 0);
  }
  return share;
}

/// value(a, k) for the nodes here, copies too.
template <class Value>
std::vector<double> nodal_array(const NodeShare& share, int entries, Value value) {
  std::vector<double> array;
  for (const int a : share.whole_node)
    for (int k = 0; k < entries; ++k) array.push_back(value(a, k));
  return array;
}

}  // namespace fsi::test
