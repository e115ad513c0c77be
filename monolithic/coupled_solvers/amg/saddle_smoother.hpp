#pragma once

#include <cstddef>
#include <vector>

#include "algebra/block_matrix.hpp"

namespace fsi {

/// A smoother for [A G; D E] (u, p) = (f, g), blocks of Size - 1 vector entries and one scalar a node. In the notation
/// of the literature G = B^T, D = B, E = -C.
template <int Size>
class SaddleSmoother {
 public:
  using Matrix = BlockMatrix<Size, Size>;

  virtual ~SaddleSmoother() = default;
  /// The matrix holds new values on the same pattern.
  virtual void update(const Matrix& a) = 0;
  /// `steps` smoothing steps on x.
  /// \param a          the matrix of the last update()
  /// \param backward   unknowns in reverse order: for post-smoothing
  /// \param from_zero  x is zero
  virtual void smooth(const Matrix& a, const std::vector<double>& b, std::vector<double>& x, int steps, bool backward,
                      bool from_zero) = 0;
  virtual std::size_t bytes() const = 0;
};

}  // namespace fsi
