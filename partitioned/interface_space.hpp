#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/communicator.hpp"

namespace fsi {

/// Scalar products of interface vectors. A vector holds the numbers of this process's interface nodes first and behind
/// them ghosts, other processes': linear combinations are formed of all, and so the ghosts stay what their owners
/// have; products count the own ones and are summed over the processes, several in one message. All processes get the
/// same bits. A process may have no interface node: whether a vector is empty says nothing.
class InterfaceSpace {
 public:
  /// Of vectors that are whole here.
  InterfaceSpace() = default;
  /// \param processes  must outlive this
  /// \param own        how many numbers of a vector are this process's
  InterfaceSpace(const Communicator& processes, std::size_t own) : processes_(&processes), own_(own) {}

  /// How many of a vector's first numbers count here.
  std::size_t own(const std::vector<double>& x) const { return processes_->is_alone() ? x.size() : own_; }
  /// Of a vector, in all processes' numbers.
  std::int64_t size(const std::vector<double>& x) const { return processes_->sum(static_cast<std::int64_t>(own(x))); }

  double dot(const std::vector<double>& x, const std::vector<double>& y) const;
  double norm(const std::vector<double>& x) const;
  /// Of each of several vectors.
  std::vector<double> norms(const std::vector<const std::vector<double>*>& vectors) const;
  /// q_i . x for each i.
  std::vector<double> dots(const std::vector<std::vector<double>>& q, const std::vector<double>& x) const;
  /// v -= Q Q^T v for orthonormal columns q, a sweep of Gram and Schmidt: the modified one where vectors are whole, else
  /// the classical one, whose products are one message. To be repeated where much cancels.
  /// \returns what was taken off, in the order of the columns
  std::vector<double> subtract_projections(const std::vector<std::vector<double>>& q, std::vector<double>& v) const;
  /// What each process counted by itself, at its own interface nodes, in all.
  void sum(double* mine, std::size_t count) const { processes_->sum(mine, count); }
  bool is_whole() const { return processes_->is_alone(); }

 private:
  double own_dot(const std::vector<double>& x, const std::vector<double>& y) const;

  const Communicator* processes_ = &Communicator::alone();
  std::size_t own_ = 0;
};

}  // namespace fsi
