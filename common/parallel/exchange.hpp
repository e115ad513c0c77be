#pragma once

#include <cstddef>
#include <cstdint>
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

  using Rows = std::vector<std::vector<double>>;

  Exchange() = default;
  /// \param processes  must outlive this
  Exchange(const Communicator& processes, std::vector<Neighbour> neighbours);

  const std::vector<Neighbour>& neighbours() const { return neighbours_; }

  /// Gives copies the values of their owners. \param entries  numbers of an item i, from values[i * entries] on
  template <class Real>
  void update(std::vector<Real>& values, int entries = 1) const {
    update(values.data(), entries);
  }
  void update(double* values, int entries) const;
  void update(float* values, int entries) const;
  /// The same for rows of any lengths. All processes together. \param rows  per item here
  void update_rows(Rows& rows) const;
  /// The other way: what copies have is added to their owners' values.
  template <class Real>
  void add_from_copies(std::vector<Real>& values, int entries = 1) const;
  /// Rows of copies, for each neighbour in the order of `sent`. All processes together. \param rows  per item here
  std::vector<Rows> rows_from_copies(const Rows& rows) const { return communicate_rows(rows, Way::to_owners); }
  /// For each neighbour what its copies of the items sent to it have, in the order of `sent`.
  std::vector<std::vector<double>> from_copies(const std::vector<double>& values, int entries = 1) const;

  std::size_t sent_items() const;
  std::size_t received_items() const;

 private:
  enum class Way { to_copies, to_owners };
  template <class Real>
  struct Buffers {
    std::vector<std::vector<Real>> outgoing, incoming;  ///< per neighbour
  };
  static const std::vector<int>& outgoing(const Neighbour& n, Way way) {
    return way == Way::to_copies ? n.sent : n.received;
  }
  static const std::vector<int>& incoming(const Neighbour& n, Way way) {
    return way == Way::to_copies ? n.received : n.sent;
  }
  template <class Real>
  Buffers<Real>& buffers() const;
  /// Fills `incoming` with what the neighbours send.
  template <class Real>
  void communicate(const Real* values, int entries, Way way) const;
  template <class Real>
  void update_copies(Real* values, int entries) const;
  /// Per neighbour.
  std::vector<Rows> communicate_rows(const Rows& rows, Way way) const;

  [[maybe_unused]] const Communicator* processes_ = nullptr;  ///< not asked without MPI
  std::vector<Neighbour> neighbours_;
  mutable Buffers<double> doubles_;
  mutable Buffers<float> floats_;
};

/// Items of which each process has a stretch of consecutive numbers among all processes', and copies of others.
struct ShareOfNumbers {
  const Communicator* processes = &Communicator::alone();
  std::int64_t first = 0;  ///< number of the first own item; they are the first items here
  int own = 0;
  std::vector<std::int64_t> copies;  ///< numbers of the items behind the own ones
  Exchange exchange;

  ShareOfNumbers() = default;
  /// All processes together. \param copies  each with an owner
  ShareOfNumbers(const Communicator& processes, int own, std::vector<std::int64_t> copies);

  int items() const { return own + static_cast<int>(copies.size()); }
  /// Among all processes'. \param item  here
  std::int64_t number(int item) const { return item < own ? first + item : copies[item - own]; }
};

}  // namespace fsi
