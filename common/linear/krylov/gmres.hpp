#pragma once

#include <vector>

#include "linear/krylov/krylov.hpp"

namespace fsi {

namespace detail {

/// Restarted GMRES, right-preconditioned, plain or flexible; [Saad2003],
/// algorithms 9.5 and 9.6. Arnoldi by modified Gram-Schmidt, repeated where cancellation spoils orthogonality.
/// Vectors are kept between calls.
class RestartedGmres {
 public:
  explicit RestartedGmres(bool flexible) : flexible_(flexible) {}
  KrylovReport solve(const LinearOperator& a, const LinearOperator& inverse, const std::vector<double>& b,
                     std::vector<double>& x, const KrylovOptions& options);
  std::size_t bytes() const;

 private:
  struct Cycle {
    int iterations = 0;
    bool finite = true;
  };
  Cycle run_cycle(const LinearOperator& a, const LinearOperator& inverse, double norm_b, double residual_norm,
                  int directions, double tolerance, std::vector<double>& x, std::vector<double>& history);
  void begin_cycle(double residual_norm, int directions);
  /// M^-1 v_k
  const std::vector<double>& preconditioned(const LinearOperator& inverse, int k);
  /// Takes v_0 to v_k off w = v_{k+1} by modified Gram-Schmidt, a second time where the first removed most of w ("twice is
  /// enough"). \returns |w|, not yet one
  double orthogonalise(int k, double length);
  /// Givens' rotations of column k. \returns false where the column has nothing above `smallest`
  bool rotate(int k, double smallest);
  /// x += M^-1 V y of the least squares' y.
  void update(const LinearOperator& inverse, int usable, std::vector<double>& x);
  std::vector<double>& direction(std::vector<std::vector<double>>& set, int k) const;
  double& h(int row, int column) { return hessenberg_[static_cast<std::size_t>(column) * stride_ + row]; }

  bool flexible_;
  int stride_ = 0;                                           ///< of a column of the Hessenberg matrix
  std::vector<std::vector<double>> basis_, preconditioned_;  ///< V, and Z = M^-1 V if flexible
  std::vector<double> residual_, work_;
  std::vector<double> hessenberg_, cosine_, sine_, right_, coefficients_;
};

}  // namespace detail

/// Right-preconditioned restarted GMRES [Saad1986]: minimises |b - A x| over x0 + M^-1 K_m(A M^-1, r0). The
/// preconditioner should be one fixed linear map. If it is not, the update M^-1 (V y) differs from what was minimised;
/// the residual is then recomputed, and the method goes on from the true one.
class Gmres {
 public:
  /// \param a        y = A x
  /// \param inverse  y = M^-1 x; empty: no preconditioner
  /// \param x        initial guess on entry, solution on return
  KrylovReport solve(const LinearOperator& a, const LinearOperator& inverse, const std::vector<double>& b,
                     std::vector<double>& x, const KrylovOptions& options = {}) {
    return method_.solve(a, inverse, b, x, options);
  }
  std::size_t bytes() const { return method_.bytes(); }

 private:
  detail::RestartedGmres method_{false};
};

}  // namespace fsi
