#pragma once

#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

#include "linear/krylov/krylov.hpp"
#include "parallel/communicator.hpp"

namespace fsi {

/// What the preconditioner of a Krylov method is.
enum class Preconditioning {
  fixed,   ///< one linear map M^-1. If it is not, the update M^-1 (V y) differs from what was minimised [Saad1986]
  varying  ///< another map in each iteration, an inner iteration say: its answers are kept beside the basis [Saad1993]
};

/// Right-preconditioned GMRES in the precision of `Number`: minimises |b - A x| over x0 + M^-1 K_m(A M^-1, r0); [Saad2003],
/// algorithms 9.5 and 9.6. Vectors are kept between calls. Sums are taken by fixed chunks: results do not depend on the
/// number of threads. Where processes share the vectors out, entries that others own are zero in right sides and products.
///
/// In double precision Arnoldi's method is by modified Gram-Schmidt, repeated where cancellation spoils orthogonality. In
/// single precision, for a few digits at a time, it is by classical Gram-Schmidt over chunks, which reads each basis vector
/// twice an iteration; the loss of orthogonality is far below the digits asked for.
template <class Number, Preconditioning kind>
class BasicGmres {
 public:
  using Vector = std::vector<Number>;

  BasicGmres() = default;
  /// \param processes  that share the vectors out; must outlive this
  explicit BasicGmres(const Communicator& processes) : processes_(&processes) {}

  /// y = L x. `y` has its size already and is overwritten; x and y are different vectors.
  using Operator = std::function<void(const Vector& x, Vector& y)>;
  /// z = M^-1 v and y = A z, for callers that find both together more cheaply.
  using PreconditionedOperator = std::function<void(const Vector& v, Vector& z, Vector& y)>;
  /// Of solve_from_zero(), relative.
  static constexpr double smallest_tolerance = std::is_same_v<Number, float> ? 1e-4 : 1e-12;

  /// Restarts from its iterate, whose residual is computed each time, until that is small enough.
  /// \param a        y = A x
  /// \param inverse  y = M^-1 x; empty: no preconditioner
  /// \param x        initial guess on entry, solution on return
  KrylovReport solve(const Operator& a, const Operator& inverse, const Vector& b, Vector& x,
                     const KrylovOptions& options = {});

  struct Estimate {
    bool converged = false;
    int iterations = 0;
    double relative_residual = 1;  ///< not computed from the solution
  };
  /// One cycle from x = 0 that believes its estimate of the residual: the inner iteration of a refinement.
  /// \param tolerance   smallest_tolerance at least
  /// \param directions  at most
  Estimate solve_from_zero(const PreconditionedOperator& both, const Vector& b, Vector& x, double tolerance,
                           int directions);
  Estimate solve_from_zero(const Operator& a, const Operator& inverse, const Vector& b, Vector& x, double tolerance,
                           int directions);

  std::size_t bytes() const;

 private:
  struct Cycle {
    int products = 0;  ///< with A
    int columns = 0;   ///< of the triangular system
    bool finite = true;
    double relative_residual = 1;  ///< estimate
  };
  /// \param residual_norm  |residual|; residual over it is the first basis vector
  /// \param history        gets the estimates; null: they are not wanted
  Cycle run_cycle(const PreconditionedOperator& both, const Vector& residual, double residual_norm, double norm_b,
                  int directions, double tolerance, std::vector<double>* history);
  /// Applies the earlier Givens rotations to column k. \returns the diagonal entry that the next rotation will leave
  double rotate(int k);
  /// x += M^-1 V y, y solving the least squares problem.
  void update(const Operator& inverse, int columns, Vector& x);
  Vector& vector_at(std::vector<Vector>& set, int k) const;
  double& h(int row, int column) { return hessenberg_[static_cast<std::size_t>(column) * stride_ + row]; }

  const Communicator* processes_ = &Communicator::alone();
  std::size_t size_ = 0;
  int stride_ = 0;                              ///< of a column of the Hessenberg matrix
  std::vector<Vector> basis_, preconditioned_;  ///< V, and Z = M^-1 V where the preconditioner varies
  Vector residual_, work_;
  std::vector<double> hessenberg_, cosine_, sine_, right_, coefficients_, partial_sums_;
};

using Gmres = BasicGmres<double, Preconditioning::fixed>;
using Fgmres = BasicGmres<double, Preconditioning::varying>;
using SingleGmres = BasicGmres<float, Preconditioning::varying>;

}  // namespace fsi
