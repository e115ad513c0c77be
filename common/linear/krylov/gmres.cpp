#include "linear/krylov/gmres.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "algebra/vector_operations.hpp"
#include "host/parallel_for.hpp"

namespace fsi {

namespace {

/// A restart cycle that leaves more than this share of the residual has made no progress worth repeating it.
constexpr double stagnation_share = 0.999;
constexpr std::size_t chunk_size = 2048;

std::size_t chunks_of(std::size_t size) {
  return (size + chunk_size - 1) / chunk_size;
}

/// Of a vector w that joins the basis.
struct Lengths {
  double whole;  ///< |w|
  double rest;   ///< of what is left without the part along the basis
};

/// What depends on the precision: how sums are taken, and which part of a vector is rounding error.
template <class Number>
struct Arithmetic;

template <>
struct Arithmetic<double> {
  using Vector = std::vector<double>;
  static constexpr double dependent = 1e-14;

  static double norm(const Vector& x, std::vector<double>&, const Communicator& processes) {
    return processes.is_alone() ? fsi::norm(x) : std::sqrt(processes.sum(dot(x, x)));
  }
  static void normalise(const Vector& x, double length, Vector& to) { scaled_copy(1 / length, x, to); }
  static void normalise(Vector& x, double length) { scale(1 / length, x); }
  static bool is_exhausted(const Lengths& w, double /*diagonal*/) { return w.rest <= dependent * w.whole; }

  /// Modified Gram-Schmidt, a second time where the first removed most of w ("twice is enough").
  static Lengths orthogonalise(const std::vector<Vector>& basis, int count, Vector& w, double* column,
                               std::vector<double>& partial, const Communicator& processes) {
    Lengths length{norm(w, partial, processes), 0};
    if (!std::isfinite(length.whole)) return length;
    length.rest = length.whole;
    for (int pass = 0; pass < 2; ++pass) {
      for (int j = 0; j < count; ++j) {
        const double overlap = processes.sum(dot(basis[j], w));
        column[j] += overlap;
        axpy(-overlap, basis[j], w);
      }
      const double left = norm(w, partial, processes);
      const bool clean = left > 0.5 * length.rest;
      length.rest = left;
      if (clean) break;
    }
    return length;
  }
};

template <>
struct Arithmetic<float> {
  using Vector = std::vector<float>;
  static constexpr double dependent = 1e-6;

  static float chunk_dot(const float* x, const float* y, std::size_t size) {
    float sum = 0;
#pragma omp simd reduction(+ : sum)
    for (std::size_t i = 0; i < size; ++i) sum += x[i] * y[i];
    return sum;
  }
  static double norm(const Vector& x, std::vector<double>& partial, const Communicator& processes) {
    const std::size_t chunks = chunks_of(x.size());
    partial.resize(chunks);
    parallel_for(chunks, chunks > 4, [&](std::size_t c) {
      const float* from = x.data() + c * chunk_size;
      partial[c] = chunk_dot(from, from, std::min(chunk_size, x.size() - c * chunk_size));
    });
    double square = 0;
    for (std::size_t c = 0; c < chunks; ++c) square += partial[c];
    return std::sqrt(processes.sum(square));
  }
  static void normalise(const Vector& x, double length, Vector& to) {
    for (std::size_t i = 0; i < x.size(); ++i) to[i] = static_cast<float>(x[i] / length);
  }
  static void normalise(Vector& x, double length) {
    const float factor = static_cast<float>(1 / length);
    for (float& value : x) value *= factor;
  }
  static bool is_exhausted(const Lengths& w, double diagonal) {
    return w.rest < 1e-7 * diagonal;
  }

