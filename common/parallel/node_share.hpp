#pragma once

#include <cstdint>
#include <vector>

#include "parallel/communicator.hpp"
#include "parallel/exchange.hpp"

namespace fsi {

/// How the nodes of one medium are shared out among processes, as one of them sees its part: the nodes that it owns, and
/// copies of those around them that belong to others (halo). All elements that touch an owned node are here, so that
/// rows of owned nodes are assembled whole. Rows of copies may be incomplete; no equation is made of them.
struct NodeShare {
  const Communicator* processes = nullptr;
  std::vector<char> owned;       ///< per node of the part here
  Exchange exchange;             ///< of nodes
  std::vector<int> whole_node;   ///< per node here, its number in the medium's part of the whole mesh
  std::int64_t whole_nodes = 0;  ///< of that part

  /// Gives the copies in a nodal array of a layout the values of their owners.
  template <class Layout>
  void update(std::vector<double>& field) const {
    exchange.update(field, Layout::entries);
  }
};

}  // namespace fsi
