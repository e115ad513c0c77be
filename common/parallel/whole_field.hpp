#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "parallel/node_share.hpp"

namespace fsi {

/// A nodal array of a medium that is shared out, as an array of all its nodes, at all processes. By all of them
/// together.
/// \param here     of the nodes of this process, copies too, which are not read
/// \param entries  numbers of a node
/// \returns entries * share.whole_nodes numbers, by whole_node
inline std::vector<double> whole_field(const NodeShare& share, const std::vector<double>& here, std::size_t entries) {
  std::vector<double> message;  // node, its numbers
  for (std::size_t a = 0; a < share.owned.size(); ++a) {
    if (share.owned[a] == 0) continue;
    message.push_back(share.whole_node[a]);
    const auto first = here.begin() + static_cast<std::ptrdiff_t>(a * entries);
    message.insert(message.end(), first, first + static_cast<std::ptrdiff_t>(entries));
  }
  message = share.processes->gather(message);
  std::vector<double> whole(static_cast<std::size_t>(share.whole_nodes) * entries);
  for (std::size_t at = 0; at < message.size(); at += entries + 1)
    std::copy_n(message.begin() + static_cast<std::ptrdiff_t>(at + 1), entries,
                whole.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(message[at]) * entries));
  return whole;
}

}  // namespace fsi
