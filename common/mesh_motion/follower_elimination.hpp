#pragma once

#include <cstddef>
#include <vector>

#include "algebra/csr_matrix.hpp"

namespace fsi {

/// Unknowns of a symmetric matrix that follow two others at most, taken out of it: nodes in the middle of edges, where the
/// mesh motion has them follow their ends. With f the followers and k the kept ones
///   (A_kk - A_kf A_ff^-1 A_fk) x_k = b_k - A_kf A_ff^-1 b_f,   x_f = A_ff^-1 (b_f - A_fk x_k),
/// A_ff being diagonal. Where ends are neighbours anyway nothing fills in.
class FollowerElimination {
 public:
  FollowerElimination() = default;
  /// \param a        symmetric, both halves stored
  /// \param reduced  set to the matrix of what is kept
  FollowerElimination(const CsrMatrix<double>& a, CsrMatrix<double>& reduced);
  /// Of a matrix that processes share.
  /// \param a        rows and columns of own unknowns, behind them of copies, whose rows are whole where they couple with own
  ///                 ones
  /// \param follows  per row, decided alike by all processes; none couples with another
  /// \param own      rows
  /// \param reduced  set to the own rows of what is kept, columns of copies behind
  FollowerElimination(const CsrMatrix<double>& a, const std::vector<char>& follows, int own,
                      CsrMatrix<double>& reduced);

  static constexpr int most_leaders = 2;
  /// Number of other unknowns that a row couples with.
  static int leaders(const CsrMatrix<double>& a, int row);

  /// Rows of A that are kept, ascending.
  const std::vector<int>& kept() const { return kept_; }
  int own_kept() const { return own_kept_; }

  /// Right-hand sides of the reduced matrix from `count` right-hand sides of A, one behind the other in both.
  /// \param b        of all rows
  /// \param of_kept  overwritten: count * own_kept() numbers
  void reduce(const std::vector<double>& b, int count, std::vector<double>& of_kept) const;
  /// The whole solution from that of all kept ones; what follows among copies is left.
  /// \param b  of the whole
  /// \param x  the whole one, overwritten
  void complete(const std::vector<double>& b, const std::vector<double>& of_kept, int count,
                std::vector<double>& x) const;

  std::size_t bytes() const;

 private:
  std::vector<int> kept_, followers_;
  int own_kept_ = 0, own_followers_ = 0;  ///< the first of each
  std::vector<double> inverse_diagonal_;  ///< per follower
  CsrMatrix<double> shares_;              ///< A_ff^-1 A_fk
  CsrMatrix<double> transposed_shares_;
};

}  // namespace fsi
