#include "mesh/far_nodes.hpp"

#include <algorithm>
#include <utility>

#include "base/sort_unique.hpp"

namespace fsi {

FarNodes::FarNodes(const PartRestriction& here, const std::vector<int>& wanted)
    : nodes_(static_cast<int>(here.whole_nodes().size())) {
  for (const int node : wanted)
    if (here.local(node) < 0) far_.push_back(node);
  sort_unique(far_);
  const Communicator& processes = *here.share().processes;
  std::vector<std::vector<double>> asked(processes.size());  // whole numbers, far below 2^53
  std::vector<Exchange::Neighbour> neighbours(processes.size());
  for (std::size_t i = 0; i < far_.size(); ++i) {
    const int owner = here.owner(far_[i]);
    asked[owner].push_back(far_[i]);
    neighbours[owner].received.push_back(nodes_ + static_cast<int>(i));
  }
  const auto asked_of_us = processes.send_and_receive(asked);
  for (int rank = 0; rank < processes.size(); ++rank) {
    neighbours[rank].rank = rank;
    for (const double node : asked_of_us[rank]) neighbours[rank].sent.push_back(here.local(static_cast<int>(node)));
  }
  neighbours.erase(std::remove_if(neighbours.begin(), neighbours.end(),
                                  [](const auto& n) { return n.sent.empty() && n.received.empty(); }),
                   neighbours.end());
  exchange_ = Exchange(processes, std::move(neighbours));
}

int FarNodes::number(const PartRestriction& here, int whole_node) const {
  if (const int local = here.local(whole_node); local >= 0) return local;
  return nodes_ + static_cast<int>(std::lower_bound(far_.begin(), far_.end(), whole_node) - far_.begin());
}

}  // namespace fsi
