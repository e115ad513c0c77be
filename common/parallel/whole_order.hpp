#pragma once

#include <cstdint>
#include <vector>

#include "parallel/communicator.hpp"
#include "parallel/node_share.hpp"

namespace fsi {

/// Items (nodes, pairs of the interface) in an order of all processes' items that does not depend on how they are shared
/// out: the order of files. For these, each process has a stretch of the whole order, the stretches being about equally
/// long and in the order of the processes. Nobody holds the whole. All functions but the sizes are for all processes
/// together.
class WholeOrder {
 public:
  /// \param processes  must outlive this
  /// \param places     per item here its place in the whole order; copies of other processes' items have theirs
  /// \param owned      per item; each place from 0 to whole - 1 is that of one owned item of one process
  /// \throws std::logic_error at all processes when the owned places are not these
  WholeOrder(const Communicator& processes, std::vector<std::int64_t> places, const std::vector<char>& owned,
             std::int64_t whole);
  /// Of a medium's nodes. \param share  what it refers to must outlive this
  explicit WholeOrder(const NodeShare& share);
  /// Of few items, ordered by numbers of theirs: all processes get to know all of them.
  /// \param keys  per item here, different for different items, the same for copies as for their originals
  static WholeOrder by_keys(const Communicator& processes, const std::vector<std::int64_t>& keys,
                            const std::vector<char>& owned);

  const Communicator& processes() const { return *processes_; }
  std::size_t items() const { return items_; }                      ///< here, copies too
  std::int64_t whole() const { return whole_; }                     ///< of all processes, each counted once
  std::int64_t first() const { return bound(processes_->rank()); }  ///< place at which this process's stretch begins
  std::int64_t count() const { return bound(processes_->rank() + 1) - first(); }  ///< places in it

  /// The values of this process's stretch. \param values  of the items here, `entries` numbers each, those of copies not
  /// read
  std::vector<double> to_stretches(const double* values, int entries) const;
  /// The values of the items here, copies too. \param stretch  of this process's stretch
  std::vector<double> from_stretches(const double* stretch, int entries) const;

 private:
  std::int64_t bound(int rank) const { return whole_ * rank / processes_->size(); }
  /// The process in whose stretch a place is.
  int holder(std::int64_t place) const;

  using Lists = std::vector<std::vector<std::int64_t>>;  ///< one for each process

  const Communicator* processes_;
  std::size_t items_;
  std::int64_t whole_;
  Lists owned_;   ///< own items, by the holder of their place
  Lists taken_;   ///< places in this stretch of what the others own
  Lists wanted_;  ///< items, by the holder of their place
  Lists handed_;  ///< places in this stretch that the others want
};

}  // namespace fsi
