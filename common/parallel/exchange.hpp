#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "parallel/communicator.hpp"

namespace fsi {

/// Items (nodes, unknowns) that one process owns and others hold copies of: brings the owners' values to the copies.
/// Items are named by their local numbers. What one process sends to another are the same items, in the same order, as
/// the other receives from it.
class Exchange {
 public:
  struct Neighbour {
    int rank;
    std::vector<int> sent;      ///< own items that the neighbour holds copies of
    std::vector<int> received;  ///< copies of the neighbour's items
  };

  Exchange() = default;
  /// \param processes  must outlive this
  Exchange(const Communicator& processes, std::vector<Neighbour> neighbours);

  const std::vector<Neighbour>& neighbours() const { return neighbours_; }

  /// Gives copies the values of their owners. \param entries  numbers of an item i, from values[i * entries] on
  void update(std::vector<double>& values, int entries = 1) const { update(values.data(), entries); }
  void update(double* values, int entries) const;
  /// The other way: for each neighbour what its copies of the items sent to it have, in the order of `sent`.
  std::vector<std::vector<double>> from_copies(const std::vector<double>& values, int entries = 1) const;

  std::size_t sent_items() const;
  std::size_t received_items() const;

 private:
  enum class Way { to_copies, to_owners };
  static const std::vector<int>& outgoing(const Neighbour& n, Way way) {
    return way == Way::to_copies ? n.sent : n.received;
  }
  static const std::vector<int>& incoming(const Neighbour& n, Way way) {
    return way == Way::to_copies ? n.received : n.sent;
  }
  /// Fills incoming_ with what the neighbours send.
  void communicate(const double* values, int entries, Way way) const;

  [[maybe_unused]] const Communicator* processes_ = nullptr;  ///< not asked without MPI
  std::vector<Neighbour> neighbours_;
  mutable std::vector<std::vector<double>> outgoing_, incoming_;  ///< buffers, per neighbour
};

}  // namespace fsi
