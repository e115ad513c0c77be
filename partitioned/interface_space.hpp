#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/communicator.hpp"

namespace fsi {

/// Scalar products of interface vectors. A vector holds the entries of the nodes that this process owns first, and
/// behind them those of ghosts, nodes of other processes. Linear combinations are formed of all entries, so that ghosts
/// keep the values of their owners. Products count owned entries and are summed over the processes, so that all get the
/// same bits. Collective: all functions but own() and is_whole() communicate, and all processes call them together,
/// also a process without interface nodes, whose vectors are empty.
class InterfaceSpace {
 public:
  /// For vectors that one process holds as a whole.
  InterfaceSpace() = default;
  /// \param processes  must outlive this
  /// \param own        how many numbers of a vector are this process's
  InterfaceSpace(const Communicator& processes, std::size_t own) : processes_(&processes), own_(own) {}

  /// How many of a vector's first numbers count here.
  std::size_t own(const std::vector<double>& x) const { return processes_->is_alone() ? x.size() : own_; }
  /// Length of a vector over all processes.
  std::int64_t size(const std::vector<double>& x) const { return processes_->sum(static_cast<std::int64_t>(own(x))); }

  double dot(const std::vector<double>& x, const std::vector<double>& y) const;
  double norm(const std::vector<double>& x) const;
  /// Euclidean norms of several vectors, by one message.
  std::vector<double> norms(const std::vector<const std::vector<double>*>& vectors) const;
  /// q_i . x for each i, by one message.
  std::vector<double> dots(const std::vector<std::vector<double>>& q, const std::vector<double>& x) const;
  /// v -= Q Q^T v for orthonormal columns q by a Gram-Schmidt sweep: modified where vectors are whole, else classical,
  /// which needs one message. To be repeated where much cancels.
  /// \returns the coefficients subtracted, one per column
  std::vector<double> subtract_projections(const std::vector<std::vector<double>>& q, std::vector<double>& v) const;
  /// Replaces `count` partial sums, each over owned entries, by the sums over all processes.
  void sum(double* mine, std::size_t count) const { processes_->sum(mine, count); }
  bool is_whole() const { return processes_->is_alone(); }

 private:
  double own_dot(const std::vector<double>& x, const std::vector<double>& y) const;

  const Communicator* processes_ = &Communicator::alone();
  std::size_t own_ = 0;
};

}  // namespace fsi
