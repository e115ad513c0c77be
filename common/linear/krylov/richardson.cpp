#include "linear/krylov/richardson.hpp"

#include <cmath>

#include "algebra/vector_operations.hpp"

namespace fsi {

KrylovReport Richardson::solve(const LinearOperator& a, const LinearOperator& inverse, const std::vector<double>& b,
                               std::vector<double>& x, const KrylovOptions& options) {
  constexpr double diverged = 1e6;
  KrylovReport report;
  x.resize(b.size(), 0.0);
  residual_.resize(b.size());
  correction_.resize(b.size());
  const double norm_b = norm(b);
  if (norm_b == 0) {
    set_zero(x);
    report.converged = true;
    report.history.push_back(0);
    return report;
  }
  for (;; ++report.iterations) {
    a(x, residual_);
    for (std::size_t i = 0; i < b.size(); ++i) residual_[i] = b[i] - residual_[i];
    report.relative_residual = norm(residual_) / norm_b;
    report.history.push_back(report.relative_residual);
    if (!std::isfinite(report.relative_residual)) {
      report.failure = "the residual is not finite";
      return report;
    }
    if (report.relative_residual <= options.tolerance) {
      report.converged = true;
      return report;
    }
    if (report.relative_residual > diverged * report.history.front()) {
      report.failure = "diverged";
      return report;
    }
    if (report.iterations >= options.max_iterations) {
      report.failure = "limit of " + std::to_string(options.max_iterations) + " iterations reached";
      return report;
    }
    inverse(residual_, correction_);
    axpy(1, correction_, x);
  }
}

}  // namespace fsi
