#include "linear/krylov/gmres.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/vector_operations.hpp"

namespace fsi::detail {

namespace {

/// A restart cycle that leaves more than this share of the residual has made no progress worth repeating it.
constexpr double stagnation_share = 0.999;

}  // namespace

std::size_t RestartedGmres::bytes() const {
  std::size_t entries = residual_.size() + work_.size() + hessenberg_.size();
  for (const auto& v : basis_) entries += v.size();
  for (const auto& z : preconditioned_) entries += z.size();
  return entries * sizeof(double);
}

void RestartedGmres::begin_cycle(double residual_norm, int directions) {
  stride_ = directions + 1;
  hessenberg_.assign(static_cast<std::size_t>(stride_) * directions, 0.0);
  cosine_.assign(directions, 0.0);
  sine_.assign(directions, 0.0);
  right_.assign(stride_, 0.0);
  right_[0] = residual_norm;
  scaled_copy(1 / residual_norm, residual_, direction(basis_, 0));
}

std::vector<double>& RestartedGmres::direction(std::vector<std::vector<double>>& set, int k) const {
  if (static_cast<int>(set.size()) <= k) set.resize(k + 1);
  set[k].resize(residual_.size());
  return set[k];
}

const std::vector<double>& RestartedGmres::preconditioned(const LinearOperator& inverse, int k) {
  if (!inverse) {
    if (flexible_) direction(preconditioned_, k) = basis_[k];  // the update reads these
    return basis_[k];
  }
  auto& image = flexible_ ? direction(preconditioned_, k) : work_;
  image.resize(residual_.size());
  inverse(basis_[k], image);
  return image;
}

double RestartedGmres::orthogonalise(int k, double length) {
  auto& w = basis_[k + 1];
  double rest = length;
  for (int pass = 0; pass < 2; ++pass) {
    for (int j = 0; j <= k; ++j) {
      const double overlap = dot(basis_[j], w);
      h(j, k) += overlap;
      axpy(-overlap, basis_[j], w);
    }
    const double left = norm(w);
    const bool clean = left > 0.5 * rest;
    rest = left;
    if (clean) break;
  }
  h(k + 1, k) = rest;
  return rest;
}

bool RestartedGmres::rotate(int k, double smallest) {
  for (int j = 0; j < k; ++j) {
    const double upper = h(j, k), lower = h(j + 1, k);
    h(j, k) = cosine_[j] * upper + sine_[j] * lower;
    h(j + 1, k) = -sine_[j] * upper + cosine_[j] * lower;
  }
  const double radius = std::hypot(h(k, k), h(k + 1, k));
  if (radius <= smallest) return false;
  cosine_[k] = h(k, k) / radius;
  sine_[k] = h(k + 1, k) / radius;
  h(k, k) = radius;
  right_[k + 1] = -sine_[k] * right_[k];
  right_[k] *= cosine_[k];
  return true;
}

void RestartedGmres::update(const LinearOperator& inverse, int usable, std::vector<double>& x) {
  coefficients_.assign(usable, 0.0);
  for (int j = usable - 1; j >= 0; --j) {
    double sum = right_[j];
    for (int k = j + 1; k < usable; ++k) sum -= h(j, k) * coefficients_[k];
    coefficients_[j] = sum / h(j, j);
  }
  if (flexible_) {
    for (int j = 0; j < usable; ++j) axpy(coefficients_[j], preconditioned_[j], x);
    return;
  }
  set_zero(residual_);
  for (int j = 0; j < usable; ++j) axpy(coefficients_[j], basis_[j], residual_);
  if (inverse) {
    inverse(residual_, work_);
    axpy(1, work_, x);
  } else {
    axpy(1, residual_, x);
  }
}

RestartedGmres::Cycle RestartedGmres::run_cycle(const LinearOperator& a, const LinearOperator& inverse, double norm_b,
                                                double residual_norm, int directions, double tolerance,
                                                std::vector<double>& x, std::vector<double>& history) {
  begin_cycle(residual_norm, directions);
  Cycle cycle;
  int usable = 0;  // columns of the triangular system
  for (int k = 0; k < directions; ++k) {
    auto& w = direction(basis_, k + 1);
    a(preconditioned(inverse, k), w);
    const double length = norm(w);
    if (!std::isfinite(length)) {
      cycle.finite = false;
      break;
    }
    ++cycle.iterations;
    const double smallest = 1e-14 * length;
    const double rest = orthogonalise(k, length);
    if (!rotate(k, smallest)) break;
    usable = k + 1;
    history.push_back(std::abs(right_[k + 1]) / norm_b);
    // A M^-1 v lies in the space already spanned: either the solution is in it, or the operator is singular on it.
    const bool breakdown = rest <= smallest;
    if (breakdown || std::abs(right_[k + 1]) <= tolerance * norm_b) break;
    scale(1 / rest, w);
  }
  if (usable > 0) update(inverse, usable, x);
  return cycle;
}

KrylovReport RestartedGmres::solve(const LinearOperator& a, const LinearOperator& inverse, const std::vector<double>& b,
                                   std::vector<double>& x, const KrylovOptions& options) {
  KrylovReport report;
  x.resize(b.size(), 0.0);
  residual_.resize(b.size());
  work_.resize(b.size());
  const double norm_b = norm(b);
  if (!std::isfinite(norm_b)) {
    report.relative_residual = norm_b;
    report.failure = "the right-hand side is not finite";
    return report;
  }
  if (norm_b == 0) {
    set_zero(x);
    report.converged = true;
    report.history.push_back(0);
    return report;
  }
  const auto recompute = [&] {
    a(x, residual_);
    for (std::size_t i = 0; i < b.size(); ++i) residual_[i] = b[i] - residual_[i];
    report.relative_residual = norm(residual_) / norm_b;
  };
  recompute();
  report.history.push_back(report.relative_residual);

  for (int stagnant = 0;;) {
    if (!std::isfinite(report.relative_residual)) {
      report.failure = "the residual is not finite";
      return report;
    }
    if (report.relative_residual <= options.tolerance) {
      report.converged = true;
      return report;
    }
    if (report.iterations >= options.max_iterations) {
      report.failure = "limit of " + std::to_string(options.max_iterations) + " iterations reached";
      return report;
    }
    if (stagnant >= 2) {
      report.failure = "stagnation: a restart no longer reduces the residual";
      return report;
    }
    const double before = report.relative_residual;
    const int directions = std::min(std::max(options.restart, 1), options.max_iterations - report.iterations);
    const Cycle cycle =
        run_cycle(a, inverse, norm_b, before * norm_b, directions, options.tolerance, x, report.history);
    report.iterations += cycle.iterations;
    recompute();
    if (static_cast<int>(report.history.size()) > 1) report.history.back() = report.relative_residual;
    if (!cycle.finite) {
      report.failure = "the operator or the preconditioner returned a number that is not finite";
      return report;
    }
    if (cycle.iterations == 0) {
      report.failure = "breakdown";
      return report;
    }
    stagnant = report.relative_residual > stagnation_share * before ? stagnant + 1 : 0;
  }
}

}  // namespace fsi::detail
