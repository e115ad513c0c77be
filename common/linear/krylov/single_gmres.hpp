#pragma once

#include <functional>
#include <vector>

namespace fsi {

/// Flexible GMRES in single precision, for a few digits at a time: the inner iteration of a refinement that computes
/// its residuals in double precision. Classical Gram-Schmidt over chunks, which reads each basis vector twice an
/// iteration; the loss of orthogonality is far below the digits asked for. Sums are taken by fixed chunks: results do
/// not depend on the number of threads.
class SingleGmres {
 public:
  using Operator = std::function<void(const std::vector<float>& x, std::vector<float>& y)>;
  /// z = M^-1 x and y = A z, for who finds both together more cheaply.
  using PreconditionedOperator =
      std::function<void(const std::vector<float>& x, std::vector<float>& z, std::vector<float>& y)>;
  static constexpr double smallest_tolerance = 1e-4;  ///< of one call

  struct Report {
    bool converged = false;
    int iterations = 0;
    double relative_residual = 1;  ///< estimate
  };

  /// x = approximate solution of A x = b, starting from zero.
  /// \param inverse         right preconditioner, y = M^-1 x
  /// \param max_iterations  at most this many directions; no restart
  Report solve(const Operator& a, const Operator& inverse, const std::vector<float>& b, std::vector<float>& x,
               double tolerance, int max_iterations);
  Report solve(const PreconditionedOperator& both, const std::vector<float>& b, std::vector<float>& x, double tolerance,
               int max_iterations);

  std::size_t bytes() const;

 private:
  void orthogonalise(int count, std::vector<float>& w, std::vector<double>& coefficients);

  std::vector<std::vector<float>> basis_, directions_;
  std::vector<double> partial_;
};

}  // namespace fsi
