#include "monolithic/coupled_solvers/amg/vanka.hpp"

#include <algorithm>
#include <cstddef>

#include "algebra/block_products.hpp"
#include "monolithic/coupled_solvers/amg/galerkin.hpp"
#include "monolithic/coupled_solvers/amg/small_inverse.hpp"

namespace fsi {

template <int Size>
Vanka<Size>::Vanka(const Matrix& a, const VankaOptions& options)
    : options_(options),
      graph_(*a.graph),
      diagonal_(graph_.rows()),
      transposed_(transposed_positions(graph_)),
      block_inverse_(static_cast<std::size_t>(graph_.rows()) * n * n),
      schur_inverse_(graph_.rows()),
      residual_(static_cast<std::size_t>(graph_.rows()) * Size) {
  std::size_t largest = 0, total = 0;
  patch_offsets_.assign(1, 0);
  for (int i = 0; i < graph_.rows(); ++i) {
    diagonal_[i] = graph_.find(i, i);
    const std::size_t unknowns = static_cast<std::size_t>(graph_.offsets[i + 1] - graph_.offsets[i]) * n + 1;
    largest = std::max(largest, unknowns);
    total += unknowns * unknowns;
    patch_offsets_.push_back(total);
  }
  if (options_.patch == VankaPatch::full) patches_.resize(total);
  right_.resize(largest);
  change_.resize(largest);
}

template <int Size>
void Vanka<Size>::update(const Matrix& a) {
  const int rows = graph_.rows();
#pragma omp parallel for schedule(static) if (graph_.blocks() > 4000)
  for (int i = 0; i < rows; ++i) {
    const double* block = a.block(diagonal_[i]);
    double* inverse = &block_inverse_[static_cast<std::size_t>(i) * n * n];
    int pivots[n];
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) inverse[r * n + c] = options_.scaling * block[r * Size + c];
    invert_in_place(inverse, n, pivots);
  }
  if (options_.patch == VankaPatch::diagonal) {
#pragma omp parallel for schedule(static) if (graph_.blocks() > 4000)
    for (int i = 0; i < rows; ++i) {
      double schur = a.block(diagonal_[i])[Size * Size - 1];
      for (int at = graph_.offsets[i]; at < graph_.offsets[i + 1]; ++at) {
        const double* d = a.block(at) + n * Size;
        const double* g = a.block(transposed_[at]);
        const double* inverse = &block_inverse_[static_cast<std::size_t>(graph_.columns[at]) * n * n];
        for (int r = 0; r < n; ++r)
          for (int c = 0; c < n; ++c) schur -= d[r] * inverse[r * n + c] * g[c * Size + n];
      }
      schur_inverse_[i] = schur != 0 ? 1 / schur : 0;
    }
    return;
  }
#pragma omp parallel if (graph_.blocks() > 4000)
  {
    std::vector<double> dense(right_.size() * right_.size());
    std::vector<int> pivots(right_.size());
#pragma omp for schedule(dynamic, 32)
    for (int i = 0; i < rows; ++i) {
      const int first = graph_.offsets[i], count = graph_.offsets[i + 1] - first, size = count * n + 1;
      std::fill_n(dense.begin(), static_cast<std::size_t>(size) * size, 0.0);
      for (int p = 0; p < count; ++p) {
        const int row = graph_.columns[first + p];
        // Both rows ascend: one pass finds the common columns.
        for (int at = graph_.offsets[row], q = 0; at < graph_.offsets[row + 1] && q < count;) {
          const int column = graph_.columns[at], wanted = graph_.columns[first + q];
          if (column == wanted)
            for (int r = 0; r < n; ++r)
              for (int c = 0; c < n; ++c) dense[(p * n + r) * size + q * n + c] = a.block(at)[r * Size + c];
          if (column <= wanted) ++at;
          if (column >= wanted) ++q;
        }
        for (int r = 0; r < n; ++r) {
          dense[(p * n + r) * size + size - 1] = a.block(transposed_[first + p])[r * Size + n];
          dense[(size - 1) * size + p * n + r] = a.block(first + p)[n * Size + r];
        }
      }
      dense[size * size - 1] = a.block(diagonal_[i])[Size * Size - 1];
      const bool regular = invert_in_place(dense.data(), size, pivots.data());
      float* to = &patches_[patch_offsets_[i]];
      for (int k = 0; k < size * size; ++k) to[k] = regular ? static_cast<float>(dense[k]) : 0.0f;
    }
  }
}

