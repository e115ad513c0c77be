#pragma once

#include <string>
#include <vector>

#include "algebra/csr_matrix.hpp"
#include "linear/amg/sweep_chunks.hpp"
#include "parallel/exchange.hpp"

namespace fsi {

/// One V-cycle of smoothed aggregation [Vanek1996] for a scalar matrix like a Laplacian, in single
/// precision: a preconditioner. Gauss-Seidel forward before the coarse correction and, if wanted, backward after it;
/// dense inverse on the coarsest level. Where processes share the rows out, each smooths and aggregates its own ones;
/// residuals, interpolation and coarse matrices are those of the whole.
class ScalarMultigrid {
 public:
  struct Options {
    double threshold = 0.08;      ///< of strong couplings, |a_ij| > threshold sqrt(|a_ii a_jj|); halved on each level
    double damping = 4.0 / 3;     ///< of the prolongation's Jacobi step, over the largest eigenvalue of D^-1 A
    int coarsest_size = 300;      ///< unknowns of the level that is inverted
    int levels = 20;              ///< at most, the finest and the coarsest among them
    bool post_smoothing = false;  ///< a backward sweep after the coarse correction: costs as much as all the rest
  };

  /// Makes all levels anew. By all processes together.
  /// \param matrix  own rows; columns of copies behind those of own rows
  /// \param share   of rows and columns
  /// \throws ConvergenceError when the coarsest matrix is singular
  void set_up(const CsrMatrix<double>& matrix, const ShareOfNumbers& share, const Options& options);
  void set_up(const CsrMatrix<double>& matrix, const Options& options) {
    set_up(matrix, ShareOfNumbers(Communicator::alone(), matrix.rows(), {}), options);
  }
  void set_up(const CsrMatrix<double>& matrix) { set_up(matrix, Options()); }
  /// x = M b in own rows, overwritten.
  void cycle(const std::vector<float>& b, std::vector<float>& x) { cycle_each<1>(b, x); }
  /// The same for m vectors at once, m = 1, 2 or 3: a row holds padded<m> floats (algebra/register_blocks.hpp), one for
  /// m = 1.
  template <int m>
  void cycle_each(const std::vector<float>& b, std::vector<float>& x);

  int levels() const { return static_cast<int>(levels_.size()) + 1; }
  double operator_complexity() const { return complexity_; }
  std::size_t bytes() const;

 private:
  struct Level {
    CsrMatrix<float> matrix, prolongation, restriction;  ///< rows of restriction: of copies, too
    ShareOfNumbers share;
    SweepChunks chunks;
    std::vector<float> inverse_diagonal;
    std::vector<float> residual, coarse_residual, coarse_correction;
  };

  const ShareOfNumbers& share(std::size_t level) const {
    return level < levels_.size() ? levels_[level].share : coarsest_share_;
  }
  template <int m>
  void cycle_from(std::size_t depth, const std::vector<float>& b, std::vector<float>& x);
  template <int m>
  void solve_coarsest(const std::vector<float>& b, std::vector<float>& x);
  void invert_coarsest(CsrMatrix<double> matrix, const ShareOfNumbers& share);

  std::vector<Level> levels_;
  std::vector<float> finest_;  ///< x with places for copies
  const Communicator* processes_ = &Communicator::alone();
  ShareOfNumbers coarsest_share_;
  std::vector<int> coarsest_counts_;     ///< rows of each process
  std::vector<float> coarsest_inverse_;  ///< own rows, dense, column-major
  std::vector<float> coarsest_right_;    ///< of all processes
  double complexity_ = 0;
  bool post_smoothing_ = false;
};

}  // namespace fsi
