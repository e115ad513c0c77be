#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "algebra/register_blocks.hpp"
#include "linear/amg/sweep_chunks.hpp"
#include "parallel/exchange.hpp"

namespace fsi {

/// Coarse levels for elasticity: smoothed aggregation with the rigid motions [Vanek1996], in single
/// precision. The finest level is smoothed by its owner; on coarse ones block Gauss-Seidel runs forward before the
/// coarse correction and, if wanted, backward after it; dense inverse on the coarsest level. Among processes as
/// ScalarMultigrid.
/// \tparam n  components of a node. In three dimensions coarse nodes hold three translations and three rotations,
///            else the n translations
template <int n>
class RigidMotionMultigrid {
 public:
  static constexpr int modes = n == 3 ? 6 : n;

  struct Options {
    double threshold = 0.08;      ///< of strong couplings, |A_ij| > threshold sqrt(|A_ii| |A_jj|); halved on each level
    double damping = 4.0 / 3;     ///< of the prolongation's Jacobi step, over the largest eigenvalue of D^-1 A
    int coarsest_nodes = 50;      ///< of the level that is inverted
    int levels = 20;              ///< at most, between the finest and the coarsest
    bool post_smoothing = false;  ///< a backward sweep after the coarse correction, on coarse levels
  };

  /// Makes all levels anew. By all processes together.
  /// \param finest  own rows; columns of copies behind those of own rows
  /// \param share   of rows and columns
  /// \param points  places of own nodes, in any unit of length
  /// \param fixed   per node and component: its row is the identity's times a number, its column zero elsewhere, and no
  ///                rigid motion moves it; empty: none is
  /// \throws ConvergenceError at all processes when the coarsest matrix or a diagonal block of a coarse level is
  ///         singular
  void set_up(const BlockMatrix<n, n>& finest, const ShareOfNumbers& share,
              const std::vector<std::array<double, 3>>& points, const Options& options,
              const std::vector<char>& fixed = {});
  void set_up(const BlockMatrix<n, n>& finest, const std::vector<std::array<double, 3>>& points, const Options& options,
              const std::vector<char>& fixed = {}) {
    set_up(finest, ShareOfNumbers(Communicator::alone(), finest.graph->rows(), {}), points, options, fixed);
  }

  /// velocity += P M R residual, M being a cycle on the coarse levels. Both hold padded<n> floats for each own node. By
  /// all processes together.
  void correct(const std::vector<float>& residual, std::vector<float>& velocity);

  int levels() const { return !coarsens_ ? 1 : static_cast<int>(levels_.size()) + 2; }
  std::size_t bytes() const;

 private:
  static constexpr int lanes = padded<modes>;

  struct Level {
    RegisterBlocks<modes, modes> matrix, prolongation, restriction;
    ShareOfNumbers share;
    SweepChunks chunks;
    std::vector<float> inverse_diagonal;  ///< blocks
    std::vector<float> b, x, residual;    ///< of the first two copies, too
  };

  std::vector<float>& b(std::size_t level) { return level < levels_.size() ? levels_[level].b : coarsest_b_; }
  const ShareOfNumbers& share(std::size_t level) const {
    return level < levels_.size() ? levels_[level].share : coarsest_share_;
  }
  std::vector<float>& x(std::size_t level) { return level < levels_.size() ? levels_[level].x : coarsest_x_; }
  void invert_coarsest(BlockMatrix<modes, modes> a, const ShareOfNumbers& share);
  void solve_coarsest();
  void cycle(std::size_t depth);

  RegisterBlocks<modes, n> restriction_;   ///< to the first coarse level
  RegisterBlocks<n, modes> prolongation_;  ///< from it
  std::vector<Level> levels_;              ///< between the finest and the coarsest
  bool coarsens_ = false;                  ///< there are coarse levels
  const Communicator* processes_ = &Communicator::alone();
  ShareOfNumbers coarsest_share_;
  std::vector<int> coarsest_counts_;     ///< floats of each process's right side
  std::vector<float> coarsest_inverse_;  ///< own rows, dense, column-major
  std::vector<float> coarsest_b_, coarsest_x_, coarsest_right_, dense_x_;
  bool post_smoothing_ = false;
};

}  // namespace fsi