  /// Classical Gram-Schmidt.
  static Lengths orthogonalise(const std::vector<Vector>& basis, int count, Vector& w, double* column,
                               std::vector<double>& partial, const Communicator& processes) {
    const std::size_t size = w.size(), chunks = chunks_of(size), width = static_cast<std::size_t>(count) + 1;
    partial.resize(chunks * width);
    parallel_for(chunks, chunks > 4, [&](std::size_t c) {
      const std::size_t from = c * chunk_size, length = std::min(chunk_size, size - from);
      for (int j = 0; j < count; ++j)
        partial[c * width + j] = chunk_dot(basis[j].data() + from, w.data() + from, length);
    });
    for (int j = 0; j < count; ++j)
      for (std::size_t c = 0; c < chunks; ++c) column[j] += partial[c * width + j];
    processes.sum(column, static_cast<std::size_t>(count));
    parallel_for(chunks, chunks > 4, [&](std::size_t c) {
      const std::size_t from = c * chunk_size, length = std::min(chunk_size, size - from);
      float* to = w.data() + from;
      for (int j = 0; j < count; ++j) {
        const float h = static_cast<float>(column[j]);
        const float* v = basis[j].data() + from;
        for (std::size_t i = 0; i < length; ++i) to[i] -= h * v[i];
      }
      partial[c * width + count] = chunk_dot(to, to, length);
    });
    double square = 0;
    for (std::size_t c = 0; c < chunks; ++c) square += partial[c * width + count];
    Lengths length{0, std::sqrt(processes.sum(square))};
    for (int j = 0; j < count; ++j) length.whole = std::hypot(length.whole, column[j]);
    length.whole = std::hypot(length.whole, length.rest);
    return length;
  }
};

/// x += sum of coefficients[j] vectors[j]
template <class Number>
void add_combination(const std::vector<double>& coefficients, const std::vector<std::vector<Number>>& vectors,
                     std::vector<Number>& x) {
  const std::size_t size = x.size();
  parallel_for(chunks_of(size), size > serial_entries, [&](std::size_t c) {
    const std::size_t from = c * chunk_size, to = std::min(size, from + chunk_size);
    for (std::size_t j = 0; j < coefficients.size(); ++j) {
      const auto y = static_cast<Number>(coefficients[j]);
      for (std::size_t i = from; i < to; ++i) x[i] += y * vectors[j][i];
    }
  });
}

template <class Vector, class Operator>
auto both_of(const Operator& a, const Operator& inverse) {
  return [&a, &inverse](const Vector& v, Vector& z, Vector& y) {
    if (inverse)
      inverse(v, z);
    else
      z = v;
    a(z, y);
  };
}

}  // namespace

template <class Number, Preconditioning kind>
std::size_t BasicGmres<Number, kind>::bytes() const {
  std::size_t entries = residual_.size() + work_.size();
  for (const auto* set : {&basis_, &preconditioned_})
    for (const Vector& v : *set) entries += v.size();
  return entries * sizeof(Number) + hessenberg_.size() * sizeof(double);
}

template <class Number, Preconditioning kind>
typename BasicGmres<Number, kind>::Vector& BasicGmres<Number, kind>::vector_at(std::vector<Vector>& set, int k) const {
  if (static_cast<int>(set.size()) <= k) set.resize(static_cast<std::size_t>(k) + 1);
  set[k].resize(size_);
  return set[k];
}

template <class Number, Preconditioning kind>
double BasicGmres<Number, kind>::rotate(int k) {
  for (int j = 0; j < k; ++j) {
    const double upper = h(j, k), lower = h(j + 1, k);
    h(j, k) = cosine_[j] * upper + sine_[j] * lower;
    h(j + 1, k) = -sine_[j] * upper + cosine_[j] * lower;
  }
  return std::hypot(h(k, k), h(k + 1, k));
}

template <class Number, Preconditioning kind>
void BasicGmres<Number, kind>::update(const Operator& inverse, int columns, Vector& x) {
  coefficients_.assign(columns, 0.0);
  for (int j = columns - 1; j >= 0; --j) {
    double sum = right_[j];
    for (int k = j + 1; k < columns; ++k) sum -= h(j, k) * coefficients_[k];
    coefficients_[j] = sum / h(j, j);
  }
  if constexpr (kind == Preconditioning::varying) {
    add_combination(coefficients_, preconditioned_, x);
  } else {
    residual_.assign(size_, Number{0});
    add_combination(coefficients_, basis_, residual_);
    if (inverse) inverse(residual_, work_);
    const Vector& change = inverse ? work_ : residual_;
    parallel_for(size_, size_ >= serial_entries, [&](std::size_t i) { x[i] += change[i]; });
  }
}

template <class Number, Preconditioning kind>
typename BasicGmres<Number, kind>::Cycle BasicGmres<Number, kind>::run_cycle(const PreconditionedOperator& both,
                                                                             const Vector& residual,
                                                                             double residual_norm, double norm_b,
                                                                             int directions, double tolerance,
                                                                             std::vector<double>* history) {
  using Sums = Arithmetic<Number>;
  stride_ = directions + 1;
  hessenberg_.resize(static_cast<std::size_t>(stride_) * directions);
  cosine_.resize(directions);
  sine_.resize(directions);
  right_.assign(stride_, 0.0);
  right_[0] = residual_norm;
  Sums::normalise(residual, residual_norm, vector_at(basis_, 0));
  Cycle cycle;
  for (int k = 0; k < directions; ++k) {
    Vector& w = vector_at(basis_, k + 1);
    both(basis_[k], kind == Preconditioning::varying ? vector_at(preconditioned_, k) : work_, w);
    std::fill_n(&h(0, k), k + 2, 0.0);
    const Lengths length = Sums::orthogonalise(basis_, k + 1, w, &h(0, k), partial_sums_, *processes_);
    cycle.finite = std::isfinite(length.whole);
    if (!cycle.finite) break;
    ++cycle.products;
    h(k + 1, k) = length.rest;
    const double diagonal = rotate(k);
    // Otherwise A M^-1 v_k lies in the span of the earlier ones: this direction leads nowhere.
    if (!(diagonal > Sums::dependent * length.whole) || !std::isfinite(diagonal)) break;
    cosine_[k] = h(k, k) / diagonal;
    sine_[k] = h(k + 1, k) / diagonal;
    h(k, k) = diagonal;
    right_[k + 1] = -sine_[k] * right_[k];
    right_[k] *= cosine_[k];
    cycle.columns = k + 1;
    cycle.relative_residual = std::abs(right_[k + 1]) / norm_b;
    if (history) history->push_back(cycle.relative_residual);
    // Exhausted: either the solution is in the space that is spanned already, or the operator is singular on it.
    if (cycle.relative_residual <= tolerance || Sums::is_exhausted(length, diagonal)) break;
    Sums::normalise(w, length.rest);
  }
  return cycle;
}

template <class Number, Preconditioning kind>
KrylovReport BasicGmres<Number, kind>::solve(const Operator& a, const Operator& inverse, const Vector& b, Vector& x,
                                             const KrylovOptions& options) {
  KrylovReport report;
  size_ = b.size();
  x.resize(size_, Number{0});
  residual_.resize(size_);
  work_.resize(size_);
  const double norm_b = Arithmetic<Number>::norm(b, partial_sums_, *processes_);
  if (!std::isfinite(norm_b)) {
    report.relative_residual = norm_b;
    report.failure = "the right-hand side is not finite";
    return report;
  }
  if (norm_b == 0) {
    x.assign(size_, Number{0});
    report.converged = true;
    report.history.push_back(0);
    return report;
  }
  const auto both = both_of<Vector>(a, inverse);
  const auto recompute = [&] {
    a(x, residual_);
    for (std::size_t i = 0; i < size_; ++i) residual_[i] = b[i] - residual_[i];
    report.relative_residual = Arithmetic<Number>::norm(residual_, partial_sums_, *processes_) / norm_b;
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
        run_cycle(both, residual_, before * norm_b, norm_b, directions, options.tolerance, &report.history);
    if (cycle.columns > 0) update(inverse, cycle.columns, x);
    report.iterations += cycle.products;
    recompute();
    if (static_cast<int>(report.history.size()) > 1) report.history.back() = report.relative_residual;
    if (!cycle.finite) {
      report.failure = "the operator or the preconditioner returned a number that is not finite";
      return report;
    }
    if (cycle.products == 0) {
      report.failure = "breakdown";
      return report;
    }
    stagnant = report.relative_residual > stagnation_share * before ? stagnant + 1 : 0;
  }
}

template <class Number, Preconditioning kind>
typename BasicGmres<Number, kind>::Estimate BasicGmres<Number, kind>::solve_from_zero(
    const PreconditionedOperator& both, const Vector& b, Vector& x, double tolerance, int directions) {
  assert(directions >= 0);
  size_ = b.size();
  x.assign(size_, Number{0});
  const double norm_b = Arithmetic<Number>::norm(b, partial_sums_, *processes_);
  if (norm_b == 0 || !std::isfinite(norm_b)) return {norm_b == 0, 0, 1};
  tolerance = std::max(tolerance, smallest_tolerance);
  Vector unused(kind == Preconditioning::fixed ? size_ : 0);
  work_.resize(unused.size());
  const Cycle cycle = run_cycle(both, b, norm_b, norm_b, directions, tolerance, nullptr);
  if (cycle.columns > 0) update([&](const Vector& v, Vector& z) { both(v, z, unused); }, cycle.columns, x);
  return {cycle.columns > 0 && cycle.relative_residual <= tolerance, cycle.columns, cycle.relative_residual};
}

template <class Number, Preconditioning kind>
typename BasicGmres<Number, kind>::Estimate BasicGmres<Number, kind>::solve_from_zero(
    const Operator& a, const Operator& inverse, const Vector& b, Vector& x, double tolerance, int directions) {
  return solve_from_zero(both_of<Vector>(a, inverse), b, x, tolerance, directions);
}

template class BasicGmres<double, Preconditioning::fixed>;
template class BasicGmres<double, Preconditioning::varying>;
template class BasicGmres<float, Preconditioning::varying>;

}  // namespace fsi
