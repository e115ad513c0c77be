#include "linear/krylov/single_gmres.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "host/parallel_for.hpp"

namespace fsi {

namespace {

constexpr std::size_t chunk_size = 2048;
constexpr double dependent = 1e-6;  // part of a vector that is rounding error

float chunk_dot(const float* x, const float* y, std::size_t size) {
  float sum = 0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < size; ++i) sum += x[i] * y[i];
  return sum;
}

std::size_t chunks_of(std::size_t size) {
  return (size + chunk_size - 1) / chunk_size;
}

}  // namespace

/// coefficients = V^T w, w -= V coefficients; coefficients[count] = |w| after it.
void SingleGmres::orthogonalise(int count, std::vector<float>& w, std::vector<double>& coefficients) {
  const std::size_t size = w.size(), chunks = chunks_of(size), width = static_cast<std::size_t>(count) + 1;
  partial_.resize(chunks * width);
  parallel_for(chunks, chunks > 4, [&](std::size_t c) {
    const std::size_t from = c * chunk_size, length = std::min(chunk_size, size - from);
    for (int j = 0; j < count; ++j)
      partial_[c * width + j] = chunk_dot(basis_[j].data() + from, w.data() + from, length);
  });
  for (int j = 0; j < count; ++j) {
    coefficients[j] = 0;
    for (std::size_t c = 0; c < chunks; ++c) coefficients[j] += partial_[c * width + j];
  }
  parallel_for(chunks, chunks > 4, [&](std::size_t c) {
    const std::size_t from = c * chunk_size, length = std::min(chunk_size, size - from);
    float* to = w.data() + from;
    for (int j = 0; j < count; ++j) {
      const float h = static_cast<float>(coefficients[j]);
      const float* v = basis_[j].data() + from;
      for (std::size_t i = 0; i < length; ++i) to[i] -= h * v[i];
    }
    partial_[c * width + count] = chunk_dot(to, to, length);
  });
  double square = 0;
  for (std::size_t c = 0; c < chunks; ++c) square += partial_[c * width + count];
  coefficients[count] = std::sqrt(square);
}

SingleGmres::Report SingleGmres::solve(const Operator& a, const Operator& inverse, const std::vector<float>& b,
                                       std::vector<float>& x, double tolerance, int max_iterations) {
  return solve(
      [&](const auto& in, auto& z, auto& y) {
        inverse(in, z);
        a(z, y);
      },
      b, x, tolerance, max_iterations);
}

SingleGmres::Report SingleGmres::solve(const PreconditionedOperator& both, const std::vector<float>& b,
                                       std::vector<float>& x, double tolerance, int max_iterations) {
  assert(max_iterations >= 0);
  Report report;
  tolerance = std::max(tolerance, smallest_tolerance);
  const std::size_t size = b.size();
  const auto vector = [&](std::vector<std::vector<float>>& all, int k) -> std::vector<float>& {
    if (static_cast<int>(all.size()) <= k) all.resize(static_cast<std::size_t>(k) + 1);
    all[k].resize(size);
    return all[k];
  };
  x.assign(size, 0.0f);
  std::vector<double> column(static_cast<std::size_t>(max_iterations) + 2), right{0}, cosine, sine;
  std::vector<std::vector<double>> upper;  // columns of R
  std::vector<float>& first = vector(basis_, 0);
  first = b;
  orthogonalise(0, first, column);
  const double norm_b = column[0];
  if (norm_b == 0 || !std::isfinite(norm_b)) {
    report.converged = norm_b == 0;
    return report;
  }
  for (float& value : first) value = static_cast<float>(value / norm_b);
  right[0] = norm_b;
  while (report.iterations < max_iterations) {
    const int k = report.iterations++;
    std::vector<float>& z = vector(directions_, k);
    std::vector<float>& w = vector(basis_, k + 1);
    both(basis_[k], z, w);
    orthogonalise(k + 1, w, column);
    const double subdiagonal = column[k + 1];
    double size_of_column = 0;
    for (int j = 0; j <= k + 1; ++j) size_of_column = std::hypot(size_of_column, column[j]);
    for (int j = 0; j < k; ++j) {
      const double rotated = cosine[j] * column[j] + sine[j] * column[j + 1];
      column[j + 1] = cosine[j] * column[j + 1] - sine[j] * column[j];
      column[j] = rotated;
    }
    const double radius = std::hypot(column[k], subdiagonal);
    if (!(radius > dependent * size_of_column) || !std::isfinite(radius)) {
      --report.iterations;  // A z lies in the span of the earlier ones: this direction leads nowhere
      break;
    }
    cosine.push_back(column[k] / radius);
    sine.push_back(subdiagonal / radius);
    column[k] = radius;
    upper.emplace_back(column.begin(), column.begin() + k + 1);
    right.push_back(-sine[k] * right[k]);
    right[k] *= cosine[k];
    report.relative_residual = std::abs(right[k + 1]) / norm_b;
    report.converged = report.relative_residual <= tolerance;
    if (report.converged || subdiagonal < 1e-7 * radius) break;
    const float scale = static_cast<float>(1 / subdiagonal);
    for (float& value : w) value *= scale;
  }
  const int used = report.iterations;
  for (int i = used - 1; i >= 0; --i) {
    for (int j = i + 1; j < used; ++j) right[i] -= upper[j][i] * right[j];
    right[i] /= upper[i][i];
  }
  parallel_for(chunks_of(size), size > 16384, [&](std::size_t c) {
    const std::size_t from = c * chunk_size, to = std::min(size, from + chunk_size);
    for (int j = 0; j < used; ++j) {
      const float y = static_cast<float>(right[j]);
      for (std::size_t i = from; i < to; ++i) x[i] += y * directions_[j][i];
    }
  });
  return report;
}

std::size_t SingleGmres::bytes() const {
  std::size_t count = 0;
  for (const auto* all : {&basis_, &directions_})
    for (const auto& v : *all) count += v.size();
  return count * sizeof(float);
}

}  // namespace fsi
