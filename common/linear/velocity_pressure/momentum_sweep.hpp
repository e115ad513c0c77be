#pragma once

#include <Eigen/LU>
#include <cstddef>
#include <vector>

#include "algebra/split_blocks.hpp"
#include "linear/amg/sweep_chunks.hpp"

namespace fsi {

/// One symmetric Gauss-Seidel sweep over n x n node blocks in place of the inverse of a momentum matrix, in single precision,
/// chunk by chunk (SweepChunks). Vectors hold padded<n> floats a node.
template <int n>
class MomentumSweep {
 public:
  static constexpr int lanes = padded<n>;
  using Nodal = Register<n>;

  /// \param matrix  must outlive this; its numbers may change
  /// \param rows    that are swept; columns behind them, of ghosts, count in product() alone
  /// \param processes  that sweep together
  MomentumSweep(const SplitBlocks<n>& matrix, int rows, int processes)
      : matrix_(matrix),
        chunks_(matrix, rows, SweepChunks::count_of_each(processes)),
        inverse_diagonal_(static_cast<std::size_t>(matrix.rows()) * n * lanes),
        upper_part_(static_cast<std::size_t>(matrix.rows()) * lanes) {}

  /// Of a node; to be told again when the matrix has changed.
  void set_diagonal(int v, const Eigen::Matrix<double, n, n>& diagonal) {
    const Eigen::Matrix<double, n, n> inverse = diagonal.inverse();
    float* to = inverse_diagonal_.data() + static_cast<std::size_t>(v) * n * lanes;
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < lanes; ++i) to[k * lanes + i] = i < n ? static_cast<float>(inverse(i, k)) : 0.0f;
  }
  void set_relaxation(double relaxation) { relaxation_ = static_cast<float>(relaxation); }

  /// x = (D/w + U)^-1 (2/w - 1) D (D/w + L)^-1 r within chunks, w being the relaxation and D the diagonal blocks.
  void apply(const std::vector<float>& r, std::vector<float>& x) {
    chunks_.forward([&](int v) {  // x = (D/w + L)^-1 r
      const std::size_t at = static_cast<std::size_t>(v) * lanes;
      const Nodal before = matrix_.lower_product(v, chunks_.first[v], chunks_.diagonal[v], x.data());
      store<n>(relaxation_ * solve_diagonal(v, load<n>(r.data() + at) - before), x.data() + at);
    });
    chunks_.backward([&](int v) {  // x = (2 - w) x - w D^-1 U x
      const std::size_t at = static_cast<std::size_t>(v) * lanes;
      const Nodal after = matrix_.upper_product(v, matrix_.upper_begin(v), chunks_.last[v], x.data());
      store<n>(after, upper_part_.data() + at);
      store<n>((2 - relaxation_) * load<n>(x.data() + at) - relaxation_ * solve_diagonal(v, after), x.data() + at);
    });
  }

  /// Row v of A x for the x of the last apply(r, x), U x being known from its backward part.
  Nodal product(int v, const float* x) const {
    const Nodal lower = matrix_.lower_product(v, matrix_.lower_begin(v), matrix_.lower_end(v), x);
    const Nodal beyond = matrix_.upper_product(v, chunks_.last[v], matrix_.upper_end(v), x);  // the chunk
    return load<n>(upper_part_.data() + static_cast<std::size_t>(v) * lanes) + lower + matrix_.diagonal_product(v, x) +
           beyond;
  }

  std::size_t bytes() const { return sizeof(float) * (inverse_diagonal_.size() + upper_part_.size()); }

 private:
  /// D^-1 r of a node.
  Nodal solve_diagonal(int v, Nodal r) const {
    const float* inverse = inverse_diagonal_.data() + static_cast<std::size_t>(v) * n * lanes;
    Nodal sum{};
    for (int k = 0; k < n; ++k) sum += load<n>(inverse + k * lanes) * r[k];
    return sum;
  }

  const SplitBlocks<n>& matrix_;
  SweepChunks chunks_;
  float relaxation_ = 1;
  std::vector<float> inverse_diagonal_;  ///< n columns of `lanes` numbers a node
  std::vector<float> upper_part_;        ///< U x of the last sweep
};

}  // namespace fsi