template <int Size>
void Vanka<Size>::correct_patch(const Matrix& a, int node, std::vector<double>& x) {
  const int first = graph_.offsets[node], count = graph_.offsets[node + 1] - first;
  double* change = change_.data();
  double scalar_change = 0;
  if (options_.patch == VankaPatch::diagonal) {
    double right = residual_[static_cast<std::size_t>(node) * Size + n];
    for (int p = 0; p < count; ++p) {
      const int j = graph_.columns[first + p];
      const double* inverse = &block_inverse_[static_cast<std::size_t>(j) * n * n];
      const double* r = &residual_[static_cast<std::size_t>(j) * Size];
      const double* d = a.block(first + p) + n * Size;
      for (int k = 0; k < n; ++k) {
        double sum = 0;
        for (int c = 0; c < n; ++c) sum += inverse[k * n + c] * r[c];
        change[p * n + k] = sum;
        right -= d[k] * sum;
      }
    }
    scalar_change = right * schur_inverse_[node];
    for (int p = 0; p < count; ++p) {
      const double* inverse = &block_inverse_[static_cast<std::size_t>(graph_.columns[first + p]) * n * n];
      const double* g = a.block(transposed_[first + p]);
      for (int k = 0; k < n; ++k)
        for (int c = 0; c < n; ++c) change[p * n + k] -= inverse[k * n + c] * g[c * Size + n] * scalar_change;
    }
  } else {
    const int size = count * n + 1;
    for (int p = 0; p < count; ++p)
      for (int k = 0; k < n; ++k)
        right_[p * n + k] = residual_[static_cast<std::size_t>(graph_.columns[first + p]) * Size + k];
    right_[size - 1] = residual_[static_cast<std::size_t>(node) * Size + n];
    const float* inverse = &patches_[patch_offsets_[node]];
    for (int r = 0; r < size; ++r) {
      double sum = 0;
      for (int c = 0; c < size; ++c) sum += inverse[r * size + c] * right_[c];
      change[r] = sum;
    }
    scalar_change = change[size - 1];
  }
  const double damping = options_.damping;
  scalar_change *= damping;
  x[static_cast<std::size_t>(node) * Size + n] += scalar_change;
  for (int p = 0; p < count; ++p) {
    const int j = graph_.columns[first + p];
    double step[Size] = {};
    for (int k = 0; k < n; ++k) {
      step[k] = damping * change[p * n + k];
      x[static_cast<std::size_t>(j) * Size + k] += step[k];
    }
    if (j == node) step[n] = scalar_change;
    for (int at = graph_.offsets[j]; at < graph_.offsets[j + 1]; ++at) {
      const double* block = a.block(transposed_[at]);
      double* r = &residual_[static_cast<std::size_t>(graph_.columns[at]) * Size];
      for (int k = 0; k < Size; ++k)
        for (int c = 0; c < Size; ++c) r[k] -= block[k * Size + c] * step[c];
    }
  }
}

template <int Size>
void Vanka<Size>::smooth(const Matrix& a, const std::vector<double>& b, std::vector<double>& x, int steps,
                         bool backward, bool from_zero) {
  if (from_zero)
    std::copy(b.begin(), b.end(), residual_.begin());
  else
    residual(a, b, x, residual_);
  const int rows = graph_.rows();
  for (int step = 0; step < steps; ++step)
    for (int k = 0; k < rows; ++k) correct_patch(a, backward ? rows - 1 - k : k, x);
}

template <int Size>
std::size_t Vanka<Size>::bytes() const {
  return patches_.size() * sizeof(float) + (diagonal_.size() + transposed_.size()) * sizeof(int) +
         (block_inverse_.size() + schur_inverse_.size() + residual_.size()) * sizeof(double) +
         patch_offsets_.size() * sizeof(std::size_t);
}

template class Vanka<3>;
template class Vanka<4>;

}  // namespace fsi
