#pragma once

#include <cstddef>
#include <vector>

#include "partitioned/interface_space.hpp"

namespace fsi {

/// QR factorisation V = Q R of difference columns that drops those which add nothing new: by Gram-Schmidt, repeated
/// once, column by column in the order given, a column whose part orthogonal to the earlier ones is not longer than
/// `filter` times the column itself is left out ([Haelterman2016], filter QR2, which preCICE's QR3 applies).
/// Zero, repeated and not finite columns are always left out. Constructor, insert_first() and least_squares() are
/// collective.
class FilteredQr {
 public:
  FilteredQr(const std::vector<const std::vector<double>*>& columns, double filter, const InterfaceSpace& space = {});

  /// The same of { v, the columns kept }, by rotations: the work of one column in place of all ([Golub2013], section
  /// 6.5.2). kept() then counts places among these.
  /// \returns false where v is a combination of the others but for rounding: then nothing has changed, and only a
  /// factorisation from the beginning tells which of them to keep
  bool insert_first(const std::vector<double>& v);
  /// Forgets the last column kept.
  void remove_last() { remove(r_.size() - 1); }

  /// Places of the columns kept, ascending.
  const std::vector<std::size_t>& kept() const { return kept_; }
  /// c minimising |V c - b| over the columns kept, in their order.
  std::vector<double> least_squares(const std::vector<double>& b) const;
  /// Rows of V^+ = R^-1 Q^T, one per column kept: least_squares(b)[i] = row i . b.
  std::vector<std::vector<double>> pseudo_inverse() const;

 private:
  /// Takes from v, of this length, what lies along the columns of Q. \returns that, and the length of what is left
  std::vector<double> orthogonalise(std::vector<double>& v, double length) const;
  void remove(std::size_t j);
  /// Turns rows i and i + 1 of R so that column j has nothing in the second, and the columns of Q with them.
  void rotate(std::size_t i, std::size_t j);

  double filter_;
  InterfaceSpace space_;
  std::vector<std::size_t> kept_;
  std::vector<double> lengths_;         ///< of the columns kept
  std::vector<std::vector<double>> q_;  ///< orthonormal columns
  std::vector<std::vector<double>> r_;  ///< r_[j][i] = R(i, j), i <= j
};

}  // namespace fsi
